//! Bounds on the distances of all points of a part of A, and on their means, for statistics.

use super::super::{FacetFoot, FacetTarget};
use super::Goal;
use super::cover::cover_with_means;
use super::part::{MAX_LEVELS, TrianglePart};
use super::patch_cell::{MIN_LENGTH, PatchCell};
use super::sampled;
use super::slab::Slab;
use super::source::{Measured, Source, Start};
use crate::area::{Area, area_of_part};
use crate::bezier::PatchSet;
use crate::facets::Facet;
use crate::model::RigidTransform;
use crate::param_box::ParamBox;
use crate::rounding::{UNIT_ROUNDOFF, gamma, lower_min, upper_max, upper_min};
use glam::DVec3;

/// The number of facets near a part beyond which it is bounded by its middle alone: it is halved
/// before it is narrow.
const MAX_NEAR: usize = 128;

/// The roundings of linear bounds at corners, and of means of three, relative to the largest length
/// (lemma F8 of docs/meshes.md).
const SPREAD_ROUNDINGS: f64 = 64.0;

/// The part of a cell's width that its distance from the plane of the nearest facet has to change by for the cell to be
/// halved along the axis where it changes more; else the longer one is halved.
const VARIED_PART: f64 = 0.25;

/// The roundings of the reach beyond which no facet matters.
const REACH_ROUNDINGS: f64 = 4.0;

/// Bounds on the distances of all points of a part from B, and on their mean and the mean of their
/// squares over its area.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spread {
    pub(crate) lower: f64,
    pub(crate) upper: f64,
    pub(crate) mean: [f64; 2],
    pub(crate) square: [f64; 2],
}

/// A set of points of A with bounds.
pub(crate) trait Weighted {
    /// Returns its area, or its number of points.
    fn weight(&self) -> Area;
    /// Returns the bounds of its distances.
    fn spread(&self) -> Spread;
}

/// Bounds on the distance of a point of A: little memory, as clouds are large.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BoundedPoint {
    lower: f64,
    upper: f64,
}

/// A part of a triangle or a patch of A with its area.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WeightedPart {
    region: WeightedRegion,
    weight: Area,
    /// A facet of B that may be near.
    start: u32,
    spread: Spread,
}

#[derive(Debug, Clone, Copy)]
enum WeightedRegion {
    /// The corners, moved, the number of cuts above it, and the place of the whole triangle.
    Triangle([DVec3; 3], u32, u32),
    Cell(PatchCell),
}

/// What a part is a part of.
#[derive(Debug, Clone, Copy)]
pub(crate) enum PartOf {
    /// Of the triangle at a place: the corners of the part, moved.
    Triangle(u32, [DVec3; 3]),
    /// Of a patch, over a range of its parameters.
    Patch(u32, ParamBox),
}

/// The parts of A, bounded before B.
pub(crate) struct Parts<'a> {
    a: Source<'a>,
    b: Measured<'a>,
    transform: RigidTransform,
    goal: Goal,
    /// What is added to both sides of every bound.
    rounding: f64,
    /// Parts within this distance of B are not looked at more closely.
    sufficient: f64,
    /// Whether lemma F8 or F12 was refuted: triangles have the bounds of their middle and their radius then.
    is_struck: bool,
}

impl Spread {
    pub(crate) fn exact([lower, upper]: [f64; 2]) -> Self {
        let lower = if lower > 0.0 { lower } else { 0.0 };
        Self { lower, upper, mean: [lower, upper], square: [lower * lower, upper * upper] }
    }

    /// Returns bounds that hold for all points of both.
    fn union(self, other: Self) -> Self {
        Self::exact([lower_min(self.lower, other.lower), upper_max(self.upper, other.upper)])
    }

    /// Returns bounds that hold where distances are off by this.
    pub(crate) fn widened(self, by: f64) -> Self {
        let [mean, square] = [self.mean, self.square];
        let below = |value: f64| if value > by { value - by } else { 0.0 };
        let low = below(mean[0]);
        Self {
            lower: below(self.lower),
            upper: self.upper + by,
            mean: [low, mean[1] + by],
            // (d + e)² is d² + 2 d e + e², and the mean of d at most the root of that of d².
            square: [low * low, square[1] + 2.0 * square[1].sqrt() * by + by * by],
        }
    }
}

