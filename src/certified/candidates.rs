//! Patches of B listed about the farthest point, around which the last cells lie.

use super::BranchAndBound;
use super::region::{Domain, SearchNode};
use crate::closest::NearbyPatches;

/// Patches looked at by parts of patches before a list is worth its making,
/// which costs about as much.
const MAX_LOOKS: usize = 64;

/// How much farther than the farthest point's patch others are listed, in radii
/// of a cell: its corners are two from that point, and so move both distances.
const ROOM: f64 = 4.0;

/// The same relative to the distance, at most: of a longer list, most would
/// never be looked at.
const MAX_ROOM: f64 = 0.03;

impl BranchAndBound<'_> {
    /// Lists the patches near the farthest point before cells like this one are
    /// bounded, if so many were looked at that it pays, and unless the point is
    /// within a cell's radius of the last list's.
    pub(super) fn list_candidates(&mut self, region: &SearchNode) {
        let looks = self.b.looks.get_mut();
        let cell = match &region.domain {
            Domain::Cell(cell) if !cell.is_whole() => cell,
            _ => {
                *looks = 0;
                return;
            }
        };
        let many = *looks >= MAX_LOOKS;
        let Some((point, distance)) = self.believed_point().filter(|_| many) else { return };
        let [s, t] = self.a.whole_bounds(cell.patch).first;
        let radius = cell.half[0] * s + cell.half[1] * t;
        let stale = |about: &NearbyPatches| about.center.distance(point) > radius;
        if self.b.candidates.as_ref().is_none_or(stale) {
            *self.b.looks.get_mut() = 0;
            let reach = distance + (ROOM * radius).min(MAX_ROOM * distance);
            self.b.candidates = Some(NearbyPatches::new(self.b.target, point, reach));
        }
    }
}
