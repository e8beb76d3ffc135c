//! The 2012 paper's Fig. 5: a plane across a cylinder, the case with the largest
//! sampling error.

use super::chart::{Axis, Panel, Series, Style};
use super::methods::certified;
use super::{Anyhow, Setup, Table};
use nurbs_hausdorff::internals::closest::Projection;
use nurbs_hausdorff::internals::engine::{DistanceOptions, IterationOptions, Method, PreparedModel};
use nurbs_hausdorff::internals::iteration::Culling;
use nurbs_hausdorff::shapes::{FIGURE5_RADIUS, FIGURE5_SAMPLES, figure5_cylinder, figure5_plane};

/// The numbers of samples along each axis; the paper's spacing of 16 is among them.
const SAMPLES: [usize; 9] = [11, 15, 21, 29, FIGURE5_SAMPLES, 57, 81, 113, 161];

const COLUMNS: [&str; 8] =
    ["method", "samples", "spacing", "computed", "lower", "upper", "k_a", "k_a_rigorous"];

/// `figure5`: the published iteration at several spacings, and `certified`.
pub(crate) fn run(setup: &Setup) -> Anyhow<()> {
    let (a, b) = (PreparedModel::new(&figure5_plane()?)?, PreparedModel::new(&figure5_cylinder()?)?);
    let side = a.bounding_box().extent().x;
    let mut table = Table::new(&COLUMNS);
    let mut curves: [Vec<Option<[f64; 2]>>; 3] = Default::default();
    for samples in SAMPLES {
        let options = DistanceOptions {
            method: Method::Iteration(IterationOptions {
                projection: Projection::TangentPlane,
                culling: Culling::None,
                ..Default::default()
            }),
            samples,
            ..DistanceOptions::default()
        };
        let result = setup.measure(&a, &b, &options)?;
        let bounds = result.iteration().map(|details| details.bounds).ok_or("no bounds")?;
        let spacing = side / (samples - 1) as f64;
        let margins = [0.0, bounds.k_a, bounds.k_a_rigorous];
        for (curve, margin) in curves.iter_mut().zip(margins) {
            curve.push(Some([spacing, result.computed + margin]));
        }
        table.rows.push(vec![
            "2012 paper".into(),
            samples.into(),
            spacing.into(),
            result.computed.into(),
            result.lower.into(),
            result.upper.into(),
            bounds.k_a.into(),
            bounds.k_a_rigorous.into(),
        ]);
    }
    let found = setup.measure(&a, &b, &certified())?;
    let mut row = vec!["certified".into(), None::<f64>.into(), None::<f64>.into()];
    row.extend([found.computed, found.lower, found.upper].map(Into::into));
    row.extend([None::<f64>, None].map(Into::into));
    table.rows.push(row);
    let ends = [0, SAMPLES.len() - 1].map(|index| side / (SAMPLES[index] - 1) as f64);
    let level = |value: f64| ends.map(|spacing| Some([spacing, value])).to_vec();
    let [computed, published, rigorous] = curves;
    let panel = Panel {
        title: format!("Plane through a cylinder of radius {FIGURE5_RADIUS}: the distance is the radius"),
        x: Axis::linear("distance between neighbouring samples, model units"),
        y: Axis::linear("directed distance, model units"),
        series: vec![
            Series::new("certified", 0, Style::Line, level(found.computed)),
            Series::new("2012 paper: computed", 1, Style::Marked, computed),
            Series::new("computed + K_A", 1, Style::Dashed, published),
            Series::new("computed + rigorous K_A", 6, Style::Dashed, rigorous),
        ],
    };
    setup.save("figure5", &table, &[panel])
}
