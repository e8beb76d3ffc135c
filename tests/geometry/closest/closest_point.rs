//! The certified closest point of a model: its interval contains the distance.

use crate::support::evaluator;
use glam::DVec3;
use nurbs_hausdorff::internals::bezier::extract;
use nurbs_hausdorff::internals::closest::Target;
use nurbs_hausdorff::internals::closest::{Closest, CriticalPoint, SquaredDistance, closest, newton};
use nurbs_hausdorff::internals::flatness::{Flatness, flatten};
use nurbs_hausdorff::shapes::{shape, sphere, torus};
use nurbs_hausdorff::{Model, SurfaceArrays};
use proptest::collection::vec;
use proptest::prelude::*;

/// The requested width of the intervals.
const GAP: f64 = 1e-9;

/// Rounding of points and distances of size 1 to 10.
const ROUNDING: f64 = 1e-12;

fn target_of(model: &Model, flatness: Flatness) -> Target {
    Target::new(flatten(&extract(model).patches, flatness).patches)
}

/// The closest point, which must lie on the model by the independent evaluator,
/// as far away as is said.
fn find(model: &Model, target: &Target, point: DVec3) -> Closest {
    let found = closest(target, point, GAP).unwrap();
    let patch = target.patches.patch(found.patch);
    let [u, v] = patch.surface_parameters(found.parameters);
    let on_it = DVec3::from_array(evaluator::point(&model.surfaces()[patch.surface], u, v));
    assert!(on_it.distance(found.point) < ROUNDING, "{on_it} {}", found.point);
    assert!((on_it.distance(point) - found.upper).abs() < ROUNDING);
    assert!(found.lower <= found.upper);
    found
}

fn assert_contains(found: &Closest, distance: f64, gap: f64, name: &str) {
    assert!(found.lower <= distance + ROUNDING && distance - ROUNDING <= found.upper, "{name}: {found:?}");
    assert!(found.upper - found.lower <= gap + ROUNDING, "{name}: {found:?}");
}

#[test]
fn distances_to_a_sphere_and_a_torus() {
    let (ball, ring) = (sphere(DVec3::ZERO, 2.0).unwrap(), torus(3.0, 1.0).unwrap());
    for flatness in [Flatness::None, Flatness::Loose, Flatness::Tight] {
        let (to_ball, to_ring) = (target_of(&ball, flatness), target_of(&ring, flatness));
        for index in 0..200_u32 {
            let at = |step: f64, size: f64| size * ((f64::from(index) * step).fract() - 0.5);
            // Multiples of irrational numbers fill a box evenly.
            let point = DVec3::new(at(0.618_034, 9.0), at(0.754_878, 9.0), at(0.569_84, 5.0));
            assert_contains(&find(&ball, &to_ball, point), (point.length() - 2.0).abs(), GAP, "sphere");
            let from_circle = (point.truncate().length() - 3.0).hypot(point.z);
            assert_contains(&find(&ring, &to_ring, point), (from_circle - 1.0).abs(), GAP, "torus");
        }
    }
}

#[test]
fn points_as_near_to_everything() {
    // The centre of a sphere; the axis of a torus, as near to a circle of points.
    let (ball, ring) = (sphere(DVec3::ZERO, 2.0).unwrap(), torus(3.0, 1.0).unwrap());
    assert_contains(&find(&ball, &target_of(&ball, Flatness::Loose), DVec3::ZERO), 2.0, GAP, "centre");
    // A circle of points is as near.
    for height in [0.0, 0.5, -4.0] {
        let found = find(&ring, &target_of(&ring, Flatness::Loose), DVec3::new(0.0, 0.0, height));
        assert_contains(&found, 3.0_f64.hypot(height) - 1.0, GAP, "axis");
    }
    // Along a torus' inner circle all its meridians' centres of curvature lie.
    let found = find(&ring, &target_of(&ring, Flatness::Loose), DVec3::new(3.0, 0.0, 0.0));
    assert_contains(&found, 1.0, GAP, "middle of the tube");
}

#[test]
fn no_patches_have_no_closest_point() {
    let none = Target::new(nurbs_hausdorff::internals::bezier::PatchSet::default());
    assert!(closest(&none, DVec3::ZERO, GAP).is_none());
}

#[test]
fn dense_samples_of_shapes_are_no_nearer() {
    for name in ["glass", "bottle", "wavy-sheet", "wigley-hull", "naca-wing", "cone"] {
        let model = shape(name).unwrap();
        let target = target_of(&model, Flatness::Loose);
        let samples: Vec<DVec3> = model
            .surfaces()
            .iter()
            .flat_map(|surface| {
                evaluator::parameters(surface, 40).into_iter().map(|[u, v]| evaluator::point(surface, u, v))
            })
            .map(DVec3::from_array)
            .collect();
        let size = model.bounding_box().diagonal();
        let middle = model.bounding_box().center();
        for index in 0..20_u32 {
            let at = |step: f64| size * ((f64::from(index) * step).fract() - 0.5);
            let point = middle + DVec3::new(at(0.618_034), at(0.754_878), at(0.569_84));
            let found = find(&model, &target, point);
            let least = samples.iter().map(|sample| sample.distance(point)).fold(f64::INFINITY, f64::min);
            assert!(found.upper <= least + GAP, "{name}: {found:?}, {least}");
            // Where the distance hardly changes around the nearest point, pieces run out a little above the gap.
            assert!(found.upper - found.lower <= 10.0 * GAP, "{name}: {found:?}");
        }
    }
}

