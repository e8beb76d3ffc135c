//! Cells of Bézier patches of A, and the two triangles that stand for a flat one.

use super::super::rounding::sag_rounding;
use super::super::{Facet, FacetFoot, FacetTarget};
use super::part::{Step, TrianglePart};
use crate::axis::Axis;
use crate::bezier::PatchSet;
use crate::model::RigidTransform;
use crate::param_box::ParamBox;
use crate::rounding::{lower_min, unit, upper_max};
use glam::{DVec3, Vec4Swizzles};

/// The part of the tolerance that the distance between a cell and its triangles may take even where
/// the cell is as far from B as the farthest point known.
const SAG_PART: f64 = 0.125;

/// The part that it may take of the difference between the threshold and the distance of a cell's
/// corners.
const SLACK_PART: f64 = 0.5;

/// The largest number of parts of the triangles of a cell before the cell is halved: few enough
/// that it is not lost time where a curved cell cannot be decided.
const MAX_PARTS: usize = 64;

/// Half of the length of a side that float64 does not usefully halve further.
pub(super) const MIN_LENGTH: f64 = 1.0 / (1_u64 << 40) as f64;

/// How many times as long as its halved side a cell may be.
const MAX_RATIO: f64 = 64.0;

/// The least sine of the angle between the diagonals of a quadrangle whose normal is used: rounding
/// turns the normal by less than a millionth then.
const MIN_SINE: f64 = 1e-9;

/// A rectangle of a patch of A.
#[derive(Debug, Clone, Copy)]
pub(super) struct PatchCell {
    pub(super) patch: u32,
    pub(super) range: ParamBox,
    /// Facets of B near the corners.
    pub(super) starts: [u32; 4],
}

/// A cell with its control points, moved.
pub(super) struct Net {
    points: Vec<DVec3>,
    degree: [usize; 2],
}

/// The result of bounding a cell.
pub(super) enum CellStep {
    /// All of the cell is within this distance, at most the threshold.
    Decided(f64),
    /// The axis along which the cell is to be halved.
    Halve(Axis),
}

/// A corner of a cell with its foot.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corner {
    pub(super) point: DVec3,
    pub(super) parameters: [f64; 2],
    pub(super) foot: FacetFoot,
}

impl PatchCell {
    pub(super) fn whole(patch: u32) -> Self {
        Self { patch, range: ParamBox::UNIT, starts: [0; 4] }
    }

    /// Returns the control points of the cell, moved.
    pub(super) fn net(&self, patches: &PatchSet, transform: &RigidTransform) -> Net {
        let patch = patches.patch(self.patch as usize);
        let [s, t] = self.range.intervals();
        let controls = patch.restricted(s, t);
        let point = |control: &glam::DVec4| transform.apply(patch.center + control.xyz() / control.w);
        Net { points: controls.iter().map(point).collect(), degree: patch.degree }
    }

    /// Returns the corners in order around the cell, with their nearest facets.
    pub(super) fn corners(&self, net: &Net, b: &FacetTarget) -> [Corner; 4] {
        let ([s0, t0], [s1, t1]) = (self.range.low(), self.range.high());
        let parameters = [[s0, t0], [s1, t0], [s1, t1], [s0, t1]];
        let points = net.corners();
        [0, 1, 2, 3].map(|index| {
            let foot = b.nearest(points[index], self.starts[index], 0.0);
            Corner { point: points[index], parameters: parameters[index], foot }
        })
    }

    /// Bounds the cell by its control points and, where it is flat enough, by its two triangles.
    pub(super) fn step(
        net: &Net,
        corners: &[Corner; 4],
        b: &FacetTarget,
        threshold: f64,
        tolerance: f64,
        length: f64,
    ) -> CellStep {
        let mut tried: [Option<u32>; 4] = [None; 4];
        let mut farthest = 0.0_f64;
        for index in 0..4 {
            let foot = corners[index].foot;
            farthest = upper_max(farthest, foot.distance_squared);
            if tried.contains(&Some(foot.facet)) {
                continue;
            }
            tried[index] = Some(foot.facet);
            if let Some(squared) = net.within(b, foot.facet, threshold * threshold) {
                return CellStep::Decided(squared.sqrt());
            }
        }
        let slack = threshold - farthest.sqrt();
        let sag = net.sag() + sag_rounding(length);
        let is_flat = sag <= SAG_PART * tolerance || sag <= SLACK_PART * slack;
        if slack > 0.0
            && is_flat
            && let Some(decided) = cover(corners, b, threshold - sag)
        {
            return CellStep::Decided(decided + sag);
        }
        CellStep::Halve(net.halved_axis(is_flat))
    }
}

