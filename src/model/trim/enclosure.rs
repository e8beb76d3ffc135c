//! Whether a box of parameters lies in the trimmed region.

use super::winding::{Arc, Winding};
use crate::param_box::ParamBox;
use glam::DVec2;

/// The largest number of halvings of an arc: a boundary that is nearer to a box than about 2^-8 of
/// the arc's length may count as in it.
const MAX_HALVINGS: u32 = 8;

impl Winding {
    /// Returns true only if every point of a box of parameters, clamped to the domain, has winding number 1
    /// or is a limit of points that have it; a box near a curve may be said to be outside.
    ///
    /// No arc enters the box: a piece from P₀ to P₁ of length at most L lies in the ellipse
    /// `|x - P₀| + |x - P₁| <= L`, and on the box the sum is at least that of the distances of both
    /// ends from the box. The winding number is then constant in the box's interior. An arc on a border
    /// line of the domain does not enter a box of the domain. O(pieces).
    #[must_use]
    pub fn encloses(&self, parameters: &ParamBox) -> bool {
        let margin = DVec2::splat(self.rounding());
        let [low, high] = [parameters.low(), parameters.high()].map(|corner| self.fraction(corner.into()));
        let low = (low - margin).clamp(DVec2::ZERO, DVec2::ONE);
        let high = (high + margin).clamp(DVec2::ZERO, DVec2::ONE);
        let is_box = low.cmplt(high).all();
        is_box
            && !self.arcs().any(|arc| !arc.is_on_border() && self.may_enter(arc, [low, high]))
            && self.number(self.parameters(0.5 * (low + high))) == Some(1)
    }

    /// Returns whether an arc may have a point in a box.
    fn may_enter(&self, arc: &Arc, [low, high]: [DVec2; 2]) -> bool {
        let is_apart = |arc: &Arc| {
            let distances = arc.ends.map(|end| end.distance(end.clamp(low, high)));
            distances[0] + distances[1] > arc.length
        };
        let enters = |arc: &Arc| arc.ends.iter().any(|end| end.cmpge(low).all() && end.cmple(high).all());
        let mut stack = vec![(arc.clone(), 0)];
        while let Some((arc, halvings)) = stack.pop() {
            if is_apart(&arc) {
                continue;
            }
            if halvings == MAX_HALVINGS || enters(&arc) {
                return true;
            }
            stack.extend(self.halves(&arc, halvings).map(|half| (half, halvings + 1)));
        }
        false
    }
}

impl Arc {
    /// Returns whether the arc runs along a border line of the domain.
    fn is_on_border(&self) -> bool {
        let mut points = self.piece.points();
        let Some(first) = points.next() else { return false };
        let mut lines = [first.x == 0.0, first.x == 1.0, first.y == 0.0, first.y == 1.0];
        for point in points {
            lines[0] &= point.x == 0.0;
            lines[1] &= point.x == 1.0;
            lines[2] &= point.y == 0.0;
            lines[3] &= point.y == 1.0;
        }
        lines.contains(&true)
    }
}
