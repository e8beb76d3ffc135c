//! Bodies that are embedded, that meet themselves, and that touch themselves, by construction.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use super::division::{Division, Task};
use super::piece::Piece;
use super::*;
use crate::bezier::extract;
use crate::model::{Model, RigidTransform, SurfaceArrays};
use crate::param_box::ParamBox;
use crate::shapes;
use crate::solid::{Edges, SurfaceOrigin, joined_arcs};
use glam::DQuat;
use std::f64::consts::TAU;

/// How near points are near to each other, unless a test asks for more: that of a file without gaps.
const NEARNESS: f64 = 1e-9;

fn verdict_with(model: &Model, nearness: f64) -> Verdict {
    let bezier = extract(model);
    let edges = Edges::of_surfaces(&bezier, SurfaceOrigin::whole);
    let aabb = model.bounding_box();
    let joined = joined_arcs(edges, &|_| [DVec3::NAN; 3], &aabb, 0.5 * nearness);
    let limits = Limits { nearness, most: 1e-3 * aabb.diagonal(), is_late: &|| false };
    verdict_on_patches(&bezier, joined, None, &limits)
}

fn verdict(model: &Model) -> Verdict {
    verdict_with(model, NEARNESS)
}

fn is_embedded(model: &Model) -> bool {
    matches!(verdict(model), Verdict::Embedded { .. })
}

fn touches(model: &Model) -> bool {
    matches!(verdict(model), Verdict::Undecided { doubt: Doubt::Contact, .. })
}

/// The surface over whole steps of knots: closed and smooth along an axis whose first controls come again at the end.
pub(super) fn spline(degree: [usize; 2], net: &[Vec<DVec3>]) -> SurfaceArrays {
    let counts = [net.len(), net[0].len()];
    let knots = [0, 1].map(|axis| (0..=counts[axis] + degree[axis]).map(|k| k as f64).collect());
    let control_points = net.iter().flatten().map(|point| point.extend(1.0).to_array()).collect();
    SurfaceArrays { degree, knots, counts, control_points }
}

pub(super) fn of(surfaces: Vec<SurfaceArrays>) -> Model {
    Model::from_arrays(None, surfaces).unwrap()
}

/// A smooth tube about a closed curve in 48 parts. Its section is smooth too, 0.8 wide and 1 high: where the curve is
/// level, the lowest line of the tube has the height of the curve, and the highest line is 1 above it.
fn tube(curve: impl Fn(f64) -> DVec3) -> Model {
    const PARTS: usize = 48;
    let at = |part: usize| {
        let t = TAU * (part % PARTS) as f64 / PARTS as f64;
        let [point, next] = [t - 1e-6, t + 1e-6].map(&curve);
        let across = 0.4 * (next - point).cross(DVec3::Z).normalize();
        let point = curve(t);
        let ring = [point + across, point - across, point - across + DVec3::Z, point + across + DVec3::Z];
        (0..6).map(|k| ring[k % 4]).collect::<Vec<_>>()
    };
    of(vec![spline([2, 2], &(0..PARTS + 2).map(at).collect::<Vec<_>>())])
}

/// A figure of eight: where its two strands cross, both are level, and one is above the other one.
fn eight(rise: f64) -> impl Fn(f64) -> DVec3 {
    move |t| {
        let height = 0.5 * rise * (2.0 * t.cos()).clamp(-1.0, 1.0);
        DVec3::new(4.0 * t.sin(), 3.0 * (2.0 * t).sin(), height)
    }
}

/// The bilinear surfaces between four corners each.
pub(super) fn quads(corners: &[[[f64; 3]; 4]]) -> Model {
    let surface = |&[a, b, c, d]: &[[f64; 3]; 4]| {
        let row = |points: [[f64; 3]; 2]| points.map(DVec3::from_array).to_vec();
        let mut surface = spline([1, 1], &[row([a, d]), row([b, c])]);
        surface.knots = [0, 1].map(|_| vec![0.0, 0.0, 1.0, 1.0]);
        surface
    };
    of(corners.iter().map(surface).collect())
}

