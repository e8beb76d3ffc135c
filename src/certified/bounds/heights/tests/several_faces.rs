//! Cells over lines between faces, and over corners in which several meet.

use super::over_faces::{
    Cut, bent, bent_surface, bound, cut_all, face, flat, flat_between, plane, plane_between,
};
use super::*;
use crate::certified::nearest::{Foot, NearestPoint};
use crate::certified::testing::{patch, through};
use crate::model::trim::FaceArrays;
use crate::rounding::upper_min;

type Polygon = Vec<[f64; 2]>;

/// The rectangle between two corners.
fn rectangle([x0, x1]: [f64; 2], [y0, y1]: [f64; 2]) -> Polygon {
    vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]]
}

/// Faces of one plane.
fn faces(polygons: &[Polygon]) -> Cut {
    cut_all(polygons.iter().map(|polygon| face(plane(), &[polygon])).collect())
}

/// A face on a surface that ends where the face does.
fn own_surface(x: [f64; 2], y: [f64; 2]) -> FaceArrays {
    face(plane_between(x, y), &[&rectangle(x, y)])
}

/// A cell over the lines of two to four faces lies on them, whether the lines are loops or ends of surfaces, straight
/// across or oblique; without one of the faces there is no bound.
#[test]
fn a_cell_over_several_faces_lies_on_them() {
    const LINE: f64 = 0.13;
    let (low, high) = ([-0.8, LINE], [LINE, 0.8]);
    let all = [-0.8, 0.8];
    let oblique = [
        vec![[-0.8, -0.8], [0.0, -0.8], [0.2, 0.8], [-0.8, 0.8]],
        vec![[0.0, -0.8], [0.8, -0.8], [0.8, 0.8], [0.2, 0.8]],
    ];
    let halves = [rectangle(low, all), rectangle(high, all)];
    let tee = [rectangle(low, all), rectangle(high, low), rectangle(high, high)];
    let quarters = [[low, low], [low, high], [high, low], [high, high]];
    let cross = quarters.map(|[x, y]| rectangle(x, y));
    let own = |ranges: &[[[f64; 2]; 2]]| -> Vec<FaceArrays> {
        ranges.iter().map(|[x, y]| own_surface(*x, *y)).collect()
    };
    let loops = |polygons: &[Polygon]| -> Vec<FaceArrays> {
        polygons.iter().map(|polygon| face(plane(), &[polygon])).collect()
    };
    let cases = [
        loops(&oblique),
        loops(&halves),
        loops(&tee),
        loops(&cross),
        own(&[[low, all], [high, all]]),
        own(&[[low, all], [high, low], [high, high]]),
        own(&quarters),
    ];
    for (case, faces) in cases.into_iter().enumerate() {
        let b = cut_all(faces.clone());
        for place in [[LINE + 0.004, LINE - 0.009], [LINE - 0.013, LINE + 0.007]] {
            let a = flat(place, 0.05);
            let found = bound(&a, &b, true, 1e-6);
            assert!(found.is_some_and(|bound| bound <= 1e-11), "{found:?} of case {case} at {place:?}");
            for left_out in 0..faces.len() {
                let mut rest = faces.clone();
                rest.remove(left_out);
                let found = bound(&a, &cut_all(rest), true, 1e-6);
                assert!(
                    found.is_none_or(|bound| bound > 1e-3),
                    "{found:?} of case {case} without {left_out}"
                );
            }
        }
    }
}

