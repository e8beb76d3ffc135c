//! Faces that polygons trim.

use crate::model::SurfaceArrays;
use crate::model::trim::{FaceArrays, TrimCurveArrays};

/// A face of a surface, with polygons for loops, of (u, v).
pub(crate) fn face(surface: SurfaceArrays, loops: &[&[[f64; 2]]]) -> FaceArrays {
    let side = |corners: &[[f64; 2]], k: usize| TrimCurveArrays {
        degree: 1,
        knots: vec![0.0, 0.0, 1.0, 1.0],
        control_points: [corners[k], corners[(k + 1) % corners.len()]].map(|[u, v]| [u, v, 1.0]).to_vec(),
        ..TrimCurveArrays::default()
    };
    let sides = |corners: &&[[f64; 2]]| (0..corners.len()).map(|k| side(corners, k)).collect();
    FaceArrays::new(surface, Some(loops.iter().map(sides).collect()))
}

/// The square [-1, 1]² at height 0; u and v are x and y.
pub(crate) fn unit_plane() -> SurfaceArrays {
    plane_between([-1.0, 1.0], [-1.0, 1.0])
}

/// A rectangle at height 0; u and v are x and y.
pub(crate) fn plane_between([x0, x1]: [f64; 2], [y0, y1]: [f64; 2]) -> SurfaceArrays {
    let corners = [x0, x1].map(|x| [y0, y1].map(|y| [x, y, 0.0, 1.0]));
    SurfaceArrays {
        degree: [1, 1],
        knots: [vec![x0, x0, x1, x1], vec![y0, y0, y1, y1]],
        counts: [2, 2],
        control_points: corners.concat(),
    }
}
