//! Bounds on all distances of a cell's points from B, and on their means over its area.
//!
//! The upper bounds are those of the search and the mean of the Taylor quadratic. The lower bounds are
//! those of *apexes*: d(x, B) >= d(c, B) − |x − c| for every point c, which is of second order in the
//! cell's size where c lies far behind the cell on the line from the foot. `docs/meshes.md`, section 7,
//! has the proofs (lemmas S1 to S4).

#[cfg(all(test, not(target_arch = "wasm32")))]
mod attained;
mod density;
mod shares;

pub(crate) use density::Density;
pub(crate) use shares::LinearBounds;

use self::density::Weight;
use super::bounds::{self, Lengths, Linear, distance_above, distance_from};
use super::cell_context::CellContext;
use super::nearest::{Foot, NearestPoint, Query};
use super::rounding::{UNIT_ROUNDOFF, closest_point_error, point_error};
use super::{Cell, Pair};
use crate::axis::Axis;
use crate::closest::closest_above;
use crate::rounding::{upper_max, upper_min};
use glam::DVec3;

/// The part of the width aimed at that a query for a distance may leave open.
const QUERY_PART: f64 = 0.02;

/// The number of apexes tried for a cell: each is nearer by [`NEARER`].
const MAX_APEXES: usize = 3;

/// The ratio of the distances of two apexes.
const NEARER: f64 = 0.25;

/// The bound that is asked of heights, in distances of the cell's centre: these bound a cell over many patches of
/// B, and a chord's points are at most twice as far from its arc as those halfway.
const HEIGHTS_RATIO: f64 = 2.0;

/// The roundings of a finished mean, relative to it.
const MEAN_ROUNDINGS: f64 = 64.0;

/// Bounds over a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CellSpread {
    /// On every distance.
    pub(crate) all: [f64; 2],
    /// On their mean over the cell's area.
    pub(crate) mean: [f64; 2],
    /// On the mean of their squares.
    pub(crate) square: [f64; 2],
    /// On each distance, linear over the cell; `None` if none are known.
    pub(crate) linear: Option<LinearBounds>,
    /// The side that is to be halved.
    pub(crate) axis: Axis,
    /// Where the bounds of the cell's halves start.
    pub(crate) start: SpreadStart,
}

/// Where the bounds of a cell start: any start is valid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SpreadStart {
    /// A point of B that may be near.
    pub(crate) foot: Foot,
    /// The distance of the apex from the cell's centre.
    pub(crate) apex: f64,
}

/// The bounds of cells of a pair.
pub(crate) struct Spreads<'a> {
    pair: Pair<'a>,
    nearest: NearestPoint<'a>,
    density: Density,
    /// Cells within this distance of B are not looked at more closely.
    sufficient: f64,
    rounding: f64,
    /// Whether the lemmas were refuted: cells have the bounds of their centre and their radius then.
    is_struck: bool,
}

impl<'a> Spreads<'a> {
    pub(crate) fn new(pair: Pair<'a>, density: Density, sufficient: f64) -> Self {
        let rounding = point_error(&pair) + closest_point_error(&pair);
        Self { nearest: NearestPoint::new(pair.b), pair, density, sufficient, rounding, is_struck: false }
    }