/// A cell beside a corner at which only three of four faces are needs no fourth one, however near and askew it passes;
/// if it reaches into that quarter, the bound is at least how far.
#[test]
fn a_cell_beside_a_corner_lies_on_three_faces() {
    const LINE: f64 = 0.13;
    let (low, high) = ([-0.8, LINE], [LINE, 0.8]);
    let quarters = [[low, low], [low, high], [high, low]];
    let of_ends = cut_all(quarters.iter().map(|[x, y]| own_surface(*x, *y)).collect());
    let of_loops = faces(&quarters.map(|[x, y]| rectangle(x, y)));
    // One side passes the corner from (2, -1) below it, or above it.
    let cell = |away: f64| {
        patch(through(|s, t| {
            let [x, y] = [0.04 * (s - 0.5) + 0.01 * (t - 1.0), -0.02 * (s - 0.5) + 0.03 * (t - 1.0)];
            DVec3::new(LINE + x - away, LINE + y, 0.0)
        }))
    };
    for b in [&of_ends, &of_loops] {
        for away in [1e-5, 1e-4, 1e-3] {
            let found = bound(&cell(away), b, true, 1e-6);
            assert!(found.is_some_and(|bound| bound <= 1e-11), "{found:?} at {away}");
            // The triangle in the fourth quarter has the legs away and away / 2.
            let into = bound(&cell(-away), b, true, 4.0 * away);
            assert!(into.is_none_or(|bound| bound >= away / 3.0), "{into:?} at {away}");
        }
    }
}

/// Over a slit the bound is half its width, which the middle of the slit attains.
#[test]
fn a_cell_over_a_slit_is_at_half_its_width() {
    let a = flat([0.003, 0.1], 0.05);
    for width in [1e-5, 1e-4] {
        let [low, high] = [[-0.8, -0.5 * width], [0.5 * width, 0.8]];
        let all = [-0.8, 0.8];
        let of_loops = faces(&[rectangle(low, all), rectangle(high, all)]);
        let of_ends = cut_all(vec![own_surface(low, all), own_surface(high, all)]);
        for b in [&of_loops, &of_ends] {
            let found = bound(&a, b, true, 8.0 * width).unwrap();
            let truth = 0.5 * width;
            assert!((truth..=truth * (1.0 + 1e-4)).contains(&found), "{found:e} {truth:e}");
        }
    }
}

/// Over a slit that opens like a wedge the bound is half its width at the cell's end, whichever end that is.
#[test]
fn a_cell_over_a_wedge_is_at_half_its_greatest_width() {
    const OPENING: f64 = 1e-3;
    for sign in [1.0, -1.0] {
        // From no width at y = -0.8 sign.
        let half = |y: f64| 0.5 * OPENING * (sign * y + 0.8);
        let left = vec![[-0.8, -0.8], [-half(-0.8), -0.8], [-half(0.8), 0.8], [-0.8, 0.8]];
        let right = vec![[half(-0.8), -0.8], [0.8, -0.8], [0.8, 0.8], [half(0.8), 0.8]];
        let b = faces(&[left, right]);
        for swapped in [false, true] {
            let (x, y) = ([-0.04, 0.05], [-0.06, 0.07]);
            let a =
                if swapped { flat_between([x[1], x[0]], [y[1], y[0]], 0.0) } else { flat_between(x, y, 0.0) };
            let widest = upper_max(half(y[0]), half(y[1]));
            let found = bound(&a, &b, true, 16.0 * widest).unwrap();
            assert!(
                (widest..=widest * (1.0 + 1e-2)).contains(&found),
                "{found:e} {widest:e} {sign} {swapped}"
            );
        }
    }
}

/// Where both faces are at different heights the bound is the larger distance, of the face about the foot or of the
/// other one.
#[test]
fn a_cell_over_a_step_is_at_its_height() {
    const STEP: f64 = 1e-5;
    let raised = |range: [f64; 2], height: f64| {
        let mut face = own_surface(range, [-0.8, 0.8]);
        for point in &mut face.surface.control_points {
            point[2] = height;
        }
        face
    };
    let b = cut_all(vec![raised([-0.8, 0.0], 0.0), raised([0.0, 0.8], -STEP)]);
    for x in [[-0.05, 0.04], [-0.04, 0.05]] {
        for height in [0.0, -STEP] {
            let found = bound(&flat_between(x, [0.1, 0.2], height), &b, true, 8.0 * STEP).unwrap();
            assert!((STEP..=STEP * (1.0 + 1e-3)).contains(&found), "{found:e} at {x:?}, {height:e}");
        }
    }
}

