//! Faces that tests of the cut begin with.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use super::face::UnitFace;
use crate::model::NurbsSurface;
use crate::model::trim::{Trim, TrimCurveArrays};
use crate::shapes::figure5_plane;

/// Returns the plane of figure 5, whose domain is one rectangle of knots.
pub(super) fn plane() -> NurbsSurface {
    figure5_plane().unwrap().surfaces()[0].clone()
}

/// Returns the part of a surface within polygons, whose corners are parts of the domain, for a
/// deviation of 1e-9.
pub(super) fn face_within(surface: &NurbsSurface, polygons: &[&[[f64; 2]]]) -> UnitFace {
    let ring = |corners: &&[[f64; 2]]| {
        let at = |k: usize| {
            let [u, v] = surface.domain().at(corners[k % corners.len()]);
            [u, v, 1.0]
        };
        let side = |k: usize| TrimCurveArrays {
            degree: 1,
            knots: vec![0.0, 0.0, 1.0, 1.0],
            control_points: vec![at(k), at(k + 1)],
            ..TrimCurveArrays::default()
        };
        (0..corners.len()).map(side).collect::<Vec<_>>()
    };
    let trim = Trim::new(0, surface, polygons.iter().map(ring).collect()).unwrap();
    UnitFace::new(0, surface, &trim, 1e-9, false).unwrap()
}
