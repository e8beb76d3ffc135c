//! The bound is attained, and no point is farther.

use super::*;
use crate::certified::nearest::{Foot, NearestPoint};
use crate::certified::testing::{Surfaces, closed, oblique, patch, through};
use crate::certified::{Cell, Pair};
use crate::flatness::Flatness;
use crate::model::RigidTransform;

/// The bound of a whole patch, from a start for the foot of its centre.
fn bound(a: &Surfaces, b: &Surfaces, start: [f64; 2], threshold: f64) -> Option<f64> {
    let pair = Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY };
    let nearest = NearestPoint::new(pair.b);
    let mut context = CellContext::new(&pair, &nearest, Cell::whole(0), &Foot::start(0, start));
    Heights.evaluate(&mut context, threshold)
}

/// The square [0, 1]² in the plane z = 0 in parameters that are not affine, with weights.
fn plane() -> Surfaces {
    let mut controls = through(|s, t| DVec3::new(s, t, 0.0));
    for (index, weight) in [(1, 1.1), (4, 0.9), (5, 1.05), (7, 1.1)] {
        controls[index].w = weight;
    }
    controls[4].x += 0.03;
    patch(controls)
}

/// A parallel plane is at its height, whatever the parameters and weights of both.
#[test]
fn planes_are_at_their_distance() {
    for height in [0.0, 1e-6, -1e-3] {
        let mut controls = oblique(|_, _| height);
        controls[4].w = 1.2;
        let bound = bound(&patch(controls), &plane(), [0.5; 2], 1.0).unwrap();
        let truth = height.abs();
        assert!((truth..=truth * (1.0 + 1e-9) + 1e-13).contains(&bound), "{bound:e} {truth:e}");
    }
}

/// A slope counts in full: the height of the farthest corner.
#[test]
fn a_slope_is_its_height() {
    let bound = bound(&patch(oblique(|x, _| 1e-3 * (x - 0.5))), &plane(), [0.5; 2], 1.0).unwrap();
    assert!((0.25e-3..=0.25e-3 * (1.0 + 1e-3)).contains(&bound), "{bound:e}");
}

/// The same paraboloid in parameters at 45° is at no distance from any of its points, and with a part
/// added at that part's height: the function that vanishes on it is found from a foot beside its axis.
#[test]
fn quadrics_are_at_no_distance_from_themselves() {
    for vertex in [0.5, 0.3] {
        let height = |x: f64, y: f64| 0.1 * ((x - vertex).powi(2) - 0.5 * (y - vertex).powi(2));
        let b = patch(through(|s, t| DVec3::new(s, t, height(s, t))));
        let on = bound(&patch(oblique(height)), &b, [0.5; 2], 1e-9).unwrap();
        assert!(on <= 1e-12, "{on:e} of {vertex}");
        let above = bound(&patch(oblique(|x, y| height(x, y) + 1e-5)), &b, [0.5; 2], 1.1e-5).unwrap();
        assert!((0.97e-5..=1.05e-5).contains(&above), "{above:e} of {vertex}");
    }
}

/// A cell that leaves B's end by some length is at that length.
#[test]
fn a_cell_beyond_the_end_is_at_its_overhang() {
    const BEYOND: f64 = 1e-3;
    let b = patch(through(|s, t| DVec3::new(s, t, 0.0)));
    for axis in 0..2 {
        for end in [0.0, 1.0] {
            let a = through(|s, t| {
                let mut point = [0.4 + 0.2 * s, 0.4 + 0.2 * t];
                let inwards = 0.2 * [s, t][axis];
                point[axis] = if end == 0.0 { inwards - BEYOND } else { 1.0 + BEYOND - inwards };
                DVec3::new(point[0], point[1], 0.0)
            });
            let bound = bound(&patch(a), &b, [0.5; 2], 1.0).unwrap();
            assert!((BEYOND..=BEYOND * (1.0 + 1e-6)).contains(&bound), "{bound:e} at {end} of {axis}");
        }
    }
}

