//! Parts of triangles: their upper bounds, and cuts along the reach of a facet of B.

use super::super::{FacetFoot, FacetTarget};
use super::cover::{MAX_CLIPS, cover, inner_point};
use crate::rounding::{upper_max, upper_min};
use glam::DVec3;

/// The share of a part's area that a cut must decide; where it would decide less, the part is
/// halved, so that parts become short and not only narrow.
const MIN_DECIDED_SHARE: f64 = 0.25;

/// Steps of the search for the end of a facet's reach along an edge: each about doubles the digits,
/// and any end is valid.
const MAX_REACH_STEPS: usize = 8;

/// The part that an end of a facet's reach should take of what is left below the threshold.
const REACH_PART: f64 = 0.5;

/// The largest number of cuts of a triangle after each other: rounding moves its points at each.
pub(super) const MAX_LEVELS: u32 = 128;

/// The cuts after each other beyond which every other one is a halving: cuts that each decide their
/// share of the area may leave parts as long as they were.
const MAX_CUT_LEVELS: u32 = 12;

/// A triangle within one of A, moved.
#[derive(Debug, Clone, Copy)]
pub(super) struct TrianglePart {
    pub(super) corners: [DVec3; 3],
    /// The nearest facets of B of the corners, where they are known.
    pub(super) feet: [FacetFoot; 3],
    /// The number of cuts above it.
    pub(super) level: u32,
}

/// The result of bounding a part. It lives on the stack of one call.
#[allow(clippy::large_enum_variant, reason = "most parts are split, and none is kept")]
pub(super) enum Step {
    /// The whole part is within this distance, at most the threshold.
    Decided(f64),
    /// This point of the part is farther than the threshold, and no point farther than `upper`.
    Far { point: DVec3, foot: FacetFoot, upper: f64 },
    /// What is left, no point of which is farther than `upper`; the rest is within this distance, at
    /// most the threshold.
    Split { decided: f64, upper: f64, parts: [Option<TrianglePart>; 2] },
}

/// A cut along the reach of one facet of B: the points within the threshold of it, which are
/// a convex set.
struct Cut {
    share: f64,
    decided: f64,
    /// The corners, beginning with the one that is on its own side.
    turned: [usize; 3],
    /// Whether that one is within reach.
    single_is_near: bool,
    /// The cut points on the edges from that corner to the two others.
    ends: [DVec3; 2],
}

impl TrianglePart {
    pub(super) fn new(corners: [DVec3; 3], facet: u32) -> Self {
        Self { corners, feet: [FacetFoot::start(facet); 3], level: 0 }
    }

    /// Returns the largest distance of the corners to one facet, squared, which bounds the distance
    /// of all points of the part to B (lemma F5 of docs/meshes.md).
    fn squares_to(&self, b: &FacetTarget, facet: u32) -> [f64; 3] {
        self.corners.map(|corner| b.distance_squared(facet, corner))
    }

    /// Returns the least bound on the distance of the part by the facets of its corners.
    pub(super) fn upper(&self, b: &FacetTarget) -> f64 {
        let bound = |foot: FacetFoot| largest(self.squares_to(b, foot.facet));
        self.feet.map(bound).into_iter().fold(f64::INFINITY, upper_min).sqrt()
    }

    /// Bounds the part, or splits it where no facet and no cover bounds all of it.
    pub(super) fn step(&mut self, b: &FacetTarget, threshold: f64) -> Step {
        let threshold_squared = threshold * threshold;
        let mut upper = f64::INFINITY;
        let first = self.feet[0].facet;
        let to_first = self.squares_to(b, first);
        if largest(to_first) <= threshold_squared {
            return Step::Decided(largest(to_first).sqrt());
        }
        if let Some(step) = self.covered(b, threshold, &mut upper) {
            return step;
        }
        self.find_feet(b);
        let mut tried = [first; 3];
        let mut cut = self.cut(b, first, to_first, threshold);
        for corner in 0..3 {
            let foot = self.feet[corner];
            if !(foot.distance_squared <= threshold_squared) {
                return Step::Far {
                    point: self.corners[corner],
                    foot,
                    upper: upper_min(upper, self.upper(b)),
                };
            }
            if tried.contains(&foot.facet) {
                continue;
            }
            tried[corner] = foot.facet;
            let squares = self.squares_to(b, foot.facet);
            if largest(squares) <= threshold_squared {
                return Step::Decided(largest(squares).sqrt());
            }
            upper = upper_min(upper, largest(squares).sqrt());
            let other = self.cut(b, foot.facet, squares, threshold);
            if other.as_ref().map_or(0.0, |cut| cut.share) > cut.as_ref().map_or(0.0, |cut| cut.share) {
                cut = other;
            }
        }
        match cut {
            Some(cut) if cut.share >= MIN_DECIDED_SHARE && self.may_be_cut() => self.split(&cut, b, upper),
            _ => Step::Split { decided: 0.0, upper, parts: self.halves(b).map(Some) },
        }
    }

