//! Every stage alone, on the CPU in float64 and on the GPU.
//!
//! `cargo bench --bench stages [-- FILTER]`. `elem/s` are patches (extraction,
//! tree), samples (sample, reduce), projections of a sample on the whole model
//! (project) or cells (certified, certified stages) per second. On the GPU
//! `project` includes `sample`, which is measured too, and `reduce` includes
//! reading the result.

#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod support;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;
use nurbs_hausdorff::internals::bezier::{BezierModel, extract};
use nurbs_hausdorff::internals::bvh::Bvh;
use nurbs_hausdorff::internals::closest::{Projection, Target};
use nurbs_hausdorff::internals::engine::{DistanceOptions, Engine, PreparedModel};
use nurbs_hausdorff::internals::flatness::{Flatness, flatten};
use nurbs_hausdorff::internals::gpu::{CertifiedStage, Gpu, IterationBench};
use nurbs_hausdorff::internals::iteration::{
    Culling, Projected, Rule, Sampling, SamplingRule, project, reduce, sample,
};
use nurbs_hausdorff::{CertifiedOptions, Method, Model, RigidTransform};
use rayon::prelude::*;
use std::hint::black_box;
use std::sync::Arc;
use std::time::Duration;
use support::{certified, models};

/// The degrees that `project` is measured for.
const DEGREES: [[usize; 2]; 5] = [[1, 1], [2, 2], [3, 3], [2, 5], [5, 5]];

/// Patches along each direction of a measured net.
const SPANS: usize = 12;

/// Samples along each direction.
const SAMPLES: usize = 96;

/// The number of cells after which method `certified` stops.
const CELLS: usize = 20_000;

fn group<'a>(c: &'a mut Criterion, name: &str, elements: usize) -> BenchmarkGroup<'a, WallTime> {
    let mut group = c.benchmark_group(name);
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_millis(1000))
        .throughput(Throughput::Elements(elements as u64));
    group
}

/// A net and the same net moved by little, as stage `project` gets them.
struct Pair {
    model: BezierModel,
    sampling: Sampling,
    target: Target,
    transform: RigidTransform,
}

impl Pair {
    fn new(degree: [usize; 2]) -> Self {
        let model = extract(&models::rough(degree, [SPANS; 2], 1.0, 1));
        let sampling = Sampling::new(&model, SAMPLES, SamplingRule::Uniform);
        let target = Target::new(flatten(&model.patches, Flatness::Loose).patches);
        let transform = RigidTransform::translation(DVec3::new(0.01, 0.005, 0.02)).expect("finite");
        Self { model, sampling, target, transform }
    }

    fn samples(&self) -> Vec<DVec3> {
        (0..self.sampling.len())
            .into_par_iter()
            .map(|index| sample(&self.model, &self.sampling, index, &self.transform))
            .collect()
    }

    fn projected(&self, samples: &[DVec3], rule: &Rule) -> Vec<Projected> {
        samples.par_iter().map(|&sample| project(&self.target, sample, rule)).collect()
    }

    fn bench(&self, gpu: &Arc<Gpu>, rule: Rule) -> IterationBench {
        let bench = IterationBench::new(gpu, &self.model, &self.sampling, &self.target, self.transform, rule);
        bench.expect("a GPU")
    }
}

fn rule(projection: Projection) -> Rule {
    Rule { projection, iterations: 5, step_tolerance: 0.01, culling: Culling::Tree }
}

fn extraction(c: &mut Criterion) {
    let net = models::rough([3, 3], [100, 100], 1.0, 1);
    let patches = extract(&net).patches;
    let mut group = group(c, "extraction", patches.len());
    group.bench_function("cpu", |b| b.iter(|| extract(black_box(&net))));
    group.bench_function("flatten cpu", |b| b.iter(|| flatten(black_box(&patches), Flatness::Loose)));
    group.finish();
}

fn tree(c: &mut Criterion) {
    let patches = extract(&models::rough([3, 3], [100, 100], 1.0, 1)).patches;
    let boxes: Vec<_> = patches.iter().map(|patch| patch.bounding_box()).collect();
    let mut group = group(c, "tree", boxes.len());
    group.bench_function("cpu", |b| b.iter(|| Bvh::new(black_box(&boxes))));
    group.finish();
}

fn sampling(c: &mut Criterion, gpu: Option<&Arc<Gpu>>) {
    let pair = Pair::new([3, 3]);
    let mut group = group(c, "sample", pair.sampling.len());
    group.bench_function("cpu", |b| b.iter(|| pair.samples()));
    if let Some(gpu) = gpu {
        let mut bench = pair.bench(gpu, rule(Projection::Newton));
        group.bench_function("gpu", |b| b.iter(|| bench.sample().expect("samples")));
    }
    group.finish();
}