    pub(crate) fn pair(&self) -> &Pair<'a> {
        &self.pair
    }

    /// Bounds cells from now on by the triangle inequality alone.
    pub(crate) fn strike(&mut self) {
        self.is_struck = true;
    }

    /// What is to be added to both sides of every bound.
    pub(crate) fn rounding(&self) -> f64 {
        self.rounding
    }

    /// An upper bound on the distance of every point of A from B: both are in the hulls of their control points.
    pub(crate) fn farthest(&self) -> f64 {
        let (a, b) = (self.pair.a.control_box, self.pair.b.control_box);
        let center = self.pair.transform.apply(a.center());
        let far = b.max_distance_squared(center).sqrt() + 0.5 * a.diagonal();
        far * (1.0 + MEAN_ROUNDINGS * UNIT_ROUNDOFF) + 2.0 * self.rounding
    }

    /// The first start: the apex is farther than A and B are from each other.
    pub(crate) fn start(&self) -> SpreadStart {
        let size = self.pair.a.control_box.diagonal() + self.pair.b.control_box.diagonal();
        SpreadStart { foot: Foot::start(0, [0.5; 2]), apex: size }
    }

    /// Returns the bounds of a cell, which rounding has not been added to.
    pub(crate) fn of(&self, cell: Cell, start: &SpreadStart) -> CellSpread {
        let mut context = CellContext::new(&self.pair, &self.nearest, cell, &start.foot);
        if self.is_struck {
            return self.by_center(&context, *start);
        }
        let mut upper = bounds::with_any_foot(&mut context, self.sufficient).upper;
        if !(upper <= self.sufficient) {
            let query = Query { target: context.jet.point, known: context.foot(), sufficient: 0.0 };
            context.set_feet(self.nearest.near(&query));
            let distance = context.foot().distance();
            let aim = self.sufficient + HEIGHTS_RATIO * distance;
            let bound = if distance <= self.sufficient {
                bounds::with_nearest_feet(&mut context, self.sufficient)
            } else if aim < upper {
                bounds::with_nearest_feet(&mut context, aim)
            } else {
                bounds::with_any_foot(&mut context, self.sufficient)
            };
            upper = upper_min(upper, bound.upper);
        }
        let start = SpreadStart { foot: context.foot(), ..*start };
        if upper <= self.sufficient {
            let [mean, square] = [[0.0, upper], [0.0, upper * upper]];
            return CellSpread { all: mean, mean, square, linear: None, axis: Axis::U, start };
        }
        self.of_apexes(&context, upper, start)
    }

    fn of_apexes(&self, context: &CellContext<'_>, upper: f64, mut start: SpreadStart) -> CellSpread {
        let weight = Weight::new(self.density, context);
        let Weight { tilt, ratio } = weight;
        let above = distance_above(context, tilt);
        let upper = upper_min(upper, above.largest);
        let mut best = Below { least: 0.0, mean: f64::NEG_INFINITY, linear: None, gains: [0.0; 2] };
        let center = context.jet.point;
        if let Some((lower, foot)) = self.query(center, start.foot) {
            best.take(lower, distance_from(context, center, tilt), ratio);
            let behind = center - self.nearest_point(&foot);
            let distance = behind.length();
            start.foot = Foot { distance_squared: distance * distance, ..foot };
            if distance > 0.0 {
                let mut known = foot;
                for _ in 0..MAX_APEXES {
                    let point = center + behind * (start.apex / distance);
                    let Some((at_apex, nearest)) = self.query(point, known) else { break };
                    known = nearest;
                    best.take(at_apex, distance_from(context, point, tilt), ratio);
                    let missing = lower + start.apex - at_apex;
                    if missing <= context.radius * context.radius / start.apex + self.gap() {
                        break;
                    }
                    start.apex *= NEARER;
                }
            }
        }
        let [s, t] = [0, 1].map(|axis| above.gains[axis] + best.gains[axis]);
        // Distances are 0 or more.
        let (least, least_mean) = (best.least, if best.mean > 0.0 { best.mean } else { 0.0 });
        let root = above.root_mean_square;
        let mean = upper_min(upper, least + ratio * (root - least));
        let square = upper_min(upper * upper, least * least + ratio * (root * root - least * least));
        let rounded = 1.0 + MEAN_ROUNDINGS * UNIT_ROUNDOFF;
        let linear =
            best.linear.zip(above.linear).and_then(|(low, high)| LinearBounds::new(low, high, weight));
        CellSpread {
            linear,
            all: [least, upper],
            mean: [least_mean / rounded, mean * rounded],
            square: [least_mean * least_mean / rounded, square * rounded],
            axis: if s >= t { Axis::U } else { Axis::V },
            start,
        }
    }

    /// The bounds by the distance of the cell's centre and its radius.
    fn by_center(&self, context: &CellContext<'_>, mut start: SpreadStart) -> CellSpread {
        let mut least = 0.0;
        start.foot = context.foot();
        if let Some((lower, foot)) = self.query(context.jet.point, context.foot()) {
            let distance = context.jet.point.distance(self.nearest_point(&foot));
            start.foot = Foot { distance_squared: distance * distance, ..foot };
            least = upper_max(least, lower - context.radius);
        }
        let all = [least, start.foot.distance() + context.radius];
        let first = context.patch_bounds().first;
        let longer_along_u = context.cell.half[0] * first[0] >= context.cell.half[1] * first[1];
        let axis = if longer_along_u { Axis::U } else { Axis::V };
        let square = all.map(|bound| bound * bound);
        CellSpread { all, mean: all, square, linear: None, axis, start }
    }

    fn gap(&self) -> f64 {
        QUERY_PART * self.sufficient
    }

    /// Returns a lower bound on the distance of a point, and a foot of it.
    fn query(&self, point: DVec3, known: Foot) -> Option<(f64, Foot)> {
        let start = Some((known.patch, known.parameters));
        let found = closest_above(self.pair.b.target, point, self.gap(), start, 0.0, None)?;
        Some((found.lower, Foot::start(found.patch as u32, found.parameters)))
    }

    fn nearest_point(&self, foot: &Foot) -> DVec3 {
        self.pair.b.patch(foot.patch).point(foot.parameters)
    }
}

