//! Whether the boundary of a body meets itself.

mod crossings;
mod proof;
mod sheets;

pub use crate::embedded::SelfOverlap;
pub use proof::{EmbeddedDoubt, EmbeddedUnknown, Embedding};

use self::crossings::{Crossing, crossings};
use self::sheets::{SheetTriangle, sheets};
use super::PreparedModel;
use crate::closest::closest;
use crate::flatness::Flatness;
use crate::solid::Joined;
use glam::DVec3;

/// The distances from a place where sheets cross at which points are tried, relative to the depth of the crossing.
const STEPS: [f64; 4] = [0.5, 0.25, 0.125, 0.03];

/// The least length of the sum of two unit normals: of sheets that are nearly opposite, no point is certainly
/// between them.
const MIN_SUM: f64 = 0.05;

/// The number of places of sheets, beside those where they cross, at which points on both sides are tried: a sheet that
/// lies on itself crosses none.
const MAX_MIDDLES: usize = 16;

/// The distance of these points from the sheet, as a part of the body's diagonal.
const RELATIVE_DEPTH: f64 = 1e-2;

/// The gap of distances, as a part of the body's diagonal.
const RELATIVE_GAP: f64 = 1e-9;

impl PreparedModel {
    /// Returns a place at which the boundary of a body encloses space twice or turned over; `None` where none is
    /// found, which is no proof, and for a body that is open or has one side.
    ///
    /// Places are looked for at first use, where triangles of the faces cross, deeper than a thousandth of the body, and
    /// about some triangles. O(n log n + crossings) in general position.
    pub(in crate::engine) fn self_overlap(&self) -> Option<&SelfOverlap> {
        self.kept_self_overlap(|| self.found_self_overlap())
    }

    fn found_self_overlap(&self) -> Option<SelfOverlap> {
        if !self.boundary().is_closed() {
            return None;
        }
        let (triangles, tolerance) = sheets(self);
        let outwards = self.outward_signs(&triangles);
        let crossings = crossings(&triangles, tolerance).into_iter();
        let mut places = crossings.chain(self.middles(&triangles));
        places.find_map(|crossing| self.overlap_at(&crossing, &outwards))
    }

    /// Returns the middles of some triangles, as places where a sheet may lie on itself.
    fn middles(&self, triangles: &[SheetTriangle]) -> impl Iterator<Item = Crossing> {
        let depth = RELATIVE_DEPTH * self.control_box().diagonal();
        let chosen = triangles.iter().step_by(triangles.len().div_ceil(MAX_MIDDLES).max(1));
        chosen.filter_map(move |&SheetTriangle { corners: [a, b, c], surface }| {
            let normal = (b - a).cross(c - a).try_normalize()?;
            let point = (a + b + c) / 3.0;
            Some(Crossing { point, normals: [normal; 2], surfaces: [surface; 2], depth })
        })
    }

    /// Returns, for each shell, 1 or -1: the sign of the volume that triangles near it enclose, as its first surface
    /// is oriented.
    fn outward_signs(&self, triangles: &[SheetTriangle]) -> Vec<i32> {
        let Joined { shells, turned, of_shell } = self.boundary().joined();
        let origin = self.control_box().center();
        let mut volumes = vec![0.0; of_shell.len()];
        for SheetTriangle { corners, surface } in triangles {
            let [a, b, c] = corners.map(|corner| corner - origin);
            let volume = a.dot(b.cross(c));
            volumes[shells[*surface as usize] as usize] +=
                if turned[*surface as usize] { -volume } else { volume };
        }
        volumes.into_iter().map(|volume| if volume < 0.0 { -1 } else { 1 }).collect()
    }

    /// Returns a point near a crossing about which the boundary winds as none does that does not meet itself.
    fn overlap_at(&self, crossing: &Crossing, signs: &[i32]) -> Option<SelfOverlap> {
        let Joined { shells, turned, .. } = self.boundary().joined();
        let [shell, other] = crossing.surfaces.map(|surface| shells[surface as usize]);
        if shell != other {
            return None;
        }
        let sign = signs[shell as usize];
        let outward = |k: usize| {
            let is_turned = turned[crossing.surfaces[k] as usize] != (sign < 0);
            if is_turned { -crossing.normals[k] } else { crossing.normals[k] }
        };
        let outwards = outward(0) + outward(1);
        if outwards.length() < MIN_SUM {
            return None;
        }
        let outwards = outwards.normalize();
        let target = &self.target(Flatness::None).target;
        STEPS.into_iter().find_map(|step| {
            let ends = [-1.0, 1.0].map(|side| crossing.point + side * step * crossing.depth * outwards);
            let windings = ends.map(|end| self.boundary().winding(shell, target, end, 0.0));
            let [Some(within), Some(beyond)] = windings.map(|winding| Some(sign * winding?)) else {
                return None;
            };
            // Behind one sheet it is one more than before it: of a body that does not meet itself, 1 and 0.
            let (point, winding) = if within > 1 { (ends[0], within) } else { (ends[1], beyond) };
            if within - beyond < 2 { None } else { self.ball_at(point, winding, crossing.surfaces) }
        })
    }

    /// Returns the place with the largest ball about a point that is known to be clear, if that is larger than the
    /// gaps.
    fn ball_at(&self, point: DVec3, winding: i32, surfaces: [u32; 2]) -> Option<SelfOverlap> {
        let target = &self.target(Flatness::None).target;
        let found = closest(target, point, RELATIVE_GAP * self.control_box().diagonal())?;
        let radius = self.boundary().clear_radius(found.lower);
        if self.boundary().clear_radius(radius) <= 0.0 {
            return None;
        }
        let faces = match self.facets() {
            Some(_) => Vec::new(),
            None => surfaces.map(|surface| self.pieces().face(surface as usize)).to_vec(),
        };
        Some(SelfOverlap { point: point.to_array(), radius: radius.next_down(), winding, faces })
    }
}

#[cfg(test)]
#[cfg(not(target_arch = "wasm32"))]
mod tests {
    use super::*;
    use crate::shapes::sphere;

    /// Behind one sheet a sphere winds once about a point and before it not at all, which is no fault.
    #[test]
    fn one_sheet_is_no_crossing() {
        let model = PreparedModel::new(&sphere(DVec3::ZERO, 2.0).unwrap()).unwrap();
        let jet = model.bezier().patches.patch(0).jet([0.4, 0.6]);
        let normals = [jet.normal().unwrap(); 2];
        let crossing = Crossing { point: jet.point, normals, surfaces: [0; 2], depth: 0.5 };
        for sign in [-1, 1] {
            assert_eq!(model.overlap_at(&crossing, &[sign]), None);
        }
    }
}
