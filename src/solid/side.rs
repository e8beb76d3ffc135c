//! The side of a solid's boundary on which a point lies.

use super::Boundary;
use super::parity::{Obstacle, patch_parity};
use super::ray::Ray;
use crate::closest::Target;
use crate::rounding::gamma;
use glam::DVec3;
use serde::Serialize;

/// The number of rays tried from a point: near an edge many meet its strip, in general position
/// one suffices.
const MAX_RAYS: u64 = 24;

/// The roundings of a coordinate along a ray, relative to the largest length (lemma S3 of
/// docs/solids.md).
const COORDINATE_ROUNDINGS: f64 = 64.0;

/// The side on which a point lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Side {
    /// Inside the solid.
    Inside,
    /// Outside the solid.
    Outside,
    /// Not decided: on the boundary, in a crack between faces, or so near to an edge that no ray
    /// avoids it for certain.
    Undecided,
}

impl Boundary {
    /// Returns the side of a point, by the parity of the faces that a ray crosses.
    ///
    /// Guarantee (lemma S2 of docs/solids.md): inside and outside are never wrong for the set that
    /// the faces and the strips between joined edges bound, by the even-odd rule. `target` has the
    /// patches of the model that this is the boundary of. It holds for all points within `error` of
    /// the one given. O(√patches) a ray in general position.
    pub(crate) fn side(&self, target: &Target, point: DVec3, error: f64) -> Side {
        if !self.is_closed() || !point.is_finite() {
            return Side::Undecided;
        }
        for direction in (0..MAX_RAYS).map(direction) {
            match self.parity(target, &Ray::new(point, direction, self.margin_at(point) + error)) {
                Ok(true) => return Side::Inside,
                Ok(false) => return Side::Outside,
                Err(Obstacle::OnTheWay) => {}
                Err(Obstacle::AtTheEnd) => return Side::Undecided,
            }
        }
        Side::Undecided
    }

    /// Returns the side of a point as [`Boundary::side`] does, from that of another, which must be
    /// known: by the faces that the segment between them crosses, or a ray where that may meet an
    /// edge. Of a segment along a face only a few patches are near.
    pub(crate) fn side_beside(&self, target: &Target, point: DVec3, (other, side): (DVec3, Side)) -> Side {
        let margin = self.margin_at(point) + self.margin_at(other);
        match (side, self.parity(target, &Ray::segment(point, other, margin))) {
            (Side::Inside, Ok(false)) | (Side::Outside, Ok(true)) => Side::Inside,
            (Side::Outside, Ok(false)) | (Side::Inside, Ok(true)) => Side::Outside,
            _ => self.side(target, point, 0.0),
        }
    }

    /// Returns an upper bound on the error of a coordinate along a ray from a point.
    pub(crate) fn margin_at(&self, point: DVec3) -> f64 {
        self.margin + gamma(COORDINATE_ROUNDINGS) * point.length()
    }

    /// Returns whether the ray crosses the faces an odd number of times, if it certainly meets no strip
    /// and no edge of a patch.
    fn parity(&self, target: &Target, ray: &Ray) -> Result<bool, Obstacle> {
        let strips = ray.leaves(&self.strip_tree);
        if !strips.into_iter().all(|strip| self.strips[strip as usize].is_avoided(ray)) {
            return Err(Obstacle::OnTheWay);
        }
        let mut parity = false;
        for patch in ray.leaves(&target.tree) {
            parity ^= patch_parity(&target.patches.patch(patch as usize), ray)?;
        }
        Ok(parity)
    }
}

/// Returns a direction of length 1, the same at every call: points of a Fibonacci spiral, turned so
/// that no axis of a model is near one.
fn direction(index: u64) -> DVec3 {
    // The multiples of these irrational numbers fill the unit square evenly (the plastic number).
    const STEPS: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];
    let [height, turn] = STEPS.map(|step| (0.5 + step * (index + 1) as f64).fract());
    let z = 2.0 * height - 1.0;
    let (sin, cos) = (std::f64::consts::TAU * turn).sin_cos();
    let radius = (1.0 - z * z).sqrt();
    DVec3::new(radius * cos, radius * sin, z).normalize()
}
