//! The check of one pair: the computation, and both directions of its result.

mod areas;
mod decoy;
mod direction;
mod farther_points;
mod measurement;
mod proofs;

use self::direction::Direction;
use self::measurement::{is_refusal, measure};
use super::attacks;
use super::pairs::{Pair, pair, reparametrized_pair};
use super::solids::violations_of_statistics;
use super::trims;
use fastrand::Rng;
use nurbs_hausdorff::internals::engine::{DistanceOptions, DistanceResult};
use nurbs_hausdorff::options::Audit;
use nurbs_hausdorff::result::Lemma;
use nurbs_hausdorff::{CertifiedOptions, HierarchyOptions, Method, MethodName};
use std::collections::BTreeMap;
use std::time::Instant;

/// Samples of method `iteration` and cells of method `hierarchy` along each direction.
const SAMPLES_OF_ITERATION: usize = 12;
const GRID_OF_HIERARCHY: usize = 16;

/// One pair in so many has its statistics checked.
const STATISTICS_OF: u64 = 16;

/// The refusal of a pair for which no valid model was drawn.
const NOT_DRAWN: &str = "NOT_DRAWN";

/// The outcome of the check of a pair.
#[derive(Default)]
pub(crate) struct Outcome {
    pub(crate) converged: bool,
    pub(crate) cells: usize,
    /// The seconds of the computation, without the check.
    pub(crate) seconds: f64,
    /// The code of the error by which the library refused the pair.
    pub(crate) refusal: Option<&'static str>,
    pub(crate) violations: Vec<String>,
    /// Directions with points that were neither found within `upper` nor proved farther.
    pub(crate) undecided: usize,
    /// The numbers of cells whose bounds were audited, by lemma.
    pub(crate) audited: BTreeMap<Lemma, usize>,
}

/// Checks the pair of a seed of the ordinary families.
pub(crate) fn check(seed: u64) -> Outcome {
    check_pair(seed, &pair(seed))
}

/// Checks the pair of a seed of the attack's families.
pub(crate) fn check_attack(seed: u64) -> Outcome {
    check_drawn(seed, attacks::pair(seed))
}

/// Checks the pair of a seed of collapsed nets.
pub(crate) fn check_collapsed(seed: u64) -> Outcome {
    check_drawn(seed, attacks::collapsed_pair(seed))
}

/// Checks the pair of a seed of surfaces in other parameters.
pub(crate) fn check_reparametrized(seed: u64) -> Outcome {
    check_pair(seed, &reparametrized_pair(seed))
}

fn check_drawn(seed: u64, pair: Option<Pair>) -> Outcome {
    pair.map_or_else(
        || Outcome { refusal: Some(NOT_DRAWN), ..Outcome::default() },
        |pair| check_pair(seed, &pair),
    )
}

/// Checks the pair of a seed of trimmed models.
pub(crate) fn check_trimmed(seed: u64) -> Outcome {
    trims::pair(seed).map_or_else(
        || Outcome { refusal: Some(NOT_DRAWN), ..Outcome::default() },
        |pair| {
            let mut outcome = check_pair(seed, &pair);
            for (name, model) in [("A", &pair.a), ("B", &pair.b)] {
                let fault = trims::fault(model).map(|fault| format!("seed {seed}: {name}: {fault}"));
                outcome.violations.extend(fault);
            }
            outcome
        },
    )
}

fn method(pair: &Pair) -> Method {
    match pair.method {
        MethodName::Certified => {
            let audit = Audit::All;
            Method::Certified(CertifiedOptions {
                max_cells: Some(pair.max_cells),
                audit,
                ..Default::default()
            })
        }
        MethodName::Hierarchy => {
            Method::Hierarchy(HierarchyOptions { grid: GRID_OF_HIERARCHY, ..Default::default() })
        }
        other => other.into(),
    }
}

/// What the audit of a result refuted.
fn refuted(result: &DistanceResult) -> Option<String> {
    let struck = result.certified()?.audit.struck;
    (!struck.is_empty()).then(|| result.notice.clone().unwrap_or_default())
}

/// The numbers of cells audited by lemma.
fn audited(result: &DistanceResult) -> BTreeMap<Lemma, usize> {
    let Some(details) = result.certified() else { return BTreeMap::new() };
    let counts = Lemma::ALL.into_iter().map(|lemma| (lemma, details.audit.cells_of(lemma)));
    counts.filter(|(_, count)| *count > 0).collect()
}

fn check_pair(seed: u64, pair: &Pair) -> Outcome {
    let started = Instant::now();
    let diagonal = pair.a.bounding_box().diagonal().max(pair.b.bounding_box().diagonal());
    let options = DistanceOptions {
        // Two points have no diagonal for a relative tolerance.
        tolerance: (diagonal == 0.0).then_some(pair.tolerance),
        relative_tolerance: (diagonal != 0.0).then_some(pair.tolerance),
        transform: pair.transform,
        symmetric: pair.symmetric,
        limit: pair.limit.map(|limit| limit * diagonal),
        method: method(pair),
        samples: SAMPLES_OF_ITERATION,
        backend: pair.backend,
        ..DistanceOptions::default()
    };
    let (result, deviations) = match measure(pair, &options) {
        Ok(measured) => measured,
        Err(error) => {
            let violations =
                if is_refusal(&error) { Vec::new() } else { vec![format!("seed {seed}: {error}")] };
            return Outcome { refusal: Some(error.code()), violations, ..Outcome::default() };
        }
    };
    let seconds = started.elapsed().as_secs_f64();
    let directions = [(Some(&result), false), (result.reverse.as_deref(), true)];
    let mut violations: Vec<String> = refuted(&result)
        .into_iter()
        .chain(decoy::violation(seed, pair))
        .chain(areas::violations(seed, pair))
        .collect();
    let mut audited = audited(&result);
    if seed % STATISTICS_OF < 2 && pair.exponent == 0 && !pair.a.is_trimmed() && !pair.b.is_trimmed() {
        let (found, parts) = violations_of_statistics(&mut Rng::with_seed(seed), [&pair.a, &pair.b]);
        violations.extend(found);
        audited.extend(parts);
    }
    let mut undecided = 0;
    for (directed, reversed) in directions {
        let Some(directed) = directed else { continue };
        let directed = if reversed { directed } else { result.forward.as_deref().unwrap_or(directed) };
        let direction = Direction::new(pair, directed, &options, reversed, deviations);
        violations.extend(direction.violations(&mut Rng::with_seed(seed)));
        undecided += usize::from(direction.undecided.get() > 0);
    }
    Outcome {
        converged: result.converged,
        cells: result.certified().map_or(0, |details| details.cells),
        seconds,
        audited,
        refusal: None,
        undecided,
        violations: violations
            .into_iter()
            .map(|what| format!("seed {seed} ({}): {what}", pair.kind))
            .collect(),
    }
}
