//! Cells over trimmed faces: across the lines of a cut, over its loops and over a seam.

use super::*;
use crate::axis::Axis;
use crate::certified::TrimmedFaces;
use crate::certified::nearest::{Foot, NearestPoint};
use crate::certified::testing::{Surfaces, oblique, patch, through};
pub(super) use crate::certified::testing::{face, plane_between, unit_plane as plane};
use crate::model::trim::{FaceArrays, RimSide};
use crate::model::{Model, ModelArrays, SurfaceArrays};
use crate::pieces::FacePieces;
use std::f64::consts::FRAC_1_SQRT_2;

/// A model's pieces, and its faces.
pub(super) struct Cut {
    pub(super) pieces: Surfaces,
    pub(super) faces: TrimmedFaces,
}

/// A straight side of a rim, at a constant parameter.
pub(super) fn flat_side(axis: Axis) -> RimSide {
    RimSide { axis, is_upwards: true, coefficients: [0.0; 5], rate: 1.0, slope: 0.0 }
}

/// Cuts faces.
pub(super) fn cut_all(faces: Vec<FaceArrays>) -> Cut {
    let model = Model::from_faces(ModelArrays { faces, ..ModelArrays::default() }).unwrap();
    let (pieces, untrimmed) = FacePieces::new(&model).unwrap();
    Cut { pieces: Surfaces::of(&untrimmed), faces: pieces.trimmed_faces(&model) }
}

fn cut(surface: SurfaceArrays, loops: &[&[[f64; 2]]]) -> Cut {
    cut_all(vec![face(surface, loops)])
}

/// Half the length of the plate, and of the diagonals of its hole.
const PLATE: f64 = 0.9;
const HOLE: f64 = 0.4;

/// A square plate at height 0 with a hole whose corners are on the axes.
pub(super) fn plate() -> Cut {
    let outer = [[-PLATE, -PLATE], [PLATE, -PLATE], [PLATE, PLATE], [-PLATE, PLATE]];
    let hole = [[HOLE, 0.0], [0.0, -HOLE], [-HOLE, 0.0], [0.0, HOLE]];
    cut(plane(), &[&outer, &hole])
}

/// The part of a plane between two corners, at a height.
pub(super) fn flat_between([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], height: f64) -> Surfaces {
    patch(through(|s, t| DVec3::new(x0 + s * (x1 - x0), y0 + t * (y1 - y0), height)))
}

/// A point of a curved surface.
pub(super) fn bent(s: f64, t: f64) -> DVec3 {
    DVec3::new(s + 0.2 * s * t, t - 0.2 * s * s, 0.3 * s * t - 0.2 * t * t)
}

/// The surface of these points over the unit square.
pub(super) fn bent_surface() -> SurfaceArrays {
    SurfaceArrays {
        degree: [2, 2],
        knots: [0; 2].map(|_| vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0]),
        counts: [3, 3],
        control_points: through(bent).iter().map(|control| control.to_array()).collect(),
    }
}

/// The distance of a point of the plane from the plate.
fn distance([x, y]: [f64; 2]) -> f64 {
    let beyond = [x, y].map(|place: f64| (place.abs() - PLATE).max(0.0));
    let into_the_hole = FRAC_1_SQRT_2 * (HOLE - x.abs() - y.abs()).max(0.0);
    beyond[0].hypot(beyond[1]).max(into_the_hole)
}

/// The bound of A's whole patch over a cut face, or over its pieces alone.
pub(super) fn bound(a: &Surfaces, b: &Cut, over_faces: bool, threshold: f64) -> Option<f64> {
    bound_of(a.operand(), b.pieces.operand().with_faces(over_faces.then_some(&b.faces)), threshold)
}

/// A flat patch at 45° about a point, so long from its centre to its corners.
pub(super) fn flat([x, y]: [f64; 2], size: f64) -> Surfaces {
    let place = |s: f64, t: f64| DVec3::new(x + size * (s + t - 1.0), y + size * (s - t), 0.0);
    patch(through(place))
}

/// Beside the hole a cell lies on the plate, whatever lines the cut has put there.
#[test]
fn a_cell_across_the_lines_of_a_cut_lies_on_the_face() {
    let (plate, mut only_whole) = (plate(), 0);
    for x in [-0.65, 0.65] {
        for y in [-0.42, -0.1, 0.1, 0.42] {
            let a = flat([x, y], 0.2);
            let whole = bound(&a, &plate, true, 1e-9).unwrap();
            assert!(whole <= 1e-12, "{whole:e} at {x}, {y}");
            only_whole += usize::from(bound(&a, &plate, false, 1e-9).is_none_or(|bound| bound > 1e-3));
        }
    }
    assert!(only_whole >= 4, "{only_whole}");
}

