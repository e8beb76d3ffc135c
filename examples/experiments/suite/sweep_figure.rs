//! Times, distances and differences by position (the 2012 paper's Figs 6 to 11).

use super::chart::{Axis, Panel, Series, Style};
use super::pairs::{Pair, pairs};
use super::sweep::{Curve, sweep, table};
use super::{Anyhow, Setup};
use nurbs_hausdorff::distance::DistanceResult;

/// Every pair: `sweep-NAME`.
pub(crate) fn run(setup: &Setup) -> Anyhow<()> {
    for pair in pairs(setup)? {
        let curves = sweep(setup, &pair)?;
        setup.save(&format!("sweep-{}", pair.name), &table(&curves), &panels(&pair, &curves))?;
    }
    Ok(())
}

fn panels(pair: &Pair, curves: &[Curve]) -> [Panel; 3] {
    let along = || Axis::linear("position of A's centre from B's, model units");
    [
        Panel {
            title: pair.title.clone(),
            x: along(),
            y: Axis::logarithmic("solve time, seconds"),
            series: each(curves, |result| result.seconds.solve),
        },
        Panel {
            title: "Directed distance from A to B".to_owned(),
            x: along(),
            y: Axis::linear("computed distance, model units"),
            series: each(curves, |result| result.computed),
        },
        Panel {
            title: "Distance less that of `certified`, with bounds".to_owned(),
            x: along(),
            y: Axis::linear("difference, model units"),
            series: differences(curves),
        },
    ]
}

/// One number of every result, a curve a method; a failure is a gap.
fn each(curves: &[Curve], of: impl Fn(&DistanceResult) -> f64) -> Vec<Series> {
    curves
        .iter()
        .enumerate()
        .map(|(color, curve)| series(color, curve, Style::Marked, "", |result, _| Some(of(result))))
        .collect()
}

/// What the methods computed less the certified distance, and where the
/// bounds of the iteration say that the certified distance can be.
fn differences(curves: &[Curve]) -> Vec<Series> {
    let Some((certified, others)) = curves.split_first() else { return Vec::new() };
    let truth: Vec<Option<f64>> = certified
        .outcomes
        .iter()
        .map(|outcome| outcome.result.as_ref().ok().map(|result| 0.5 * (result.lower + result.upper)))
        .collect();
    let less_truth = |index: usize, value: f64| truth[index].map(|truth| value - truth);
    let mut all = Vec::new();
    for (color, curve) in (1..).zip(others) {
        all.push(series(color, curve, Style::Marked, "", |result, index| {
            less_truth(index, result.computed)
        }));
    }
    // The bounds of the paper are those of its loose flatness; K_A is the same in all.
    let bounds = |result: &DistanceResult| result.iteration.map(|details| details.bounds);
    if let Some((color, loose)) = (1..).zip(others).find(|(_, curve)| curve.method.name.ends_with("loose")) {
        all.push(series(color, loose, Style::Dashed, " + K_A", |result, index| {
            less_truth(index, result.computed + bounds(result)?.k_a)
        }));
        all.push(series(color + 3, loose, Style::Dashed, " - K_B", |result, index| {
            less_truth(index, result.computed - bounds(result)?.k_b?)
        }));
        all.push(series(6, loose, Style::Dashed, " + rigorous K_A", |result, index| {
            less_truth(index, result.computed + bounds(result)?.k_a_rigorous)
        }));
    }
    all
}

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
