//! One pair, every position, every method.

use super::methods::{Entry, methods};
use super::pairs::Pair;
use super::plan::Plan;
use super::{Anyhow, Cell, Setup, Table};
use nurbs_hausdorff::distance::{DistanceResult, Options, PreparedModel};
use nurbs_hausdorff::flatness::Flatness;
use std::time::Instant;

/// What one method gave at one position.
#[derive(Debug, Clone)]
pub(crate) struct Outcome {
    pub(crate) position: f64,
    /// The result, or why there is none: an error's code, or "left-out".
    pub(crate) result: Result<DistanceResult, &'static str>,
    /// How long the first run took, uploads included, in seconds.
    took: f64,
}

/// A method's outcomes in the order of the positions.
#[derive(Debug)]
pub(crate) struct Curve {
    pub(crate) method: Entry,
    pub(crate) outcomes: Vec<Outcome>,
}

/// Runs every method at every position, the methods in turn; what is short
/// enough again, position after position, and tells the shortest of the times:
/// other work on the machine only adds, and what lasts for a while meets a
/// position once.
pub(crate) fn sweep(setup: &Setup, plan: &Plan, pair: &Pair) -> Anyhow<Vec<Curve>> {
    let (a, b) = (PreparedModel::new(&pair.a), PreparedModel::new(&pair.b));
    let mut curves: Vec<Curve> = methods(setup.choose(64, 12))
        .into_iter()
        .map(|method| Curve { method, outcomes: Vec::new() })
        .collect();
    let positions = pair.positions(setup.choose(21, 5));
    for (index, &position) in positions.iter().enumerate() {
        let in_the_middle = index == positions.len() / 2;
        for curve in &mut curves {
            let options = Options { transform: pair.at(position)?, ..curve.method.options.clone() };
            let many = curve.method.on_all_patches && projections(&a, &b, &options) > plan.most_projections;
            let begun = Instant::now();
            let result = if !many || (in_the_middle && options.flatness == Flatness::None) {
                setup.measure(&a, &b, &options).map_err(|error| error.code())
            } else {
                Err("left-out")
            };
            let took = begun.elapsed().as_secs_f64();
            curve.outcomes.push(Outcome { position, result, took });
        }
    }
    for round in 1..setup.choose(plan.most_rounds, 1) {
        for (index, &position) in positions.iter().enumerate() {
            for Curve { method, outcomes } in &mut curves {
                let Outcome { result: Ok(result), took, .. } = &mut outcomes[index] else { continue };
                if round as f64 * *took < plan.repeated_seconds {
                    let shortest = &mut result.seconds.solve;
                    let options = Options { transform: pair.at(position)?, ..method.options.clone() };
                    *shortest = shortest.min(setup.measure(&a, &b, &options)?.seconds.solve);
                }
            }
        }
    }
    Ok(curves)
}

/// Projections that a method takes which tries every patch that extraction
/// gives; flatter patches are more.
fn projections(a: &PreparedModel, b: &PreparedModel, options: &Options) -> usize {
    a.bezier().grids.len() * options.samples * options.samples * b.bezier().patches.len()
}

/// A row for every method and position.
pub(crate) fn table(plan: &Plan, curves: &[Curve]) -> Table {
    let mut table = Table::new(&plan.columns);
    for curve in curves {
        for Outcome { position, result, .. } in &curve.outcomes {
            let found = result.as_ref().ok();
            let number = |of: &dyn Fn(&DistanceResult) -> f64| Cell::from(found.map(of));
            let bounds = found.and_then(|result| result.iteration).map(|details| details.bounds);
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
                found.and_then(|result| result.certified).map(|details| details.cells).into(),
                found.map(|result| result.patches.b).into(),
                result.as_ref().err().copied().into(),
            ]);
        }
    }
    table
}
