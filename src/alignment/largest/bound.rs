//! The lower bound on the largest distance over a cell of motions: empty balls, and weights of a linear
//! program. Lemmas Z1 and Z2 of docs/alignment.md.

use super::chart::{Cell, Chart, Middle};
use super::program::{Row, solve};
use crate::alignment::field::Place;
use crate::alignment::freedoms::{COORDINATES, Coordinates};
use crate::rounding::{gamma, upper_max, upper_min};
use glam::DVec3;

/// The factor between the radii of balls that are tried.
const SHRINK: f64 = 4.0;

/// The largest number of balls that are tried on a side of a point.
const MAX_BALLS: usize = 5;

/// A ball is tried only up to this multiple of the point's movement: below it the curvature of the ball takes
/// more than a movement does.
const LEAST_REACH: f64 = 1.5;

/// The roundings of a row, relative to the lengths that enter.
const ROW_ROUNDINGS: f64 = 512.0;

/// What is known of B about a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Clear {
    /// Bounds on the distance from the point to B.
    pub(crate) lower: f64,
    pub(crate) upper: f64,
    /// The unit vector from B to the point, about: a wrong one costs sharpness.
    pub(crate) direction: DVec3,
}

/// A model with certain bounds on the distances of points from it.
pub(crate) trait Clearance: Sync {
    /// Returns bounds on the distance of a point; `place` is where the last foot was. `None` for a model without points.
    fn clear(&self, point: DVec3, place: &mut Place) -> Option<Clear>;
}

/// Points of A, with the model B that they are laid on.
pub(crate) struct Contacts<'a, C> {
    pub(crate) chart: &'a Chart,
    pub(crate) clearance: &'a C,
    pub(crate) points: &'a [DVec3],
    /// The distance of the points from the exact A, at most.
    pub(crate) error: f64,
    /// The radius of balls beyond which a larger one gains nothing: a length of B.
    pub(crate) largest_ball: f64,
    /// The width of the interval that is looked for.
    pub(crate) width: f64,
}