/// Returns a bound on the distance of the two triangles between the corners that is at most the
/// threshold, if a few parts show that there is one.
fn cover(corners: &[Corner; 4], b: &FacetTarget, threshold: f64) -> Option<f64> {
    let part = |indices: [usize; 3]| TrianglePart {
        corners: indices.map(|index| corners[index].point),
        feet: indices.map(|index| corners[index].foot),
        level: 0,
    };
    let mut stack = vec![part([0, 1, 2]), part([0, 2, 3])];
    let (mut decided, mut count) = (0.0_f64, 0);
    while let Some(mut part) = stack.pop() {
        count += 1;
        if count > MAX_PARTS {
            return None;
        }
        match part.step(b, threshold) {
            Step::Decided(bound) => decided = upper_max(decided, bound),
            Step::Far { .. } => return None,
            Step::Split { decided: bound, parts, .. } => {
                decided = upper_max(decided, bound);
                stack.extend(parts.into_iter().flatten());
            }
        }
    }
    Some(decided)
}

impl Net {
    pub(super) fn points(&self) -> &[DVec3] {
        &self.points
    }

    fn point(&self, i: usize, j: usize) -> DVec3 {
        self.points[i * (self.degree[1] + 1) + j]
    }

    pub(super) fn corners(&self) -> [DVec3; 4] {
        let [p, q] = self.degree;
        [self.point(0, 0), self.point(p, 0), self.point(p, q), self.point(0, q)]
    }

    /// Returns the largest squared distance of the control points to a facet if it is within the
    /// threshold: it bounds that of the cell (lemma F5 of docs/meshes.md).
    fn within(&self, b: &FacetTarget, facet: u32, threshold_squared: f64) -> Option<f64> {
        let mut largest = 0.0_f64;
        for &point in &self.points {
            let squared = b.distance_squared(facet, point);
            if !(squared <= threshold_squared) {
                return None;
            }
            largest = upper_max(largest, squared);
        }
        Some(largest)
    }

    /// Returns the least bound on the distance of the cell by one of these facets.
    pub(super) fn upper_by(&self, b: &FacetTarget, facets: [u32; 4]) -> f64 {
        let mut least = f64::INFINITY;
        for (index, &facet) in facets.iter().enumerate() {
            if !facets[..index].contains(&facet)
                && let Some(squared) = self.within(b, facet, least)
            {
                least = squared;
            }
        }
        least.sqrt()
    }

    /// Returns an upper bound on the distance of any point of the cell from the two triangles
    /// between its corners, which rounding has not been added to (lemma F6 of docs/meshes.md).
    pub(super) fn sag(&self) -> f64 {
        let [a, b, c, d] = self.corners();
        let triangles = [Facet::Triangle([a, b, c]), Facet::Triangle([a, c, d])];
        let mut farthest = 0.0_f64;
        for &point in &self.points {
            let [one, other] = triangles.map(|triangle| triangle.nearest(point).distance_squared);
            let squared = if one < other { one } else { other };
            farthest = upper_max(farthest, squared);
        }
        let beside =
            |triangle: usize, corner: DVec3| triangles[triangle].nearest(corner).distance_squared.sqrt();
        let by_corner = beside(0, d).min(beside(1, b));
        farthest.sqrt()
            + height_of_quadrangle(&[a, b, c, d]).map_or(by_corner, |height| height.min(by_corner))
    }

