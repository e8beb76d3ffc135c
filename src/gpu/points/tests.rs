//! The allowances of the table in docs/points.md, written out.

use super::subpatches::Subpatches;
use super::{Copy, GpuPoints};
use crate::bezier::{Patch, PatchSet};
use crate::closest::{Target, nearest_control, newton};
use crate::gpu::Gpu;
use crate::gpu::float32::UNIT_ROUNDOFF;
use crate::gpu::testing::adapter::gpu;
use crate::param_box::ParamBox;
use crate::rounding::gamma;
use glam::{DVec3, DVec4, Vec4Swizzles};
use std::sync::Arc;

const U: f64 = UNIT_ROUNDOFF;

/// The share of a loss by which the derivatives of F in the tests may differ from those in exact arithmetic.
const SHARE_LEFT_OUT: f64 = 0.03;

/// A gap below 0 by which boxes suffice only where they are so much farther than the foot: nearer subpatches are bounded.
const BOUNDED: f64 = -0.1;

fn target(patches: &[([usize; 2], Vec<DVec4>)]) -> Target {
    let mut set = PatchSet::default();
    for (degree, controls) in patches {
        set.push(Patch {
            surface: 0,
            degree: *degree,
            domain: ParamBox::UNIT,
            center: DVec3::ZERO,
            controls,
            rational: controls.iter().any(|control| control.w != 1.0),
        });
    }
    Target::new(set)
}

fn stage(gpu: &Arc<Gpu>, target: &Target, gap: f64) -> GpuPoints {
    let uploaded = Arc::new(gpu.upload_point_target(target));
    pollster::block_on(GpuPoints::new(gpu, uploaded, gap, 64)).unwrap().unwrap()
}

/// A square of this side about `middle`, along two axes.
fn square(middle: DVec3, [along, across]: [DVec3; 2]) -> ([usize; 2], Vec<DVec4>) {
    let corner = |i: f64, j: f64| (middle + i * along + j * across).extend(1.0);
    ([1, 1], vec![corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, -1.0), corner(1.0, 1.0)])
}

/// Half the height of the quarter: so low that F hardly depends on the weights.
const HALF_HEIGHT: f64 = 1e-3;

/// The quarter of a cylinder of radius 1 about the y axis, about the x axis.
fn quarter() -> ([usize; 2], Vec<DVec4>) {
    let half = 0.5_f64.sqrt();
    let arc = [
        DVec4::new(half, 0.0, -half, 1.0),
        DVec4::new(1.0, 0.0, 0.0, half),
        DVec4::new(half, 0.0, half, 1.0),
    ];
    let at = |control: DVec4, y: f64| control + DVec4::new(0.0, control.w * y, 0.0, 0.0);
    (
        [2, 1],
        arc.into_iter().flat_map(|control| [at(control, -HALF_HEIGHT), at(control, HALF_HEIGHT)]).collect(),
    )
}