/// Where B's parameter lags behind its linear function, a cell ends beyond B although that function
/// says that it does not.
#[test]
fn the_lag_of_a_parameter_shows_the_end() {
    const BEYOND: f64 = 0.05;
    for axis in 0..2 {
        let place = |along: f64, across: f64| {
            if axis == 0 { DVec3::new(along, across, 0.0) } else { DVec3::new(across, along, 0.0) }
        };
        // Along the axis with the controls 0, 0.7 and 1: at 0.6 with derivative 1 in the middle.
        let b = through(|s, t| {
            let [x, across] = if axis == 0 { [s, t] } else { [t, s] };
            place(x * (1.4 - 0.4 * x), across)
        });
        let a = through(|s, t| place(0.6 + (0.4 + BEYOND) * (2.0 * s - 1.0), 0.4 + 0.2 * t));
        let bound = bound(&patch(a), &patch(b), [0.5; 2], 1.0).unwrap();
        assert!(bound >= BEYOND, "{bound:e} along axis {axis}");
    }
}

/// No point of a cell is farther than its bound: oblique patches near closed surfaces, polynomial and
/// rational, over their seams and knot lines.
#[test]
fn no_point_is_farther_than_the_bound() {
    let random = &mut fastrand::Rng::with_seed(28);
    let mut bounded = 0;
    for case in 0..60 {
        let b = Surfaces::new(vec![closed(700 + case, case % 2 == 1)], Flatness::None);
        let (pair_b, sheets) = (b.operand(), b.sheets());
        let nearest = NearestPoint::new(pair_b);
        for _ in 0..20 {
            let flat = random.u32(0..b.places.count() as u32);
            let chart = Chart::new(sheets, flat, [random.f64(), random.f64()]);
            let size = 10.0_f64.powf(-0.5 - 2.0 * random.f64());
            let jet = chart.jet();
            let [turn, skew] = [random.f64() * std::f64::consts::TAU, 0.5 + random.f64()];
            let noise: Vec<f64> = (0..9).map(|_| 1e-2 * size * (random.f64() - 0.5)).collect();
            let normal = jet.s.cross(jet.t).normalize();
            let mut controls = through(|s, t| {
                let [x, y] = [size * (s - 0.5), skew * size * (t - 0.5)];
                let step = [x * turn.cos() - y * turn.sin(), x * turn.sin() + y * turn.cos()];
                let [u, v] = step;
                let bend = 0.5 * u * u * jet.ss + u * v * jet.st + 0.5 * v * v * jet.tt;
                jet.point + u * jet.s + v * jet.t + bend
            });
            for (control, noise) in controls.iter_mut().zip(&noise) {
                *control += (*noise * jet.s.length() * normal).extend(0.0);
            }
            let a = patch(controls);
            let Some(upper) = bound_from(&a, &nearest, pair_b, flat) else { continue };
            bounded += 1;
            for _ in 0..20 {
                let target = a.operand().patch(0).point([random.f64(), random.f64()]);
                let foot = nearest.nearest(target, Foot::start(flat, [0.5; 2]), 0.0);
                let foot = nearest.certified(target, foot, 1e-9);
                assert!(foot.distance() <= upper + 1e-9, "{} {upper} case {case}", foot.distance());
            }
        }
    }
    assert!(bounded > 200, "{bounded}");
}

/// The bound of a whole patch from its nearest foot.
fn bound_from(a: &Surfaces, nearest: &NearestPoint<'_>, b: Operand<'_>, flat: u32) -> Option<f64> {
    let pair = Pair { a: a.operand(), b, transform: RigidTransform::IDENTITY };
    let mut context = CellContext::new(&pair, nearest, Cell::whole(0), &Foot::start(flat, [0.5; 2]));
    Heights.evaluate(&mut context, 1.0).filter(|bound| bound.is_finite())
}
