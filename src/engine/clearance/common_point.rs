//! The search for a point inside both of two solids.

use super::overlap::Solids;
use crate::bezier::Patch;
use crate::bvh::Aabb;
use crate::clearance::Nearest;
use crate::engine::PreparedModel;
use crate::rounding::upper_max;
use crate::solid::Side;
use crate::sorting::sort_by_number;
use glam::DVec3;

/// The distances along both parameters of a patch at which its points are tried, from those where
/// the boundaries meet.
const STEPS: [f64; 6] = [0.5, 0.2, 5e-2, 1e-2, 1e-3, 1e-4];

/// The directions of the steps.
const DIRECTIONS: [[f64; 2]; 8] =
    [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0], [0.7, 0.7], [-0.7, 0.7], [0.7, -0.7], [-0.7, -0.7]];

/// The distances from the boundary of one solid, relative to the diagonal of the box that both solids
/// reach into, at which points inside both are tried.
const DEPTHS: [f64; 5] = [0.1, 1e-2, 1e-3, 1e-4, 1e-6];

/// The largest number of patches of each solid behind which points are tried.
const MAX_PATCHES: usize = 256;

/// The number of points of each solid's boundary that are tried where it has few patches, and of places
/// along each parameter of a patch.
const BOUNDARY_POINTS: usize = 512;
const MAX_PLACES: usize = 6;

/// The distances of places from the corners of a patch, along both parameters: a corner of a solid may be all that
/// is inside the other one.
const CORNER_INSETS: [f64; 2] = [1e-2, 1e-3];

/// The number of points of the box that both solids reach into.
const BOX_POINTS: usize = 256;

/// A point of one solid's boundary, the one of A moved.
struct BoundaryPoint {
    point: DVec3,
    normal: Option<DVec3>,
    is_of_a: bool,
}

/// The outcome of the search for a point inside both solids.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum CommonPoint {
    /// A point that is certainly inside both.
    Found(DVec3),
    /// None of the points tried is; those in the box that both reach into are certainly outside one.
    NotFound,
    /// None certainly is, and some of those in the box may be.
    Undecided,
    /// The time was over before all were tried.
    Late,
}