/// The sides of a box.
fn cuboid([x, y, z]: [f64; 3], [a, b, c]: [f64; 3]) -> Vec<[[f64; 3]; 4]> {
    vec![
        [[x, y, z], [x, b, z], [a, b, z], [a, y, z]],
        [[x, y, c], [a, y, c], [a, b, c], [x, b, c]],
        [[x, y, z], [a, y, z], [a, y, c], [x, y, c]],
        [[x, b, z], [x, b, c], [a, b, c], [a, b, z]],
        [[x, y, z], [x, y, c], [x, b, c], [x, b, z]],
        [[a, y, z], [a, b, z], [a, b, c], [a, y, c]],
    ]
}

/// The model where it is, and turned and moved far away.
fn placed(model: Model) -> [Model; 2] {
    let axis = DVec3::new(1.0, 2.0, -0.5).normalize();
    let motion =
        RigidTransform::new(DQuat::from_axis_angle(axis, 1.1), DVec3::new(300.0, -70.0, 11.0)).unwrap();
    let mut surfaces: Vec<_> = model.surfaces().iter().map(|surface| surface.clone().into_arrays()).collect();
    for point in surfaces.iter_mut().flat_map(|surface| &mut surface.control_points) {
        let [x, y, z, weight] = *point;
        *point = motion.apply(DVec3::new(x, y, z)).extend(weight).to_array();
    }
    [model, of(surfaces)]
}

#[test]
fn shapes_are_embedded() {
    let all = [
        quads(&cuboid([0.0; 3], [1.0, 2.0, 3.0])),
        shapes::sphere(DVec3::new(1.0, 2.0, 3.0), 2.0).unwrap(),
        shapes::cylinder(1.0, 3.0).unwrap(),
        shapes::cone(1.0, 3.0).unwrap(),
        shapes::torus(3.0, 1.0).unwrap(),
        shapes::torus(1.0, 0.99).unwrap(),
        tube(|t| DVec3::new(4.0 * t.cos(), 3.0 * t.sin(), 0.0)),
    ];
    for (index, model) in all.into_iter().enumerate() {
        for model in placed(model) {
            assert!(is_embedded(&model), "{index}: {:?}", verdict(&model));
        }
    }
}

#[test]
fn a_spindle_torus_is_not_embedded_and_neither_is_one_that_touches_itself() {
    for minor in [1.0, 1.01, 1.5, 2.0] {
        for model in placed(shapes::torus(1.0, minor).unwrap()) {
            assert!(!is_embedded(&model), "{minor}");
        }
    }
}

/// The strands are 0.001 from each other where they pass, touch, and pass through each other.
#[test]
fn a_tube_that_passes_itself_is_embedded_until_it_touches() {
    for rise in [1.5, 1.001] {
        for model in placed(tube(eight(rise))) {
            assert!(is_embedded(&model), "{rise}: {:?}", verdict(&model));
        }
    }
    for rise in [1.0, 0.999, 0.5, 0.0] {
        for model in placed(tube(eight(rise))) {
            assert!(!is_embedded(&model), "{rise}");
        }
    }
}

/// Strands that are nearer to each other than the gaps of the body may touch within these.
#[test]
fn a_tube_that_passes_itself_nearer_than_its_gaps_is_undecided() {
    let model = tube(eight(1.001));
    assert!(matches!(verdict_with(&model, 0.9e-3), Verdict::Embedded { .. }));
    let Verdict::Undecided { doubt: Doubt::Contact, point, .. } = verdict_with(&model, 1.1e-3) else {
        panic!("{:?}", verdict_with(&model, 1.1e-3));
    };
    assert!(point.truncate().length() < 0.8, "{point}");
}

/// A sheet and its fold at an angle: what is near each other is beside the fold, over the sine of half the angle.
#[test]
fn a_folded_sheet_is_embedded_up_to_its_fold() {
    let folded = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let [y, z] = [cos, sin];
        quads(&[
            [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
            [[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, y, z], [1.0, y, z]],
        ])
    };
    for degrees in [1.0, 10.0, 90.0, 180.0] {
        let Verdict::Embedded { within } = verdict(&folded(degrees)) else {
            panic!("{degrees}: {:?}", verdict(&folded(degrees)))
        };
        let sine = (0.5 * degrees).to_radians().sin();
        let least = NEARNESS / sine;
        // Ways that are short enough are not made shorter.
        let most = if 2.0 * least < 65.0 * NEARNESS { 65.0 * NEARNESS } else { 2.0 * least };
        assert!(least <= within && within < most, "{degrees}: {within:e} for {least:e}");
    }
    assert!(touches(&folded(0.0)));
}

