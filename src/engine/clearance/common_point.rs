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
    /// both reach into, behind some hundred patches of both, and behind each other patch whose middle is inside the other
    /// solid. The least depth is half the tolerance, so that a layer as thick as the tolerance between two faces has a
    /// point. There may be a point inside both where none is found. Ends before a point once `is_late`.
    /// O(points √patches).
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
        let behind = |points: &mut dyn Iterator<Item = BoundaryPoint>| {
            self.behind(points.take_while(|_| !is_late()), &steps, &common)
        };
        if let Some(found) = behind(&mut self.about(nearest).into_iter()) {
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
        let near = [0, 1].map(|side| self.near(side, &common));
        let found = behind(&mut self.spread(&near).into_iter())
            .or_else(|| behind(&mut self.middles_within(&near, is_late)));
        match found {
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
        for boundary_point in points {
            let other = self.side_of_other(&boundary_point);
            let BoundaryPoint { point, normal, .. } = boundary_point;
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

    /// Returns the patches of A or of B that reach into a box.
    fn near(&self, side: usize, common: &Aabb) -> Vec<usize> {
        let patches = &self.model(side).bezier().patches;
        let reaches = |index: &usize| {
            let aabb = patches.patch(*index).bounding_box();
            let center = if side == 0 { self.transform.apply(aabb.center()) } else { aabb.center() };
            common.min_distance_squared(center) <= 0.25 * aabb.extent().length_squared()
        };
        (0..patches.len()).filter(reaches).collect()
    }

    fn model(&self, side: usize) -> &PreparedModel {
        if side == 0 { self.a } else { self.b }
    }

    /// Returns points of both boundaries, of patches spread evenly over these.
    fn spread(&self, near: &[Vec<usize>; 2]) -> Vec<BoundaryPoint> {
        let of_side = |(side, near): (usize, &Vec<usize>)| {
            let patches = &self.model(side).bezier().patches;
            let chosen = near.len().min(MAX_PATCHES);
            let places = (BOUNDARY_POINTS / chosen.max(1)).isqrt().clamp(1, MAX_PLACES);
            let mut points = Vec::with_capacity(chosen * places * places);
            for patch in (0..chosen).map(|index| patches.patch(near[index * near.len() / chosen])) {
                let inner = (0..places * places)
                    .map(|place| [place / places, place % places].map(|k| (k as f64 + 0.5) / places as f64));
                for at in inner.chain(beside_corners()) {
                    points.push(self.boundary_point(&patch, at, side == 0));
                }
            }
            points
        };
        near.iter().enumerate().flat_map(of_side).collect()
    }

    /// Returns the middles of patches that are certainly inside the other solid, of each boundary with more patches than
    /// [`Self::spread`] takes.
    fn middles_within<'a>(
        &'a self,
        near: &'a [Vec<usize>; 2],
        is_late: &'a dyn Fn() -> bool,
    ) -> impl Iterator<Item = BoundaryPoint> + 'a {
        let many = near.iter().enumerate().filter(|(_, near)| near.len() > MAX_PATCHES);
        let of_side = move |(side, near): (usize, &'a Vec<usize>)| {
            let patches = &self.model(side).bezier().patches;
            let middle =
                move |&index: &usize| self.boundary_point(&patches.patch(index), [0.5; 2], side == 0);
            near.iter().take_while(|_| !is_late()).map(middle)
        };
        many.flat_map(of_side).filter(|middle| self.side_of_other(middle) == Side::Inside)
    }

    /// Returns the side of the other solid on which a point of one boundary lies.
    fn side_of_other(&self, &BoundaryPoint { point, is_of_a, .. }: &BoundaryPoint) -> Side {
        if is_of_a { self.b.side_within(point, 0.0) } else { self.side_of_a(point) }
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
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::model::{Model, RigidTransform, SurfaceArrays};

    /// The coordinates of knots. Even steps would make the knots removable.
    fn uneven(index: usize) -> f64 {
        index as f64 + if index % 2 == 1 { 0.25 } else { 0.0 }
    }

    /// A cube of side `SIDE` above a height. Its bottom consists of 900 patches, and one of their common corners lies lower.
    fn spiked(height: f64) -> PreparedModel {
        const SIDE: usize = 30;
        let side = SIDE as f64;
        let flat = |points: [[f64; 3]; 4]| SurfaceArrays {
            degree: [1, 1],
            knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
            counts: [2, 2],
            control_points: points.map(|[x, y, z]| [x, y, z + height, 1.0]).to_vec(),
        };
        let on_line = |[x, y]: [f64; 2], [to_x, to_y]: [f64; 2]| {
            flat([[x, y, 0.0], [x, y, side], [to_x, to_y, 0.0], [to_x, to_y, side]])
        };
        let corners = [[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]];
        let mut surfaces: Vec<_> = (0..4).map(|k| on_line(corners[(k + 1) % 4], corners[k])).collect();
        surfaces.push(flat([[0.0, 0.0, side], [0.0, side, side], [side, 0.0, side], [side, side, side]]));
        let knots: Vec<f64> = (0..SIDE + 3).map(|k| (k.clamp(1, SIDE + 1) - 1) as f64).collect();
        let points = (0..=SIDE).flat_map(|y| (0..=SIDE).map(move |x| [x, y]));
        let control_points = points.map(|[x, y]| {
            let depth = if [x, y] == [11, 7] { -0.5 } else { 0.0 };
            [uneven(x), uneven(y), height + depth, 1.0]
        });
        surfaces.push(SurfaceArrays {
            degree: [1, 1],
            knots: [knots.clone(), knots],
            counts: [SIDE + 1; 2],
            control_points: control_points.collect(),
        });
        PreparedModel::new(&Model::from_arrays(None, surfaces).unwrap()).unwrap()
    }

    /// The bottom lies on another cube. Only the four patches about the lower corner reach into it.
    #[test]
    fn patches_whose_middles_are_inside_are_found_among_many() {
        let (above, below) = (spiked(0.0), spiked(-30.0));
        let solids = Solids::new([&above, &below], RigidTransform::IDENTITY).unwrap();
        let common = solids.common_box().unwrap();
        let near = [0, 1].map(|side| solids.near(side, &common));
        assert!(near[0].len() > MAX_PATCHES, "{near:?}");
        let mut found: Vec<_> =
            solids.middles_within(&near, &|| false).map(|middle| middle.point.to_array()).collect();
        found.sort_by(|a, b| a.partial_cmp(b).unwrap());
        // The corner is at (11.25, 7.25).
        let at = |x: f64, y: f64| [x, y, -0.125];
        assert_eq!(found, [at(10.625, 6.625), at(10.625, 7.625), at(11.625, 6.625), at(11.625, 7.625)]);
        assert!(solids.middles_within(&near, &|| true).next().is_none(), "it ends in time");
    }

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
