//! The float32 error bounds of method `certified`: of subpatches' jets against
//! float64, and of cells' upper bounds against certified distances.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

use super::adapter::gpu;
use crate::bezier::{LocalDerivativeBounds, PatchSet};
use crate::certified::{BranchAndBound, Cell, Domain, Foot, Operand, Pair, SearchNode};
use crate::closest::{Target, closest};
use crate::gpu::Gpu;
use crate::gpu::certified::layouts::{Batch, CellState, JET_BYTES, LevelParams};
use crate::gpu::certified::{BoundsDomain, Float32Error, GpuCertified, SubpatchFrame, Subpatches, kernels};
use crate::gpu::kernel::WORKGROUP_SIZE;
use crate::gpu::submission::{Dispatch, Extent, Submission};
use crate::model::RigidTransform;
use crate::param_box::ParamBox;
use bytemuck::{Zeroable, bytes_of};
use glam::{DQuat, DVec3, DVec4};

/// A patch of these degrees, with noise of size `roughness` and weights from 1 to `ratio`.
fn rough(random: &mut fastrand::Rng, [p, q]: [usize; 2], roughness: f64, ratio: f64) -> Vec<DVec4> {
    let mut controls = Vec::new();
    for i in 0..=p {
        for j in 0..=q {
            let mut noise = || roughness * (random.f64() - 0.5);
            let point = DVec3::new(i as f64 / p as f64 + noise(), j as f64 / q as f64 + noise(), noise());
            let weight = ratio.powf(random.f64());
            controls.push((weight * (point - DVec3::new(0.5, 0.5, 0.0))).extend(weight));
        }
    }
    controls
}

fn set(patches: &[Vec<DVec4>], degree: [usize; 2]) -> PatchSet {
    let mut set = PatchSet::default();
    for controls in patches {
        let rational = controls.iter().any(|control| control.w != controls[0].w);
        set.push(crate::bezier::Patch {
            surface: 0,
            degree,
            domain: ParamBox::UNIT,
            center: DVec3::ZERO,
            controls,
            rational,
        });
    }
    set
}

fn bounds(set: &PatchSet) -> Vec<LocalDerivativeBounds> {
    set.iter().map(|_| LocalDerivativeBounds::new(ParamBox::UNIT)).collect()
}

/// The jets at the cells' centres as the kernel `cell_jet` computes them, by (σ, τ).
fn jets(gpu: &Gpu, subpatches: &Subpatches, degree: [usize; 2], cells: &[CellState]) -> Vec<[f32; 24]> {
    let frame = SubpatchFrame { origin: DVec3::ZERO, scale: 1.0, center_unit: 2_f64.powi(-26) };
    let members = vec![(degree, (0..subpatches.domains.len() as u32).collect())];
    let uploaded = gpu.upload_subpatches(subpatches, &members, BoundsDomain::Subpatch, &frame);
    let count = cells.len() as u32;
    let batch = Batch { workgroups: [0; 3], count };
    let params = gpu.params_buffer();
    let bytes = u64::from(count) * JET_BYTES;
    let [jets, samples, projected] = ["jets", "samples", "projected"].map(|label| gpu.storage(label, bytes));
    let buffers = [gpu.upload("batch", &[batch]), gpu.upload("cells", cells)];
    let group = &uploaded.groups[0];
    let storage =
        [&buffers[0], &buffers[1], &group.coefficients, &uploaded.subpatches, &jets, &samples, &projected];
    let kernel = kernels::cell_jet(degree);
    let (pipeline, _) = gpu.pipelines.get(kernel);
    let bind_group = gpu.bind(&pipeline, &params, &storage);
    let level_params = LevelParams { subpatch_count: group.count as u32, ..LevelParams::zeroed() };
    let mut submission = Submission::new(gpu, &params);
    submission.dispatch(&Dispatch {
        kernel,
        pipeline: &pipeline,
        bind_group: &bind_group,
        params: bytes_of(&level_params),
        extent: Extent::Workgroups(count.div_ceil(WORKGROUP_SIZE)),
        units: 0,
    });
    let readable = gpu.readable("readable", bytes);
    bytemuck::pod_collect_to_vec(&pollster::block_on(submission.read(&jets, &readable, bytes)).unwrap())
}