/// Sheets: one through another of the same body, one that ends on it, and one just before it.
#[test]
fn a_sheet_that_reaches_another_part_of_itself_is_not_embedded() {
    let bent = |reach: f64| {
        quads(&[
            [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
            [[2.0, 0.0, 0.0], [2.0, 0.0, 1.0], [2.0, 1.0, 1.0], [2.0, 1.0, 0.0]],
            [[2.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]],
            [[1.0, 0.0, 1.0], [1.0, 0.0, reach], [1.0, 1.0, reach], [1.0, 1.0, 1.0]],
        ])
    };
    assert!(is_embedded(&bent(1e-3)), "{:?}", verdict(&bent(1e-3)));
    for reach in [0.0, -1e-3, -1.0] {
        assert!(touches(&bent(reach)), "{reach}");
    }
}

/// Two boxes: apart by little, with a face, an edge or a corner in the same place, and in each other.
#[test]
fn boxes_that_touch_are_not_embedded_together() {
    let with = |low: [f64; 3]| {
        let mut sides = cuboid([0.0; 3], [1.0; 3]);
        sides.extend(cuboid(low, low.map(|coordinate| coordinate + 1.0)));
        quads(&sides)
    };
    assert!(is_embedded(&with([1.001, 0.2, 0.3])));
    for low in [[1.0, 0.2, 0.3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.2], [1.0, 1.0, 0.0], [1.0; 3], [0.5; 3]] {
        assert!(!is_embedded(&with(low)), "{low:?}");
    }
}

/// One patch alone: nearly with a cusp, with one, and crossing itself.
#[test]
fn a_patch_that_crosses_itself_is_not_embedded() {
    let at = |x: f64, z: f64| [DVec3::new(x, 0.0, z), DVec3::new(x, 1.0, z)].to_vec();
    // Both derivatives vanish in the middle of the cubic for a reach of 1; beyond it crosses itself.
    let curve = |reach: f64| {
        let mut surface = spline([3, 1], &[at(0.0, 0.0), at(reach, 1.0), at(1.0 - reach, 1.0), at(1.0, 0.0)]);
        surface.knots = [vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]];
        of(vec![surface])
    };
    assert!(is_embedded(&curve(0.9)), "{:?}", verdict(&curve(0.9)));
    for reach in [1.0, 1.1, 3.0] {
        assert!(!is_embedded(&curve(reach)), "{reach}");
    }
}

/// The faces of a box from other nets: one in two that meet in the middle of a neighbour's edge.
#[test]
fn edges_that_end_within_others_are_shared_in_parts() {
    let mut sides = cuboid([0.0; 3], [1.0, 2.0, 3.0]);
    let [a, b, c, d] = sides.remove(0);
    let mix = |p: [f64; 3], q: [f64; 3], t: f64| [0, 1, 2].map(|k| (1.0 - t) * p[k] + t * q[k]);
    let [e, f] = [mix(a, b, 0.3), mix(d, c, 0.6)];
    sides.extend([[a, e, f, d], [e, b, c, f]]);
    for model in placed(quads(&sides)) {
        assert!(is_embedded(&model), "{:?}", verdict(&model));
    }
}

/// A plane quadrilateral whose sides turn past each other, so that it lies on itself along a fold: the directions along both
/// parameters are all to one side, and not apart from each other; with one parameter reversed, they are apart from each
/// other, and not to one side.
#[test]
fn a_patch_that_folds_over_is_not_embedded() {
    let with = |y: f64| [[0.0; 3], [1.0, 0.0, 0.0], [2.0, y + 0.3, 0.0], [1.0, 0.3, 0.0]];
    let reversed = |[a, b, c, d]: [[f64; 3]; 4]| [b, a, d, c];
    for (plain, folded) in [(with(0.2), with(0.5)), (reversed(with(0.2)), reversed(with(0.5)))] {
        assert!(is_embedded(&quads(&[plain])), "{:?}", verdict(&quads(&[plain])));
        assert!(!is_embedded(&quads(&[folded])), "{folded:?}");
    }
}