impl Weighted for BoundedPoint {
    fn weight(&self) -> Area {
        Area { lower: 1.0, upper: 1.0 }
    }

    fn spread(&self) -> Spread {
        Spread::exact([self.lower, self.upper])
    }
}

impl Weighted for WeightedPart {
    fn weight(&self) -> Area {
        self.weight
    }

    fn spread(&self) -> Spread {
        self.spread
    }
}

impl<'a> Parts<'a> {
    /// Parts within `sufficient` of B have no better bounds.
    pub(crate) fn new(a: Source<'a>, b: Measured<'a>, transform: RigidTransform, sufficient: f64) -> Self {
        let goal = Goal::new(&a, &b, &transform, 0.0, None);
        let rounding = goal.bounds + goal.points + gamma(SPREAD_ROUNDINGS) * goal.length;
        Self { a, b, transform, goal, rounding, sufficient, is_struck: false }
    }

    /// The number of parts at first.
    pub(crate) fn len(&self) -> usize {
        match self.a {
            Source::Facets { facets, .. } => facets.len(),
            Source::Patches { patches, .. } => patches.len(),
        }
    }

    /// What rounding adds to both sides of every bound on a distance.
    pub(crate) fn rounding(&self) -> f64 {
        self.rounding
    }

    /// Returns the bounds of a point of A, at most `gap` apart where rounding allows, searched from a
    /// place on B that may be near, and the place found; `None` for a B without pieces.
    pub(crate) fn point(&self, place: u32, start: Start, gap: f64) -> Option<(BoundedPoint, Start)> {
        let Source::Facets { facets, .. } = self.a else { return None };
        let Facet::Point(point) = facets.facet(place) else { return None };
        let closest = self.b.certified(self.transform.apply(point), start, gap, self.goal.length)?;
        let Spread { lower, upper, .. } =
            Spread::exact([closest.lower, closest.upper]).widened(self.rounding);
        Some((BoundedPoint { lower, upper }, closest.start))
    }

    /// Returns the bounds of a triangle or a patch, searched from a place on B that may be near, and
    /// the place found; `None` for a B without pieces.
    pub(crate) fn first(&self, place: u32, start: Start) -> Option<(WeightedPart, Start)> {
        let (region, weight) = match self.a {
            Source::Facets { facets, .. } => {
                let Facet::Triangle(corners) = facets.facet(place) else { return None };
                let moved = corners.map(|corner| self.transform.apply(corner));
                (WeightedRegion::Triangle(moved, 0, place), facets.area(place))
            }
            Source::Patches { patches, .. } => {
                let cell = PatchCell::whole(place);
                (WeightedRegion::Cell(cell), self.area(patches, &cell))
            }
        };
        let part = self.bounded(region, weight, start.piece)?;
        Some((part, Start { piece: part.start, ..start }))
    }

    /// Returns bounds on a point of A, or on a triangle or a patch, that hold without looking at B: by the boxes of both.
    pub(crate) fn unmeasured_point(&self) -> BoundedPoint {
        BoundedPoint { lower: 0.0, upper: self.farthest() }
    }

    /// The same of a triangle or a patch.
    pub(crate) fn unmeasured(&self, place: u32) -> WeightedPart {
        let (region, weight) = match self.a {
            Source::Facets { facets, .. } => {
                let corner = |weights| self.transform.apply(facets.facet(place).point(weights));
                let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(corner);
                (WeightedRegion::Triangle(corners, 0, place), facets.area(place))
            }
            Source::Patches { patches, .. } => {
                let cell = PatchCell::whole(place);
                (WeightedRegion::Cell(cell), self.area(patches, &cell))
            }
        };
        WeightedPart { region, weight, start: 0, spread: Spread::exact([0.0, self.farthest()]) }
    }

    /// An upper bound on the distance of every point of A from B.
    fn farthest(&self) -> f64 {
        let (a, b) = (self.a.bounding_box(), self.b.bounding_box());
        let far = b.max_distance_squared(self.transform.apply(a.center())).sqrt() + 0.5 * a.diagonal();
        far * (1.0 + gamma(SPREAD_ROUNDINGS)) + 2.0 * self.rounding
    }

    /// Returns the halves of a part; `None` for a part that float64 does not halve.
    pub(crate) fn halves(&self, part: &WeightedPart) -> Option<[WeightedPart; 2]> {
        self.halves_along(part, true)
    }

