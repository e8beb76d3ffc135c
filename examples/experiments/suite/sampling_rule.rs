//! Samples evenly spaced in arc length against samples evenly spaced in the
//! parameter, an open question of the 2012 paper.

use super::chart::{Axis, Panel, Series, Style};
use super::inputs::models::models_of;
use super::methods::certified;
use super::{Anyhow, Setup, Table};
use glam::DVec3;
use nurbs_hausdorff::internals::engine::{DistanceOptions, MethodName, PreparedModel};
use nurbs_hausdorff::internals::iteration::SamplingRule;
use nurbs_hausdorff::shapes::shape;
use nurbs_hausdorff::{Model, RigidTransform};

const SAMPLES: [usize; 9] = [8, 12, 16, 24, 32, 48, 64, 96, 128];

const RULES: [(SamplingRule, &str); 2] =
    [(SamplingRule::Uniform, "uniform"), (SamplingRule::ArcLength, "arc length")];

const COLUMNS: [&str; 7] = ["pair", "rule", "samples", "k_a", "k_a_rigorous", "certified", "error"];

/// `sampling-rule`: K_A and the actual error, by the number of samples.
pub(crate) fn run(setup: &Setup) -> Anyhow<()> {
    let mut table = Table::new(&COLUMNS);
    let mut panels = Vec::new();
    for (name, models, translation) in cases(setup)? {
        let [a, b] = &models;
        let (a, b) = (PreparedModel::new(a)?, PreparedModel::new(b)?);
        let transform = RigidTransform::translation(translation)?;
        let found = setup.measure(&a, &b, &DistanceOptions { transform, ..certified() })?;
        let truth = 0.5 * (found.lower + found.upper);
        let mut series = Vec::new();
        for (color, (sampling, rule)) in RULES.into_iter().enumerate() {
            let mut curves: [Vec<Option<[f64; 2]>>; 2] = Default::default();
            for &samples in &SAMPLES[..setup.choose(SAMPLES.len(), 3)] {
                let options = DistanceOptions {
                    method: MethodName::Iteration.into(),
                    samples,
                    sampling,
                    transform,
                    ..DistanceOptions::default()
                };
                let result = setup.measure(&a, &b, &options)?;
                let bounds = result.iteration().map(|details| details.bounds).ok_or("no bounds")?;
                let error = truth - result.computed;
                curves[0].push(Some([samples as f64, bounds.k_a]));
                curves[1].push(Some([samples as f64, error]));
                table.rows.push(vec![
                    name.into(),
                    rule.into(),
                    samples.into(),
                    bounds.k_a.into(),
                    bounds.k_a_rigorous.into(),
                    truth.into(),
                    error.into(),
                ]);
            }
            let [k_a, error] = curves;
            series.push(Series::new(format!("K_A: {rule}"), color, Style::Dashed, k_a));
            series.push(Series::new(format!("error: {rule}"), color, Style::Marked, error));
        }
        panels.push(Panel {
            title: name.to_owned(),
            x: Axis::logarithmic("samples along each direction of a surface"),
            y: Axis::logarithmic("model units"),
            series,
        });
    }
    setup.save("sampling-rule", &table, &panels)
}

type Case = (&'static str, [Model; 2], DVec3);

fn cases(setup: &Setup) -> Anyhow<Vec<Case>> {
    let moved = DVec3::new(0.4, 0.1, 0.0);
    let mut cases = vec![("glass against bottle", [shape("glass")?, shape("bottle")?], moved)];
    if !setup.quick {
        cases.push(("duck body against its moved copy", models_of("body")?, moved));
        let wings = [shape("naca-wing")?, shape("naca-wing-thicker")?];
        cases.push(("wing against a thicker one", wings, DVec3::ZERO));
    }
    Ok(cases)
}
