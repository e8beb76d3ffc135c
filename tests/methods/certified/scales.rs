//! Models of any size, place and weights that are accepted: the interval holds,
//! and converged intervals are as narrow as requested.

use crate::support::cpu::measure;
use crate::support::fixtures::with_grid;
use glam::DVec3;
use nurbs_hausdorff::internals::engine::{DistanceOptions, DistanceResult, MethodName};
use nurbs_hausdorff::shapes::{sphere, torus};
use nurbs_hausdorff::{CertifiedOptions, Method, Model, RigidTransform, SurfaceArrays};

/// From where squares are lost to the largest that is accepted.
const SIZES: [f64; 13] =
    [1e-307, 1e-300, 1e-200, 1e-160, 1e-150, 1e-140, 1e-101, 1e-99, 1e-50, 1e-10, 1e10, 1e50, 1e99];

/// Those between which even fourth powers have all digits.
const USUAL_SIZES: std::ops::Range<f64> = 1e-60..1e60;

const METHODS: [MethodName; 3] = [MethodName::Certified, MethodName::Iteration, MethodName::Hierarchy];

/// Cells after which a search may end where it must only be honest.
const CELLS: usize = 300;

/// Part of the distance that its analytic value is rounded by.
const ROUNDING: f64 = 1e-12;

/// The permitted width, as a fraction of the diagonal.
const TOLERANCE: f64 = 1e-6;

fn options(method: MethodName) -> DistanceOptions {
    let symmetric = method != MethodName::Hierarchy;
    let relative_tolerance = Some(TOLERANCE);
    let method = match method {
        MethodName::Certified => {
            Method::Certified(CertifiedOptions { max_cells: Some(CELLS), ..Default::default() })
        }
        other => with_grid(other, 16),
    };
    DistanceOptions { method, relative_tolerance, symmetric, samples: 8, ..DistanceOptions::default() }
}

/// The interval holds `truth`, and is as narrow as requested where the result says so.
fn assert_honest(result: &DistanceResult, truth: f64, tolerance: f64, name: &str) {
    let DistanceResult { computed, lower, upper, converged, .. } = *result;
    let message = format!("{name}: {truth:e} in [{lower:e}, {upper:e}], computed {computed:e}");
    let rounding = ROUNDING * truth;
    assert!(lower <= truth + rounding && truth - rounding <= upper, "{message}");
    assert!(lower <= computed && computed <= upper, "{message}");
    assert!(result.witness.a.point.iter().chain(&result.witness.b.point).all(|x| x.is_finite()), "{message}");
    if converged && result.certified().is_some() {
        assert!(upper - lower <= tolerance * result.diagonal, "{message}");
    }
}

/// A bilinear square from `low` to `high` along x and y, its corners weighted:
/// the same points whatever the weights.
fn square([low, high]: [f64; 2], height: f64, weights: [f64; 4]) -> Model {
    let [a, b, c, d] = weights;
    let corners = [[low, low, a], [low, high, b], [high, low, c], [high, high, d]];
    let knots = || vec![0.0, 0.0, 1.0, 1.0];
    let arrays = SurfaceArrays {
        degree: [1, 1],
        knots: [knots(), knots()],
        counts: [2, 2],
        control_points: corners.map(|[x, y, w]| [x, y, height, w]).to_vec(),
    };
    Model::from_arrays(None, vec![arrays]).unwrap()
}

#[test]
fn spheres_of_any_size_are_measured() {
    for size in SIZES {
        let [a, b] = [1.0, 1.5].map(|radius| sphere(DVec3::splat(size), radius * size).unwrap());
        for method in METHODS {
            let options = DistanceOptions { symmetric: false, ..options(method) };
            let result = measure(&a, &b, &options);
            let truth = 1.5 * size - size;
            assert_honest(&result, truth, TOLERANCE, &format!("{method:?}, {size:e}"));
            if method == MethodName::Certified && USUAL_SIZES.contains(&size) {
                assert!(result.converged, "{size:e}: [{:e}, {:e}]", result.lower, result.upper);
            }
        }
    }
}

#[test]
fn tori_of_any_size_are_measured() {
    for size in SIZES {
        // Of one circle, so everywhere as far apart as the tubes' radii.
        let [a, b] = [0.5, 0.75].map(|tube| torus(2.0 * size, tube * size).unwrap());
        let options = options(MethodName::Certified);
        let result = measure(&a, &b, &options);
        assert_honest(&result, 0.25 * size, TOLERANCE, &format!("{size:e}"));
    }
}

#[test]
fn squares_of_any_weights_are_measured() {
    for weight in [1e-100_f64, 1e-20, 1e-6, 1e6, 1e20, 1e100] {
        // Of one surface, weights may be up to 1e30 apart.
        let [far, near] = [weight.clamp(1e-29, 1e29), weight];
        for (on_a, on_b) in [([near; 4], [1.0; 4]), ([far, 1.0, 2.0, 1.0], [1.0, 1.0, 1.0, far])] {
            let [a, b] = [square([0.0, 1.0], 1.0, on_a), square([-1.0, 2.0], 0.0, on_b)];
            for method in METHODS {
                let options = DistanceOptions { symmetric: false, ..options(method) };
                let result = measure(&a, &b, &options);
                assert_honest(&result, 1.0, TOLERANCE, &format!("{method:?}, {on_a:?}, {on_b:?}"));
            }
        }
    }
}

/// Far from the origin coordinates are rounded by more than a fine tolerance;
/// then the result says that float64 ended the search.
#[test]
fn what_float64_cannot_tell_has_not_converged() {
    let mut converged = 0;
    let tolerances = [1e-6, 1e-9, 1e-15];
    for far in [0.0, 1e7] {
        for tolerance in tolerances {
            let middle = DVec3::new(far, -far, far);
            let [a, b] = [1.0, 1.5].map(|radius| sphere(middle, radius).unwrap());
            let options =
                DistanceOptions { relative_tolerance: Some(tolerance), ..options(MethodName::Certified) };
            let aside = RigidTransform::translation(DVec3::new(0.3, 0.0, -0.4)).unwrap();
            let moved = DistanceOptions { transform: aside, ..options.clone() };
            for result in [measure(&a, &b, &options), measure(&a, &a, &moved)] {
                assert_honest(&result, 0.5, tolerance, &format!("{far}, {tolerance}"));
                converged += usize::from(result.converged);
            }
        }
    }
    assert!(converged >= 4 && converged < 4 * tolerances.len(), "{converged}");
}
