//! Projection by evaluation of the NURBS surface itself against projection on its
//! Bézier patches, the 2012 paper's first open question.

mod evaluator;
mod kernels;

use super::chart::{Axis, Panel, Series, Style};
use super::{Anyhow, Setup, Table};
use evaluator::NurbsEvaluator;
use glam::DVec3;
use nurbs_hausdorff::RigidTransform;
use nurbs_hausdorff::internals::bezier::extract;
use nurbs_hausdorff::internals::closest::{Projection, Target, closest};
use nurbs_hausdorff::internals::iteration::{Culling, Rule, Sampling, SamplingRule, project, sample};
use nurbs_hausdorff::shapes::{WavySheet, wavy_sheet};
use std::time::Instant;

/// The numbers of control points of B along each axis.
const COUNTS: [usize; 9] = [4, 6, 8, 12, 16, 24, 32, 48, 64];

/// The 2012 paper's iteration on every patch.
const PUBLISHED: Rule = Rule {
    projection: Projection::TangentPlane,
    iterations: 5,
    step_tolerance: 0.01,
    culling: Culling::None,
};

/// The width of the interval of a sample's true distance, in model units.
const TRUTH: f64 = 1e-9;

/// The distance of the sampled sheet above B, in model units.
const ABOVE: f64 = 0.5;

/// The seconds for which runs are repeated; the fastest counts, as other load only adds.
const REPEATED_SECONDS: f64 = 0.2;

const COLUMNS: [&str; 5] =
    ["patches", "method", "seconds_a_sample", "missed_percent", "evaluations_a_second"];

/// `nurbs-evaluation`: the cost and the errors of a projection by the number of
/// patches, and the evaluations per second on the GPU.
pub(crate) fn run(setup: &Setup) -> Anyhow<()> {
    let mut table = Table::new(&COLUMNS);
    let points = samples(setup.choose(16, 6))?;
    let names = ["Bézier: all patches", "Bézier: BVH over patches", "NURBS: nearest control point"];
    let mut curves: [[Vec<Option<[f64; 2]>>; 3]; 2] = Default::default();
    let mut rates: [Vec<Option<[f64; 2]>>; 2] = Default::default();
    let gpu = kernels::Gpu::new();
    for &count in &COUNTS[..setup.choose(COUNTS.len(), 3)] {
        let model = wavy_sheet(&WavySheet::of_counts([count, count], 0))?;
        let surface = &model.surfaces()[0];
        let target = Target::new(extract(&model).patches);
        let patches = target.patches.len();
        let nurbs = NurbsEvaluator::new(surface);
        let in_tree = Rule { culling: Culling::Tree, ..PUBLISHED };
        let project = |point, rule| project(&target, point, rule).distance_squared.sqrt();
        let projections: [&dyn Fn(DVec3) -> f64; 3] =
            [&|point| project(point, &PUBLISHED), &|point| project(point, &in_tree), &|point| {
                nurbs.tangent_plane(point, PUBLISHED.iterations, PUBLISHED.step_tolerance)
            }];
        for (index, projection) in projections.into_iter().enumerate() {
            let mut seconds = f64::INFINITY;
            let mut distances = Vec::new();
            let begun = Instant::now();
            while seconds.is_infinite() || begun.elapsed().as_secs_f64() < REPEATED_SECONDS {
                let started = Instant::now();
                distances = points.iter().map(|&point| projection(point)).collect();
                seconds = seconds.min(started.elapsed().as_secs_f64() / points.len() as f64);
            }
            let is_missed = |(&point, distance): (&DVec3, f64)| {
                let found = closest(&target, point, TRUTH);
                found.is_some_and(|found| distance > found.upper + PUBLISHED.step_tolerance)
            };
            let missed = points.iter().zip(distances).filter(|&pair| is_missed(pair)).count();
            let percent = 100.0 * missed as f64 / points.len() as f64;
            curves[0][index].push(Some([patches as f64, MICROSECONDS * seconds]));
            curves[1][index].push(Some([patches as f64, percent]));
            let row =
                vec![patches.into(), names[index].into(), seconds.into(), percent.into(), None::<f64>.into()];
            table.rows.push(row);
        }
        let Some(gpu) = &gpu else { continue };
        for (index, rate) in gpu.rates(surface, setup.quick)?.into_iter().enumerate() {
            rates[index].push(Some([patches as f64, rate / MILLION]));
            let name = ["GPU: Bézier", "GPU: NURBS"][index];
            let empty = || None::<f64>.into();
            table.rows.push(vec![patches.into(), name.into(), empty(), empty(), rate.into()]);
        }
    }
    let panel = |title: &str, y, names: &[&str], curves: Vec<_>| Panel {
        title: title.to_owned(),
        x: Axis::logarithmic("Bézier patches of B"),
        y,
        series: curves
            .into_iter()
            .enumerate()
            .map(|(index, curve)| Series::new(names[index], index, Style::Marked, curve))
            .collect(),
    };
    let [times, missed] = curves.map(Vec::from);
    let mut panels = vec![
        panel("Projecting a sample, float64 on one core", Axis::logarithmic("microseconds"), &names, times),
        panel("Samples missed by more than the tolerance", Axis::linear("percent"), &names, missed),
    ];
    if gpu.is_some() {
        let names = ["Bézier patch", "NURBS surface"];
        let y = Axis::logarithmic("millions per second");
        panels.push(panel("Points with tangents, float32 in a kernel", y, &names, rates.into()));
    }
    setup.save("nurbs-evaluation", &table, &panels)
}

const MICROSECONDS: f64 = 1e6;
const MILLION: f64 = 1e6;

/// Returns `count` × `count` points of another sheet above B.
fn samples(count: usize) -> Anyhow<Vec<DVec3>> {
    let bezier = extract(&wavy_sheet(&WavySheet::of_counts([14, 13], 1))?);
    let sampling = Sampling::new(&bezier, count, SamplingRule::Uniform);
    let above = RigidTransform::translation(DVec3::Z * ABOVE)?;
    Ok((0..sampling.len()).map(|index| sample(&bezier, &sampling, index, &above)).collect())
}
