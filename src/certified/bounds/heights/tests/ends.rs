//! Cells over ends of surfaces that lie in planes.

use super::super::comparison::candidates;
use super::super::frame::Placement;
use super::*;
use crate::axis::Axis;
use crate::certified::nearest::{Foot, NearestPoint};
use crate::certified::testing::{Surfaces, patch, through};
use crate::flatness::Flatness;
use crate::model::SurfaceArrays;
use crate::rounding::upper_min;
use glam::{DMat3, DVec4};

/// An arc of the unit circle between two angles: homogeneous controls.
fn arc([from, to]: [f64; 2]) -> [DVec3; 3] {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let at = |angle: f64| DVec3::new(angle.cos(), angle.sin(), 1.0);
    [at(from), DVec3::new(middle.cos(), middle.sin(), half.cos()), at(to)]
}

/// The part of a torus about the z axis, or with the major radius 0 of the unit sphere, between longitudes, along s, and
/// latitudes, along t.
fn revolved(major: f64, longitudes: [f64; 2], latitudes: [f64; 2]) -> [DVec4; 9] {
    let (along, across) = (arc(longitudes), arc(latitudes));
    std::array::from_fn(|index| {
        let (u, v) = (along[index / 3], across[index % 3]);
        let radius = v.x + major * v.z;
        let weight = v.z * u.z;
        (DVec3::new(radius * u.x, radius * u.y, v.y * u.z) / weight).extend(weight)
    })
}

/// The same in other parameters: those of a torus about a line that is turned about the x axis.
fn turned(controls: [DVec4; 9], angle: f64) -> [DVec4; 9] {
    let turn = DMat3::from_rotation_x(angle);
    controls.map(|control| (turn * control.xyz()).extend(control.w))
}

/// Surfaces of patches of degree 2.
fn surfaces(patches: &[[DVec4; 9]]) -> Surfaces {
    let knots = [0; 2].map(|_| vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
    let of = |controls: &[DVec4; 9]| SurfaceArrays {
        degree: [2, 2],
        knots: knots.clone(),
        counts: [3, 3],
        control_points: controls.map(|control| control.to_array()).to_vec(),
    };
    Surfaces::new(patches.iter().map(of).collect(), Flatness::None)
}

fn bound(a: &Surfaces, b: &Surfaces, threshold: f64) -> Option<f64> {
    bound_of(a.operand(), b.operand(), threshold)
}

/// A cell of the sphere across a circle of latitude, or a meridian, at which two parts of it meet is at no distance
/// however large it is, and without one of them there is no bound.
#[test]
fn parts_of_a_sphere_that_meet_in_a_plane_are_at_no_distance_from_it() {
    let a = patch(turned(revolved(0.0, [-0.14, 0.12], [-0.11, 0.13]), 0.4));
    let (all, low, high) = ([-0.5, 0.5], [-0.6, 0.02], [0.02, 0.7]);
    for parts in [[(all, low), (all, high)], [(low, all), (high, all)]] {
        let parts = parts.map(|(longitudes, latitudes)| revolved(0.0, longitudes, latitudes));
        let found = bound(&a, &surfaces(&parts), 1e-9);
        assert!(found.is_some_and(|bound| bound <= 1e-12), "{found:?}");
        for part in &parts {
            let found = bound(&a, &surfaces(&[*part]), 1e-9);
            assert!(found.is_none(), "{found:?}");
        }
    }
}

/// Over a slit between two circles of latitude the bound is half its width, but for what the functions turn over the
/// cell, where those that follow the parameters are off by more.
#[test]
fn a_cell_over_a_slit_along_a_circle_is_at_half_its_width() {
    let a = patch(turned(revolved(0.0, [-0.04, 0.04], [-0.04, 0.04]), 0.4));
    for width in [5e-7, 1e-6] {
        let parts = [[-0.6, 0.0], [width, 0.7]].map(|latitudes| revolved(0.0, [-0.5, 0.5], latitudes));
        let found = bound(&a, &surfaces(&parts), 6.0 * width).unwrap();
        let truth = 0.5 * width;
        assert!((truth * (1.0 - 1e-9)..=truth * 1.25).contains(&found), "{found:e} {truth:e}");
    }
}

/// The bound is 0 for a cell that ends with the surface, and the length of the overshoot for one that extends beyond it.
#[test]
fn a_cell_at_the_end_of_a_sphere_is_as_far_as_it_is_beyond_it() {
    let b = surfaces(&[revolved(0.0, [-0.5, 0.5], [-0.6, 0.2])]);
    for beyond in [0.0, 1e-6, 5e-6_f64] {
        let size = upper_max(2.0 * beyond.cbrt(), 1e-2);
        let a = patch(revolved(0.0, [-size, 1.5 * size], [0.2 - size, 0.2 + beyond]));
        let found = bound(&a, &b, 1e-9 + 1.25 * beyond);
        let is_close = |found: f64| (beyond * (1.0 - 1e-9)..=beyond * 1.25 + 1e-12).contains(&found);
        assert!(found.is_some_and(is_close), "{found:?} {beyond:e}");
    }
}

/// A frame about a foot of a patch with a cell about it, and the patch over it.
fn over(b: &Surfaces, at: [f64; 2], size: f64) -> Over<'_> {
    let frame = Frame::new(Chart::new(b.sheets(), 0, at)).unwrap();
    let patch = b.operand().patch(0);
    // The cell is the part of the same patch over these parameters, clamped to its domain.
    let ends = at.map(|at| [(at - size).max(0.0), (at + size).min(1.0)]);
    let controls = patch.restricted(ends[0], ends[1]);
    let a = Piece::new(patch.degree, controls, frame.jet.point - patch.center, 10.0);
    let (image, linear) = frame.image(&a).unwrap();
    Over::of(frame, None, a, image, linear)
}