/// A cell over the line between two faces that ends beyond a loop of both is at least at that overhang.
#[test]
fn a_cell_over_two_faces_is_at_the_overhang_of_their_loops() {
    const BEYOND: f64 = 1e-5;
    let b = faces(&[rectangle([-0.8, 0.0], [-0.8, 0.8]), rectangle([0.0, 0.8], [-0.8, 0.8])]);
    for x in [[-0.05, 0.04], [-0.04, 0.05]] {
        let a = flat_between(x, [0.75, 0.8 + BEYOND], 0.0);
        let found = bound(&a, &b, true, 8.0 * BEYOND).unwrap();
        assert!((BEYOND..=BEYOND * (1.0 + 1e-3)).contains(&found), "{found:e} at {x:?}");
    }
}

/// Faces of the bent surface, one for each polygon of its parameters.
fn bent_faces(polygons: &[Polygon]) -> Cut {
    cut_all(polygons.iter().map(|polygon| face(bent_surface(), &[polygon])).collect())
}

/// Of several faces of a curved surface about a random corner, with slits and without, no point of a cell is
/// farther than its bound, and bounds over several faces are found.
#[test]
fn no_point_over_several_faces_is_farther_than_the_bound() {
    let random = &mut fastrand::Rng::with_seed(321);
    let (mut bounded, mut over_several) = (0, 0);
    for case in 0..60 {
        let middle = [0, 1].map(|_| 0.4 + 0.2 * random.f64());
        let slit = if case % 3 == 0 { 0.0 } else { 10.0_f64.powf(-2.0 - 3.0 * random.f64()) };
        // Sectors about the middle, to the sides of a square.
        let turn = random.f64();
        let spokes: Vec<f64> = (0..3 + case % 2)
            .map(|k| std::f64::consts::TAU * (k as f64 + turn + 0.3 * random.f64()) / (3 + case % 2) as f64)
            .collect();
        let end = |angle: f64| [middle[0] + 0.35 * angle.cos(), middle[1] + 0.35 * angle.sin()];
        let polygons: Vec<Polygon> = (0..spokes.len())
            .map(|k| {
                let from = spokes[k];
                let to = spokes[(k + 1) % spokes.len()];
                let to = if to < from { to + std::f64::consts::TAU } else { to };
                let along = |x: f64| end(from + x * (to - from));
                let inner = 0.5 * (from + to);
                let tip = [middle[0] + slit * inner.cos(), middle[1] + slit * inner.sin()];
                vec![tip, along(0.0), along(0.25), along(0.5), along(0.75), along(1.0)]
            })
            .collect();
        let whole = bent_faces(&polygons);
        let parts: Vec<Cut> =
            polygons.iter().map(|polygon| bent_faces(std::slice::from_ref(polygon))).collect();
        let operand = whole.pieces.operand();
        let nearest = NearestPoint::new(operand);
        for _ in 0..20 {
            let size = 10.0_f64.powf(-1.3 - 1.5 * random.f64());
            let spoke = spokes[random.usize(0..spokes.len())];
            let away = if random.bool() { 0.0 } else { 0.3 * random.f64() };
            let shift = size * (random.f64() - 0.5);
            let place = [middle[0] + away * spoke.cos() + shift, middle[1] + away * spoke.sin() + shift];
            let angle = std::f64::consts::TAU * random.f64();
            let a = patch(through(|s, t| {
                let [x, y] = [size * (s - 0.5), 0.7 * size * (t - 0.5)];
                let [u, v] = [x * angle.cos() - y * angle.sin(), x * angle.sin() + y * angle.cos()];
                bent(place[0] + u, place[1] + v)
            }));
            let threshold = 0.02;
            let Some(upper) = bound(&a, &whole, true, threshold) else { continue };
            bounded += 1;
            let alone = parts.iter().filter_map(|part| bound(&a, part, true, threshold));
            over_several += usize::from(alone.fold(f64::INFINITY, upper_min) > upper);
            let mut farthest = 0.0_f64;
            for _ in 0..30 {
                let target = a.operand().patch(0).point([random.f64(), random.f64()]);
                let foot = nearest.nearest(target, Foot::start(0, [0.5; 2]), 0.0);
                farthest = upper_max(farthest, nearest.certified(target, foot, 1e-9).distance());
            }
            assert!(farthest <= upper + 1e-9, "{farthest:e} {upper:e} of case {case}, {place:?}, {size}");
        }
    }
    assert!(bounded > 400 && over_several > 100, "{bounded} {over_several}");
}
