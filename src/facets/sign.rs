//! The normals of a mesh at feet, which decide the signs of distances to it.

use super::rounding::facet_rounding;
use super::{Facet, FacetTarget, Nearest};
use glam::DVec3;
use std::f64::consts::PI;

/// A weight below this is that of a corner opposite to an edge with the point, or of one of the two
/// that are far from a corner with it: rounding moves a foot by much less.
const BORDER: f64 = 1e-9;

/// The distance up to which a facet has a foot too, in roundings of a distance.
const REACH_ROUNDINGS: f64 = 4.0;

/// The part of the sum of angles below which a sum of normals counts as vanishing.
const MIN_SUM: f64 = 1e-6;

impl FacetTarget {
    /// Returns the normal of the facet at a foot, of length 1. On an edge or a corner it is the
    /// angle-weighted normal of all facets there (Bærentzen and Aanæs 2005): the points of a closed mesh
    /// whose normals point outwards are inside where they are behind it. `None` where no normal exists,
    /// where normals cancel, and for a cloud. O(log n).
    pub(crate) fn normal(&self, place: u32, nearest: &Nearest) -> Option<DVec3> {
        let facet = self.facet(place);
        let is_inside = nearest.weights.iter().all(|&weight| weight > BORDER);
        let normal = if is_inside { facet.normal() } else { self.pseudonormal(facet.point(nearest.weights)) };
        normal.map(DVec3::normalize)
    }

    /// Returns the sum of the normals of all triangles at a point, weighted by their angles there.
    fn pseudonormal(&self, point: DVec3) -> Option<DVec3> {
        let reach = REACH_ROUNDINGS * facet_rounding(self.bounding_box().farthest_from_origin());
        let reach_squared = reach * reach;
        let (mut sum, mut angles) = (DVec3::ZERO, 0.0);
        self.visit(point, reach_squared, |place| {
            let facet = self.facet(place);
            let nearest = facet.nearest(point);
            if nearest.distance_squared <= reach_squared
                && let (Facet::Triangle(corners), Some(normal)) = (facet, facet.normal())
            {
                let angle = angle(&corners, nearest.weights);
                sum += angle * normal.normalize();
                angles += angle;
            }
            (reach_squared, false)
        });
        (sum.length() > MIN_SUM * angles).then_some(sum)
    }
}

/// Returns the angle that a triangle fills about the point of these weights.
fn angle(corners: &[DVec3; 3], weights: [f64; 3]) -> f64 {
    let large: Vec<usize> = (0..3).filter(|&corner| weights[corner] > BORDER).collect();
    match large.as_slice() {
        [corner] => {
            let [left, right] = [1, 2].map(|step| corners[(corner + step) % 3] - corners[*corner]);
            left.angle_between(right)
        }
        [_, _] => PI,
        _ => 2.0 * PI,
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::facets::TriangleMesh;

    /// A spike: at its tip the normal of the first facet would take half of the points for inside.
    #[test]
    fn points_off_edges_and_corners_have_the_sign_of_their_side() {
        let mut vertices: Vec<DVec3> = (0..5)
            .map(|k| {
                let (y, x) = (0.4 * PI * f64::from(k)).sin_cos();
                DVec3::new(x, y, 0.0)
            })
            .collect();
        vertices.extend([DVec3::new(0.3, 0.0, 4.0), DVec3::new(0.3, 0.0, 3.0)]);
        let mut triangles = Vec::new();
        // Outside the tall cone, and the lower one within it, which the solid leaves out.
        for k in 0..5_u32 {
            triangles.extend([[k, (k + 1) % 5, 5], [(k + 1) % 5, k, 6]]);
        }
        let target = FacetTarget::of_mesh(&TriangleMesh::new(&vertices, &triangles).unwrap());
        let is_inside = |p: DVec3| {
            let below = |tip: DVec3| {
                (0..5).all(|k| {
                    let (a, b) = (vertices[k], vertices[(k + 1) % 5]);
                    (b - a).cross(tip - a).dot(p - a) < 0.0
                })
            };
            p.z > 0.0 && below(vertices[5]) && !below(vertices[6])
        };
        let random = &mut fastrand::Rng::with_seed(8);
        let mut inside = 0;
        for _ in 0..4000 {
            let near = vertices[random.usize(..7)];
            let point = near + 0.3 * DVec3::from_array([0; 3].map(|_| random.f64() - 0.5));
            let (foot, nearest, _) = target.certified(point, 0);
            let Some(normal) = target.normal(foot.facet, &nearest) else { continue };
            let along = -nearest.offset.dot(normal);
            if along.abs() > 1e-6 * nearest.offset.length() && nearest.offset.length() > 1e-9 {
                assert_eq!(along < 0.0, is_inside(point), "{point} {along}");
                inside += usize::from(along < 0.0);
            }
        }
        assert!(inside > 200, "{inside}");
    }

    /// Two triangles on both sides of an edge, turned so that their normals are rounded: oriented
    /// against each other they have no normal on it, however the sum of both is rounded.
    #[test]
    fn normals_that_cancel_but_for_rounding_have_no_sum() {
        for turn in 1..40 {
            let rotation =
                glam::DQuat::from_axis_angle(DVec3::new(1.0, -2.0, 0.5).normalize(), 0.1 * f64::from(turn));
            let vertices = [DVec3::ZERO, DVec3::Y, DVec3::new(1.0, 0.3, 0.0), DVec3::new(-1.0, 0.4, 0.0)]
                .map(|vertex| rotation * vertex);
            let normal = |other: [u32; 3]| {
                let mesh = TriangleMesh::new(&vertices, &[[0, 1, 2], other]).unwrap();
                FacetTarget::of_mesh(&mesh).pseudonormal(0.5 * vertices[1])
            };
            assert_eq!(normal([0, 1, 3]), None, "{turn}");
            let along = normal([1, 0, 3]).unwrap().normalize();
            assert!(along.distance(rotation * DVec3::NEG_Z) < 1e-12, "{along}");
        }
    }
}
