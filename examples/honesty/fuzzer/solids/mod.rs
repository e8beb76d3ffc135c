//! The check of solids: facts, forms of faces, sides, signed distances on grids, statistics and volumes in common, each by a
//! second way, that none is said to meet itself, nor to be embedded if it does, and that each is a void of a box about it.

mod draw;
mod embedding;
mod facts;
mod forms;
mod frames;
mod grids;
mod moments;
mod overlap;
mod sides;
mod statistics;
mod voids;

use super::check::Outcome;
use fastrand::Rng;
use nurbs_hausdorff::internals::engine::PreparedModel;
use std::time::Instant;

pub(crate) use draw::Shapes;
pub(crate) use statistics::violations as violations_of_statistics;

/// The seeds between two whose statistics and volumes in common are checked too: these take longer than the rest.
const PAIR_EVERY: u64 = 2;

/// Checks the solid of a seed: a shape of the catalogue under an affine or a projective map.
pub(crate) fn check_solid(seed: u64, shapes: &Shapes) -> Outcome {
    let rng = &mut Rng::with_seed(seed);
    let not_drawn = || Outcome { refusal: Some("NOT_DRAWN"), ..Outcome::default() };
    let Some((name, model)) = shapes.draw(rng) else { return not_drawn() };
    let Ok(prepared) = PreparedModel::new(&model) else { return not_drawn() };
    let started = Instant::now();
    let mut violations = facts::violations(&prepared, &model);
    let seconds = started.elapsed().as_secs_f64();
    // By numbers of their own: those of the checks below are the ones of recorded runs.
    violations.extend(forms::violations(&mut Rng::with_seed(seed), &model));
    let (grid, undecided) = grids::violations(rng, &prepared, &model);
    violations.extend(grid);
    violations.extend(sides::violations(rng, &prepared, &model));
    violations.extend(embedding::violations(&mut Rng::with_seed(seed), &prepared));
    violations.extend(voids::violations(&mut Rng::with_seed(seed), &prepared, &model));
    let mut outcome = Outcome::default();
    if seed.is_multiple_of(PAIR_EVERY)
        && let Some((_, other)) = shapes.draw(rng)
    {
        let (found, audited) = statistics::violations(rng, [&model, &other]);
        violations.extend(found);
        outcome.audited = audited;
        violations.extend(overlap::violations(rng, [&model, &other]));
    }
    Outcome {
        converged: true,
        seconds,
        undecided: usize::from(undecided > 0),
        violations: violations.into_iter().map(|what| format!("seed {seed} ({name}): {what}")).collect(),
        ..outcome
    }
}
