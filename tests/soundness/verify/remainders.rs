//! Upper ends that a remainder half as large would prove, although they are wrong: the corners of a
//! patch lie on the other one, and the points of the patch that are beyond lie between all samples.

use super::{SETTINGS, parallelogram, parsed};
use crate::proof::{self, Claim, Motion, Verdict, Witness};
use glam::DVec3;
use nurbs_hausdorff::{Model, SurfaceArrays};

/// The height of the bent patches, relative to their profile.
const HEIGHT: f64 = 0.2;

/// The profile t (1 - t) (1 + SKEW (2 t - 1)) as a cubic Bézier curve: inner control values.
const SKEW: f64 = 0.2;
const INNER: [f64; 2] = [(1.0 - SKEW) / 3.0, (1.0 + SKEW) / 3.0];

/// The profile is 0.25 in the middle, where cells are looked at first, 0.2496 at the sample 0.6, and
/// PEAK at t = 0.5486. Its second derivative does not exceed 3.2, so that the remainder is 0.4, and half
/// of it 0.2.
const BEYOND_SAMPLES: f64 = 0.251;
const PEAK: f64 = 0.25245;

/// The unit square raised by HEIGHT times the profile of one parameter.
fn arch(axis: usize) -> Model {
    let knots = |degree: usize| [vec![0.0; degree + 1], vec![1.0; degree + 1]].concat();
    let degree = if axis == 0 { [3, 1] } else { [1, 3] };
    let counts = degree.map(|degree| degree + 1);
    let control_points = (0..counts[0] * counts[1])
        .map(|index| {
            let place = [index / counts[1], index % counts[1]];
            let [x, y] = [0, 1].map(|k| place[k] as f64 / degree[k] as f64);
            let profile = [0.0, INNER[0], INNER[1], 0.0][place[axis]];
            [x, y, HEIGHT * profile, 1.0]
        })
        .collect();
    let surface = SurfaceArrays { degree, knots: degree.map(knots), counts, control_points };
    Model::from_arrays(None, vec![surface]).unwrap()
}

fn upper_verdict(a: &Model, b: &Model, upper: f64) -> Verdict {
    let witness = Witness { surface: 0, u: 0.5, v: 0.5 };
    let claim = Claim { lower: 0.0, upper, witness };
    let settings = proof::Settings { slack: 0.0, ..SETTINGS };
    proof::check(&parsed(a), &Motion::IDENTITY, &parsed(b), &claim, &settings).upper
}

/// The top of an arch is `HEIGHT PEAK` away from the square below it, and that point of the square
/// from the arch, whose radius of curvature is larger than its height.
#[test]
fn remainders_of_either_model_are_needed_whole() {
    let square = parallelogram(DVec3::ZERO, [DVec3::X, DVec3::Y]);
    for axis in 0..2 {
        for [a, b] in [[&arch(axis), &square], [&square, &arch(axis)]] {
            assert_eq!(upper_verdict(a, b, HEIGHT * BEYOND_SAMPLES), Verdict::Refuted, "axis {axis}");
            assert_eq!(upper_verdict(a, b, HEIGHT * (PEAK + 1e-4)), Verdict::Proved, "axis {axis}");
        }
    }
}

/// B is z = TWIST x y over the unit square, A the plane through the middles of its edges' points,
/// which are its corners: along A's edges, z differs by up to TWIST / 16, all by B's mixed derivative.
#[test]
fn the_remainder_of_the_mixed_derivative_is_needed() {
    const TWIST: f64 = 0.1;
    let on_b = |x: f64, y: f64| DVec3::new(x, y, TWIST * x * y);
    let bilinear = |corners: [DVec3; 4]| {
        let knots = vec![0.0, 0.0, 1.0, 1.0];
        let control_points = corners.map(|point| [point.x, point.y, point.z, 1.0]).to_vec();
        let knots = [knots.clone(), knots];
        let surface = SurfaceArrays { degree: [1, 1], knots, counts: [2, 2], control_points };
        Model::from_arrays(None, vec![surface]).unwrap()
    };
    let b = bilinear([on_b(0.0, 0.0), on_b(0.0, 1.0), on_b(1.0, 0.0), on_b(1.0, 1.0)]);
    let a = bilinear([on_b(0.0, 0.5), on_b(0.5, 1.0), on_b(0.5, 0.0), on_b(1.0, 0.5)]);
    assert_eq!(upper_verdict(&a, &b, 0.98 * TWIST / 16.0), Verdict::Refuted);
    assert_eq!(upper_verdict(&a, &b, TWIST / 16.0), Verdict::Proved);
}
