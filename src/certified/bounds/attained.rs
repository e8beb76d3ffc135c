//! Pairs on which the bounds are attained or nearly so: a bound that is less
//! than its theorem states is below the distance of some point of these.

use super::{
    CellContext, ConvexCombination, InSphere, PolynomialDifference, SameNet, Taylor, UpperBound, bvh_node,
    least, same_net, sphere, whole_models, with_any_foot, with_nearest_feet,
};
use crate::bezier::{LocalDerivativeBounds, extract};
use crate::certified::audit::{Lemma, Lemmas};
use crate::certified::nearest::{Foot, NearestPoint};
use crate::certified::testing::*;
use crate::certified::{Cell, Operand, Pair};
use crate::closest::Target;
use crate::model::RigidTransform;
use crate::param_box::ParamBox;
use crate::rounding::{UNIT_ROUNDOFF, upper_max};
use crate::shapes::shape;
use crate::symmetry::{Sphere, revolutions};
use glam::{DVec3, DVec4};

/// The exponents of the monomials up to third order.
fn monomials() -> impl Iterator<Item = [usize; 2]> {
    (0..=3).flat_map(|a| (0..=3 - a).map(move |b| [a, b])).skip(1)
}

/// Over a plane the distance of a graph is its height, whose expansion has no
/// negative term: its quadratic and its remainder are the largest at one corner.
#[test]
fn taylor_over_a_plane() {
    let b = PatchModel::new(&[plane([-2.0, 3.0])]);
    for powers in monomials() {
        let a = PatchModel::new(&[graph(0.0, 1.0, powers)]);
        for (threshold, bounds) in [(0.0, "patch"), (1.0 - 1e-6, "local")] {
            let bound = evaluate(&Taylor, &a, &b, Cell::whole(0), threshold).unwrap();
            assert!((1.0 - ROUNDING..1.0 + ROUNDING).contains(&bound), "{powers:?}, {bounds}: {bound}");
        }
    }
}

/// The same with the graph as B, so flat that its normals are almost vertical.
#[test]
fn taylor_over_a_graph() {
    const FACTOR: f64 = 1e-4;
    let a = PatchModel::new(&[graph(0.0, 0.0, [0, 0])]);
    for powers in monomials() {
        // Higher than the first-order bound allows without the expansion.
        let b = PatchModel::new(&[graph(1e-5, FACTOR, powers)]);
        for threshold in [0.0, 1.09e-4] {
            let bound = evaluate(&Taylor, &a, &b, Cell::whole(0), threshold).unwrap();
            // A slope of 3e-4 moves the foot by 3e-8, and takes 5e-8 off the distance.
            assert_attained(bound * (1.0 + 1e-7), 1.1e-4, 1e-6);
        }
    }
}

/// The same under a parallelogram, along whose sides both parameters of B grow:
/// B's expansion by the parameters of A is attained at the corner (0.8, 0.8).
#[test]
fn taylor_across_the_parameter_lines() {
    const FACTOR: f64 = 1e-4;
    let a =
        PatchModel::new(&[bilinear([[0.2, 0.2, 0.0], [0.4, 0.6, 0.0], [0.6, 0.4, 0.0], [0.8, 0.8, 0.0]])]);
    for powers in monomials() {
        let b = PatchModel::new(&[graph(0.0, FACTOR, powers)]);
        let bound = evaluate(&Taylor, &a, &b, Cell::whole(0), 0.0).unwrap();
        let height = FACTOR * 0.8_f64.powi((powers[0] + powers[1]) as i32);
        assert_attained(bound * (1.0 + 1e-6), height, 1e-5);
    }
}

/// A small cell of a quartic: its local bounds are those of its own corner.
#[test]
fn taylor_with_local_bounds() {
    const HALF: f64 = 1.0 / 16.0;
    let b = PatchModel::new(&[plane([-2.0, 3.0])]);
    for (powers, axis) in [([4, 0], 0), ([0, 4], 1)] {
        let a = PatchModel::new(&[graph(0.0, 0.25, powers)]);
        let mut cell = Cell { patch: 0, center: [0.5; 2], half: [HALF; 2] };
        cell.center[axis] = 1.0 - HALF;
        let bound = evaluate(&Taylor, &a, &b, cell, 0.25 - 1e-6).unwrap();
        // The remainder is 4 h³ / 4 at the corner's derivative, the true one 4 h³ - 3 h⁴.
        assert_attained(bound, 0.25, 4.0 * 0.76 * HALF.powi(4));
    }
}

