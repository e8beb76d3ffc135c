//! A ray, and the coordinates in which it is an axis.

use crate::bvh::{Aabb, Bvh};
use crate::rounding::unit;
use glam::{DVec3, DVec4, Vec4Swizzles};

/// A ray from a point, or a segment between two; z is along it, x and y across.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ray {
    pub(super) start: DVec3,
    axes: [DVec3; 3],
    /// Its length, +∞ for a ray.
    pub(super) length: f64,
    /// An upper bound on the error of a coordinate.
    pub(super) margin: f64,
}

impl Ray {
    /// Makes the ray along a direction of length 1.
    pub(super) fn new(start: DVec3, direction: DVec3, margin: f64) -> Self {
        let (x, y) = direction.any_orthonormal_pair();
        Self { start, axes: [x, y, direction], length: f64::INFINITY, margin }
    }

    /// Makes the segment between two points, which differ.
    pub(super) fn segment(start: DVec3, end: DVec3, margin: f64) -> Self {
        Self { length: start.distance(end), ..Self::new(start, unit(end - start), margin) }
    }

    /// Returns the coordinates of a point.
    fn coordinates(&self, point: DVec3) -> DVec3 {
        let offset = point - self.start;
        DVec3::from_array(self.axes.map(|axis| axis.dot(offset)))
    }

    /// Returns homogeneous controls about a centre in the ray's coordinates.
    pub(super) fn controls(&self, center: DVec3, controls: &[DVec4]) -> Vec<DVec4> {
        let shift = self.coordinates(center);
        let local = |vector: DVec3| DVec3::from_array(self.axes.map(|axis| axis.dot(vector)));
        controls.iter().map(|control| (local(control.xyz()) + control.w * shift).extend(control.w)).collect()
    }

    /// Returns true only if the ray certainly does not meet the hull of the points.
    pub(super) fn avoids(&self, points: impl Iterator<Item = DVec3>) -> bool {
        self.is_beside(&Range::of(points.map(|point| self.coordinates(point))))
    }

    /// Returns the leaves of a tree that the ray may meet.
    pub(super) fn leaves(&self, tree: &Bvh) -> Vec<u32> {
        let mut found = Vec::new();
        let mut stack = vec![0];
        while let Some(index) = stack.pop() {
            let Some(node) = tree.nodes().get(index) else { continue };
            if !self.may_meet(&node.aabb) {
                continue;
            }
            if node.is_leaf() {
                found.push(tree.primitive(node));
            } else {
                stack.extend_from_slice(&[index + 1, node.right_child as usize]);
            }
        }
        found
    }

    fn may_meet(&self, aabb: &Aabb) -> bool {
        let center = self.coordinates(aabb.center());
        let half = 0.5 * aabb.extent();
        let [x, y, z] = self.axes.map(|axis| axis.abs().dot(half) + self.margin);
        center.x.abs() <= x && center.y.abs() <= y && center.z >= -z && center.z <= self.length + z
    }

    /// Returns true only if the hull of points of these coordinates lies beside the ray, behind its
    /// start or beyond its end.
    pub(super) fn is_beside(&self, range: &Range) -> bool {
        range.is_aside(self.margin) || range.high.z < -self.margin || range.low.z > self.length + self.margin
    }

    /// Returns where the hull of some points lies, if planes of this normal, of length 1 or 0, through the
    /// ray's ends separate it from these: true for between both planes, where all crossings with the
    /// ray's line are ones with the ray, and false where the ray certainly does not meet it.
    pub(super) fn beyond_plane(&self, normal: DVec3, points: impl Iterator<Item = DVec3>) -> Option<bool> {
        let none = [f64::INFINITY, f64::NEG_INFINITY];
        let [low, high] = points.fold(none, |[low, high], point| {
            let height = normal.dot(point);
            // Points that overflowed may be anywhere.
            if height.is_finite() {
                [low.min(height), high.max(height)]
            } else {
                [f64::NEG_INFINITY, f64::INFINITY]
            }
        });
        // A height has at most √3 times the error of a coordinate, and its own rounding.
        let margin = 2.0 * self.margin;
        let [low, high, slope] = if high < 0.0 { [-high, -low, -normal.z] } else { [low, high, normal.z] };
        let is_away = slope <= 0.0 || low > slope * self.length + margin;
        if !(low > margin) {
            None
        } else if is_away {
            Some(false)
        } else {
            (high < slope * self.length - margin).then_some(true)
        }
    }

    /// Returns true only if the hull lies between the planes across the start and the end.
    pub(super) fn is_ahead(&self, range: &Range) -> bool {
        range.low.z > self.margin && range.high.z < self.length - self.margin
    }
}

/// The least and the largest of some points' coordinates, and of x + y and x - y.
#[derive(Debug, Clone, Copy)]
pub(super) struct Range {
    pub(super) low: DVec3,
    pub(super) high: DVec3,
    diagonals: [[f64; 2]; 2],
}

