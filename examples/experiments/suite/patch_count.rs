//! The growth of the work of `certified` with the number of B's patches.

use super::chart::{Axis, Panel, Series, Style};
use super::inputs::models::shared;
use super::methods::certified;
use super::{Anyhow, Setup, Table};
use glam::DVec3;
use nurbs_hausdorff::internals::engine::{DistanceOptions, PreparedModel};
use nurbs_hausdorff::shapes::operations::cut_model;
use nurbs_hausdorff::shapes::{WavySheet, wavy_sheet};
use nurbs_hausdorff::{Model, RigidTransform};

/// The sides of B's pieces, relative to the whole.
const PARTS: [f64; 3] = [0.25, 0.5, 1.0];

/// The side of A, which stays inside the smallest piece when it is moved.
const SIDE_A: f64 = 0.2;

/// The translation of A, relative to its diagonal.
const MOVE: DVec3 = DVec3::new(0.01, 0.005, 0.002);

/// The number of solves; the fastest counts, as other load only adds.
const ROUNDS: usize = 7;

const COLUMNS: [&str; 7] =
    ["part", "patches_of_b", "cells", "seconds_solve", "seconds_prepare", "lower", "upper"];

/// `patch-count`: a moved corner of a survey against growing parts of the survey.
pub(crate) fn run(setup: &Setup) -> Anyhow<()> {
    let whole = match shared("occt_terrain")?.filter(|_| !setup.quick) {
        Some(terrain) => terrain,
        None => wavy_sheet(&WavySheet::of_counts(setup.choose([312, 323], [40, 40]), 0))?,
    };
    let corner = corner(&whole, SIDE_A)?;
    let a = PreparedModel::new(&corner)?;
    let shift = MOVE * corner.bounding_box().diagonal();
    let mut table = Table::new(&COLUMNS);
    let mut curves: [Vec<Option<[f64; 2]>>; 2] = Default::default();
    for part in PARTS {
        let b = PreparedModel::new(&self::corner(&whole, part)?)?;
        // Relative to A, so that the problem is the same for every size of B.
        let tolerance = 1e-6 * corner.bounding_box().diagonal();
        let options = DistanceOptions {
            tolerance: Some(tolerance),
            transform: RigidTransform::translation(shift)?,
            ..certified()
        };
        let mut results = Vec::new();
        for _ in 0..ROUNDS {
            results.push(setup.measure(&a, &b, &options)?);
        }
        let prepare = results[0].seconds.prepare;
        results.sort_by(|a, b| a.seconds.solve.total_cmp(&b.seconds.solve));
        let fastest = &results[0];
        let cells = fastest.certified().map_or(0, |details| details.cells);
        let patches = fastest.patches.b;
        curves[0].push(Some([patches as f64, cells as f64]));
        curves[1].push(Some([patches as f64, fastest.seconds.solve * MILLISECONDS]));
        table.rows.push(vec![
            (part * part).into(),
            patches.into(),
            cells.into(),
            fastest.seconds.solve.into(),
            prepare.into(),
            fastest.lower.into(),
            fastest.upper.into(),
        ]);
    }
    let [cells, times] = curves;
    let panel = |title: &str, label: &str, name: &str, points| Panel {
        title: title.to_owned(),
        x: Axis::logarithmic("Bézier patches of B"),
        y: Axis::logarithmic(label),
        series: vec![Series::new(name, 0, Style::Marked, points)],
    };
    let panels = [
        panel("Part of a survey against 1/16, 1/4 and all of it", "cells bounded", "cells", cells),
        panel("The same pairs", "solve time, milliseconds", "solve time", times),
    ];
    setup.save("patch-count", &table, &panels)
}

const MILLISECONDS: f64 = 1e3;

/// Returns the piece of the model's first surface over [0, side]² of its domain.
fn corner(model: &Model, side: f64) -> Anyhow<Model> {
    if side >= 1.0 {
        return Ok(model.clone());
    }
    let pieces = cut_model(model, [&[side], &[side]])?;
    Ok(Model::new(None, pieces.surfaces()[..1].to_vec())?)
}