/// A line that runs away from a point of B: both terms are attained at its end.
#[test]
fn lipschitz_along_a_line() {
    let b = PatchModel::new(&[point([0.0; 3])]);
    let along_t = line([1.0, 0.0, 0.0], [3.0, 0.0, 0.0]);
    let along_s = bilinear([[1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [3.0, 0.0, 0.0], [3.0, 0.0, 0.0]]);
    for a in [along_t, along_s] {
        let bound = evaluate(&Taylor, &PatchModel::new(&[a]), &b, Cell::whole(0), 4.0).unwrap();
        assert_attained(bound, 3.0, 0.0);
    }
}

/// Two points of B so near to each other that both are about as far from all of A.
#[test]
fn convex_combination_of_two_points() {
    const APART: f64 = 1e-2;
    const WIDTH: f64 = 1e-3;
    let b = PatchModel::new(&[point([APART, 0.0, -1.0]), point([-APART, 0.0, -1.0])]);
    // From z = -1/8 to z = 1/8 as a cubic with its inflection at the centre, and
    // across the bisector in s.
    let heights = [-0.125, 0.125, -0.125, 0.125];
    let controls = [-WIDTH, WIDTH].map(|x| heights.map(|z| DVec4::new(x, 0.0, 4.0 * z, 1.0)));
    let a = PatchModel::new(&[([1, 3], controls.concat())]);
    let pair = pair(&a, &b);
    let nearest = NearestPoint::new(pair.b);
    let truth = (1.5_f64.powi(2) + APART.powi(2)).sqrt();
    for threshold in [0.0, truth * (1.0 - 1e-6)] {
        let mut context = CellContext::new(&pair, &nearest, Cell::whole(0), &Foot::start(0, [0.5; 2]));
        let mut feet = context.feet.clone();
        feet.add(nearest.on_patch(context.jet.point, 1, [0.5; 2]));
        context.set_feet(feet);
        let bound = ConvexCombination.evaluate(&mut context, threshold).unwrap();
        assert_attained(bound, truth, 1e-4);
    }
}

/// The height over a plane is the largest at a coefficient, of the polynomial
/// s^a t^b and of the rational function 1 / (1 + s).
#[test]
fn polynomial_difference_at_a_corner() {
    const THRESHOLD: f64 = 1.0 + 1e-9;
    let b = PatchModel::new(&[plane([-2.0, 3.0])]);
    for powers in [[1, 0], [2, 1], [3, 3]] {
        let a = PatchModel::new(&[graph(0.25, 0.75, powers)]);
        let bound = evaluate(&PolynomialDifference, &a, &b, Cell::whole(0), THRESHOLD).unwrap();
        assert_attained(bound, 1.0, 0.0);
    }
    // (s w, t w, 1, w) with w = 1 + s, and the same mirrored, scaled to small weights.
    let rational = |mirrored: bool, scale: f64| {
        let rows = [[0.0, 1.0], [0.5, 1.5], [2.0, 2.0]].map(|[x, w]| {
            let x = if mirrored { w - x } else { x };
            [0.0, 1.0].map(|t| scale * DVec4::new(x, t * w, 1.0, w))
        });
        ([2, 1], rows.concat())
    };
    for (mirrored, scale) in [(false, 1.0), (true, 1.0), (false, 0.125)] {
        let a = PatchModel::new(&[rational(mirrored, scale)]);
        let bound = evaluate(&PolynomialDifference, &a, &b, Cell::whole(0), THRESHOLD).unwrap();
        assert_attained(bound, 1.0, 0.0);
    }
}

/// The roles exchanged: the graph is B, almost flat.
#[test]
fn polynomial_difference_from_a_graph() {
    const HEIGHT: f64 = 1e-6;
    let a = PatchModel::new(&[graph(0.0, 0.0, [0, 0])]);
    for powers in [[1, 0], [2, 0], [1, 2]] {
        let b = PatchModel::new(&[graph(HEIGHT, HEIGHT, powers)]);
        let bound = evaluate(&PolynomialDifference, &a, &b, Cell::whole(0), 2.1 * HEIGHT).unwrap();
        assert_attained(bound * (1.0 + 1e-9), 2.0 * HEIGHT, 1e-6);
    }
}

/// A copy moved along its normal, with one corner moved farther.
#[test]
fn same_net_of_a_moved_copy() {
    let square = |height: f64, weight: f64| -> Net {
        let corners = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]];
        ([1, 1], corners.map(|[x, y]| weight * DVec4::new(x, y, height, 1.0)).to_vec())
    };
    for (corner, weight) in [(0, 1.0), (1, 0.5), (2, 2.0), (3, 4.0)] {
        let b = PatchModel::new(&[square(0.0, weight)]);
        let mut copy = square(1.0, weight);
        copy.1[corner].z *= 2.0;
        let a = PatchModel::new(&[copy]);
        assert_attained(same_net::upper_bound(&pair(&a, &b), 0), 2.0, 0.0);
        assert_attained(evaluate(&SameNet, &a, &b, Cell::whole(0), 0.0).unwrap(), 2.0, 0.0);
        // A weight that differs leaves no copy.
        let mut other = square(1.0, weight);
        other.1[corner] *= 2.0;
        assert_eq!(same_net::upper_bound(&pair(&PatchModel::new(&[other]), &b), 0), f64::INFINITY);
        // No patch of B corresponds to A's second one.
        let a = PatchModel::new(&[square(1.0, weight), square(1.0, weight)]);
        assert_eq!(same_net::upper_bound(&pair(&a, &b), 1), f64::INFINITY);
    }
}