/// Four squares about a point. One of them is moved by a gap along both of its edges there, so that it overlaps the square
/// across the point in a small square of that side. These two squares share a corner only. The ways to it from the two
/// other corners of the small square are two of its sides each.
#[test]
fn the_spread_of_a_corner_is_in_what_is_stated() {
    let gap = 1e-6;
    let square = |x: f64, y: f64, by: f64| {
        [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[s, t]| [x + s + by, y + t + by, 0.0])
    };
    let model = quads(&[
        square(0.0, 0.0, 0.0),
        square(-1.0, 0.0, 0.0),
        square(-1.0, -1.0, gap),
        square(0.0, -1.0, 0.0),
    ]);
    let Verdict::Embedded { within } = verdict(&model) else { panic!("{:?}", verdict(&model)) };
    assert!(2.0 * gap <= within && within < 2.4 * gap, "{within:e}");
}

/// A sheet and one at a right angle to it, joined at edges between which both pass through each other: the ways from where
/// they do to both edges are 0.5 and 1 of these lengths, and the corners as far from each other as the edges.
#[test]
fn the_gap_of_an_edge_is_in_what_is_stated() {
    let (y, z) = (0.5e-5, -1e-5);
    let model = quads(&[
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
        [[1.0, y, z], [0.0, y, z], [0.0, y, 1.0], [1.0, y, 1.0]],
    ]);
    let Verdict::Embedded { within } = verdict(&model) else { panic!("{:?}", verdict(&model)) };
    assert!(y - z <= within && within < 1.2 * (y - z), "{within:e}");
    let complex = complex_of(&model);
    let spreads = complex.places(0).iter().map(|place| complex.spread(place.corner));
    let largest = spreads.fold(0.0, f64::max);
    assert!((largest - y.hypot(z)).abs() < 1e-12, "{largest:e}");
}

fn complex_of(model: &Model) -> Complex {
    let bezier = extract(model);
    let edges = Edges::of_surfaces(&bezier, SurfaceOrigin::whole);
    let joined = joined_arcs(edges, &|_| [DVec3::NAN; 3], &model.bounding_box(), 0.0);
    Complex::new(&bezier, joined, |_| None, 0.0)
}

/// A side that two others share in parts is within none of its arcs, and theirs are.
#[test]
fn a_side_is_within_its_arc_only_if_all_of_it_is() {
    let strip = |x: f64, y: f64| [[0.0, x, 0.0], [0.0, y, 0.0], [1.0, y, 0.0], [1.0, x, 0.0]];
    let model = quads(&[
        [[-1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 1.0, 0.0]],
        strip(0.0, 0.25),
        strip(0.25, 1.0),
    ]);
    let (complex, bezier) = (complex_of(&model), extract(&model));
    for other in [1, 2] {
        let edges: Vec<_> = complex.edges([0, other], [0, other]).collect();
        assert!(edges.len() == 1 && edges[0].0 == [0, other]);
        let has = [0, other].map(|patch| {
            let whole = bezier.patches.patch(patch as usize);
            let piece = Piece::new(&whole, patch, ParamBox::UNIT, 0, std::iter::empty());
            edges[0].1.has_side(&piece, usize::from(patch != 0))
        });
        assert_eq!(has, [false, true]);
    }
}