    /// The same, of a cell of a patch along its longer side.
    pub(crate) fn halves_of_longer(&self, part: &WeightedPart) -> Option<[WeightedPart; 2]> {
        self.halves_along(part, false)
    }

    /// Halves a part; a cell where its distance from the nearest facet's plane varies most, if that is asked for.
    fn halves_along(&self, part: &WeightedPart, by_distance: bool) -> Option<[WeightedPart; 2]> {
        let Measured::Facets { facets: b, .. } = self.b else { return None };
        let bounded = |region, weight| self.bounded(region, weight, part.start);
        let [one, other] = match (part.region, self.a) {
            (WeightedRegion::Triangle(corners, level, place), _) if level < MAX_LEVELS => {
                let half = Area { lower: 0.5 * part.weight.lower, upper: 0.5 * part.weight.upper };
                let halves = TrianglePart::new(corners, part.start).halves(b);
                halves.map(|of| bounded(WeightedRegion::Triangle(of.corners, level + 1, place), half))
            }
            (WeightedRegion::Cell(cell), Source::Patches { patches, .. }) => {
                let net = cell.net(patches, &self.transform);
                let Spread { lower, upper, .. } = part.spread;
                let varied = || net.varied_axis(&b.facet(part.start), VARIED_PART * (upper - lower));
                let varied = by_distance.then(varied).flatten();
                let axis = varied.unwrap_or_else(|| net.halved_axis(true));
                if cell.range.lengths()[axis as usize] < MIN_LENGTH {
                    return None;
                }
                cell.range.halves(axis).map(|range| {
                    let half = PatchCell { range, ..cell };
                    bounded(WeightedRegion::Cell(half), self.area(patches, &half))
                })
            }
            _ => return None,
        };
        Some([one?, other?])
    }

    /// Returns what a part is a part of.
    pub(crate) fn part_of(&self, part: &WeightedPart) -> PartOf {
        match part.region {
            WeightedRegion::Triangle(corners, _, place) => PartOf::Triangle(place, corners),
            WeightedRegion::Cell(cell) => PartOf::Patch(cell.patch, cell.range),
        }
    }

    /// Returns model A and its motion.
    pub(crate) fn source(&self) -> (Source<'a>, &RigidTransform) {
        (self.a, &self.transform)
    }

    /// Bounds parts from now on by the triangle inequality alone.
    pub(crate) fn strike(&mut self) {
        self.is_struck = true;
    }

    /// Looks at the corners of a part and `further` points of it: the distance of each, by the closest point, is in
    /// the range stated for all; and where `mean` is set, at the mean by a rule, whose error is estimated. Returns
    /// in words what refutes the bounds.
    pub(crate) fn refutation(&self, part: &WeightedPart, further: usize, mean: bool) -> Option<String> {
        let Spread { lower, upper, mean: stated, .. } = part.spread;
        let refuted = |what: &str, point: DVec3, stated: [f64; 2], found: [f64; 2]| {
            let is_apart = found[1] < stated[0] || stated[1] < found[0];
            is_apart.then(|| format!("{stated:?} at the {what} {point}, found {found:?}"))
        };
        let of_points = sampled::places(further).find_map(|weights| {
            let point = self.point_of(part, weights);
            refuted("point", point, [lower, upper], self.distance(point, part.start)?)
        });
        let of_mean = || {
            let [fine, coarse] = sampled::RULES.map(|count| self.mean_by_rule(part, count));
            let (fine, coarse) = (fine?, coarse?);
            let error = sampled::rule_error(fine, coarse, upper - lower) + self.rounding;
            refuted("mean about", self.point_of(part, [1.0 / 3.0; 3]), stated, [fine - error, fine + error])
        };
        of_points.or_else(|| if mean { of_mean() } else { None })
    }

    /// The point of a part at barycentric weights: of a cell of a patch that at the place of the same weights in one
    /// half of its rectangle.
    fn point_of(&self, part: &WeightedPart, weights: [f64; 3]) -> DVec3 {
        match (part.region, self.a) {
            (WeightedRegion::Cell(cell), Source::Patches { patches, .. }) => {
                let ([s0, t0], [s1, t1]) = (cell.range.low(), cell.range.high());
                let [_, along_s, along_t] = weights;
                let at = [s0 + along_s * (s1 - s0), t0 + along_t * (t1 - t0)];
                self.transform.apply(patches.patch(cell.patch as usize).point(at))
            }
            (WeightedRegion::Triangle(corners, ..), _) => Facet::Triangle(corners).point(weights),
            (WeightedRegion::Cell(_), _) => DVec3::NAN,
        }
    }

