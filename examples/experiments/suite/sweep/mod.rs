//! Times, distances and differences by position, as in the 2012 paper's Figs 6 to 11.

mod positions;

use super::chart::{Axis, Panel, Series, Style};
use super::inputs::pairs::{Pair, pairs};
use super::inputs::plan::Plan;
use super::{Anyhow, Setup};
use nurbs_hausdorff::internals::engine::{DistanceResult, MethodName};
use positions::{Curve, sweep, table};

/// `sweep-NAME`: runs every requested pair.
pub(crate) fn run(setup: &Setup) -> Anyhow<()> {
    let plan = Plan::read()?;
    for pair in pairs(setup, &plan)? {
        let name = format!("sweep-{}", pair.name);
        if !setup.is_requested(&name) {
            continue;
        }
        let curves = sweep(setup, &plan, &pair)?;
        setup.save(&name, &table(&plan, &curves), &panels(&pair, &curves))?;
    }
    Ok(())
}

fn panels(pair: &Pair, curves: &[Curve]) -> [Panel; 4] {
    let along = || Axis::linear("position of A's centre relative to B's, model units");
    [
        Panel {
            title: pair.title.clone(),
            x: along(),
            y: Axis::logarithmic("solve time, seconds"),
            series: each(curves, Style::Marked, |result, _| Some(result.seconds.solve)),
        },
        Panel {
            title: "Directed distance from A to B".to_owned(),
            x: along(),
            y: Axis::linear("distance, model units"),
            series: each(curves, Style::Line, |result, _| Some(result.computed)),
        },
        Panel {
            title: "Difference from the certified distance, with bounds".to_owned(),
            x: along(),
            y: Axis::linear("difference, model units"),
            series: bounds(curves),
        },
        Panel {
            title: "Absolute difference".to_owned(),
            x: along(),
            y: Axis::logarithmic("difference, model units"),
            series: sizes(curves),
        },
    ]
}

/// Returns one curve per method, of one number per result; a failure is a gap.
fn each(
    curves: &[Curve],
    style: Style,
    value: impl Fn(&DistanceResult, usize) -> Option<f64>,
) -> Vec<Series> {
    curves.iter().enumerate().map(|(color, curve)| series(color, curve, style, "", &value)).collect()
}

/// Returns the certified distances, the middles of the intervals.
fn truth(curves: &[Curve]) -> Vec<Option<f64>> {
    let middle = |result: &DistanceResult| 0.5 * (result.lower + result.upper);
    let outcomes = curves.first().map_or(&[][..], |certified| &certified.outcomes);
    outcomes.iter().map(|outcome| outcome.result.as_ref().ok().map(middle)).collect()
}

/// Returns the computed distances and the bounds of all methods, less the certified
/// distance.
fn bounds(curves: &[Curve]) -> Vec<Series> {
    let truth = truth(curves);
    let difference = |index: usize, value: f64| truth[index].map(|truth| value - truth);
    let mut all = each(curves, Style::Line, |result, index| difference(index, result.computed));
    let bounds_of = |result: &DistanceResult| result.iteration().map(|details| details.bounds);
    for (color, curve) in curves.iter().enumerate() {
        let dashed = |suffix: &str, value: &dyn Fn(&DistanceResult) -> Option<f64>| {
            series(color, curve, Style::Dashed, suffix, |result, index| difference(index, value(result)?))
        };
        // K_A is that of the samples, whatever the flatness; K_B hardly differs.
        if curve.method.name.ends_with("loose") {
            all.push(dashed(" + K_A", &|result| Some(result.computed + bounds_of(result)?.k_a)));
            all.push(dashed(" - K_B", &|result| Some(result.computed - bounds_of(result)?.k_b?)));
        }
        if curve.method.name == "hierarchy" {
            all.push(dashed(": upper", &|result| Some(result.upper)));
            all.push(dashed(": lower", &|result| Some(result.lower)));
        }
    }
    all
}

/// Returns the distance of each method's result from the certified one; for method
/// `certified` itself, half the width of its interval.
fn sizes(curves: &[Curve]) -> Vec<Series> {
    let truth = truth(curves);
    each(curves, Style::Line, |result, index| match result.method() {
        MethodName::Certified => Some(0.5 * (result.upper - result.lower)),
        _ => truth[index].map(|truth| (result.computed - truth).abs()),
    })
}

/// Returns the curve of one method.
fn series(
    color: usize,
    curve: &Curve,
    style: Style,
    suffix: &str,
    value: impl Fn(&DistanceResult, usize) -> Option<f64>,
) -> Series {
    let points = curve
        .outcomes
        .iter()
        .enumerate()
        .map(|(index, outcome)| {
            let value = value(outcome.result.as_ref().ok()?, index)?;
            Some([outcome.position, value])
        })
        .collect();
    Series::new(format!("{}{suffix}", curve.method.name), color, style, points)
}