    /// Returns the axis along which a cell is halved: the longer one of a flat cell, else the one
    /// along which the control points leave their chords more.
    pub(super) fn halved_axis(&self, is_flat: bool) -> Axis {
        let [p, q] = self.degree;
        let (mut bends, mut lengths) = ([0.0_f64; 2], [0.0_f64; 2]);
        for i in 0..=p {
            for j in 0..=q {
                let point = self.point(i, j);
                let [s, t] = [i as f64 / p as f64, j as f64 / q as f64];
                let on_chord =
                    [self.point(0, j).lerp(self.point(p, j), s), self.point(i, 0).lerp(self.point(i, q), t)];
                for axis in 0..2 {
                    bends[axis] = bends[axis].max(point.distance_squared(on_chord[axis]));
                }
            }
        }
        for (i, j) in [(0, 0), (p, q)] {
            lengths[0] = lengths[0].max(self.point(0, j).distance_squared(self.point(p, j)));
            lengths[1] = lengths[1].max(self.point(i, 0).distance_squared(self.point(i, q)));
        }
        let sizes = if is_flat || bends == [0.0; 2] { lengths } else { bends };
        if sizes[0] >= sizes[1] { Axis::U } else { Axis::V }
    }
}

impl Net {
    /// Returns the axis along which the control points change their distance from a triangle's plane more, by at least
    /// `least`; `None` if neither does, or if the cell is much longer along the other one.
    pub(super) fn varied_axis(&self, facet: &Facet, least: f64) -> Option<Axis> {
        let Facet::Triangle([a, b, c]) = *facet else { return None };
        let normal = unit((b - a).cross(c - a));
        let [p, q] = self.degree;
        let height = |i: usize, j: usize| normal.dot(self.point(i, j) - a);
        let range = |heights: &mut dyn Iterator<Item = f64>| {
            let [low, high] = heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], height| {
                [low.min(height), high.max(height)]
            });
            high - low
        };
        let along = [
            (0..=q).map(|j| range(&mut (0..=p).map(|i| height(i, j)))).fold(0.0, f64::max),
            (0..=p).map(|i| range(&mut (0..=q).map(|j| height(i, j)))).fold(0.0, f64::max),
        ];
        let [a, b, c, d] = self.corners();
        let lengths = [(b - a).length() + (c - d).length(), (d - a).length() + (c - b).length()];
        let axis = if along[0] >= along[1] { Axis::U } else { Axis::V };
        let is_long = MAX_RATIO * lengths[axis as usize] >= lengths[1 - axis as usize];
        (along[axis as usize] >= least && is_long).then_some(axis)
    }
}