impl Solids<'_> {
    /// Looks for a point inside both solids: about the place where they are nearest, in the box that
    /// both reach into, and behind some hundred patches of both, down to half the tolerance behind them: a layer
    /// between two faces as thick as the tolerance has points there. There may be such points where none is
    /// found. Ends before a point once `is_late`. O(points √patches).
    pub(super) fn common_point(
        &self,
        nearest: &Nearest,
        tolerance: f64,
        is_late: &dyn Fn() -> bool,
    ) -> CommonPoint {
        let Some(common) = self.common_box() else { return CommonPoint::NotFound };
        let depths = DEPTHS.map(|depth| depth * common.diagonal());
        let mut steps: Vec<f64> = depths.into_iter().chain([0.5 * tolerance]).collect();
        sort_by_number(&mut steps, |step| -step);
        let behind = |points: Vec<BoundaryPoint>| {
            self.behind(points.into_iter().take_while(|_| !is_late()), &steps, &common)
        };
        if let Some(found) = behind(self.about(nearest)) {
            return CommonPoint::Found(found);
        }
        let mut is_decided = true;
        for point in points_of(&common).take_while(|_| !is_late()) {
            match self.common_side(point) {
                Side::Inside => return CommonPoint::Found(point),
                Side::Outside => {}
                Side::Undecided => is_decided = false,
            }
        }
        match behind(self.spread(&common)) {
            Some(found) => CommonPoint::Found(found),
            None if is_late() => CommonPoint::Late,
            None if is_decided => CommonPoint::NotFound,
            None => CommonPoint::Undecided,
        }
    }

    /// Returns the box that has all points inside both; `None` if it has no inside.
    fn common_box(&self) -> Option<Aabb> {
        let corners = self.a.control_box().corners().map(|corner| self.transform.apply(corner));
        let of_a = corners.into_iter().fold(Aabb::EMPTY, Aabb::with);
        let of_b = self.b.control_box();
        let common = Aabb { min: of_a.min.max(of_b.min), max: of_a.max.min(of_b.max) };
        common.min.cmplt(common.max).all().then_some(common)
    }

    /// Returns a point inside both solids, and so in the box of both, behind one of these points, or before it: normals
    /// may point either way.
    fn behind(
        &self,
        points: impl Iterator<Item = BoundaryPoint>,
        steps: &[f64],
        common: &Aabb,
    ) -> Option<DVec3> {
        for BoundaryPoint { point, normal, is_of_a } in points {
            let other = if is_of_a { self.b.side_within(point, 0.0) } else { self.side_of_a(point) };
            let Some(normal) = normal.filter(|_| other != Side::Outside) else { continue };
            for side in [1.0, -1.0] {
                let inner = steps.iter().map(|&step| point + side * step * normal);
                let inner: Vec<DVec3> =
                    inner.filter(|&point| common.min_distance_squared(point) == 0.0).collect();
                if self.are_outside(&inner) {
                    continue;
                }
                let found = inner.into_iter().find(|&point| self.common_side(point) == Side::Inside);
                if found.is_some() {
                    return found;
                }
            }
        }
        None
    }

    /// Returns true only if all of these points, which stand in order on a segment, are certainly outside one of both
    /// solids: the first point is, and the segment is clear of that solid's boundary.
    fn are_outside(&self, points: &[DVec3]) -> bool {
        let &[first, .., last] = points else { return points.is_empty() };
        let of_b =
            || self.b.side_within(first, 0.0) == Side::Outside && self.b.is_clear_between([first, last], 0.0);
        of_b() || {
            let error = self.transform.rounding(upper_max(first.length(), last.length()));
            let own = [first, last].map(|point| self.transform.apply_inverse(point));
            self.side_of_a(first) == Side::Outside && self.a.is_clear_between(own, error)
        }
    }

    /// Returns points of both boundaries about the two nearest ones.
    fn about(&self, nearest: &Nearest) -> Vec<BoundaryPoint> {
        let steps =
            || STEPS.iter().flat_map(|&step| DIRECTIONS.map(|direction| direction.map(|part| step * part)));
        let of_side = |(side, model): (usize, &PreparedModel)| {
            let target = model.certified_target();
            let patch = target.target.patches.patch(nearest.patches[side] as usize);
            let at = nearest.parameters[side];
            let places = steps().map(|step| [0, 1].map(|axis| (at[axis] + step[axis]).clamp(0.0, 1.0)));
            places.map(|place| self.boundary_point(&patch, place, side == 0)).collect::<Vec<_>>()
        };
        [self.a, self.b].into_iter().enumerate().flat_map(of_side).collect()
    }

    /// Returns points of both boundaries, of patches spread evenly over those that reach into a box.
    fn spread(&self, common: &Aabb) -> Vec<BoundaryPoint> {
        let of_side = |(side, model): (usize, &PreparedModel)| {
            let is_of_a = side == 0;
            let patches = &model.bezier().patches;
            let reaches = |index: &usize| {
                let aabb = patches.patch(*index).bounding_box();
                let center = if is_of_a { self.transform.apply(aabb.center()) } else { aabb.center() };
                common.min_distance_squared(center) <= 0.25 * aabb.extent().length_squared()
            };
            let near: Vec<usize> = (0..patches.len()).filter(reaches).collect();
            let chosen = near.len().min(MAX_PATCHES);
            let places = (BOUNDARY_POINTS / chosen.max(1)).isqrt().clamp(1, MAX_PLACES);
            let mut points = Vec::with_capacity(chosen * places * places);
            for patch in (0..chosen).map(|index| patches.patch(near[index * near.len() / chosen])) {
                let inner = (0..places * places)
                    .map(|place| [place / places, place % places].map(|k| (k as f64 + 0.5) / places as f64));
                for at in inner.chain(beside_corners()) {
                    points.push(self.boundary_point(&patch, at, is_of_a));
                }
            }
            points
        };
        [self.a, self.b].into_iter().enumerate().flat_map(of_side).collect()
    }

    fn boundary_point(&self, patch: &Patch<'_>, at: [f64; 2], is_of_a: bool) -> BoundaryPoint {
        let jet = patch.jet(at);
        let (point, normal) = (jet.point, jet.normal());
        if is_of_a {
            let normal = normal.map(|normal| self.transform.rotate(normal));
            return BoundaryPoint { point: self.transform.apply(point), normal, is_of_a };
        }
        BoundaryPoint { point, normal, is_of_a }
    }
}

/// Returns the places beside a patch's corners.
fn beside_corners() -> impl Iterator<Item = [f64; 2]> {
    CORNER_INSETS.into_iter().flat_map(|inset| {
        let [low, high] = [inset, 1.0 - inset];
        [[low, low], [low, high], [high, low], [high, high]]
    })
}

/// Returns points that fill a box evenly.
fn points_of(aabb: &Aabb) -> impl Iterator<Item = DVec3> + '_ {
    // The multiples of these irrational numbers fill the unit cube evenly: the powers of the root of
    // x⁴ = x + 1.
    const STEPS: DVec3 =
        DVec3::new(0.819_172_513_396_164_4, 0.671_043_606_703_789_2, 0.549_700_477_901_970_3);
    (1..=BOX_POINTS).map(|index| aabb.min + (0.5 + index as f64 * STEPS).fract() * aabb.extent())
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// Every eighth of a box has some of its points, and no point is outside.
    #[test]
    fn points_fill_a_box() {
        let aabb = Aabb { min: DVec3::new(-1.0, 2.0, 5.0), max: DVec3::new(1.0, 2.5, 9.0) };
        let mut counts = [0; 8];
        for point in points_of(&aabb) {
            assert!(aabb.min_distance_squared(point) == 0.0, "{point}");
            let high = point.cmpgt(aabb.center());
            counts[high.bitmask() as usize] += 1;
        }
        assert!(counts.iter().all(|&count| count >= BOX_POINTS / 16), "{counts:?}");
    }
}