/// Checks what the kernel loses of the squared distance 1 from the origin to patch 1, of two patches, by the least bound on
/// its subpatches in units of the model's size.
fn check(
    gpu: &Arc<Gpu>,
    patches: &[([usize; 2], Vec<DVec4>)],
    gap: f64,
    bound: impl Fn(&Patch<'_>, [f64; 2], f64) -> f64,
) {
    let target = target(patches);
    let stage = stage(gpu, &target, gap);
    let scale = stage.target.subpatches.scale;
    let found = pollster::block_on(stage.run(&[Copy::new(DVec3::ZERO, &stage.target)])).unwrap()[0];
    assert_eq!(found.owner, 0);
    let cut = Subpatches::new(&target);
    let mut least = f64::INFINITY;
    for (index, domain) in cut.domains.iter().enumerate().filter(|(_, domain)| domain.patch == 1) {
        let [low, high] = [[0.0; 2], [1.0; 2]].map(|at| domain.patch_parameters(at));
        let widths = [high[0] - low[0], high[1] - low[1]];
        let bound = bound(&cut.target.patches.patch(index), widths, scale);
        least = if bound < least { bound } else { least };
    }
    let exact = scale * scale;
    let [lost, expected] = [f64::from(found.others), least].map(|bound| exact - bound);
    println!("lost {lost:e}, by the lemma {expected:e}");
    // Two roundings of the result, and what is left out of the lemma's own.
    let rounding = 2.0 * U * exact / expected + SHARE_LEFT_OUT;
    assert!((lost / expected - 1.0).abs() <= rounding, "lost {lost:e}, by the lemma {expected:e}");
}

/// Lemma P3 from the origin, with all derivatives of F as they are in exact arithmetic: w² times `second` along the axes of
/// the whole patch, none mixed, and slopes 0.
fn about(patch: &Patch<'_>, widths: [f64; 2], scale: f64, second: [f64; 2]) -> f64 {
    let foot = newton(patch, DVec3::ZERO, nearest_control(patch, DVec3::ZERO), 16);
    let at = patch.point(foot.parameters);
    let distance = scale * at.length();
    let at = at - patch.center;
    // The quarter's weights are 1 and less, and so are those of its parts, above 1/2.
    let heaviest = patch.controls.iter().map(|control| control.w).fold(0.0, f64::max);
    let weight_scale = if heaviest < 1.0 { 2.0 } else { 1.0 };
    let lightest = patch.controls.iter().map(|control| control.w).fold(f64::INFINITY, f64::min);
    let [heaviest, lightest] = [heaviest, lightest].map(|weight| weight_scale * weight);
    let offset = |control: &DVec4| scale * weight_scale * (control.xyz() - control.w * at).length();
    let radius = patch.controls.iter().map(offset).fold(0.0, f64::max);
    let [p, q] = patch.degree.map(|degree| degree as f64);
    let pull = heaviest * distance;
    let span = radius + heaviest * scale * at.length();
    let n = 4.0 * (p + q) + 4.0;
    let terms = (p + 1.0) * (q + 1.0) + 20.0;
    let of_form = U * (terms * radius * (radius + 2.0 * pull) + 2.0 * span * (radius + pull));
    let mixed = 4.0 * p * q * 4.0 * of_form;
    let seconds = [0, 1].map(|axis| {
        let degree = 2.0 * [p, q][axis];
        second[axis] * (lightest * scale * widths[axis]).powi(2) - degree * (degree - 1.0) * 4.0 * of_form
    });
    let share = if seconds[0] > 0.0 && seconds[1] > 0.0 { (seconds[0] / seconds[1]).sqrt() } else { 1.0 };
    let of_slope = U * span * ((8.0 * n + 20.0) * radius + (16.0 * n + 50.0) * pull);
    let least = |axis: usize| {
        let shared = mixed * [share, 1.0 / share][axis];
        let curvature = seconds[axis] - shared - 16.0 * U * (seconds[axis].abs() + shared);
        let slope = [p, q][axis] * of_slope;
        let room = foot.parameters[axis].max(1.0 - foot.parameters[axis]);
        if curvature > 0.0 {
            -0.5 * slope * slope / curvature
        } else {
            0.5 * curvature * room * room - slope * room
        }
    };
    let excess = least(0) + least(1) - U * span * (4.0 * n + 10.0) * pull;
    distance * distance * (1.0 - 8.0 * U) + excess / (lightest * lightest)
}

/// A plane beyond a nearer one on the other side, askew to the axes: no plane behind the nearest foot separates it. F(g) and
/// the square have allowances.
#[test]
fn the_value_about_a_foot_has_its_allowance() {
    let Some(gpu) = gpu("the_value_about_a_foot_has_its_allowance") else { return };
    let normal = DVec3::new(1.0, 2.0, -2.0) / 3.0;
    let (along, across) = normal.any_orthonormal_pair();
    let near = square(-0.99 * normal, [0.5 * along, 0.5 * across]);
    for size in [4.0, 1.0] {
        let far = square(normal, [size * along, size * across]);
        // |S_s|² = (2 size)², and twice that is the second derivative of the square.
        let second = [8.0 * size * size; 2];
        check(&gpu, &[near.clone(), far], BOUNDED, |patch, widths, scale| {
            about(patch, widths, scale, second)
        });
    }
}

/// From its axis every point of a cylinder has the same distance: F is 0 along the arc, and so are its derivatives. Second
/// differences and slopes have allowances, along either axis of the patch.
#[test]
fn second_differences_and_slopes_have_their_allowances() {
    let Some(gpu) = gpu("second_differences_and_slopes_have_their_allowances") else { return };
    let near = square(DVec3::new(-0.99, 0.0, 0.0), [0.25 * DVec3::Y, 0.25 * DVec3::Z]);
    let along_the_axis = 2.0 * (2.0 * HALF_HEIGHT).powi(2);
    let ([p, q], arcs) = quarter();
    let turned =
        (0..=q).flat_map(|j| (0..=p).map(move |i| i * (q + 1) + j)).map(|index| arcs[index]).collect();
    let cases = [(([p, q], arcs.clone()), [0.0, along_the_axis]), (([q, p], turned), [along_the_axis, 0.0])];
    for (quarter, second) in cases {
        check(&gpu, &[near.clone(), quarter], BOUNDED, |patch, widths, scale| {
            about(patch, widths, scale, second)
        });
    }
}

/// Planes about whose corners the squared distance is expanded, as no step is taken: the bound is that of the foot's
/// quadratic, exact where both axes are orthogonal and the weights equal, and below it else.
#[test]
fn a_bound_about_no_foot_is_that_of_the_foot() {
    let Some(gpu) = gpu("a_bound_about_no_foot_is_that_of_the_foot") else { return };
    let normal = DVec3::new(1.0, 2.0, -2.0) / 3.0;
    let (along, across) = normal.any_orthonormal_pair();
    // Off the corners of all subpatches.
    let middle = normal + 0.043 * along + 0.057 * across;
    let near = square(-0.5 * normal, [0.1 * along, 0.1 * across]);
    let orthogonal = square(middle, [along, across]);
    let skewed = [1.0, -1.0].map(|sign| square(middle, [along, across + sign * 0.7 * along]));
    let mut weighed = [orthogonal.clone(), orthogonal.clone()];
    for (index, axis) in [(0, 0), (1, 0), (2, 0), (3, 0), (0, 1), (1, 1), (2, 1), (3, 1)] {
        let end = [index / 2, index % 2][axis];
        weighed[axis].1[index] *= [1.0, 0.1][end];
    }
    let [one, other] = skewed;
    let [by_s, by_t] = weighed;
    for (index, far) in [orthogonal, one, other, by_s, by_t].into_iter().enumerate() {
        let target = target(&[near.clone(), far]);
        let mut stage = stage(&gpu, &target, -0.6);
        stage.iterations = 0;
        let found = pollster::block_on(stage.run(&[Copy::new(DVec3::ZERO, &stage.target)])).unwrap()[0];
        assert_eq!(found.owner, 0);
        let bound = f64::from(found.others) / stage.target.subpatches.scale.powi(2);
        println!("{index}: {bound}");
        assert!(bound <= 1.0, "{index}: {bound}");
        assert!(index > 0 || bound >= 1.0 - 300.0 * U, "{bound}");
    }
}

/// A plane behind a parallel one, askew to the axes, so that no box is passed over: the height along the normal.
#[test]
fn heights_have_their_allowance() {
    let Some(gpu) = gpu("heights_have_their_allowance") else { return };
    let normal = DVec3::new(1.0, 2.0, -2.0) / 3.0;
    let (along, across) = normal.any_orthonormal_pair();
    let squares = [0.99, 1.0].map(|height| square(height * normal, [0.03 * along, 0.03 * across]));
    // Heights above 0.9975 suffice.
    check(&gpu, &squares, -0.0075, |patch, _, scale| {
        let reach = patch.local_points().map(DVec3::length).fold(0.0, f64::max);
        let height = scale * (1.0 - 20.0 * U * (patch.center.length() + reach));
        height * height * (1.0 - 4.0 * U)
    });
}

/// A box that is passed over, whose side is the distance, behind a patch that is a point.
#[test]
fn boxes_have_their_allowance() {
    let Some(gpu) = gpu("boxes_have_their_allowance") else { return };
    let sized = |z: f64, size: f64| square(DVec3::new(0.0, 0.0, z), [size * DVec3::X, size * DVec3::Y]);
    check(&gpu, &[sized(0.875, 0.0), sized(1.0, 0.25)], 0.0, |_, _, scale| scale * scale * (1.0 - 1e-6));
}

/// What is taken off after the kernel: the copies of patches and of the point, and the point relative to a centre.
#[test]
fn a_copy_has_its_allowances() {
    let Some(gpu) = gpu("a_copy_has_its_allowances") else { return };
    // Halved as often as is allowed, the sides have no number of float32.
    let squares =
        [0.25, 1.0 / 3.0].map(|z| square(DVec3::new(0.0, 0.0, z), [DVec3::X / 3.0, DVec3::Y / 3.0]));
    let target = target(&squares);
    let stage = stage(&gpu, &target, 1e-6);
    let subpatches = &stage.target.subpatches;
    let aabb = target.patches.bounding_box();
    let halved = gamma(2.0 * 6.0 + 8.0) * aabb.diagonal() + gamma(1.0) * aabb.farthest_from_origin();
    let part = (stage.target.error - subpatches.representation_error) / halved;
    assert!(subpatches.representation_error > 1e-3 * U && (part - 1.0).abs() <= 1e-3, "{part}");
    for point in
        [DVec3::new(0.1, 0.3, 7.0 / 9.0), DVec3::new(0.5, -0.25, 0.75), DVec3::new(0.0, 0.0, 1e5 / 3.0)]
    {
        let copy = Copy::new(point, &stage.target);
        let scaled = subpatches.scale * (point - subpatches.origin);
        let rounding = scaled.as_vec3().as_dvec3().distance(scaled) / subpatches.scale;
        let distance = point.distance(subpatches.origin);
        let local = 1.01 * U * (distance + subpatches.radius) + gamma(8.0) * distance;
        let part = copy.error / (stage.target.error + rounding + local);
        assert!((part - 1.0).abs() <= 1e-11, "{point}: {part}");
    }
    // Where squares might overflow nothing is measured.
    assert_eq!(Copy::new(DVec3::new(0.0, 0.0, 1e13), &stage.target).error, f64::INFINITY);
    assert_eq!(Copy::new(DVec3::NAN, &stage.target).error, f64::INFINITY);
}
