//! Subdivision where the curvature is halved against subdivision in the middle, an
//! open question of the 2012 paper.

mod rules;

use super::chart::{Axis, Panel, Series, Style};
use super::inputs::models::models_of;
use super::{Anyhow, Setup, Table};
use glam::DVec3;
use nurbs_hausdorff::internals::bezier::{PatchSet, extract};
use nurbs_hausdorff::internals::closest::{Projection, Target, closest};
use nurbs_hausdorff::internals::flatness::{Flatness, flatten};
use nurbs_hausdorff::internals::iteration::{Culling, Rule, Sampling, SamplingRule, project, sample};
use nurbs_hausdorff::shapes::shape;
use nurbs_hausdorff::{Model, RigidTransform};
use rayon::prelude::*;
use rules::{CUTS, cut_all};

/// The largest angles between normals of a patch, in degrees.
const ANGLES: [f64; 7] = [90.0, 60.0, 45.0, 35.0, 25.0, 18.0, 12.0];

/// The width of the interval of a sample's true distance, in model units.
const TRUTH: f64 = 1e-9;

/// The 2012 paper's iteration.
const PUBLISHED: Rule = Rule {
    projection: Projection::TangentPlane,
    iterations: 5,
    step_tolerance: 0.01,
    culling: Culling::Tree,
};

/// A sample is missed if its distance exceeds the true one by more than the
/// tolerance of the iteration.
const MISSED: f64 = PUBLISHED.step_tolerance;

const COLUMNS: [&str; 6] = ["pair", "rule", "degrees", "patches", "missed_percent", "largest_error"];

/// `split-rule`: the samples missed by the published iteration, by the number of patches.
pub(crate) fn run(setup: &Setup) -> Anyhow<()> {
    let mut table = Table::new(&COLUMNS);
    let mut panels = Vec::new();
    for (name, [a, b], shift) in cases(setup)? {
        let b = extract(&b).patches;
        let samples = samples(&a, setup.choose(40, 10), shift)?;
        let uncut = Target::new(b.clone());
        let truth: Vec<f64> = samples
            .par_iter()
            .map(|&point| closest(&uncut, point, TRUTH).map_or(0.0, |found| found.upper))
            .collect();
        let mut measure = |rule: &str, degrees: f64, patches: PatchSet| {
            let [missed, largest] = errors(&Target::new(patches.clone()), &samples, &truth);
            table.rows.push(vec![
                name.into(),
                rule.into(),
                degrees.into(),
                patches.len().into(),
                missed.into(),
                largest.into(),
            ]);
            Some([patches.len() as f64, missed])
        };
        let mut series = Vec::new();
        for (color, (rule, cut)) in CUTS.into_iter().enumerate() {
            let angles = &ANGLES[..setup.choose(ANGLES.len(), 3)];
            let points =
                angles.iter().map(|&degrees| measure(rule, degrees, cut_all(&b, degrees, cut))).collect();
            series.push(Series::new(rule, color, Style::Marked, points));
        }
        let curvature = measure("flatness curvature", 45.0, flatten(&b, Flatness::Curvature).patches);
        series.push(Series::new("flatness `curvature`", 2, Style::Marked, vec![curvature]));
        panels.push(Panel {
            title: name.to_owned(),
            x: Axis::logarithmic("patches of B after cutting"),
            y: Axis::linear("samples missed, percent"),
            series,
        });
    }
    setup.save("split-rule", &table, &panels)
}

type Case = (&'static str, [Model; 2], DVec3);

fn cases(setup: &Setup) -> Anyhow<Vec<Case>> {
    let moved = DVec3::new(0.4, 0.1, 0.3);
    let mut cases = vec![("glass against bottle", [shape("glass")?, shape("bottle")?], moved)];
    if !setup.quick {
        cases.push(("duck body against its moved copy", models_of("body")?, moved));
        let tori = [shape("torus-fatter")?, shape("torus")?];
        cases.push(("torus against a moved, thinner one", tori, moved));
    }
    Ok(cases)
}

/// Returns `count` × `count` points of every surface, moved by `shift`.
fn samples(model: &Model, count: usize, shift: DVec3) -> Anyhow<Vec<DVec3>> {
    let bezier = extract(model);
    let sampling = Sampling::new(&bezier, count, SamplingRule::Uniform);
    let transform = RigidTransform::translation(shift)?;
    Ok((0..sampling.len()).map(|index| sample(&bezier, &sampling, index, &transform)).collect())
}

/// Returns the percentage of samples missed, and the largest excess over the true distance.
fn errors(target: &Target, samples: &[DVec3], truth: &[f64]) -> [f64; 2] {
    let excess: Vec<f64> = samples
        .par_iter()
        .zip(truth)
        .map(|(&point, truth)| project(target, point, &PUBLISHED).distance_squared.sqrt() - truth)
        .collect();
    let missed = excess.iter().filter(|&&excess| excess > MISSED).count();
    let percent = 100.0 * missed as f64 / samples.len() as f64;
    [percent, excess.into_iter().fold(0.0, f64::max)]
}