impl Range {
    pub(super) fn of(points: impl Iterator<Item = DVec3>) -> Self {
        let none = [f64::INFINITY, f64::NEG_INFINITY];
        let empty = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY, diagonals: [none; 2] };
        let all = [f64::NEG_INFINITY, f64::INFINITY];
        let whole = Self { low: DVec3::NEG_INFINITY, high: DVec3::INFINITY, diagonals: [all; 2] };
        points.fold(empty, |range, point| {
            // Points that overflowed may be anywhere.
            if !point.is_finite() {
                return whole;
            }
            let sums = [point.x + point.y, point.x - point.y];
            let diagonals =
                [0, 1].map(|k| [range.diagonals[k][0].min(sums[k]), range.diagonals[k][1].max(sums[k])]);
            Self { low: range.low.min(point), high: range.high.max(point), diagonals }
        })
    }

    /// Returns true only if the hull of the points lies beside the axis.
    fn is_aside(&self, margin: f64) -> bool {
        // A sum of two coordinates has at most twice the error of one.
        let sums = self.diagonals.iter().any(|&[low, high]| low > 2.0 * margin || high < -2.0 * margin);
        let [low, high] = [self.low, self.high];
        sums || low.x > margin || high.x < -margin || low.y > margin || high.y < -margin
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    const MARGIN: f64 = 1e-3;

    fn along_z() -> Ray {
        Ray::new(DVec3::ZERO, DVec3::Z, MARGIN)
    }

    fn segment() -> Ray {
        Ray::segment(DVec3::ZERO, 5.0 * DVec3::Z, MARGIN)
    }

    fn range(points: &[DVec3]) -> Range {
        Range::of(points.iter().copied())
    }

    /// Long hulls beside the axis, whose least distance from it is along x, along y or between both,
    /// where a sum of two coordinates has twice the error of one (lemma S3).
    #[test]
    fn a_hull_lies_beside_a_ray_only_beyond_the_margin() {
        for sign in [1.0, -1.0] {
            for (toward, limit) in [
                (DVec3::X, MARGIN),
                (DVec3::Y, MARGIN),
                (DVec3::new(0.5, 0.5, 0.0), 2.0 * MARGIN),
                (DVec3::new(0.5, -0.5, 0.0), 2.0 * MARGIN),
            ] {
                let across = DVec3::Z.cross(toward);
                let is_beside = |distance: f64| {
                    let nearest = sign * distance * toward + DVec3::Z;
                    segment().is_beside(&range(&[nearest - 9.0 * across, nearest + 9.0 * across]))
                };
                assert!(!is_beside(0.99 * limit), "{toward} {sign}");
                assert!(is_beside(1.01 * limit), "{toward} {sign}");
            }
        }
    }

    #[test]
    fn a_hull_lies_ahead_behind_or_beyond_only_past_the_margin() {
        let about = |low: f64, high: f64| range(&[DVec3::new(-1.0, -1.0, low), DVec3::new(1.0, 1.0, high)]);
        for (low, high, is_ahead) in [
            (1.01 * MARGIN, 5.0 - 1.01 * MARGIN, true),
            (0.99 * MARGIN, 4.0, false),
            (1.0, 5.0 - 0.99 * MARGIN, false),
        ] {
            assert_eq!(segment().is_ahead(&about(low, high)), is_ahead, "{low} to {high}");
        }
        assert!(along_z().is_ahead(&about(1.01 * MARGIN, 1e9)));
        for (low, high, is_beside) in [
            (-1.0, -1.01 * MARGIN, true),
            (-1.0, -0.99 * MARGIN, false),
            (5.0 + 1.01 * MARGIN, 9.0, true),
            (5.0 + 0.99 * MARGIN, 9.0, false),
        ] {
            assert_eq!(segment().is_beside(&about(low, high)), is_beside, "{low} to {high}");
        }
    }

    /// Boxes within the margin of a segment are looked at, whichever side they lie on.
    #[test]
    fn boxes_within_the_margin_are_met() {
        for (toward, start) in [
            (DVec3::X, DVec3::Z),
            (DVec3::NEG_X, DVec3::Z),
            (DVec3::Y, DVec3::Z),
            (DVec3::NEG_Y, DVec3::Z),
            (DVec3::NEG_Z, DVec3::ZERO),
            (DVec3::Z, 5.0 * DVec3::Z),
        ] {
            let count = |distance: f64| {
                let center = start + (distance + 0.5) * toward;
                let aabb = Aabb { min: center - 0.5, max: center + 0.5 };
                segment().leaves(&Bvh::new(&[aabb])).len()
            };
            assert_eq!([0.99 * MARGIN, 1.01 * MARGIN].map(count), [1, 0], "{toward}");
        }
    }

    /// A point that overflowed may be anywhere, so that nothing is known of a hull with it.
    #[test]
    fn points_that_overflowed_lie_nowhere() {
        let (aside, ahead) = (DVec3::new(9.0, 9.0, 1.0), DVec3::new(0.0, 0.0, 1.0));
        for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for axis in 0..3 {
                let with_wrong = |mut point: DVec3| {
                    let sound = point;
                    point[axis] = wrong;
                    range(&[sound, point, sound])
                };
                assert!(!segment().is_beside(&with_wrong(aside)), "{wrong} of {axis}");
                assert!(!segment().is_ahead(&with_wrong(ahead)), "{wrong} of {axis}");
                let mut point = ahead;
                point[axis] = wrong;
                for ray in [along_z(), segment()] {
                    for normal in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_Z, DVec3::ONE.normalize()] {
                        let sound = ahead + normal;
                        let found = ray.beyond_plane(normal, [sound, point].into_iter());
                        assert!(
                            point.dot(normal).is_finite() || found.is_none(),
                            "{wrong} of {axis} along {normal}: {found:?}"
                        );
                    }
                }
            }
        }
    }
}