/// Of two patches the second one is moved farther; without a copy of it there is no bound but that
/// of the boxes.
#[test]
fn whole_models_are_bounded_by_all_patches() {
    let square =
        |height: f64| bilinear([[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]].map(|[x, y]| [x, y, height]));
    let b = PatchModel::new(&[square(0.0), square(0.0)]);
    let bound = |heights: &[f64]| {
        let nets: Vec<Net> = heights.iter().map(|&height| square(height)).collect();
        whole_models(&pair(&PatchModel::new(&nets), &b), Lemmas::default()).upper
    };
    assert_attained(bound(&[1.0, 2.0]), 2.0, 0.0);
    assert_attained(bound(&[2.0, 1.0]), 2.0, 0.0);
    assert_attained(bound(&[1.0, 1.0, 2.0]), 6.0_f64.sqrt(), 0.0);
}

/// Points inside and outside a sphere, and the end of a line.
#[test]
fn sphere_and_points() {
    let sphere = Sphere { center: DVec3::new(1.0, 0.0, 0.0), radius: 2.0, deviation: 0.125 };
    let bound = |net: Net, cell: Cell| {
        let model = PatchModel::new(&[net]);
        let bound = |motion: DVec3| {
            let sphere = Sphere { center: sphere.center + motion, ..sphere };
            let motion = RigidTransform::translation(motion).unwrap();
            sphere::upper_bound(&cell, &model.operand().patch(0), &motion, &sphere)
        };
        // A sphere that moves as the patch does keeps its distance.
        let bounds = [DVec3::ZERO, DVec3::new(0.0, 8.0, -4.0)].map(bound);
        assert_eq!(bounds[0], bounds[1]);
        bounds[0]
    };
    assert_attained(bound(point([1.0, 0.25, 0.0]), Cell::whole(0)), 1.875, 0.0);
    assert_attained(bound(point([1.0, 0.0, -5.0]), Cell::whole(0)), 3.125, 0.0);
    let away = || line([3.0, 0.0, 0.0], [7.0, 0.0, 0.0]);
    assert_attained(bound(away(), Cell::whole(0)), 4.125, 0.0);
    assert_attained(bound(away(), Cell { half: [0.5, 0.25], ..Cell::whole(0) }), 3.125, 0.0);
}

/// The same for a surface that is found to be a sphere.
#[test]
fn sphere_among_surfaces() {
    let bezier = extract(&shape("sphere").unwrap());
    let revolutions = revolutions(&bezier);
    let radius = revolutions[0].as_ref().unwrap().sphere.unwrap().radius;
    let center = revolutions[0].as_ref().unwrap().sphere.unwrap().center;
    let target = Target::new(bezier.patches);
    let bounds: Vec<_> = target.patches.iter().map(|_| LocalDerivativeBounds::new(ParamBox::UNIT)).collect();
    for distance in [0.25, 3.0] {
        let a = PatchModel::new(&[point((center + DVec3::new(distance * radius, 0.0, 0.0)).to_array())]);
        let b = Operand::new(&target, &bounds).with_revolutions(&revolutions);
        let pair = Pair { b, ..pair(&a, &a) };
        let nearest = NearestPoint::new(pair.b);
        let mut context = CellContext::new(&pair, &nearest, Cell::whole(0), &Foot::start(0, [0.5; 2]));
        let bound = InSphere.evaluate(&mut context, 0.0).unwrap();
        assert_attained(bound, (distance - 1.0).abs() * radius, 1e-9);
        assert_attained(whole_models(&pair, Lemmas::default()).upper, (distance - 1.0).abs() * radius, 1e-9);
    }
}

