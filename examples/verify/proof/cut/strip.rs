//! Strips that contain all curves near a box, so that beside them nothing changes.
//!
//! A curve of size h is within h² times its curvature of a line, so that a box that a smooth boundary
//! crosses is decided at a size of about the root of the limit, and one that a straight line crosses
//! at any.
//!
//! Lengths are in units of the face's small sizes, in which boxes are enlarged by 1. A strip is no wider
//! than [`MAX_WIDTH`], so that from every point of a box one reaches any side of it that the enlarged
//! box has by a move of at most 1 straight across, which stays in the enlarged box.

use super::curve::{MAX_HALVINGS, Node, Outline};
use super::{Box2, Face};
use crate::proof::interval::Interval;

/// The largest width of a strip and of what reaches beyond it: 1 less far more than rounding.
const MAX_WIDTH: f64 = 0.99;

/// The part of a box below which a curve is not looked at more closely.
const MIN_PART: f64 = 1.0 / 256.0;

/// The most parts of curves that one strip is tried for: a strip that needs more is found for halves of
/// its box with less work, and all parts are kept.
const MAX_PARTS: u32 = 256;

/// The set of points at which a linear function is in a range.
pub(super) struct Strip {
    normal: [f64; 2],
    range: Option<Interval>,
    /// The number of parts of curves that may still be looked at.
    parts: u32,
}

/// A side of a strip in a box: its corner that is the farthest from the strip.
pub(super) struct Side {
    pub(super) corner: Box2,
    is_upper: bool,
}

impl Strip {
    /// Returns the strip of all curves of some outlines that meet an enlarged box; `None` if none is found.
    pub(super) fn around(face: &Face<'_>, outlines: &[&Outline], enlarged: &Box2) -> Option<Self> {
        let [u, v] = outlines.iter().find_map(|outline| outline.direction(enlarged))??;
        // In units of the small sizes the normal has length 1.
        let along = [u / face.small[0], v / face.small[1]];
        let length = along[0].hypot(along[1]);
        let normal = [-along[1] / length / face.small[0], along[0] / length / face.small[1]];
        let mut strip = Self { normal, range: None, parts: MAX_PARTS };
        let is_whole = normal.iter().all(|component| component.is_finite())
            && outlines.iter().all(|outline| outline.extend(&mut strip, enlarged));
        (is_whole && strip.range.is_some()).then_some(strip)
    }

    /// Returns the values of the linear function in a box.
    pub(super) fn values(&self, points: &Box2) -> Interval {
        Interval::point(self.normal[0]) * points[0] + Interval::point(self.normal[1]) * points[1]
    }

    /// Extends the strip; returns whether it is still narrow enough.
    fn include(&mut self, values: Interval) -> bool {
        let range = self.range.map_or(values, |range| range.hull(values));
        let is_narrow = (Interval::point(range.hi) - Interval::point(range.lo)).hi <= MAX_WIDTH;
        if is_narrow {
            self.range = Some(range);
        }
        is_narrow
    }

    /// Returns the sides of the strip in a box that no curve of it leaves; `None` where rounding hides one.
    pub(super) fn sides(&self, enlarged: &Box2) -> Option<Vec<Side>> {
        let range = self.range?;
        let mut sides = Vec::with_capacity(2);
        for is_upper in [false, true] {
            let corner = std::array::from_fn(|axis| {
                let is_high = (self.normal[axis] > 0.0) == is_upper;
                Interval::point(if is_high { enlarged[axis].hi } else { enlarged[axis].lo })
            });
            let value = self.values(&corner);
            let [beyond, within] = if is_upper {
                [value.lo > range.hi, value.hi <= range.hi]
            } else {
                [value.hi < range.lo, value.lo >= range.lo]
            };
            if beyond {
                sides.push(Side { corner, is_upper });
            } else if !within {
                return None;
            }
        }
        Some(sides)
    }

    /// Returns whether points with these values are on a side, or a move across away from it.
    pub(super) fn is_beside(&self, side: &Side, values: Interval) -> bool {
        self.range.is_some_and(|range| {
            let beyond = if side.is_upper {
                Interval::point(range.hi) - values
            } else {
                values - Interval::point(range.lo)
            };
            beyond.hi <= MAX_WIDTH
        })
    }
}

impl Outline {
    /// Returns the direction of a part of a curve that may meet a box and is not larger than it:
    /// `None` without such a part, `Some(None)` where rounding hides which one it is.
    fn direction(&self, target: &Box2) -> Option<Option<[f64; 2]>> {
        self.chains.iter().find_map(|chain| chain.direction(target, 0))
    }

    /// Extends a strip by all that meets a box; returns whether it is narrow enough for that.
    fn extend(&self, strip: &mut Strip, target: &Box2) -> bool {
        self.chains.iter().all(|chain| chain.extend(strip, target, 0))
    }
}

impl Node {
    fn direction(&self, target: &Box2, halvings: u32) -> Option<Option<[f64; 2]>> {
        if !self.meets(target) {
            return None;
        }
        // All 2^40 parts of a curve may be larger than a box below its rounding.
        if halvings == MAX_HALVINGS {
            return Some(None);
        }
        if self.is_chain() || !self.is_within(target, 1.0) {
            return self.halves().iter().find_map(|half| half.direction(target, halvings + 1));
        }
        let [start, end] = self.ends;
        let along = [end[0] - start[0], end[1] - start[1]];
        (along != [0.0; 2]).then_some(Some(along))
    }

    fn extend(&self, strip: &mut Strip, target: &Box2, halvings: u32) -> bool {
        if !self.meets(target) {
            return true;
        }
        if strip.parts == 0 {
            return false;
        }
        strip.parts -= 1;
        if !self.is_chain() {
            let values = self.points().map(|point| strip.values(&point)).reduce(Interval::hull);
            if values.is_some_and(|values| strip.include(values)) {
                return true;
            }
            if halvings == MAX_HALVINGS || self.is_within(target, MIN_PART) {
                return false;
            }
            // Points of the curve in the box are in every strip.
            for end in self.ends {
                let end = end.map(Interval::point);
                let is_inside = (0..2).all(|k| target[k].lo <= end[k].lo && end[k].hi <= target[k].hi);
                if is_inside && !strip.include(strip.values(&end)) {
                    return false;
                }
            }
        }
        self.halves().iter().all(|half| half.extend(strip, target, halvings + 1))
    }

    /// Whether the curve's box is at most this part of another box in size.
    fn is_within(&self, target: &Box2, part: f64) -> bool {
        (0..2).all(|k| self.hull[k].hi - self.hull[k].lo <= part * (target[k].hi - target[k].lo))
    }
}