/// Lower bounds over a cell.
struct Below {
    least: f64,
    mean: f64,
    /// Of those of the apexes the one with the largest value at the centre.
    linear: Option<Linear>,
    gains: [f64; 2],
}

impl Below {
    /// Takes the bounds of an apex at this distance where they are larger.
    fn take(&mut self, at_apex: f64, reach: Lengths, ratio: f64) {
        let least = at_apex - reach.largest;
        let mean = least + (reach.largest - reach.root_mean_square) / ratio;
        // NaN bounds nothing.
        if least > self.least {
            self.least = least;
        }
        if mean > self.mean {
            self.mean = mean;
            self.gains = reach.gains;
        }
        let below =
            |reach: Linear| Linear { value: at_apex - reach.value, slopes: reach.slopes.map(|slope| -slope) };
        let linear = reach.linear.map(below);
        if self.linear.is_none_or(|best| linear.is_some_and(|one| one.value > best.value)) {
            self.linear = linear;
        }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::certified::testing::Surfaces;
    use crate::model::RigidTransform;
    use crate::shapes::sphere;

    const SUFFICIENT: f64 = 1e-6;

    /// The points of a cell's grid along each side.
    const GRID: usize = 12;

    /// Lemmas S1 to S3: every distance of a cell's points is in its bounds, and their mean by area is.
    #[test]
    fn distances_of_a_cell_and_their_mean_are_in_its_bounds() {
        let center = DVec3::new(0.25, -0.125, 0.5);
        let [a, b] =
            [sphere(DVec3::ZERO, 1.0), sphere(center, 2.0)].map(|model| Surfaces::of(&model.unwrap()));
        let pair = Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY };
        let spreads = Spreads::new(pair, Density::OfPatch, SUFFICIENT);
        let random = &mut fastrand::Rng::with_seed(15);
        for _ in 0..200 {
            let half = [0; 2].map(|_| 0.5_f64.powi(random.i32(1..7)));
            let place = [0, 1].map(|axis| half[axis] + (1.0 - 2.0 * half[axis]) * random.f64());
            let cell = Cell { patch: random.u32(0..pair.a.patches().len() as u32), center: place, half };
            let found = spreads.of(cell, &spreads.start());
            let [mut weight, mut sum, mut squares] = [0.0; 3];
            for index in 0..GRID * GRID {
                let at = [index / GRID, index % GRID].map(|k| (2 * k + 1) as f64 / GRID as f64 - 1.0);
                let jet = pair.jet_of_a(cell.patch, cell.at(at));
                let distance = 2.0 - jet.point.distance(center);
                let rounding = 1e-12;
                assert!(
                    found.all[0] <= distance + rounding && distance <= found.all[1] + rounding,
                    "{distance} {found:?}"
                );
                let density = jet.s.cross(jet.t).length();
                weight += density;
                sum += density * distance;
                squares += density * distance * distance;
            }
            // The sum is over points: its error is a part of the range's square.
            let slack = (found.all[1] - found.all[0]) / (GRID * GRID) as f64 + 1e-12;
            let [mean, square] = [sum / weight, squares / weight];
            assert!(found.mean[0] <= mean + slack && mean <= found.mean[1] + slack, "{mean} {found:?}");
            assert!(
                found.square[0] <= square + 4.0 * slack && square <= found.square[1] + 4.0 * slack,
                "{square} {found:?}"
            );
        }
    }

