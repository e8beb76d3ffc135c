//! Cells on which the kernel's Taylor bound is attained up to float32: one that
//! leaves out a part of the remainder is below a distance.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

use super::adapter::gpu;
use crate::bezier::{LocalDerivativeBounds, Patch, PatchSet};
use crate::certified::{BranchAndBound, Cell, Domain, Foot, Operand, Pair, SearchNode};
use crate::closest::Target;
use crate::gpu::Gpu;
use crate::gpu::certified::GpuCertified;
use crate::model::RigidTransform;
use crate::param_box::ParamBox;
use glam::{DVec3, DVec4};
use std::sync::Arc;

/// The Bernstein coefficients of 1, x, x² and x³ in degree 3.
const MONOMIALS: [[f64; 4]; 4] =
    [[1.0; 4], [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0], [0.0, 0.0, 1.0 / 3.0, 1.0], [0.0, 0.0, 0.0, 1.0]];

/// A tolerance to which float32 is exact enough for uncut patches.
const TOLERANCE: f64 = 0.05;

/// The patch of degrees 3 with the controls that `point` gives.
fn patch(point: impl Fn(usize, usize) -> DVec3) -> Target {
    let controls: Vec<DVec4> = (0..16).map(|index| point(index / 4, index % 4).extend(1.0)).collect();
    let mut patches = PatchSet::default();
    patches.push(Patch {
        surface: 0,
        degree: [3, 3],
        domain: ParamBox::UNIT,
        center: DVec3::ZERO,
        controls: &controls,
        rational: false,
    });
    Target::new(patches)
}

/// The graph z = factor s^a t^b over the square from `low` to `high`.
fn graph(factor: f64, [a, b]: [usize; 2], [low, high]: [f64; 2]) -> Target {
    let at = |index: usize| low + MONOMIALS[1][index] * (high - low);
    patch(|i, j| DVec3::new(at(i), at(j), factor * MONOMIALS[a][i] * MONOMIALS[b][j]))
}

/// The parallelogram in the plane z = 0 around (½, ½) of these half sides.
fn parallelogram([p, q]: [[f64; 2]; 2]) -> Target {
    let at = |index: usize| 2.0 * MONOMIALS[1][index] - 1.0;
    patch(|i, j| {
        let [x, y] = [0, 1].map(|axis| 0.5 + at(i) * p[axis] + at(j) * q[axis]);
        DVec3::new(x, y, 0.0)
    })
}

/// The kernels' upper bound on the only patch of A.
fn upper_bound(gpu: &Arc<Gpu>, a: &Target, b: &Target) -> f64 {
    let bounds = [(); 2].map(|()| [LocalDerivativeBounds::new(ParamBox::UNIT)]);
    let [a, b] = [Operand::new(a, &bounds[0]), Operand::new(b, &bounds[1])];
    let pair = Pair { a, b, transform: RigidTransform::IDENTITY };
    let search = BranchAndBound::new(pair, TOLERANCE, None, 0.0);
    let driver = GpuCertified::new(gpu, &search).unwrap().unwrap();
    let cell = Cell { patch: 0, center: [0.5; 2], half: [0.5; 2] };
    let foot = Foot::start(0, [0.5; 2]);
    let node = SearchNode { domain: Domain::Cell(cell), upper: 1e6, foot, level: 0 };
    // With so high a threshold the first level prunes everything.
    let result = pollster::block_on(driver.bound(&[node], 1e5)).unwrap();
    assert_eq!((result.cells, result.waiting.len(), result.undecided.len()), (1, 0, 0));
    result.dropped
}

/// Over a plane the distance of a graph is its height, and all terms of its
/// expansion are the largest at the same corner.
#[test]
fn the_remainders_of_both_surfaces_are_attained() {
    let Some(gpu) = gpu("the_remainders_of_both_surfaces_are_attained") else { return };
    let plane = graph(0.0, [0, 0], [-2.0, 3.0]);
    // B's slopes of 0.06 at most take less than 0.2 % off its height. A is
    // smaller than B, so that feet beyond its edges are inside B; along the sides
    // of the second both parameters of B grow.
    let factor = 0.02;
    let flat = [([[0.45, 0.0], [0.0, 0.45]], 0.95), ([[0.2, 0.1], [0.1, 0.2]], 0.8)];
    for powers in (0..=3).flat_map(|a| (0..=3 - a).map(move |b| [a, b])).skip(1) {
        let bound = upper_bound(&gpu, &graph(1.0, powers, [0.0, 1.0]), &plane);
        assert!((1.0..1.001).contains(&bound), "{powers:?}: {bound}");
        for (sides, corner) in flat {
            let bound = upper_bound(&gpu, &parallelogram(sides), &graph(factor, powers, [0.0, 1.0]));
            let height = factor * f64::powi(corner, (powers[0] + powers[1]) as i32);
            assert!((0.998..1.02).contains(&(bound / height)), "{powers:?}: {bound}, not {height}");
        }
    }
}