/// One surface of a few spans, degrees up to 4, weights of a ratio up to 10.
fn any_model() -> impl Strategy<Value = Model> {
    (1_usize..=4, 1_usize..=4, 0_usize..3, 0_usize..3).prop_flat_map(|(p, q, inner_u, inner_v)| {
        let counts = [p + 1 + inner_u, q + 1 + inner_v];
        let point = (-1.0..1.0, -1.0..1.0, -1.0..1.0, 1.0..10.0).prop_map(|(x, y, z, w)| [x, y, z, w]);
        vec(point, counts[0] * counts[1]).prop_map(move |control_points| {
            let knots = [(p, inner_u), (q, inner_v)].map(|(degree, inner)| {
                let inside = (1..=inner).map(|knot| knot as f64);
                let ends = [0.0, (inner + 1) as f64].map(|end| vec![end; degree + 1]);
                [ends[0].clone(), inside.collect(), ends[1].clone()].concat()
            });
            let arrays = SurfaceArrays { degree: [p, q], knots, counts, control_points };
            Model::from_arrays(None, vec![arrays]).unwrap()
        })
    })
}

fn any_point() -> impl Strategy<Value = DVec3> {
    (-2.0..2.0, -2.0..2.0, -2.0..2.0).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    /// `upper` is the distance of a point of the model, so never too small;
    /// `lower` is at most `gap` below it; and no sample is nearer than `lower`
    /// or, by the two, than `upper` less `gap`.
    #[test]
    fn no_sample_is_nearer_than_the_interval(model in any_model(), points in vec(any_point(), 4)) {
        let target = target_of(&model, Flatness::None);
        let surface = &model.surfaces()[0];
        let samples = evaluator::parameters(surface, 30);
        for point in points {
            let found = find(&model, &target, point);
            prop_assert!(found.upper - found.lower <= GAP + ROUNDING, "{:?}", found);
            for &[u, v] in &samples {
                let distance = evaluator::distance(evaluator::point(surface, u, v), point.to_array());
                prop_assert!(found.lower <= distance + ROUNDING, "{:?} {}", found, distance);
            }
        }
    }

    /// The bounds of a patch, one of them about any point of it.
    #[test]
    fn no_sample_is_nearer_than_the_bounds_of_its_patch(
        model in any_model(),
        point in any_point(),
        about in [0.0..=1.0_f64, 0.0..=1.0],
    ) {
        let patches = extract(&model).patches;
        for patch in patches.iter() {
            let form = SquaredDistance::new(patch.degree, patch.controls, point - patch.center);
            let known = |parameters: [f64; 2]| {
                CriticalPoint::new(&patch, point, parameters)
            };
            let foot = newton(&patch, point, about, 32).parameters;
            let least = [about, foot].iter().fold(form.lower_bound(), |least, &at| least.max(form.lower_bound_about(&known(at))));
            for index in 0..15 * 15 {
                let at = [index / 15, index % 15].map(|index| f64::from(index) / 14.0);
                let [u, v] = patch.surface_parameters(at);
                let distance = evaluator::distance(evaluator::point(&model.surfaces()[0], u, v), point.to_array());
                prop_assert!(least <= distance * distance + ROUNDING, "{} {}", least, distance);
            }
        }
    }
}

/// Squares of the lengths of one patch are subnormal, which once gave its box axes of other lengths
/// than 1, and a lower bound of 1.3 at a distance of 1.
#[test]
fn a_patch_is_found_however_small() {
    let unit = 2.0_f64.powi(-540);
    let [x, y, z] = [0.729_547_882_645_832_5, -0.593_816_449_119_345_1, 0.339_325_672_005_928_4];
    let tiny = [[-3.0, -4.0, 0.0], [-3.0, 2.0, 4.0], [-3.0, -2.0, -3.0], [2.0, 1.0, -2.0]]
        .map(|point| point.map(|value: f64| value * unit));
    let farther = [[2.3 * x, 2.3 * y, 2.3 * z]; 4];
    let surfaces = [tiny, farther].map(|corners| SurfaceArrays {
        degree: [1, 1],
        knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
        counts: [2, 2],
        control_points: corners.map(|[x, y, z]| [x, y, z, 1.0]).to_vec(),
    });
    let model = Model::from_arrays(None, surfaces.to_vec()).unwrap();
    let found = closest(&Target::new(extract(&model).patches), DVec3::new(x, y, z), 0.0).unwrap();
    assert!(found.lower <= 1.0 && (found.upper - 1.0).abs() < 1e-15, "{found:?}");
}
