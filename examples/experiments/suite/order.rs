//! The growth of the work of `certified` with the requested tolerance.

use super::chart::{Axis, Panel, Series, Style};
use super::inputs::models::models_of;
use super::methods::certified;
use super::{Anyhow, Setup, Table};
use glam::DVec3;
use nurbs_hausdorff::internals::engine::{DistanceOptions, PreparedModel};
use nurbs_hausdorff::shapes::{shape, sphere_parts};
use nurbs_hausdorff::{CertifiedOptions, Method, Model, RigidTransform};

/// The number of tolerances per order of magnitude, the first, and their number.
const STEPS_PER_DECADE: f64 = 2.0;
const FIRST_TOLERANCE: f64 = 1e-2;
const TOLERANCES: usize = 11;

/// The number of cells after which a pair ends at its last tolerance: about ten seconds.
const MAX_CELLS: usize = 3_000_000;

/// The expected exponent on exact offsets, where halving a cell makes four of one
/// and bounds eight times as close.
const SLOPE: f64 = -2.0 / 3.0;

const COLUMNS: [&str; 7] = ["pair", "tolerance", "cells", "levels", "seconds_solve", "lower", "upper"];

struct Case {
    name: &'static str,
    models: [Model; 2],
    translation: DVec3,
    /// Whether all points of A are equally far from B.
    offset: bool,
}

/// `order`: the number of cells by tolerance, on exact offsets and on other pairs.
pub(crate) fn run(setup: &Setup) -> Anyhow<()> {
    let mut table = Table::new(&COLUMNS);
    let (mut offsets, mut others) = (Vec::new(), Vec::new());
    for case in cases(setup)? {
        let points = measure(setup, &case, &mut table)?;
        let group = if case.offset { &mut offsets } else { &mut others };
        group.push(Series::new(case.name, group.len(), Style::Marked, points));
    }
    if let Some([tolerance, cells]) = offsets[0].points.iter().flatten().last().copied() {
        let at = |other: f64| Some([other, cells * (other / tolerance).powf(SLOPE)]);
        let slope = vec![at(FIRST_TOLERANCE), at(tolerance)];
        offsets.push(Series::new("slope -2/3", 6, Style::Dashed, slope));
    }
    let panel = |title: &str, y, series| Panel {
        title: title.to_owned(),
        x: Axis::logarithmic("tolerance, relative to the diagonal"),
        y,
        series,
    };
    let panels = [
        panel("Exact offsets: a power of the tolerance", Axis::logarithmic("cells bounded"), offsets),
        panel("Other pairs: at most its logarithm", Axis::linear("cells bounded"), others),
    ];
    setup.save("order", &table, &panels)
}

fn cases(setup: &Setup) -> Anyhow<Vec<Case>> {
    let case = |name, models, translation, offset| Case { name, models, translation, offset };
    let unmoved = |name, models, offset| case(name, models, DVec3::ZERO, offset);
    let mut cases = vec![
        unmoved("parts of spheres, radius 1 and 1.1", sphere_parts([1.0, 1.1])?, true),
        unmoved("wavy sheets", [shape("wavy-sheet")?, shape("wavy-sheet-b")?], false),
    ];
    if setup.quick {
        return Ok(cases);
    }
    cases.push(unmoved("parts of a sphere", sphere_parts([1.0, 1.0])?, true));
    let translation = DVec3::new(0.3, 0.1, 0.0);
    cases.push(case("glass and bottle", [shape("glass")?, shape("bottle")?], translation, false));
    cases.push(unmoved("wings of other sections", [shape("naca-wing")?, shape("naca-wing-thicker")?], false));
    let [duck, teapot] = models_of("several")?;
    let twice = [duck.clone(), duck.clone()];
    cases.push(case("duck and duck moved", twice, DVec3::new(0.4, 0.1, 0.0), false));
    cases.push(unmoved("duck and teapot", [duck, teapot], false));
    Ok(cases)
}

/// Returns the numbers of cells at all tolerances that the budget allows.
fn measure(setup: &Setup, case: &Case, table: &mut Table) -> Anyhow<Vec<Option<[f64; 2]>>> {
    let [a, b] = &case.models;
    let (a, b) = (PreparedModel::new(a)?, PreparedModel::new(b)?);
    let mut points = Vec::new();
    for step in 0..setup.choose(TOLERANCES, 5) {
        let tolerance = FIRST_TOLERANCE * 10_f64.powf(-(step as f64) / STEPS_PER_DECADE);
        let options = DistanceOptions {
            method: Method::Certified(CertifiedOptions { max_cells: Some(MAX_CELLS), ..Default::default() }),
            relative_tolerance: Some(tolerance),
            transform: RigidTransform::translation(case.translation)?,
            ..certified()
        };
        let result = setup.measure(&a, &b, &options)?;
        let Some(details) = result.certified().filter(|_| result.converged) else { break };
        points.push(Some([tolerance, details.cells as f64]));
        table.rows.push(vec![
            case.name.replace(',', ":").as_str().into(),
            tolerance.into(),
            details.cells.into(),
            f64::from(details.levels).into(),
            result.seconds.solve.into(),
            result.lower.into(),
            result.upper.into(),
        ]);
    }
    Ok(points)
}