impl<C: Clearance> Contacts<'_, C> {
    /// Returns a lower bound on the largest distance of the points from B over all motions of a cell, and an upper bound
    /// on it in the middle, by which the first is audited. O(points log B).
    pub(crate) fn bounds(&self, cell: &Cell) -> [f64; 2] {
        let middle = self.chart.middle(cell);
        let mut rows = Vec::with_capacity(3 * self.points.len());
        let mut place: Place = None;
        let mut in_middle = 0.0;
        for &point in self.points {
            let upper = self.add(point, &middle, &mut place, &mut rows);
            in_middle = upper_max(in_middle, upper.unwrap_or(f64::INFINITY));
        }
        let found = solve(&rows, &cell.half).map_or(0.0, |found| proven(&rows, &found.weights, cell));
        [if found > 0.0 { found } else { 0.0 }, in_middle]
    }

    /// Returns an upper bound on the largest distance of the points from B under one motion, by certified closest
    /// points alone. O(points log B).
    pub(super) fn largest(&self, at: &Coordinates) -> f64 {
        let middle = self.chart.middle(&Cell { middle: *at, half: [0.0; COORDINATES] });
        let mut place: Place = None;
        let upper = |&point: &DVec3| {
            let clear = self.clearance.clear(middle.motion.apply(point), &mut place)?;
            Some(clear.upper + self.error + middle.rounding(point.length()))
        };
        self.points.iter().map(upper).map(|found| found.unwrap_or(f64::INFINITY)).fold(0.0, upper_max)
    }

    /// Adds the rows of one point: that of its distance, and those of the balls on both sides of B. Returns an upper bound
    /// on its distance in the middle.
    fn add(&self, point: DVec3, middle: &Middle, place: &mut Place, rows: &mut Vec<Row>) -> Option<f64> {
        let image = middle.motion.apply(point);
        let arm = (image - middle.center).length();
        let rounding = self.error + middle.rounding(point.length());
        let above = 1.0 + gamma(ROW_ROUNDINGS);
        let turned = middle.angle * (arm + rounding);
        let reach = (middle.shift + turned + rounding) * above;
        let clear = self.clearance.clear(image, place)?;
        let flat = Row { value: clear.lower - reach, slope: [0.0; COORDINATES] };
        rows.push(flat);
        let curved = 0.5 * middle.growth * middle.angle * turned + rounding;
        let ball = Ball { image, reach, curved };
        for side in [1.0, -1.0] {
            // On the other side of B a point is in no ball until it has moved through B.
            if side < 0.0 && clear.lower > reach {
                continue;
            }
            if let Some(row) = self.ball(&ball, side * clear.direction, middle, *place) {
                rows.push(row);
            }
        }
        Some(clear.upper + rounding)
    }

    /// Returns the row of the best of some balls whose centres are along a direction from a point.
    fn ball(&self, ball: &Ball, along: DVec3, middle: &Middle, mut place: Place) -> Option<Row> {
        let Ball { image, reach, curved } = *ball;
        let enough = SHRINK * reach * reach / self.width;
        let most = upper_min(self.largest_ball, enough);
        let least = LEAST_REACH * reach;
        let mut distance = upper_max(2.0 * least, most);
        let mut best: Option<(f64, DVec3)> = None;
        for _ in 0..MAX_BALLS {
            if distance < least {
                break;
            }
            let center = image + distance * along;
            let clear = self.clearance.clear(center, &mut place)?;
            let to_center = center - image;
            let length = to_center.length();
            let lengths = length + clear.lower + reach + image.length();
            let bulge = reach * reach / (2.0 * (length - reach));
            let lost = bulge + curved + gamma(ROW_ROUNDINGS) * (lengths + bulge);
            let value = clear.lower - length - lost;
            let is_better = best.is_none_or(|(known, _)| value > known);
            if length > reach && is_better {
                best = Some((value, to_center / length));
            }
            // A ball that is empty up to less than its bulge leaves little to gain.
            if best.is_some() && !is_better {
                break;
            }
            distance /= SHRINK;
        }
        let (value, direction) = best?;
        Some(Row { value, slope: middle.slopes(&self.chart.freedoms, image, direction) })
    }
}

/// A point's image in the middle of a cell, an upper bound on its movement within it, and what curved movements
/// and rounding take off.
struct Ball {
    image: DVec3,
    reach: f64,
    curved: f64,
}