    /// The audit refutes a range that a point of the cell is beyond, by either end, and a mean that is off by a
    /// hundredth; what the lemmas state it does not refute, nor what the triangle inequality states without them.
    #[test]
    fn an_audit_refutes_what_is_wrong_and_nothing_else() {
        let center = DVec3::new(0.25, -0.125, 0.5);
        let [a, b] =
            [sphere(DVec3::ZERO, 1.0), sphere(center, 2.0)].map(|model| Surfaces::of(&model.unwrap()));
        let pair = Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY };
        let mut spreads = Spreads::new(pair, Density::OfPatch, SUFFICIENT);
        let cell = Cell { patch: 1, center: [0.375, 0.5], half: [0.125; 2] };
        for is_struck in [false, true] {
            if is_struck {
                spreads.strike();
            }
            let CellSpread { all, mean, linear, .. } = spreads.of(cell, &spreads.start());
            assert_eq!(spreads.refutation(&cell, (all, linear.as_ref()), 3), None);
            assert_eq!(spreads.refutation_of_mean(&cell, all, mean), None);
        }
        let distances: Vec<f64> = [-1.0, 0.0, 1.0]
            .into_iter()
            .flat_map(|s| [-1.0, 0.0, 1.0].map(|t| [s, t]))
            .map(|place| 2.0 - pair.point_of_a(cell.patch, cell.at(place)).distance(center))
            .collect();
        let ends = [f64::min, f64::max].map(|fold| distances.iter().copied().reduce(fold).unwrap());
        let range = ends[1] - ends[0];
        for wrong in [[ends[0] + 0.05 * range, 3.0], [0.0, ends[1] - 0.05 * range]] {
            let found = spreads.refutation(&cell, (wrong, None), 3).unwrap();
            assert!(found.stated == wrong && !found.is_mean, "{found:?}");
        }
        let mean = distances.iter().sum::<f64>() / distances.len() as f64;
        let off = [mean + 0.2 * range, mean + 0.3 * range];
        assert!(spreads.refutation_of_mean(&cell, ends, off).is_some_and(|found| found.is_mean));
    }

    /// Halving a cell thrice makes the width of its mean about 64 times less, where that of all distances is 8 times.
    #[test]
    fn the_width_of_a_mean_is_of_second_order() {
        let center = DVec3::new(0.25, -0.125, 0.5);
        let [a, b] =
            [sphere(DVec3::ZERO, 1.0), sphere(center, 2.0)].map(|model| Surfaces::of(&model.unwrap()));
        let pair = Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY };
        let spreads = Spreads::new(pair, Density::OfPatch, 1e-9);
        let width = |half: f64| {
            let cell = Cell { patch: 0, center: [0.4, 0.6], half: [half; 2] };
            let found = spreads.of(cell, &spreads.start());
            found.mean[1] - found.mean[0]
        };
        let [coarse, fine] = [1.0 / 32.0, 1.0 / 256.0].map(width);
        assert!(fine < coarse / 32.0, "{coarse} {fine}");
    }

    /// Lemma S1, attained: about the common centre of two spheres all distances are the same, at an apex that
    /// is the centre and by the mean and the least of its bounds.
    #[test]
    fn a_cell_about_its_apex_has_one_distance() {
        let [a, b] = [1.0, 1.25].map(|radius| Surfaces::of(&sphere(DVec3::ZERO, radius).unwrap()));
        let pair = Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY };
        let spreads = Spreads::new(pair, Density::OfPatch, SUFFICIENT);
        let cell = Cell { patch: 0, center: [0.5; 2], half: [1.0 / 64.0; 2] };
        let start = SpreadStart { apex: 1.0, ..spreads.start() };
        let CellSpread { all, mean, square, .. } = spreads.of(cell, &start);
        let cube = (1.0 / 32.0_f64).powi(3);
        for ([lower, upper], value) in [(all, 0.25), (mean, 0.25), (square, 0.0625)] {
            assert!(lower <= value + 1e-12 && value <= upper + 1e-12, "{lower} {upper}");
            // The remainder is of third order; a bound by the radius would leave 0.06.
            assert!(upper - lower <= 100.0 * cube, "{lower} {upper}");
        }
    }
}