/// One end of an axis alone.
fn open(axis: usize, end: usize) -> [[bool; 2]; 2] {
    let mut open = [[false; 2]; 2];
    open[axis][end] = true;
    open
}

/// The functions at ends are constant there and have no part across the surface; the other axis keeps its own.
#[test]
fn functions_at_ends_vanish_on_them() {
    let spheres = surfaces(&[revolved(0.0, [-0.5, 0.5], [-0.6, 0.3])]);
    for (axis, end, at) in
        [(1, 1, [0.5, 0.97]), (1, 0, [0.5, 0.05]), (0, 1, [0.96, 0.5]), (0, 0, [0.06, 0.4])]
    {
        let over = over(&spheres, at, 0.15);
        let closer = over.frame.closer_placement(&over.a, &over.image);
        let found = over.frame.placement_at_ends(&over.a, &over.image, open(axis, end), 1e-9).unwrap();
        let spread = |placement: &Placement| {
            let ranges = over.image.end(Axis::BOTH[axis], end);
            let [low, high] =
                ranges.map(|curve| curve.values(&placement.functions[axis]).range()).next().unwrap();
            (high - low) / over.frame.inverse[axis].length()
        };
        assert!(spread(&found) < 1e-12, "{:e}", spread(&found));
        if axis == 1 {
            assert!(spread(&closer) > 1e-6, "{:e}", spread(&closer));
        }
        let gradient = found.functions[axis].linear;
        assert!(gradient.dot(over.frame.normal).abs() < 1e-12 * gradient.length());
        let row = over.frame.inverse[axis];
        assert!((gradient - row).length() <= 0.05 * row.length());
        let other = 1 - axis;
        assert_eq!(found.functions[other].form, closer.functions[other].form);
    }
}