    /// Bounds on the distance of a point of A, moved, with what rounding may add.
    fn distance(&self, point: DVec3, start: u32) -> Option<[f64; 2]> {
        let start = Start { piece: start, ..Start::default() };
        let found = self.b.certified(point, start, 0.0, self.goal.length)?;
        Some([found.lower - self.rounding, found.upper + self.rounding])
    }

    /// The mean over the middles of equal parts of a triangle; `None` for a cell of a patch.
    fn mean_by_rule(&self, part: &WeightedPart, count: usize) -> Option<f64> {
        if matches!(part.region, WeightedRegion::Cell(_)) {
            return None;
        }
        let (mut sum, mut points) = (0.0, 0.0);
        for weights in sampled::middles(count) {
            let [lower, upper] = self.distance(self.point_of(part, weights), part.start)?;
            sum += 0.5 * (lower + upper);
            points += 1.0;
        }
        Some(sum / points)
    }

    fn area(&self, patches: &PatchSet, cell: &PatchCell) -> Area {
        area_of_part(&patches.patch(cell.patch as usize), cell.range)
    }

    fn bounded(&self, region: WeightedRegion, weight: Area, start: u32) -> Option<WeightedPart> {
        let Measured::Facets { facets: b, .. } = self.b else { return None };
        let spread = |corners: [DVec3; 3], start, sufficient| {
            if self.is_struck {
                return spread_by_middle(b, &corners, start);
            }
            TriangleBounds { b, corners: &corners, allowance: self.rounding, sufficient }.spread(start)
        };
        let (spread, start) = match (region, self.a) {
            (WeightedRegion::Triangle(corners, ..), _) => spread(corners, start, self.sufficient),
            (WeightedRegion::Cell(cell), Source::Patches { patches, .. }) => {
                let net = cell.net(patches, &self.transform);
                let of_corners = self.is_struck;
                let length = self.goal.length;
                let Slab { triangles: [first, second], height } =
                    if of_corners { net.corner_triangles(length) } else { net.slab(length) };
                let left = if height < self.sufficient { self.sufficient - height } else { 0.0 };
                let (one, start) = spread(first, start, left);
                let (other, start) = spread(second, start, left);
                (one.union(other).widened(height), start)
            }
            _ => return None,
        };
        Some(WeightedPart { region, weight, start, spread: spread.widened(self.rounding) })
    }
}

/// Returns the bounds by the distance of a triangle's middle and its radius, and the facet nearest to the middle.
fn spread_by_middle(b: &FacetTarget, corners: &[DVec3; 3], start: u32) -> (Spread, u32) {
    let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    let radius = corners.iter().fold(0.0, |radius, corner| upper_max(radius, corner.distance(middle)));
    let (foot, _, lower) = b.certified(middle, start);
    (Spread::exact([lower - radius, foot.distance_squared.sqrt() + radius]), foot.facet)
}

/// A triangle whose distances are bounded, which rounding has not been added to.
struct TriangleBounds<'a> {
    b: &'a FacetTarget,
    corners: &'a [DVec3; 3],
    /// The rounding of distances.
    allowance: f64,
    /// The distance within which all of the triangle is near enough.
    sufficient: f64,
}

/// Upper bounds on the distances of all points of a triangle, on their mean and on that of their squares.
#[derive(Clone, Copy)]
struct Above {
    upper: f64,
    mean: f64,
    square: f64,
}