    /// Bounds the part by the facet that is nearest to a point within it, and by the facets around that one;
    /// `upper` becomes what these prove where it is beyond the threshold.
    fn covered(&mut self, b: &FacetTarget, threshold: f64, upper: &mut f64) -> Option<Step> {
        let inner = inner_point(&self.corners);
        let foot = b.nearest(inner, self.feet[0].facet, 0.0);
        for of_corner in self.feet.iter_mut().filter(|foot| foot.distance_squared == f64::INFINITY) {
            of_corner.facet = foot.facet;
        }
        let squares = self.squares_to(b, foot.facet);
        *upper = largest(squares).sqrt();
        if *upper <= threshold {
            return Some(Step::Decided(*upper));
        }
        if !(foot.distance_squared.sqrt() <= threshold) {
            return Some(Step::Far { point: inner, foot, upper: *upper });
        }
        if self.level + MAX_CLIPS > MAX_LEVELS {
            return None;
        }
        let cover = cover(b, &self.corners, foot.facet, threshold)?;
        *upper = upper_min(*upper, cover.upper);
        if *upper <= threshold {
            return Some(Step::Decided(*upper));
        }
        let foot = b.nearest(cover.farthest, cover.facet, 0.0);
        let is_far = !(foot.distance_squared.sqrt() <= threshold);
        is_far.then_some(Step::Far { point: cover.farthest, foot, upper: *upper })
    }

    /// Whether a cut along a reach is tried: deep parts are halved in turn, so that they become short.
    fn may_be_cut(&self) -> bool {
        self.level < MAX_CUT_LEVELS || self.level.is_multiple_of(2)
    }

    /// Finds the nearest facets of the corners that are not known yet.
    pub(super) fn find_feet(&mut self, b: &FacetTarget) {
        for corner in 0..3 {
            if self.feet[corner].distance_squared == f64::INFINITY {
                self.feet[corner] = b.nearest(self.corners[corner], self.feet[corner].facet, 0.0);
            }
        }
    }

    /// Returns the cut along the reach of a facet, if it has corners on both sides.
    fn cut(&self, b: &FacetTarget, facet: u32, squares: [f64; 3], threshold: f64) -> Option<Cut> {
        let near = squares.map(|square| square <= threshold * threshold);
        let single_is_near = match near.iter().filter(|&&near| near).count() {
            1 => true,
            2 => false,
            _ => return None,
        };
        let single = near.iter().position(|&near| near == single_is_near)?;
        let turned = [single, (single + 1) % 3, (single + 2) % 3];
        let mut ends = [DVec3::ZERO; 2];
        let mut fractions = [0.0; 2];
        let mut decided = 0.0_f64;
        for side in 0..2 {
            let other = turned[side + 1];
            let [inner, outer] = if single_is_near { [single, other] } else { [other, single] };
            let edge = [self.corners[inner], self.corners[outer]];
            let (fraction, end, distance) = reach(b, facet, edge, threshold);
            fractions[side] = if single_is_near { fraction } else { 1.0 - fraction };
            ends[side] = end;
            decided = upper_max(upper_max(decided, distance), squares[inner].sqrt());
        }
        let corner_share = fractions[0] * fractions[1];
        let share = if single_is_near { corner_share } else { 1.0 - corner_share };
        Some(Cut { share, decided, turned, single_is_near, ends })
    }

    /// Returns what a cut leaves of the part.
    fn split(&self, cut: &Cut, b: &FacetTarget, upper: f64) -> Step {
        let Cut { turned: [single, left, right], ends: [to_left, to_right], .. } = *cut;
        let level = self.level + 1;
        // The points beyond the reach have their nearest facet where the far corners have theirs.
        let start = if cut.single_is_near { self.feet[left] } else { self.feet[single] };
        let foot = |point: DVec3| b.nearest(point, start.facet, 0.0);
        let feet = [foot(to_left), foot(to_right)];
        let parts = if cut.single_is_near {
            let (corners, ends) = ([self.corners[left], self.corners[right]], [to_left, to_right]);
            let of = [self.feet[left], self.feet[right]];
            let is_left = ends[0].distance_squared(corners[1]) <= ends[1].distance_squared(corners[0]);
            let part = |corners, feet| Some(Self { corners, feet, level });
            if is_left {
                [
                    part([ends[0], corners[0], corners[1]], [feet[0], of[0], of[1]]),
                    part([ends[0], corners[1], ends[1]], [feet[0], of[1], feet[1]]),
                ]
            } else {
                [
                    part([ends[0], corners[0], ends[1]], [feet[0], of[0], feet[1]]),
                    part([corners[0], corners[1], ends[1]], [of[0], of[1], feet[1]]),
                ]
            }
        } else {
            let corners = [self.corners[single], to_left, to_right];
            [Some(Self { corners, feet: [self.feet[single], feet[0], feet[1]], level }), None]
        };
        Step::Split { decided: cut.decided, upper, parts }
    }