/// The farthest corner of A's box from a point, and of B's box from a point.
#[test]
fn boxes_are_attained_at_a_corner() {
    let diagonal = || line([0.0, 0.0, 0.0], [1.0, 2.0, 2.0]);
    let origin = || point([0.0; 3]);
    for (a, b) in [(diagonal(), origin()), (origin(), diagonal())] {
        assert_attained(
            whole_models(&pair(&PatchModel::new(&[a]), &PatchModel::new(&[b])), Lemmas::default()).upper,
            3.0,
            0.0,
        );
    }
}

/// Two parts of a line that runs away from a point of B.
#[test]
fn bvh_node_of_a_line() {
    let a =
        PatchModel::new(&[line([1.0, 0.0, 0.0], [2.0, 0.0, 0.0]), line([2.0, 0.0, 0.0], [5.0, 0.0, 0.0])]);
    let b = PatchModel::new(&[point([0.0; 3])]);
    let pair = pair(&a, &b);
    let nearest = NearestPoint::new(pair.b);
    let (bound, _) = bvh_node(&pair, &nearest, 0, &Foot::start(0, [0.5; 2]), 0.0);
    assert_attained(bound, 5.0, 0.0);
}

/// A bound of a fixed value.
struct Fixed(Option<f64>);

impl UpperBound for Fixed {
    fn lemma(&self) -> Lemma {
        Lemma::Bilinear
    }

    fn evaluate(&self, _context: &mut CellContext<'_>, _threshold: f64) -> Option<f64> {
        self.0
    }
}

/// The list of bounds ends at the first that suffices; none and NaN bound nothing.
#[test]
fn the_least_bound_of_a_list() {
    let a = PatchModel::new(&[graph(0.0, 3.0, [3, 0])]);
    let b = PatchModel::new(&[plane([-2.0, 3.0])]);
    let pair = pair(&a, &b);
    let nearest = NearestPoint::new(pair.b);
    let mut context = CellContext::new(&pair, &nearest, Cell::whole(0), &Foot::start(0, [0.5; 2]));
    for (bounds, expected) in [
        (&[None, Some(3.0), Some(2.0), Some(1.0)][..], 2.0),
        (&[Some(3.0), Some(4.0), None], 3.0),
        (&[Some(f64::NAN), Some(3.0)], 3.0),
        (&[Some(f64::NAN), None], f64::INFINITY),
        (&[], f64::INFINITY),
    ] {
        let fixed: Vec<Fixed> = bounds.iter().map(|&bound| Fixed(bound)).collect();
        let list: Vec<&dyn UpperBound> = fixed.iter().map(|bound| bound as &dyn UpperBound).collect();
        assert_eq!(least(&list, &mut context, 2.0).upper, expected, "{bounds:?}");
    }
    assert_attained(with_any_foot(&mut context, 0.0).upper, 3.0, 0.0);
    assert_attained(with_nearest_feet(&mut context, 0.0).upper, 3.0, 0.0);
}

/// Two parallel planes, whose difference is constant: the Taylor bound is the distance and J of
/// both patches (lemma R8), with n = 4 · 2 + 6.
#[test]
fn the_rounding_of_both_jets_adds_to_the_taylor_bound() {
    let [a, b] = [PatchModel::new(&[graph(1.0, 0.0, [1, 1])]), PatchModel::new(&[plane([-1.0, 2.0])])];
    let rounding = |model: &PatchModel, further: f64, reach: f64| {
        let radius =
            model.target.patches.patch(0).local_points().map(|point| point.length()).fold(0.0, upper_max);
        let first = (4.0 * 14.0 + 6.0 + further) * 4.0 * reach;
        let second = (6.0 * 14.0 + 12.0 + further) * 12.0 * reach * reach;
        UNIT_ROUNDOFF * radius * (first + second)
    };
    // The cell reaches ½ along both axes, and its image ½ of 3 and of 5.
    let lemma = rounding(&a, 71.0, 1.0) + rounding(&b, 7.0, 0.5 / 3.0 + 0.5 / 5.0);
    let bound = evaluate(&Taylor, &a, &b, Cell::whole(0), 0.0).unwrap();
    let part = (bound - 1.0) / lemma;
    assert!((0.99..=1.1).contains(&part), "{part} of J");
}