/// Over the hole and beyond the edges no point of a cell is farther than its bound.
#[test]
fn no_point_over_a_hole_is_farther_than_the_bound() {
    let random = &mut fastrand::Rng::with_seed(318);
    let (plate, mut bounded, mut off) = (plate(), 0, 0);
    for _ in 0..2000 {
        let [x, y] = [0, 1].map(|_| 2.0 * random.f64() - 1.0);
        let size = 10.0_f64.powf(-0.5 - 2.0 * random.f64());
        let a = flat([x, y], size);
        let Some(upper) = bound(&a, &plate, true, 0.1) else { continue };
        bounded += 1;
        let mut farthest = 0.0_f64;
        for _ in 0..50 {
            let [s, t] = [random.f64(), random.f64()];
            farthest = upper_max(farthest, distance([x + size * (s + t - 1.0), y + size * (s - t)]));
        }
        off += usize::from(farthest > 1e-6);
        assert!(farthest <= upper + 1e-12, "{farthest:e} {upper:e} at {x}, {y}, {size}");
    }
    assert!(bounded > 500 && off > 20, "{bounded} {off}");
}

/// A tube of four cubics that join smoothly at u = 0 and u = 1, of height 1.
fn tube() -> SurfaceArrays {
    // A periodic cubic on a square, unclamped: the last three control points are the first ones.
    let place = |k: usize| [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]][k % 4];
    let point = |k: usize, z: f64| [place(k)[0], place(k)[1], z, 1.0];
    SurfaceArrays {
        degree: [3, 1],
        knots: [(-3..=7).map(|k| 0.25 * f64::from(k)).collect(), vec![0.0, 0.0, 1.0, 1.0]],
        counts: [7, 2],
        control_points: (0..7).flat_map(|k| [0.0, 1.0].map(|z| point(k, z))).collect(),
    }
}

/// Over the seam of a tube a cell lies on it, unless there is a hole on either side.
#[test]
fn a_cell_across_a_seam_lies_on_the_face_up_to_its_holes() {
    let border: &[[f64; 2]] = &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let hole_at = |u: f64| [[u - 0.01, 0.5], [u, 0.6], [u + 0.01, 0.5], [u, 0.4]];
    let full = crate::bezier::extract(&Model::from_arrays(None, vec![tube()]).unwrap());
    let jet = full.patches.patch(0).jet([0.0, 0.5]);
    // About the seam, as a paraboloid that is at 45° to it: [-0.03, 0.03] of u.
    let steps = |s: f64, t: f64| [0.06 * (s + t - 1.0), 0.06 * (s - t)];
    let a = patch(through(|s, t| {
        let [u, v] = steps(s, t);
        jet.point + u * jet.s + v * jet.t + 0.5 * u * u * jet.ss
    }));
    let rise = 0.06_f64.powi(3) * jet.ss.length();
    let over = bound(&a, &cut(tube(), &[border]), true, 0.01).unwrap();
    assert!(over <= rise, "{over:e} {rise:e}");
    // The hole is 0.02 wide and 0.2 high: its middle is farther than 0.005 / 4 |B_u| from its ends.
    let least = 0.005 * 4.0 * jet.s.length().min(1.0) * 0.25;
    for u in [0.02, 0.98] {
        let over_hole = bound(&a, &cut(tube(), &[border, &hole_at(u)]), true, 0.01);
        assert!(over_hole.is_none_or(|bound| bound >= least), "{over_hole:?} {least:e}");
    }
}

/// The oblique cell of the other tests is bounded by its height over a face, too.
#[test]
fn a_height_over_a_face_is_the_distance() {
    let mut raised = oblique(|_, _| 1e-4);
    for control in &mut raised {
        control.x = 0.5 * control.x - 0.9;
        control.y = 0.5 * control.y - 0.25;
    }
    let bound = bound(&patch(raised), &plate(), true, 1.0).unwrap();
    assert!((1e-4..=1e-4 * (1.0 + 1e-9)).contains(&bound), "{bound:e}");
}