    /// Returns the halves at the middle of the longest edge.
    pub(super) fn halves(&self, b: &FacetTarget) -> [Self; 2] {
        let length = |corner: usize| self.corners[corner].distance_squared(self.corners[(corner + 1) % 3]);
        let start =
            (1..3).fold(0, |longest, corner| if length(corner) > length(longest) { corner } else { longest });
        let end = (start + 1) % 3;
        let middle = 0.5 * (self.corners[start] + self.corners[end]);
        let foot = b.nearest(middle, self.feet[start].facet, 0.0);
        let level = self.level + 1;
        [end, start].map(|replaced| {
            let mut part = Self { level, ..*self };
            (part.corners[replaced], part.feet[replaced]) = (middle, foot);
            part
        })
    }
}

fn largest(squares: [f64; 3]) -> f64 {
    squares.into_iter().fold(0.0, upper_max)
}

/// Returns about the last point on the way from a point within the threshold of a facet to one
/// beyond it that is within it: its fraction of the way, itself, and its distance.
///
/// The distance f to a convex set is convex along the way. The chord from a point within to one
/// beyond meets the threshold at a point within; the tangent at a point beyond meets it beyond.
fn reach(b: &FacetTarget, facet: u32, [inner, outer]: [DVec3; 2], threshold: f64) -> (f64, DVec3, f64) {
    let facet = b.facet(facet);
    let way = outer - inner;
    let at = |fraction: f64| {
        let point = inner + way * fraction;
        let nearest = facet.nearest(point);
        let distance = nearest.distance_squared.sqrt();
        let slope = -nearest.offset.dot(way) / distance;
        (point, distance, slope)
    };
    let (point, distance, _) = at(0.0);
    let mut end = (0.0, point, distance);
    let sufficient = distance + REACH_PART * (threshold - distance);
    let (_, distance, slope) = at(1.0);
    let mut beyond = (1.0, distance, slope);
    for _ in 0..MAX_REACH_STEPS {
        if end.2 >= sufficient {
            break;
        }
        let by_tangent = beyond.0 - (beyond.1 - threshold) / beyond.2;
        if by_tangent > end.0 && by_tangent < beyond.0 {
            let (point, distance, slope) = at(by_tangent);
            if distance <= threshold {
                end = (by_tangent, point, distance);
            } else {
                beyond = (by_tangent, distance, slope);
            }
        }
        let by_chord = end.0 + (beyond.0 - end.0) * (threshold - end.2) / (beyond.1 - end.2);
        if !(by_chord > end.0 && by_chord < beyond.0) {
            break;
        }
        let (point, distance, slope) = at(by_chord);
        if distance <= threshold {
            end = (by_chord, point, distance);
        } else {
            beyond = (by_chord, distance, slope);
        }
    }
    end
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::facets::TriangleMesh;

    /// Above a facet, where the distance is almost the threshold, its reach goes on beyond its edge: to
    /// the root of 1.01² − 1 at the threshold, and of 1.005² − 1 at least.
    #[test]
    fn a_reach_that_begins_near_the_threshold_takes_half_of_what_is_left() {
        let corners = [DVec3::new(0.0, -9.0, 0.0), DVec3::new(0.0, 9.0, 0.0), DVec3::NEG_X * 20.0];
        let b = FacetTarget::of_mesh(&TriangleMesh::new(&corners, &[[0, 1, 2]]).unwrap());
        let (fraction, end, distance) = reach(&b, 0, [-1.0, 1.0].map(|x| DVec3::new(x, 0.0, 1.0)), 1.01);
        assert!((1.005..=1.01).contains(&distance), "{distance}");
        assert!(end.x >= 0.1 && end.x <= 0.1418 && (2.0 * fraction - 1.0 - end.x).abs() < 1e-12, "{end}");
    }
}