impl TriangleBounds<'_> {
    /// Returns the bounds, and the facet nearest to the triangle's middle (lemmas F5, F8 and F12 of
    /// docs/meshes.md).
    fn spread(&self, start: u32) -> (Spread, u32) {
        let &Self { b, corners, allowance, sufficient } = self;
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        let radius = corners.iter().fold(0.0, |radius, corner| upper_max(radius, corner.distance(middle)));
        let foot = b.nearest(middle, start, 0.0);
        let Above { upper, mean, square } = self.above(foot, radius);
        if upper <= sufficient {
            return (Spread { lower: 0.0, upper, mean: [0.0, mean], square: [0.0, square] }, foot.facet);
        }
        let least = least_at_corners(b, corners, middle, upper, radius, allowance).unwrap_or_else(|| {
            let (_, _, lower) = b.certified(middle, foot.facet);
            [lower - radius; 3]
        });
        let lower = least.into_iter().fold(f64::INFINITY, lower_min);
        let low_mean = (least[0] + least[1] + least[2]) / 3.0;
        let positive = |value: f64| if value > 0.0 { value } else { 0.0 };
        let low = positive(low_mean);
        let spread = Spread { lower: positive(lower), upper, mean: [low, mean], square: [low * low, square] };
        (spread, foot.facet)
    }

    /// Returns the least upper bounds by the facet nearest to the middle, by a cover and by the facets nearest to
    /// the corners.
    fn above(&self, foot: FacetFoot, radius: f64) -> Above {
        let &Self { b, corners, sufficient, .. } = self;
        let to_middle = foot.distance_squared.sqrt();
        let all = to_middle + radius;
        let mut above = Above { upper: all, mean: all, square: all * all };
        above.take(self.by_facet(foot.facet));
        if above.upper <= sufficient {
            return above;
        }
        if let Some((cover, means)) = cover_with_means(b, corners, foot.facet, sufficient) {
            above.take(Above { upper: cover.upper, mean: means.mean, square: means.square });
            return above;
        }
        let mut tried = [foot.facet; 3];
        for corner in 0..3 {
            let facet = b.nearest(corners[corner], foot.facet, 0.0).facet;
            if !tried[..corner].contains(&facet) && facet != foot.facet {
                above.take(self.by_facet(facet));
            }
            tried[corner] = facet;
        }
        above
    }

    /// Returns the bounds by one facet: the distance is convex, and so is its square.
    fn by_facet(&self, facet: u32) -> Above {
        let squares = self.corners.map(|corner| self.b.distance_squared(facet, corner));
        let distances = squares.map(f64::sqrt);
        Above {
            upper: distances.into_iter().fold(0.0, upper_max),
            mean: (distances[0] + distances[1] + distances[2]) / 3.0,
            square: (squares[0] + squares[1] + squares[2]) / 3.0,
        }
    }
}

impl Above {
    fn take(&mut self, other: Self) {
        self.upper = upper_min(self.upper, other.upper);
        self.mean = upper_min(self.mean, other.mean);
        self.square = upper_min(self.square, other.square);
    }
}

