//! Square frames that are cut at one place, with planes that are one face on both sides of the cut.

use super::super::surfaces::magnitude;
use fastrand::Rng;
use glam::{DMat3, DVec3};
use nurbs_hausdorff::trim::{FaceArrays, TrimCurveArrays};
use nurbs_hausdorff::{Model, ModelArrays, SurfaceArrays};

/// The exponents of 10 of the parameters' range: loops may lie in each other by a millionth of it.
const RANGES: [f64; 2] = [0.7, 5.0];

/// A face of the points `origin + a u + b v` with (a, b) within these loops.
struct Plane {
    origin: DVec3,
    u: DVec3,
    v: DVec3,
    loops: Vec<Vec<[f64; 2]>>,
}

/// Returns a frame whose two ends lie in each other by `depth`, or are as far apart where it is negative, under a linear
/// map; `None` where its loops are not accepted.
pub(super) fn frame(rng: &mut Rng, depth: f64) -> Option<Model> {
    let [left, right] = [0.5 * depth, -0.5 * depth];
    let outer = [[right, 0.0], [2.0, 0.0], [2.0, 4.0], [-2.0, 4.0], [-2.0, 0.0], [left, 0.0]];
    let inner = [[left, 1.0], [-1.0, 1.0], [-1.0, 3.0], [1.0, 3.0], [1.0, 1.0], [right, 1.0]];
    let outline = [outer, inner].concat();
    let rectangle = |a: f64, b: f64| vec![[a, 0.0], [b, 0.0], [b, 1.0], [a, 1.0]];
    let turned = outline.iter().rev().map(|&[x, y]| [y, x]).collect();
    let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
    let below = vec![rectangle(-2.0, left), rectangle(right, 2.0)];
    let above = vec![rectangle(-left, 1.0), rectangle(-1.0, -right)];
    let mut planes = vec![
        Plane { origin: z, u: x, v: y, loops: vec![outline.clone()] },
        Plane { origin: DVec3::ZERO, u: y, v: x, loops: vec![turned] },
        Plane { origin: DVec3::ZERO, u: x, v: z, loops: below },
        Plane { origin: y, u: -x, v: z, loops: above },
    ];
    for side in [1, 2, 3, 5, 7, 8, 9, 11] {
        let [from, to] = [side, (side + 1) % outline.len()].map(|k| {
            let [x, y] = outline[k];
            DVec3::new(x, y, 0.0)
        });
        planes.push(Plane { origin: from, u: to - from, v: z, loops: vec![rectangle(0.0, 1.0)] });
    }
    let range = magnitude(rng, RANGES[0], RANGES[1]);
    let map = loop {
        let map = DMat3::from_cols_array(&std::array::from_fn(|k| f64::from(k % 4 == 0) + rng.f64() - 0.5));
        if map.determinant() > 0.2 {
            break map;
        }
    };
    let faces = planes.into_iter().map(|plane| face(plane, range, map)).collect();
    Model::from_faces(ModelArrays { faces, ..ModelArrays::default() }).ok()
}

fn face(Plane { origin, u, v, loops }: Plane, range: f64, map: DMat3) -> FaceArrays {
    let at = |a: f64, b: f64| (map * (origin + a * u + b * v)).extend(1.0).to_array();
    let surface = SurfaceArrays {
        degree: [1, 1],
        knots: [0, 1].map(|_| vec![-range, -range, range, range]),
        counts: [2, 2],
        control_points: vec![at(-range, -range), at(-range, range), at(range, -range), at(range, range)],
    };
    let line = |from: [f64; 2], to: [f64; 2]| TrimCurveArrays {
        degree: 1,
        knots: vec![0.0, 0.0, 1.0, 1.0],
        control_points: [from, to].map(|[a, b]| [a, b, 1.0]).to_vec(),
        ..TrimCurveArrays::default()
    };
    let lines = |corners: &Vec<[f64; 2]>| {
        (0..corners.len()).map(|k| line(corners[k], corners[(k + 1) % corners.len()])).collect()
    };
    FaceArrays::new(surface, Some(loops.iter().map(lines).collect()))
}