/// The bound of a cell that ends beyond an edge of the plate is its overhang; beyond a corner it is at most the
/// sum of both.
#[test]
fn a_cell_beyond_a_loop_is_at_its_overhang() {
    const BEYOND: f64 = 1e-4;
    let plate = plate();
    let at = |x: [f64; 2], y: [f64; 2]| flat_between(x, y, 0.0);
    let edge = |low: f64| [low, PLATE + BEYOND];
    for swapped in [false, true] {
        for sign in [1.0, -1.0] {
            let beside = edge(0.8).map(|end| sign * end);
            let a = if swapped { at([0.3, 0.35], beside) } else { at(beside, [0.3, 0.35]) };
            let bound = bound(&a, &plate, true, 1e-3).unwrap();
            assert!((BEYOND..=BEYOND * (1.0 + 1e-3)).contains(&bound), "{bound:e} {swapped} {sign}");
        }
    }
    let bound = bound(&at(edge(0.85), edge(0.86)), &plate, true, 1e-3).unwrap();
    assert!((2.0_f64.sqrt() * BEYOND..=2.0 * BEYOND * (1.0 + 1e-3)).contains(&bound), "{bound:e}");
}

/// Of a face of a curved surface with round sides no point of a cell about a loop is farther than its bound, and
/// bounds over loops are found: the lags of both parameters count.
#[test]
fn no_point_about_a_loop_of_a_curved_face_is_farther_than_the_bound() {
    let random = &mut fastrand::Rng::with_seed(3190);
    // A polygon of many corners about a circle, and one with a reflex corner.
    let round: Vec<[f64; 2]> = (0..40)
        .map(|k| std::f64::consts::TAU * f64::from(k) / 40.0)
        .map(|angle| [0.5 + 0.3 * angle.cos(), 0.5 + 0.35 * angle.sin()])
        .collect();
    let reflex = [[0.2, 0.2], [0.8, 0.25], [0.75, 0.5], [0.5, 0.55], [0.45, 0.8], [0.25, 0.75]];
    let (mut bounded, mut over_loops) = (0, 0);
    for loop_ in [&round[..], &reflex[..]] {
        let b = cut(bent_surface(), &[loop_]);
        let pair_b = b.pieces.operand();
        let nearest = NearestPoint::new(pair_b);
        for _ in 0..300 {
            let corner = random.usize(0..loop_.len());
            let [from, to] = [loop_[corner], loop_[(corner + 1) % loop_.len()]];
            let along = if random.bool() { 0.0 } else { random.f64() };
            let size = 10.0_f64.powf(-1.3 - 1.5 * random.f64());
            let shift = size * (random.f64() - 0.5);
            let middle = [0, 1].map(|axis| from[axis] + along * (to[axis] - from[axis]) + shift);
            let turn = std::f64::consts::TAU * random.f64();
            let place = |s: f64, t: f64| {
                let [x, y] = [size * (s - 0.5), 0.7 * size * (t - 0.5)];
                [middle[0] + x * turn.cos() - y * turn.sin(), middle[1] + x * turn.sin() + y * turn.cos()]
            };
            let a = patch(through(|s, t| {
                let [u, v] = place(s, t);
                bent(u, v)
            }));
            let Some(upper) = bound(&a, &b, true, 0.02) else { continue };
            bounded += 1;
            over_loops += usize::from(bound(&a, &b, false, 0.02).is_none_or(|pieces| pieces > upper));
            for _ in 0..30 {
                let target = a.operand().patch(0).point([random.f64(), random.f64()]);
                let foot = nearest.nearest(target, Foot::start(0, [0.5; 2]), 0.0);
                let foot = nearest.certified(target, foot, 1e-9);
                assert!(foot.distance() <= upper + 1e-9, "{} {upper} at {middle:?}, {size}", foot.distance());
            }
        }
    }
    assert!(bounded > 150 && over_loops > 50, "{bounded} {over_loops}");
}

/// What is left of an excess by the steps of two sides is nothing, for slopes of any size that are allowed.
#[test]
fn steps_lead_within_both_sides() {
    let random = &mut fastrand::Rng::with_seed(31);
    for _ in 0..200 {
        let slopes = [random.f64() * 10.0, random.f64() * 0.05];
        let excesses = [random.f64(), random.f64()];
        let side = |axis: Axis, slope: f64| RimSide { slope, ..flat_side(axis) };
        let sides = [side(Axis::V, slopes[0]), side(Axis::U, slopes[1])];
        let [along_u, along_v] = rim::steps(&sides, &excesses);
        assert!(along_v - slopes[0] * along_u >= excesses[0]);
        assert!(along_u - slopes[1] * along_v >= excesses[1]);
        assert!(along_v - slopes[0] * along_u <= excesses[0] * (1.0 + 1e-9) + 1e-9);
        let both = rim::steps(&[side(Axis::V, 0.0), side(Axis::V, 0.0)], &excesses);
        assert_eq!(both, [0.0, excesses[0].max(excesses[1])]);
    }
}