/// Returns the extent of four points along the common normal of the quadrangle's diagonals if the
/// quadrangle is convex seen along it: the hull of the points is within it of two triangles.
fn height_of_quadrangle([a, b, c, d]: &[DVec3; 4]) -> Option<f64> {
    let [first, second] = [c - a, d - b];
    let across = first.cross(second);
    let is_open = across.length() >= MIN_SINE * first.length() * second.length();
    let normal = unit(across);
    let side = |diagonal: DVec3, from: DVec3, point: DVec3| diagonal.cross(point - from).dot(normal);
    let crosses = |one: f64, other: f64| one.min(other) <= 0.0 && one.max(other) >= 0.0;
    let is_convex = is_open
        && normal != DVec3::ZERO
        && crosses(side(first, *a, *b), side(first, *a, *d))
        && crosses(side(second, *b, *a), side(second, *b, *c));
    let heights = [b - a, c - a, d - a].map(|corner| corner.dot(normal));
    let high = heights.into_iter().fold(0.0, upper_max);
    let low = heights.into_iter().fold(0.0, lower_min);
    is_convex.then_some(high - low)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
impl Net {
    pub(super) fn new(points: Vec<DVec3>, degree: [usize; 2]) -> Self {
        Self { points, degree }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    fn net(points: [[f64; 3]; 4]) -> Net {
        Net { points: points.map(DVec3::from_array).to_vec(), degree: [1, 1] }
    }

    /// Lemma F6: the middle of one diagonal is as far above the other as the bound.
    #[test]
    fn the_sag_of_a_saddle_is_attained() {
        let height = 0.3;
        let net = net([[0.0, 0.0, 0.0], [0.0, 1.0, height], [1.0, 0.0, height], [1.0, 1.0, 0.0]]);
        let [a, b, c, d] = net.corners();
        let middle = 0.5 * (b + d);
        let to = |triangle: [DVec3; 3]| Facet::Triangle(triangle).nearest(middle).distance_squared.sqrt();
        let attained = to([a, b, c]).min(to([a, c, d]));
        // The corners that are no ends of the diagonal are about as far from the other triangle.
        assert!(net.sag() >= attained && height_of_quadrangle(&[a, b, c, d]) == Some(height));
        assert!(net.sag() <= height + 1e-15);
    }

    /// No point of a random patch is farther from the triangles than the sag.
    #[test]
    fn no_point_of_a_patch_is_beyond_its_sag() {
        let random = &mut fastrand::Rng::with_seed(6);
        let mut largest: f64 = 0.0;
        for round in 0..3000 {
            let degree = [random.usize(1..4), random.usize(1..4)];
            // Nearly flat, any, and in a plane, where the quadrangle of the corners may be a dart.
            let bend = [DVec3::splat(0.05), DVec3::ONE, DVec3::new(1.0, 1.0, 0.0)][round % 3];
            let mut points = Vec::new();
            for i in 0..=degree[0] {
                for j in 0..=degree[1] {
                    let at = DVec3::new(i as f64 / degree[0] as f64, j as f64 / degree[1] as f64, 0.0);
                    points.push(at + bend * DVec3::from_array([0; 3].map(|_| random.f64() - 0.5)));
                }
            }
            let net = Net { points, degree };
            let [a, b, c, d] = net.corners();
            let triangles = [Facet::Triangle([a, b, c]), Facet::Triangle([a, c, d])];
            for _ in 0..20 {
                // A convex combination, as that of rational patches.
                let weights: Vec<f64> = net.points.iter().map(|_| random.f64().powi(4)).collect();
                let sum: f64 = weights.iter().sum();
                let point: DVec3 =
                    net.points.iter().zip(&weights).map(|(&point, weight)| point * (weight / sum)).sum();
                let distance = triangles
                    .map(|triangle| triangle.nearest(point).distance_squared.sqrt())
                    .into_iter()
                    .fold(f64::INFINITY, f64::min);
                assert!(distance <= net.sag() + sag_rounding(2.0), "round {round}");
                largest = if net.sag() > 1e-9 { largest.max(distance / net.sag()) } else { largest };
            }
        }
        assert!(largest > 0.5, "{largest}");
    }

    /// A long arch over a facet is halved along its arc, where its distance changes; a part of the facet's plane, and an
    /// arch that is very long, are not.
    #[test]
    fn a_cell_is_halved_where_its_distance_changes() {
        let facet = Facet::Triangle([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(DVec3::from_array));
        let arch = |length: f64, height: f64| {
            let across = [[0.0, 0.0], [0.5, height], [1.0, 0.0]];
            let points = across.into_iter().flat_map(|[x, z]| [0.0, length].map(|y| DVec3::new(x, y, z)));
            Net { points: points.collect(), degree: [2, 1] }
        };
        assert_eq!(arch(8.0, 0.1).halved_axis(true), Axis::V);
        assert_eq!(arch(8.0, 0.1).varied_axis(&facet, 0.1), Some(Axis::U));
        for (net, least) in [(arch(8.0, 0.1), 0.11), (arch(8.0, 0.0), 1e-9), (arch(65.0, 0.1), 0.1)] {
            assert_eq!(net.varied_axis(&facet, least), None);
        }
        assert_eq!(arch(8.0, 0.1).varied_axis(&Facet::Point(DVec3::ZERO), 0.0), None);
    }

    /// Lemma F6: the normal of diagonals with a sine below 10⁻⁹ is not used, as its rounding may turn
    /// it by any angle.
    #[test]
    fn the_normal_of_diagonals_that_are_nearly_parallel_is_not_used() {
        let quadrangle = |sine: f64| {
            let half = DVec3::new((1.0 - sine * sine).sqrt(), sine, 0.0) * 0.5;
            let middle = DVec3::X * 0.5;
            height_of_quadrangle(&[DVec3::ZERO, middle - half, DVec3::X, middle + half])
        };
        assert_eq!(quadrangle(1e-8), Some(0.0));
        assert_eq!(quadrangle(1e-10), None);
    }

    /// Where two opposite corners are equal, the triangles are two sides of the third one, whose
    /// middle is half as long away from them as they are: the quadrangle has no normal.
    #[test]
    fn a_cell_with_equal_opposite_corners_is_a_triangle_between_two_sides() {
        let cell = net([[0.0; 3], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0; 3]]);
        let [a, b, c, d] = cell.corners();
        assert!(a == c && b.x == 1.0 && d.y == 1.0);
        assert!(cell.sag() >= 0.5, "{}", cell.sag());
    }
}