/// Returns the values at the corners of a concave function that no distance of a point of the
/// triangle is below, at most `upper`: the least of linear functions, one for each facet that may be
/// nearest to a point (lemma F8 of docs/meshes.md); `None` if too many may be.
fn least_at_corners(
    b: &FacetTarget,
    corners: &[DVec3; 3],
    middle: DVec3,
    upper: f64,
    radius: f64,
    allowance: f64,
) -> Option<[f64; 3]> {
    let reach = (upper + radius + allowance) * (1.0 + REACH_ROUNDINGS * UNIT_ROUNDOFF);
    let reach_squared = reach * reach;
    let (mut least, mut count) = ([upper; 3], 0);
    b.visit(middle, reach_squared, |place| {
        let facet = b.facet(place);
        let nearest = facet.nearest(middle);
        // Planes that overflowed bound nothing.
        let mut best = [f64::NEG_INFINITY; 3];
        let (mut farthest, mut largest) = (0.0, f64::NEG_INFINITY);
        facet.for_each_plane(middle, &nearest, |normal, distance| {
            if distance > farthest {
                farthest = distance;
            }
            let mut under = least;
            for (under, corner) in under.iter_mut().zip(corners) {
                *under = lower_min(*under, distance - normal.dot(*corner - middle));
            }
            // Any plane of the facet is valid: the one that takes least off.
            let sum = under[0] + under[1] + under[2];
            if sum > largest {
                (largest, best) = (sum, under);
            }
        });
        // A facet that far is nearest to no point of the triangle.
        if farthest <= reach {
            count += 1;
            least = best;
        }
        (reach_squared, count > MAX_NEAR)
    });
    (count <= MAX_NEAR).then_some(least)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::facets::{PointCloud, TriangleMesh};

    /// The sides of a triangle are cut into this many for its means.
    const CUTS: usize = 40;

    /// Every end moves by the error, and the mean square by both of its terms.
    #[test]
    fn bounds_are_widened_by_every_term() {
        let spread = Spread { lower: 2.0, upper: 5.0, mean: [3.0, 4.0], square: [9.5, 16.0] };
        let expected = Spread { lower: 1.0, upper: 6.0, mean: [2.0, 5.0], square: [4.0, 25.0] };
        assert_eq!(spread.widened(1.0), expected);
        let [one, other] = [Spread::exact([1.0, 4.0]), Spread::exact([2.0, 5.0])];
        assert_eq!([one.union(other), other.union(one)], [Spread::exact([1.0, 5.0]); 2]);
    }

    fn mesh(corners: &[DVec3]) -> FacetTarget {
        let triangles: Vec<[u32; 3]> =
            (0..corners.len() as u32 / 3).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        FacetTarget::of_mesh(&TriangleMesh::new(corners, &triangles).unwrap())
    }

    #[test]
    fn halves_have_half_of_the_area_each() {
        let a = mesh(&[DVec3::ZERO, DVec3::X, DVec3::Y]);
        let source = Source::Facets { facets: &a, error: 0.0 };
        let parts =
            Parts::new(source, Measured::Facets { facets: &a, error: 0.0 }, RigidTransform::IDENTITY, 0.0);
        let (whole, _) = parts.first(0, Start::default()).unwrap();
        let half = whole.weight();
        for part in parts.halves(&whole).unwrap() {
            assert_eq!([2.0 * part.weight().lower, 2.0 * part.weight().upper], [half.lower, half.upper]);
        }
    }

    fn spread_of_triangle(b: &FacetTarget, corners: &[DVec3; 3], sufficient: f64) -> Spread {
        TriangleBounds { b, corners, allowance: 0.0, sufficient }.spread(0).0
    }

    /// A sheet of 18 triangles that share their vertices, which are this far from their places at most.
    fn sheet(random: &mut fastrand::Rng, off: f64) -> FacetTarget {
        let grid = |k: u32| f64::from(k) / 3.0 - 0.5 + off * (random.f64() - 0.5);
        let mut grid = grid;
        let vertices: Vec<DVec3> = (0..16).map(|k| DVec3::new(grid(k / 4), grid(k % 4), grid(1))).collect();
        let square = |k: u32| {
            let first = (k / 3) * 4 + k % 3;
            [[first, first + 4, first + 5], [first, first + 5, first + 1]]
        };
        let triangles: Vec<[u32; 3]> = (0..9).flat_map(square).collect();
        FacetTarget::of_mesh(&TriangleMesh::new(&vertices, &triangles).unwrap())
    }

    /// Lemmas F8 and F12 against the distances in the middles of small triangles, to few facets and, where the
    /// bound is by the middle alone, to many.
    #[test]
    fn no_distance_of_a_triangle_is_beyond_its_bounds() {
        let random = &mut fastrand::Rng::with_seed(61);
        let point = |random: &mut fastrand::Rng| DVec3::from_array([0; 3].map(|_| random.f64() - 0.5));
        for round in 0..400 {
            let size = 0.5_f64.powi(random.i32(0..5));
            let corners = [0; 3].map(|_| size * point(random));
            let b = if round % 20 == 0 {
                let near: Vec<DVec3> = (0..2 * MAX_NEAR).map(|_| 0.1 * point(random)).collect();
                FacetTarget::of_cloud(&PointCloud::new(near).unwrap())
            } else if round % 2 == 0 {
                let off = [0.01, 0.2, 0.6][random.usize(0..3)];
                sheet(random, off)
            } else {
                mesh(&(0..3 * random.usize(1..4)).map(|_| point(random)).collect::<Vec<_>>())
            };
            let sufficient = [0.0, 0.05][round / 2 % 2];
            let spread = spread_of_triangle(&b, &corners, sufficient);
            let [mut sum, mut squares] = [0.0; 2];
            for i in 0..CUTS {
                for j in 0..CUTS - i {
                    for third in [1.0, 2.0].into_iter().take(if i + j + 1 < CUTS { 2 } else { 1 }) {
                        let [s, t] = [i, j].map(|k| (k as f64 + third / 3.0) / CUTS as f64);
                        let at = Facet::Triangle(corners).point([1.0 - s - t, s, t]);
                        let to = |facet| b.distance_squared(facet, at);
                        let squared = (0..b.len() as u32).map(to).fold(f64::INFINITY, f64::min);
                        let distance = squared.sqrt();
                        assert!(spread.lower - 1e-12 <= distance && distance <= spread.upper + 1e-12);
                        sum += distance;
                        squares += squared;
                    }
                }
            }
            let count = (CUTS * CUTS) as f64;
            let [mean, square] = [sum / count, squares / count];
            let slack = 2e-3 * size;
            assert!(spread.mean[0] - slack <= mean && mean <= spread.mean[1] + slack, "{mean} {spread:?}");
            assert!(
                spread.square[0] - slack <= square && square <= spread.square[1] + slack,
                "{square} {spread:?}"
            );
        }
    }

    /// Lemma F12, attained: in a valley the distance is linear on either side of its floor, so that its mean is that of
    /// the corners of either half of the triangle; one facet has a larger one.
    #[test]
    fn the_mean_of_a_triangle_in_a_valley_is_attained() {
        let valley =
            [[0.0, -4.0, 0.0], [0.0, 4.0, 0.0], [3.0, 0.0, 4.0], [-3.0, 0.0, 4.0]].map(DVec3::from_array);
        let b = FacetTarget::of_mesh(&TriangleMesh::new(&valley, &[[0, 1, 2], [1, 0, 3]]).unwrap());
        let corners = [[-0.25, 0.1, 1.0], [0.25, 0.1, 1.0], [0.0, -0.3, 1.0]].map(DVec3::from_array);
        // At x it is (3 − 4 |x|) / 5: at the corners of a half 0.6, 0.6 and 0.4.
        let spread = spread_of_triangle(&b, &corners, 0.0);
        let mean = 1.6 / 3.0;
        // The rounding of areas is relative to the square of the largest length, 25, and the area is 0.1.
        let rounding = 1e-10;
        assert!((spread.upper - 0.6).abs() <= 1e-12 && spread.mean[1] >= mean, "{spread:?}");
        assert!(spread.mean[1] <= mean + rounding, "{spread:?}");
        let square = mean * mean + (2.0 * (0.6 - mean).powi(2) + (0.4 - mean).powi(2)) / 12.0;
        assert!(spread.square[1] >= square && spread.square[1] <= (0.36 + 0.36 + 0.16) / 3.0 + rounding);
        let of_one = (0.8 + 0.4 + 0.6) / 3.0;
        assert!(spread.mean[1] < of_one - 0.05 && spread.mean[0] <= mean);
    }

    /// A triangle that is near enough is not looked at more closely.
    #[test]
    fn a_triangle_within_the_sufficient_distance_is_decided_whole() {
        let b = sheet(&mut fastrand::Rng::with_seed(3), 0.0);
        let height = 0.25;
        let corners =
            [[-0.4, -0.45], [0.45, -0.1], [-0.2, 0.4]].map(|[x, y]| DVec3::new(x, y, height - 1.0 / 6.0));
        for (sufficient, lower) in [(0.24, height), (0.26, 0.0)] {
            let spread = spread_of_triangle(&b, &corners, sufficient);
            assert!(spread.upper >= height - 1e-12 && spread.upper <= upper_max(sufficient, height + 1e-12));
            assert!((spread.lower - lower).abs() <= 1e-12, "{spread:?}");
        }
    }

    /// Of more facets than are looked at, the others may be nearer: here one near a corner, beyond
    /// many above the middle.
    #[test]
    fn a_facet_beyond_many_others_may_be_nearest() {
        let corners = [DVec3::ZERO, DVec3::X * 3.0, DVec3::Y * 3.0];
        let middle = DVec3::new(1.0, 1.0, 0.0);
        // As many near the corner, so that the halves of the tree are the two.
        let near = [middle + DVec3::Z, DVec3::Z * 0.25];
        let points: Vec<DVec3> =
            (0..4 * MAX_NEAR).map(|k| near[k % 2] + DVec3::X * 1e-6 * k as f64).collect();
        let b = FacetTarget::of_cloud(&PointCloud::new(points).unwrap());
        let spread = spread_of_triangle(&b, &corners, 0.0);
        assert!(spread.lower <= 0.25, "{spread:?}");
    }
}