/// Ends that lie in no plane, whose plane is nearly that of the surface, or that turn too far from the parameter's lines
/// have no such functions, nor have both ends of an axis.
#[test]
fn other_ends_have_no_such_functions() {
    let of_foot = |b: &Surfaces, open: [[bool; 2]; 2], foot: f64| {
        let over = over(b, [0.5, foot], 1.2 * (1.0 - foot) + 0.09);
        over.frame.placement_at_ends(&over.a, &over.image, open, 1e-9).is_some()
    };
    let of = |b: &Surfaces, open: [[bool; 2]; 2]| of_foot(b, open, 0.95);
    let at_end = open(1, 1);
    let latitude = |end: f64| surfaces(&[revolved(0.0, [-0.3, 0.3], [end - 0.3, end])]);
    assert!(of(&latitude(1.2), at_end) && !of(&latitude(1.4), at_end));
    assert!(!of(&latitude(0.4), [[false; 2], [true; 2]]) && !of(&latitude(0.4), [[false; 2]; 2]));
    // An end that leaves its plane by more than a sixty-fourth of the threshold, or by less.
    let wavy = |height: f64| {
        let point = |index: usize, shift: f64| {
            let (bow, wave) = ([0.3, -0.1, -0.1, 0.3][index], [1.0, -1.0, 1.0, -1.0][index] * height);
            [index as f64 / 3.0, shift + 0.3 * bow, bow + wave, 1.0]
        };
        let knots = [vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]];
        let control_points = (0..4).flat_map(|index| [0.0, 1.0].map(|shift| point(index, shift))).collect();
        let surface = SurfaceArrays { degree: [3, 1], knots, counts: [4, 2], control_points };
        Surfaces::new(vec![surface], Flatness::None)
    };
    let deviation = |height: f64| of(&wavy(height), at_end);
    assert_eq!([0.0, 1e-12, 1e-6].map(deviation), [true, true, false]);
    // A straight end, about a foot where the other lines run as the end does, or at an angle of 21° to it.
    let askew = patch(through(|s, t| DVec3::new(s, t + 4.0 * t * t * s, 0.0)));
    assert!(of_foot(&askew, at_end, 0.95) && !of_foot(&askew, at_end, 0.6));
}

/// Whatever functions serve, and however they turn, no point of a cell that goes beyond an end is farther than the
/// bound.
#[test]
fn no_point_is_farther_whatever_the_functions_are() {
    let random = &mut fastrand::Rng::with_seed(317);
    let mut bounded = 0;
    for case in 0..400 {
        let b = surfaces(&[revolved([0.0, 2.0][case % 2], [-0.5, 0.5], [-0.6, 0.3])]);
        let operand = b.operand();
        let nearest = NearestPoint::new(operand);
        let beyond = 0.01 * random.f64();
        let a = revolved([0.0, 2.0][case % 2], [-0.1, 0.1], [0.1, 0.3 + beyond]);
        let a_surfaces = patch(a);
        let frame = Frame::new(Chart::new(b.sheets(), 0, [0.5, 0.8 + 0.2 * random.f64()])).unwrap();
        let of_a = a_surfaces.operand().patch(0);
        let whole = of_a.restricted([0.0, 1.0], [0.0, 1.0]);
        let a = Piece::new([2, 2], whole, frame.jet.point - of_a.center, 10.0);
        let Some((image, linear)) = frame.image(&a) else { continue };
        let mut functions = frame.closer_placement(&a, &image).functions;
        for function in &mut functions {
            let size = function.linear.length();
            let mut number = || 0.3 * size * (random.f64() - 0.5);
            function.linear += DVec3::new(number(), number(), number());
            function.form += DMat3::from_diagonal(DVec3::new(number(), number(), number()));
        }
        let placement = frame.placement(&a, &image, functions);
        let over = Over::of(frame, None, a, image, linear);
        let mut found = f64::INFINITY;
        for candidate in candidates(&over.a, over.frame.normal, over.frame.tangents[0], 1.0) {
            found = upper_min(found, over.comparison(&placement).bound_by(&candidate));
        }
        if !found.is_finite() {
            continue;
        }
        bounded += 1;
        for place in [[0.0, 1.0], [0.5, 1.0], [1.0, 1.0], [0.3, 0.9]] {
            let target = of_a.point(place);
            let foot = nearest.nearest(target, Foot::start(0, [0.5; 2]), 0.0);
            let distance = nearest.certified(target, foot, 1e-9).distance();
            assert!(distance <= found + 1e-9, "{distance:e} {found:e} of case {case}");
        }
    }
    assert!(bounded > 100, "{bounded}");
}
