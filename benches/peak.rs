//! The share of the GPU's float32 peak that the projection kernel reaches.
//!
//! `cargo bench --bench peak [-- NAME]`: settings whose names contain NAME, as
//! Markdown. Peak and kernels run in turn,
//! in many short rounds of which the fastest count, so that other work on the
//! machine matters little.

#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "support/clock.rs"]
mod clock;
#[path = "support/flops.rs"]
mod flops;
#[path = "support/models.rs"]
mod models;
#[path = "support/peak.rs"]
mod peak;

use clock::Stopwatch;
use glam::DVec3;
use nurbs_hausdorff::bezier::extract;
use nurbs_hausdorff::flatness::{Flatness, flatten};
use nurbs_hausdorff::gpu::{Gpu, StageBench};
use nurbs_hausdorff::iteration::{Culling, Rule, Sampling, SamplingRule, Target};
use nurbs_hausdorff::project::Projection;
use nurbs_hausdorff::{Model, RigidTransform};
use std::path::Path;
use std::rc::Rc;

const ROUNDS: usize = 40;

/// As `iteration` does by default.
const RULE: Rule =
    Rule { projection: Projection::Newton, iterations: 5, step_tolerance: 0.01, culling: Culling::Tree };

struct Case {
    name: String,
    bench: StageBench,
    samples: usize,
    /// Floating-point operations of all samples.
    operations: f64,
    /// The least seen of `sample` alone, and of `sample` and `project`.
    seconds: [f64; 2],
}

impl Case {
    /// `translation` in parts of the diagonal.
    fn new(
        gpu: &Rc<Gpu>,
        name: &str,
        model: &Model,
        samples: usize,
        translation: [f64; 3],
        flatness: Flatness,
    ) -> Self {
        let diagonal = model.bounding_box().diagonal();
        let model = extract(model);
        let sampling = Sampling::new(&model, samples, SamplingRule::Uniform);
        let target = Target::new(flatten(&model.patches, flatness));
        let transform =
            RigidTransform::translation(diagonal * DVec3::from_array(translation)).expect("finite");
        let mut bench = StageBench::new(gpu, &model, &sampling, &target, transform, RULE).expect("a GPU");
        bench.edit(&|text| flops::counting(&text));
        bench.project().expect("a projection");
        let written = bench.written().expect("counts");
        bench.edit(&|text| text);
        // The kernels' pace is learnt.
        for _ in 0..4 {
            bench.project().expect("a projection");
        }
        Self {
            name: name.to_owned(),
            bench,
            samples: written.len(),
            operations: written.iter().map(|&flops| f64::from(flops)).sum(),
            seconds: [f64::INFINITY; 2],
        }
    }

    fn run(&mut self, on_processor: bool) {
        let started = Stopwatch::start(on_processor);
        self.bench.sample().expect("samples");
        let sampled = started.seconds();
        let started = Stopwatch::start(on_processor);
        self.bench.project().expect("a projection");
        let seconds = [sampled, started.seconds()];
        self.seconds = [0, 1].map(|stage| self.seconds[stage].min(seconds[stage]));
    }
}

fn main() {
    let gpu = Rc::new(pollster::block_on(Gpu::new()).expect("an adapter"));
    println!("Adapter: {}\n", gpu.adapter().unwrap_or_default());
    let peak = peak::Peak::new();
    let wanted = std::env::args().skip(1).find(|argument| !argument.starts_with('-')).unwrap_or_default();
    let mut cases = cases(&gpu, &wanted);
    let mut fastest = vec![0.0_f64; peak::VARIANTS.len()];
    for _ in 0..ROUNDS {
        for (best, (_, this)) in fastest.iter_mut().zip(peak.measure()) {
            *best = best.max(this);
        }
        cases.iter_mut().for_each(|case| case.run(peak.on_processor));
    }
    println!("| multiply-adds | GFLOP/s |\n|---|---|");
    for (variant, flops) in peak::VARIANTS.iter().zip(&fastest) {
        println!("| {variant} | {:.1} |", flops / 1e9);
    }
    let peak = fastest.into_iter().fold(0.0, f64::max);
    println!(
        "\n| setting | samples | operations a sample | projections a second | GFLOP/s | share of the peak |"
    );
    println!("|---|---|---|---|---|---|");
    for Case { name, samples, operations, seconds, .. } in &cases {
        let seconds = seconds[1] - seconds[0];
        let flops = operations / seconds;
        println!(
            "| {name} | {samples} | {:.0} | {:.0} | {:.1} | {:.1} % |",
            operations / *samples as f64,
            *samples as f64 / seconds,
            flops / 1e9,
            100.0 * flops / peak,
        );
    }
}

/// The settings whose names contain `wanted`.
fn cases(gpu: &Rc<Gpu>, wanted: &str) -> Vec<Case> {
    let mut cases = Vec::new();
    let mut add = |name: &str, model: &Model, samples, translation, flatness| {
        if name.contains(wanted) {
            cases.push(Case::new(gpu, name, model, samples, translation, flatness));
        }
    };
    let offset = [0.01, 0.005, 0.1];
    for degree in [[1, 1], [2, 2], [3, 3], [2, 5], [5, 5]] {
        let name = format!("one patch of degrees {degree:?}");
        add(&name, &models::rough(degree, [1, 1], 1.0, 1), 192, offset, Flatness::None);
    }
    let rational = models::rough([3, 3], [1, 1], 2.0, 1);
    add("one rational patch of degrees [3, 3]", &rational, 192, offset, Flatness::None);
    let sheet = models::rough([3, 3], [16, 16], 1.0, 2);
    add("16 x 16 bicubic patches", &sheet, 192, [0.01, 0.005, 0.02], Flatness::None);
    for (name, samples) in [("duck", 128), ("occt_terrain", 192)] {
        if name.contains(wanted)
            && let Some(model) = shared(name)
        {
            add(name, &model, samples, [0.01, 0.005, 0.002], Flatness::Loose);
        }
    }
    cases
}

/// A model of the shared folder, if it is there.
fn shared(name: &str) -> Option<Model> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/models");
    let text = std::fs::read_to_string(folder.join(format!("{name}.json"))).ok()?;
    Some(Model::from_json(&text).expect("a valid model"))
}