/// Degrees, roughness and ratios of weights of the draws below.
const KINDS: [([usize; 2], f64, f64); 16] = [
    ([1, 1], 0.1, 1.0),
    ([1, 2], 0.5, 3.0),
    ([2, 2], 0.1, 2.0),
    ([3, 3], 0.0, 1.0),
    ([3, 3], 0.1, 1.0),
    ([3, 3], 1.0, 1.0),
    ([3, 3], 0.1, 10.0),
    ([3, 3], 1.0, 1e3),
    ([2, 5], 0.3, 5.0),
    ([5, 4], 0.3, 1.0),
    ([5, 5], 0.3, 5.0),
    ([7, 7], 0.3, 1.0),
    ([7, 3], 1.0, 5.0),
    ([7, 7], 0.1, 5.0),
    ([10, 6], 0.3, 2.0),
    ([15, 15], 0.3, 1.2),
];
const PATCHES: usize = 64;
const DRAWS: usize = 1024;

#[test]
fn a_million_jets_are_within_their_error_bounds() {
    let Some(gpu) = gpu("a_million_jets_are_within_their_error_bounds") else { return };
    let random = &mut fastrand::Rng::with_seed(11);
    let mut draws = 0;
    for (degree, roughness, ratio) in KINDS {
        let patches: Vec<_> = (0..PATCHES).map(|_| rough(random, degree, roughness, ratio)).collect();
        let target = Target::new(set(&patches, degree));
        // Whole patches, and small ones as the search uses them.
        for depth in [1, 8] {
            let width = 1.0 / f64::from(depth);
            let corner = [0, 1].map(|_| f64::from(random.i32(0..depth)) * width);
            let [s, t] = corner.map(|start| [start, start + width]);
            let small: Vec<_> = target.patches.iter().map(|patch| patch.restricted(s, t)).collect();
            let patches = if depth == 1 { &target.patches } else { &set(&small, degree) };
            let subpatches = Subpatches::new(patches, &RigidTransform::IDENTITY, &|_| true, PATCHES).unwrap();
            let cells: Vec<CellState> = (0..PATCHES * DRAWS / 2)
                .map(|index| CellState {
                    center: [0, 1].map(|_| if random.u8(0..8) == 0 { 1.0 } else { 2.0 * random.f32() - 1.0 }),
                    half: [1.0; 2],
                    subpatch: (index % PATCHES) as u32,
                    ..CellState::zeroed()
                })
                .collect();
            let errors: Vec<_> =
                subpatches.patches.iter().map(|patch| Float32Error::new(&patch, 1.0)).collect();
            let mut worst = 0.0_f64;
            for (cell, jet) in cells.iter().zip(jets(&gpu, &subpatches, degree, &cells)) {
                let patch = subpatches.patches.patch(cell.subpatch as usize);
                let error = &errors[cell.subpatch as usize];
                let exact = patch.jet(cell.center.map(|x| 0.5 * (1.0 + f64::from(x))));
                let exact = [
                    (exact.point - patch.center, error.value),
                    (0.5 * exact.s, error.first[0]),
                    (0.5 * exact.t, error.first[1]),
                    (0.25 * exact.ss, error.second[0]),
                    (0.25 * exact.st, error.second[1]),
                    (0.25 * exact.tt, error.second[2]),
                ];
                for ((exact, bound), found) in exact.into_iter().zip(jet.chunks_exact(4)) {
                    let found = DVec3::new(found[0].into(), found[1].into(), found[2].into());
                    let error = found.distance(exact);
                    assert!(error <= bound, "{degree:?}, weights 1 to {ratio}: {error} > {bound}");
                    worst = worst.max(error / bound);
                }
                draws += 1;
            }
            println!(
                "{degree:?} of roughness {roughness}, weights 1 to {ratio}: at most {worst:.2} of the bound"
            );
            // Useful to the search: not orders of magnitude above the largest error.
            let ordinary = depth > 1 && ratio <= 5.0 && roughness > 0.0;
            assert!(!ordinary || worst > 1e-3, "{degree:?}, weights 1 to {ratio}: {worst}");
        }
    }
    assert!(draws >= 1_000_000, "{draws}");
}

