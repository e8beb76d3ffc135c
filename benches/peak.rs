//! The fraction of the GPU's float32 peak that the kernels of stages `project`
//! and `taylor_bound` reach.
//!
//! `cargo bench --bench peak [-- NAME]` prints the settings whose names contain
//! NAME as Markdown. Peak and kernels run in turn, in many short rounds of
//! which the fastest count, so that other processes matter little.

#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod support;

use glam::DVec3;
use nurbs_hausdorff::internals::bezier::extract;
use nurbs_hausdorff::internals::closest::{Projection, Target};
use nurbs_hausdorff::internals::flatness::{Flatness, flatten};
use nurbs_hausdorff::internals::gpu::{CertifiedStage, Gpu, IterationBench};
use nurbs_hausdorff::internals::iteration::{Culling, Rule, Sampling, SamplingRule};
use nurbs_hausdorff::{Model, RigidTransform};
use std::cell::RefCell;
use std::path::Path;
use std::rc::Rc;
use std::sync::Arc;
use support::clock::Stopwatch;
use support::{certified, flops, models, peak};

const ROUNDS: usize = 40;

/// The default of method `iteration`.
const RULE: Rule =
    Rule { projection: Projection::Newton, iterations: 5, step_tolerance: 0.01, culling: Culling::Tree };

struct Case {
    name: String,
    /// Runs the timed stages, or only those whose time is subtracted.
    run: Box<dyn FnMut(bool)>,
    /// Threads: samples or cells.
    threads: usize,
    /// Floating-point operations of all threads.
    operations: f64,
    /// The least times without and with the timed stage.
    seconds: [f64; 2],
}

impl Case {
    fn new(name: String, counted: &[f32], mut run: Box<dyn FnMut(bool)>) -> Self {
        // Measures the kernels' throughput, which sets the size of submissions.
        (0..4).for_each(|_| run(true));
        let operations = counted.iter().map(|&flops| f64::from(flops).floor()).sum();
        Self { name, run, threads: counted.len(), operations, seconds: [f64::INFINITY; 2] }
    }

    /// Stage `project` of method `iteration`; `translation` is relative to the diagonal.
    fn projection(
        gpu: &Arc<Gpu>,
        name: &str,
        model: &Model,
        samples: usize,
        translation: [f64; 3],
        flatness: Flatness,
    ) -> Self {
        let diagonal = model.bounding_box().diagonal();
        let model = extract(model);
        let sampling = Sampling::new(&model, samples, SamplingRule::Uniform);
        let target = Target::new(flatten(&model.patches, flatness).patches);
        let transform =
            RigidTransform::translation(diagonal * DVec3::from_array(translation)).expect("finite");
        let mut bench = IterationBench::new(gpu, &model, &sampling, &target, transform, RULE).expect("a GPU");
        bench.edit(&|text| flops::counting(&text, flops::PROJECT));
        bench.project().expect("a projection");
        let counted = bench.written().expect("counts");
        bench.edit(&|text| text);
        let run = move |timed| if timed { bench.project() } else { bench.sample() }.expect("samples");
        Self::new(name.to_owned(), &counted, Box::new(run))
    }

    /// Stages `cell_jet`, `project` and `taylor_bound` of method `certified` on
    /// the cells of `stages.rs`.
    fn certified(gpu: &Arc<Gpu>, name: &str, degree: [usize; 2]) -> Vec<Self> {
        const BEFORE: [CertifiedStage; 2] = [CertifiedStage::CellJet, CertifiedStage::Project];
        let bench = Rc::new(RefCell::new(certified::bench(gpu, degree)));
        let case = |stage, end, before: &'static [CertifiedStage], whole: &'static [CertifiedStage]| {
            let mut edited = bench.borrow_mut();
            // The input of the stage.
            edited.run(&BEFORE).expect("cells");
            edited.edit(stage, &|text| flops::counting(&text, end));
            edited.run(whole).expect("a count");
            edited.edit(stage, &|text| text);
            let written = edited.written().expect("counts");
            let counted: Vec<f32> = written
                .iter()
                .map(
                    |&[s, foot_distance]| {
                        if stage == CertifiedStage::TaylorBound { foot_distance } else { s }
                    },
                )
                .collect();
            edited.run(&BEFORE).expect("cells");
            let bench = Rc::clone(&bench);
            drop(edited);
            let run = move |timed| bench.borrow().run(if timed { whole } else { before }).expect("cells");
            Self::new(format!("{stage:?}, {name}"), &counted, Box::new(run))
        };
        vec![
            case(CertifiedStage::CellJet, flops::CELL_JET, &[], &BEFORE[..1]),
            case(CertifiedStage::Project, flops::PROJECT, &BEFORE[..1], &BEFORE),
            case(CertifiedStage::TaylorBound, flops::TAYLOR_BOUND, &[], &[CertifiedStage::TaylorBound]),
        ]
    }

    fn run(&mut self, on_cpu: bool) {
        for timed in [false, true] {
            let started = Stopwatch::start(on_cpu);
            (self.run)(timed);
            let fastest = &mut self.seconds[usize::from(timed)];
            *fastest = fastest.min(started.seconds());
        }
    }
}

fn main() {
    let gpu = Arc::new(pollster::block_on(Gpu::new()).expect("an adapter"));
    println!("Adapter: {}\n", gpu.adapter().unwrap_or_default());
    let peak = peak::Peak::new();
    let filter = std::env::args().skip(1).find(|argument| !argument.starts_with('-')).unwrap_or_default();
    let mut cases = cases(&gpu, &filter);
    let mut fastest = vec![0.0_f64; peak::VARIANTS.len()];
    for _ in 0..ROUNDS {
        for (fastest, (_, flops)) in fastest.iter_mut().zip(peak.measure()) {
            *fastest = fastest.max(flops);
        }
        cases.iter_mut().for_each(|case| case.run(peak.on_cpu));
    }
    println!("| multiply-adds | GFLOP/s |\n|---|---|");
    for (variant, flops) in peak::VARIANTS.iter().zip(&fastest) {
        println!("| {variant} | {:.1} |", flops / 1e9);
    }
    let peak = fastest.into_iter().fold(0.0, f64::max);
    println!(
        "\n| setting | threads | operations per thread | threads per second | GFLOP/s | fraction of the peak |"
    );
    println!("|---|---|---|---|---|---|");
    for Case { name, threads, operations, seconds, .. } in &cases {
        let seconds = seconds[1] - seconds[0];
        let flops = operations / seconds;
        println!(
            "| {name} | {threads} | {:.0} | {:.0} | {:.1} | {:.1} % |",
            operations / *threads as f64,
            *threads as f64 / seconds,
            flops / 1e9,
            100.0 * flops / peak,
        );
    }
}

/// The settings whose names contain `filter`.
fn cases(gpu: &Arc<Gpu>, filter: &str) -> Vec<Case> {
    let mut cases = Vec::new();
    let mut add = |name: &str, model: &Model, samples, translation, flatness| {
        if name.contains(filter) {
            cases.push(Case::projection(gpu, name, model, samples, translation, flatness));
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
        if name.contains(filter)
            && let Some(model) = shared(name)
        {
            add(name, &model, samples, [0.01, 0.005, 0.002], Flatness::Loose);
        }
    }
    for degree in certified::DEGREES {
        let name = format!("cells of degrees {degree:?}");
        if name.contains(filter) {
            cases.extend(Case::certified(gpu, &name, degree));
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
