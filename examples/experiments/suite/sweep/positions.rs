//! The results of all methods on one pair at all positions.

use super::super::inputs::pairs::Pair;
use super::super::inputs::plan::Plan;
use super::super::methods::{Entry, methods};
use super::super::{Anyhow, Cell, Setup, Table};
use nurbs_hausdorff::Error;
use nurbs_hausdorff::internals::engine::{
    DistanceOptions, DistanceResult, IterationOptions, Method, PreparedModel,
};
use nurbs_hausdorff::internals::flatness::Flatness;
use std::time::Instant;

/// The outcome of one method at one position.
#[derive(Debug, Clone)]
pub(crate) struct Outcome {
    pub(crate) position: f64,
    /// The result, or the reason for its absence: an error's code, or "left-out".
    pub(crate) result: Result<DistanceResult, &'static str>,
}

/// The outcomes of one method in the order of the positions.
#[derive(Debug)]
pub(crate) struct Curve {
    pub(crate) method: Entry,
    pub(crate) outcomes: Vec<Outcome>,
}

/// Runs one method after another, each at every position, as a method on the CPU
/// takes longer right after one on the GPU, whose threads are still active. Several
/// passes over the positions average out temporary load of the machine.
pub(crate) fn sweep(setup: &Setup, plan: &Plan, pair: &Pair) -> Anyhow<Vec<Curve>> {
    let (a, b) = (PreparedModel::new(&pair.a)?, PreparedModel::new(&pair.b)?);
    let positions = pair.positions(setup.choose(21, 5));
    let mut curves = Vec::new();
    for method in methods(setup.choose(64, 12)) {
        let at = |position| -> Anyhow<DistanceOptions> {
            Ok(DistanceOptions { transform: pair.at(position)?, ..method.options.clone() })
        };
        let mut outcomes = Vec::new();
        for (index, &position) in positions.iter().enumerate() {
            let is_middle = index == positions.len() / 2;
            let options = at(position)?;
            let is_large = method.on_all_patches && projections(&a, &b, &options) > plan.most_projections;
            let result = if !is_large || (is_middle && is_uncut(options.method)) {
                repeated(setup, plan, &a, &b, &options).map_err(|error| error.code())
            } else {
                Err("left-out")
            };
            outcomes.push(Outcome { position, result });
        }
        for _ in 1..setup.choose(plan.passes, 1) {
            for Outcome { position, result } in &mut outcomes {
                let Ok(DistanceResult { seconds, .. }) = result else { continue };
                if seconds.solve < plan.repeated_seconds {
                    let repetition = repeated(setup, plan, &a, &b, &at(*position)?)?.seconds.solve;
                    seconds.solve = seconds.solve.min(repetition);
                }
            }
        }
        curves.push(Curve { method, outcomes });
    }
    Ok(curves)
}

/// Returns the number of projections of a method that tries every patch of the
/// extraction; subdivision adds patches.
fn projections(a: &PreparedModel, b: &PreparedModel, options: &DistanceOptions) -> usize {
    let patches: usize = b.patch_counts().map(|[rows, columns]| rows * columns).sum();
    a.patch_counts().len() * options.samples * options.samples * patches
}

/// Returns the result with the shortest of several times, as other load of the
/// machine only adds.
fn repeated(
    setup: &Setup,
    plan: &Plan,
    a: &PreparedModel,
    b: &PreparedModel,
    options: &DistanceOptions,
) -> Result<DistanceResult, Error> {
    let begun = Instant::now();
    let mut result = setup.measure(a, b, options)?;
    for _ in 1..setup.choose(plan.rounds, 1) {
        if begun.elapsed().as_secs_f64() > plan.repeated_seconds {
            break;
        }
        let repetition = setup.measure(a, b, options)?.seconds.solve;
        result.seconds.solve = result.seconds.solve.min(repetition);
    }
    Ok(result)
}

/// Returns a table with a row for every method and position.
pub(crate) fn table(plan: &Plan, curves: &[Curve]) -> Table {
    let mut table = Table::new(&plan.columns);
    for curve in curves {
        for Outcome { position, result } in &curve.outcomes {
            let found = result.as_ref().ok();
            let number = |value: &dyn Fn(&DistanceResult) -> f64| Cell::from(found.map(value));
            let bounds = found.and_then(|result| result.iteration()).map(|details| details.bounds);
            table.rows.push(vec![
                (*position).into(),
                curve.method.name.into(),
                number(&|result| result.computed),
                number(&|result| result.lower),
                number(&|result| result.upper),
                bounds.map(|bounds| bounds.k_a).into(),
                bounds.map(|bounds| bounds.k_a_rigorous).into(),
                bounds.and_then(|bounds| bounds.k_b).into(),
                found.map(|result| if result.converged { "yes" } else { "no" }).into(),
                number(&|result| result.seconds.solve),
                number(&|result| result.seconds.prepare),
                found.and_then(|result| result.certified()).map(|details| details.cells).into(),
                found.map(|result| result.patches.b).into(),
                result.as_ref().err().copied().into(),
            ]);
        }
    }
    table
}

/// Whether B is projected on as it is.
fn is_uncut(method: Method) -> bool {
    matches!(method, Method::Iteration(IterationOptions { flatness: Flatness::None, .. }))
}