/// The smallest number of cells that the kernels get first.
const CELLS: usize = 100;

/// Rounds of halving from these cells, and the cells checked in each.
const ROUNDS: usize = 5;
const CHECKED: usize = 250;

#[test]
fn no_point_of_a_cell_is_farther_than_its_upper_bound() {
    let Some(gpu) = gpu("no_point_of_a_cell_is_farther_than_its_upper_bound") else { return };
    let random = &mut fastrand::Rng::with_seed(12);
    let mut checked = 0;
    for (degree, roughness, ratio, shift) in [
        ([3, 3], 0.1, 1.0, 1e-3),
        ([3, 3], 0.3, 3.0, 1e-2),
        ([2, 2], 0.1, 2.0, 0.1),
        ([1, 4], 0.2, 1.0, 0.01),
        ([5, 2], 0.2, 2.0, 1e-4),
    ] {
        let one: Vec<_> = (0..3).map(|_| rough(random, degree, roughness, ratio)).collect();
        // In another order, since patches of one index bound each other.
        let mut two: Vec<_> = one
            .iter()
            .map(|patch| {
                patch
                    .iter()
                    .map(|control| {
                        let noise = DVec3::new(random.f64(), random.f64(), random.f64()) * shift;
                        (control.truncate() + control.w * noise).extend(control.w)
                    })
                    .collect()
            })
            .collect();
        two.rotate_left(1);
        let [a, b] = [one, two].map(|patches: Vec<Vec<DVec4>>| Target::new(set(&patches, degree)));
        let (bounds_a, bounds_b) = (bounds(&a.patches), bounds(&b.patches));
        let turn = DQuat::from_axis_angle(DVec3::new(1.0, -2.0, 0.5).normalize(), shift);
        let transform = RigidTransform::new(turn, DVec3::splat(0.1 * shift)).unwrap();
        let pair = Pair { a: Operand::new(&a, &bounds_a), b: Operand::new(&b, &bounds_b), transform };
        let mut search = BranchAndBound::new(pair, 1e-5, None, 0.0);
        assert!(search.advance_once(usize::MAX).is_none(), "{degree:?}: decided too soon");
        let driver = GpuCertified::new(&gpu, &search).unwrap().unwrap();
        let whole = |patch| SearchNode {
            domain: Domain::Cell(Cell::whole(patch)),
            upper: search.interval().upper,
            foot: Foot::start(0, [0.5; 2]),
            level: 0,
        };
        let mut batch: Vec<_> = (0..3).map(whole).collect();
        while batch.len() < CELLS {
            let mut parts = Vec::new();
            batch.iter().for_each(|node| node.branch(&search.pair().a, node.foot, None, &mut parts));
            batch = parts;
        }
        // With a threshold of 0 no cell is pruned, and each whose centre is not on B
        // is returned with its bound. Its parts are bounded next.
        for _ in 0..ROUNDS {
            let result = pollster::block_on(driver.bound(&batch, 0.0)).unwrap();
            assert!(result.cells >= batch.len() && result.dropped == 0.0);
            let nodes = || result.waiting.iter().chain(&result.undecided);
            let (mut parts, stride) = (Vec::new(), (nodes().count() / CHECKED).max(1));
            for node in nodes().step_by(stride) {
                let Domain::Cell(cell) = node.domain else { panic!("the batch has a node of the BVH") };
                let position = [0, 1].map(|_| [-1.0, 1.0, 2.0 * random.f64() - 1.0][random.usize(0..3)]);
                let point = transform.apply(a.patches.patch(cell.patch as usize).point(cell.at(position)));
                let truth = closest(&b, point, 1e-9).unwrap();
                assert!(truth.lower <= node.upper, "{degree:?}: {} > {}", truth.lower, node.upper);
                checked += 1;
                node.branch(&search.pair().a, node.foot, None, &mut parts);
            }
            batch = parts;
        }
    }
    assert!(checked > 5_000, "{checked}");
}