/// How far pieces are from the surface of their face is added to what is near.
#[test]
fn the_distance_of_pieces_from_their_surface_is_in_what_is_stated() {
    let model = quads(&cuboid([0.0; 3], [1.0, 2.0, 3.0]));
    let bezier = extract(&model);
    let within = |off: f64| {
        let edges = Edges::of_surfaces(&bezier, SurfaceOrigin::whole);
        let joined = joined_arcs(edges, &|_| [DVec3::NAN; 3], &model.bounding_box(), 0.0);
        let map = crate::untrim::ParameterMap::Identity;
        let of_pieces = (0..6).map(|surface| Some((surface, &map))).collect();
        // Ways of up to 64 times what is near are not made shorter.
        let limits = Limits { nearness: 1e-4, most: 1.0, is_late: &|| false };
        match verdict_on_patches(&bezier, joined, Some(&Sheets { model: &bezier, of_pieces, off }), &limits) {
            Verdict::Embedded { within } => within,
            other => panic!("{other:?}"),
        }
    };
    let (exact, far) = (within(0.0), within(1e-3));
    // At a right angle to a plane, a way of what is near on the piece, and of twice that in the plane.
    assert!((1e-4..3.001e-4).contains(&exact) && 2e-3 <= far, "{exact:e} {far:e}");
}

/// The length of a leg that is too short to have a direction, 1,000 from the middle of a surface.
const LEG: f64 = 4e-8;

/// The way forth and back along a line of [`back_and_forth`].
pub(super) const BACK: f64 = 12.0 * LEG;

/// A sheet whose lines go forth by one leg and back by eight that have no direction. With s = 1 − u they are at
/// 9 (s − s⁹) legs, which is at most 8 · 9^(−1/8) > 6, from where they return to their beginning.
pub(super) fn back_and_forth() -> Model {
    let row = |k: usize| {
        let x = if k == 0 { 0.0 } else { (9 - k) as f64 * LEG };
        [-1e3, 1e3].map(|y| DVec3::new(x, y, 0.0)).to_vec()
    };
    let mut sheet = spline([9, 1], &(0..10).map(row).collect::<Vec<_>>());
    sheet.knots = [[[0.0; 10], [1.0; 10]].concat(), vec![0.0, 0.0, 1.0, 1.0]];
    of(vec![sheet])
}

#[test]
fn what_has_no_direction_is_in_the_ways_along_a_piece() {
    let bezier = extract(&back_and_forth());
    let complex = Complex::new(&bezier, Vec::new(), |_| None, NEARNESS);
    let search = Search::new(&bezier.patches, &complex, None, NEARNESS);
    let within = search.within(Task::One(0), 1.0);
    assert!(within.is_some_and(|within| within >= BACK), "{within:?}");
}

/// A sheet with a last part that is shorter than what has a direction: its ways have their length too, which the audit knows.
#[test]
fn the_way_along_what_has_no_direction_is_in_what_is_stated() {
    let strip = |step: f64| {
        let row = |x: f64| [DVec3::new(x, 0.0, 0.0), DVec3::new(x, 1.0, 0.0)].to_vec();
        let mut surface = spline([1, 1], &[row(0.0), row(1.0), row(1.0 + step)]);
        surface.knots = [vec![0.0, 0.0, 1.0, 2.0, 2.0], vec![0.0, 0.0, 1.0, 1.0]];
        verdict_with(&of(vec![surface]), 1e-13)
    };
    for step in [1e-11, -1e-11] {
        assert!(!matches!(strip(step), Verdict::Undecided { doubt: Doubt::Refuted, .. }), "{step}");
    }
}

/// A surface that narrows to a point between its ends, and goes on as a second cone, in the same direction or turned over.
#[test]
fn two_cones_of_one_surface_are_not_embedded() {
    let cones = |sign: f64| {
        let row = |z: f64, r: f64| (0..4).map(|k| in_turn(r, 30.0 * f64::from(k), z)).collect::<Vec<_>>();
        let mut surface = spline([1, 1], &[row(-1.0, sign), row(0.0, 0.0), row(1.0, 1.0)]);
        surface.knots = [vec![0.0, 0.0, 1.0, 2.0, 2.0], vec![0.0, 0.0, 1.0, 2.0, 3.0, 3.0]];
        of(vec![surface])
    };
    let in_one = cones(1.0);
    assert!(touches(&in_one) && touches(&cones(-1.0)));
}

fn in_turn(radius: f64, degrees: f64, z: f64) -> DVec3 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    DVec3::new(radius * cos, radius * sin, z)
}