/// Returns the lower bound that weights prove: of rows whose value + slope · y does not exceed the largest
/// distance anywhere in the cell. Any weights prove one; those of the solution prove the best, and their rounding
/// cannot spoil it.
fn proven(rows: &[Row], weights: &[(usize, f64)], cell: &Cell) -> f64 {
    let (mut total, mut value, mut size) = (0.0, 0.0, 0.0);
    let mut slopes = [0.0; COORDINATES];
    for &(index, weight) in weights {
        let row = &rows[index];
        total += weight;
        value += weight * row.value;
        size += weight * row.value.abs();
        for ((sum, slope), half) in slopes.iter_mut().zip(row.slope).zip(cell.half) {
            *sum += weight * slope;
            size += weight * slope.abs() * half;
        }
    }
    let moved: f64 = slopes.iter().zip(cell.half).map(|(slope, half)| slope.abs() * half).sum();
    let operations = 4.0 * (weights.len() + COORDINATES) as f64;
    let bound = (value - moved - gamma(operations) * size) / (total * (1.0 + gamma(operations)));
    if bound.is_finite() { bound * (1.0 - gamma(4.0)) } else { 0.0 }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::alignment::freedoms::Freedoms;
    use crate::model::RigidTransform;

    /// The plane z = 0.
    struct Plane;

    impl Clearance for Plane {
        fn clear(&self, point: DVec3, _place: &mut Place) -> Option<Clear> {
            let [lower, upper] = [-1e-15, 1e-15].map(|rounding| point.z.abs() * (1.0 + rounding));
            Some(Clear { lower, upper, direction: DVec3::Z * point.z.signum() })
        }
    }

    /// The sphere of radius 5 about the origin.
    struct Sphere;

    impl Clearance for Sphere {
        fn clear(&self, point: DVec3, _place: &mut Place) -> Option<Clear> {
            let inwards = if point.length() < 5.0 { -1.0 } else { 1.0 };
            let distance = (5.0 - point.length()).abs();
            let [lower, upper] = [-1e-15, 1e-15].map(|rounding| distance * (1.0 + rounding));
            Some(Clear { lower, upper, direction: inwards * point.normalize_or(DVec3::X) })
        }
    }

    fn bound(points: &[DVec3], angle: f64, shift: f64) -> f64 {
        bound_to(&Plane, 1e3, points, angle, shift)
    }

    fn bound_to(
        clearance: &impl Clearance,
        largest_ball: f64,
        points: &[DVec3],
        angle: f64,
        shift: f64,
    ) -> f64 {
        let chart = Chart {
            base: RigidTransform::IDENTITY,
            freedoms: Freedoms::all(),
            center: DVec3::ZERO,
            radius: 2.0,
        };
        let contacts = Contacts { chart: &chart, clearance, points, error: 0.0, largest_ball, width: 1e-6 };
        let [lower, in_middle] = contacts.bounds(&chart.cell(angle, shift));
        assert!(lower <= in_middle);
        lower
    }

    /// Corners of a square whose heights are ± 0.1 in turn: no plane is nearer to all four than 0.1, and the
    /// bound comes near to it as the box becomes smaller.
    #[test]
    fn the_bound_of_a_saddle_is_attained() {
        let heights = |height: f64| {
            [(1.0, 1.0, height), (-1.0, 1.0, -height), (-1.0, -1.0, height), (1.0, -1.0, -height)]
                .map(|(x, y, z)| DVec3::new(x, y, z))
        };
        let points = heights(0.1);
        for (size, least) in [(0.05, 0.0), (0.01, 0.099), (0.001, 0.09999)] {
            let lower = bound(&points, size, size);
            assert!(lower <= 0.1 && lower >= least, "{size}: {lower}");
        }
        // A plane through four points of one plane: nothing is proven.
        assert_eq!(bound(&points.map(|point| point.with_z(0.0)), 0.01, 0.01), 0.0);
        // Heights of one sign are undone by a shift.
        assert!(bound(&points.map(|point| point.with_z(0.1)), 0.01, 0.2) < 1e-9);
        let shifted = bound(&points.map(|point| point.with_z(0.1)), 0.0, 0.05);
        assert!(shifted > 0.0499 && shifted <= 0.05, "{shifted}");
    }

    /// Two points across a sphere from within: a shift h along both axes across brings both nearer, to
    /// 5 − √(k² + 2h²). The ball about the middle is bent as the sphere is, and the movement that it allows for is √3 h.
    #[test]
    fn the_bound_within_a_sphere_allows_for_its_curvature() {
        let k = 4.0;
        let points = [k * DVec3::X, -k * DVec3::X];
        for h in [0.02, 0.1] {
            let lower = bound_to(&Sphere, k, &points, 0.0, h);
            let least = 5.0 - (k * k + 2.0 * h * h).sqrt();
            assert!(lower <= least, "{h}: {lower} of {least}");
            assert!(lower >= 5.0 - k - 2.0 * 3.0 * h * h / (2.0 * k), "{h}: {lower} of {least}");
        }
    }

    /// A point above a plane that is turned about its foot by h about both axes across comes down to z cos √2 h.
    #[test]
    fn the_bound_of_a_turn_allows_for_its_arc() {
        let z = 2.0;
        for h in [0.01, 0.05] {
            let lower = bound(&[z * DVec3::Z], h, 0.0);
            let least = z * (2.0_f64.sqrt() * h).cos();
            assert!(lower <= least && lower >= z * (1.0 - 2.0 * h * h), "{h}: {lower} of {least}");
        }
    }
}