fn projection(c: &mut Criterion, gpu: Option<&Arc<Gpu>>) {
    for projection in [Projection::Newton, Projection::TangentPlane] {
        let rule = rule(projection);
        for degree in DEGREES {
            let pair = Pair::new(degree);
            let samples = pair.samples();
            let name = format!("project {projection:?}");
            let mut group = group(c, &name, samples.len());
            let degrees = format!("{}x{}", degree[0], degree[1]);
            group.bench_function(BenchmarkId::new("cpu", &degrees), |b| {
                b.iter(|| pair.projected(&samples, &rule))
            });
            if let Some(gpu) = gpu {
                let mut bench = pair.bench(gpu, rule);
                group.bench_function(BenchmarkId::new("gpu", &degrees), |b| {
                    b.iter(|| bench.project().expect("projections"));
                });
            }
            group.finish();
        }
    }
}

fn reduction(c: &mut Criterion, gpu: Option<&Arc<Gpu>>) {
    let pair = Pair::new([3, 3]);
    let rule = rule(Projection::Newton);
    let projected = pair.projected(&pair.samples(), &rule);
    let mut group = group(c, "reduce", projected.len());
    group.bench_function("cpu", |b| b.iter(|| reduce(black_box(&projected))));
    if let Some(gpu) = gpu {
        let mut bench = pair.bench(gpu, rule);
        bench.project().expect("projections");
        group.bench_function("gpu", |b| b.iter(|| bench.reduce().expect("blocks")));
    }
    group.finish();
}

/// Method `certified` within a budget of cells, on a net and its copy moved
/// by little, which exhausts the budget.
fn certified_search(c: &mut Criterion) {
    let engine = Engine::cpu();
    for degree in [[2, 2], [3, 3], [5, 5]] {
        let net: Model = models::rough(degree, [SPANS; 2], 1.0, 1);
        let model = PreparedModel::new(&net).expect("valid trims");
        let options = DistanceOptions {
            method: Method::Certified(CertifiedOptions { max_cells: Some(CELLS), ..Default::default() }),
            relative_tolerance: Some(1e-9),
            transform: RigidTransform::translation(DVec3::new(0.0, 0.0, 1e-3)).expect("finite"),
            ..DistanceOptions::default()
        };
        let run = || engine.distance(&model, &model, &options).wait().expect("a distance");
        let cells = run().certified().expect("cells").cells;
        let mut group = group(c, "certified", cells);
        group
            .bench_function(BenchmarkId::new("cpu", format!("{}x{}", degree[0], degree[1])), |b| b.iter(run));
        group.finish();
    }
}

/// The kernels of method `certified` on a level of cells, alone and together.
fn certified_stages(c: &mut Criterion, gpu: &Arc<Gpu>) {
    for degree in certified::DEGREES {
        let bench = certified::bench(gpu, degree);
        let mut group = group(c, "certified stages", bench.cells());
        bench.run(&CertifiedStage::ALL).expect("cells");
        for (name, stages) in [
            ("cell_jet", &[CertifiedStage::CellJet][..]),
            ("cell_jet and project", &[CertifiedStage::CellJet, CertifiedStage::Project]),
            ("taylor_bound", &[CertifiedStage::TaylorBound]),
            ("split", &[CertifiedStage::Split]),
            ("next_level", &[CertifiedStage::NextLevel]),
            ("all", &CertifiedStage::ALL),
        ] {
            let id = BenchmarkId::new(name, format!("{}x{}", degree[0], degree[1]));
            group.bench_function(id, |b| b.iter(|| bench.run(stages).expect("cells")));
        }
        group.finish();
    }
}

fn stages(c: &mut Criterion) {
    let gpu = pollster::block_on(Gpu::new()).map(Arc::new).ok();
    let adapter = gpu.as_ref().and_then(|gpu| gpu.adapter());
    println!("Adapter: {}", adapter.unwrap_or_else(|| "none, CPU only".to_owned()));
    extraction(c);
    tree(c);
    sampling(c, gpu.as_ref());
    projection(c, gpu.as_ref());
    reduction(c, gpu.as_ref());
    certified_search(c);
    if let Some(gpu) = &gpu {
        certified_stages(c, gpu);
    }
}

criterion_group!(benches, stages);
criterion_main!(benches);
