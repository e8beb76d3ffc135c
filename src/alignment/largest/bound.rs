//! The lower bound on the largest distance over a cell of motions: empty balls, and weights of a linear
//! program. Theorem Z of docs/alignment.md.

use super::chart::{Cell, Chart, Middle};
use super::minorant::{Ball, Minorant, Proven, proven};
use super::program::{Row, solve};
use crate::alignment::freedoms::{COORDINATES, Coordinates};
use crate::rounding::{gamma, upper_max, upper_min};
use glam::DVec3;

/// The factor between the radii of balls that are tried.
const SHRINK: f64 = 4.0;

/// The largest number of balls that are tried on a side of a point.
const MAX_BALLS: usize = 5;

/// The number of balls between two that were tried: the best radius is met within a fifth.
const REFINEMENTS: usize = 3;

/// A ball is tried only down to this multiple of the point's movement: below it the curvature of the ball takes
/// more than a movement does.
const LEAST_REACH: f64 = 1.5;

/// The roundings of a movement, relative to its parts.
const MOVEMENT_ROUNDINGS: f64 = 16.0;

/// What is known of B about a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Clear {
    /// Bounds on the distance from the point to B, or on the signed distance.
    pub(crate) lower: f64,
    pub(crate) upper: f64,
    /// The unit vector along which it grows, about: a wrong one costs sharpness.
    pub(crate) direction: DVec3,
}

/// A model with certain bounds on the distances of points from it, or on signed distances, which are negative on one side
/// of a closed model. Both are 1-Lipschitz.
pub(crate) trait Clearance: Sync {
    /// What is known from the last point.
    type Memory: Clone + Default;

    /// Whether distances are signed.
    const SIGNED: bool;

    /// Returns bounds on the distance of a point. `None` for a model without points.
    fn clear(&self, point: DVec3, memory: &mut Self::Memory) -> Option<Clear>;
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
    pub(super) fn bounds(&self, cell: &Cell) -> (Proven, f64) {
        let middle = self.chart.middle(cell);
        let mut minorants = Vec::with_capacity(3 * self.points.len());
        let mut memory = C::Memory::default();
        let mut in_middle = f64::NEG_INFINITY;
        for &point in self.points {
            let upper = self.add(point, (cell, &middle), &mut memory, &mut minorants);
            in_middle = upper_max(in_middle, upper.unwrap_or(f64::INFINITY));
        }
        let rows: Vec<Row> = minorants.iter().map(|minorant| minorant.row(cell)).collect();
        let found = solve(&rows, &cell.half).map_or_else(
            || Proven { lower: f64::NEG_INFINITY, widest: cell.longest() },
            |found| proven(&minorants, &found.weights, cell),
        );
        (found, in_middle)
    }

    /// Returns an upper bound on the largest distance of the points from B under one motion, by certified closest
    /// points alone. O(points log B).
    pub(super) fn largest(&self, at: &Coordinates) -> f64 {
        let middle = self.chart.middle(&Cell { middle: *at, half: [0.0; COORDINATES] });
        let mut memory = C::Memory::default();
        let upper = |&point: &DVec3| {
            let clear = self.clearance.clear(middle.motion.apply(point), &mut memory)?;
            Some(clear.upper + self.error + middle.rounding(point.length()))
        };
        self.points
            .iter()
            .map(upper)
            .map(|found| found.unwrap_or(f64::INFINITY))
            .fold(f64::NEG_INFINITY, upper_max)
    }

    /// Adds the minorants of one point: by its distance, and by the balls on both sides of B. Returns an upper bound
    /// on its distance in the middle.
    fn add(
        &self,
        point: DVec3,
        at: (&Cell, &Middle),
        memory: &mut C::Memory,
        minorants: &mut Vec<Minorant>,
    ) -> Option<f64> {
        let middle = at.1;
        let image = middle.motion.apply(point);
        let error = self.error + middle.rounding(point.length());
        let turned = middle.angle * ((image - middle.center).length() + error);
        let reach = (middle.shift + turned + error) * (1.0 + gamma(MOVEMENT_ROUNDINGS));
        let clear = self.clearance.clear(image, memory)?;
        minorants.push(Minorant::constant(clear.lower - reach));
        for side in [1.0, -1.0] {
            // A point is in no ball on the other side of B until it has moved through B. A signed distance falls there.
            if side < 0.0 && (C::SIGNED || clear.lower > reach) {
                continue;
            }
            let along = side * clear.direction;
            minorants.extend(self.by_ball((image, error), (along, reach), at, memory.clone()));
        }
        Some(clear.upper + error)
    }

    /// Returns the best minorant of some balls whose centres are along a direction from an image.
    fn by_ball(
        &self,
        (image, error): (DVec3, f64),
        (along, reach): (DVec3, f64),
        (cell, middle): (&Cell, &Middle),
        mut memory: C::Memory,
    ) -> Option<Minorant> {
        let enough = SHRINK * reach * reach / self.width;
        let most = upper_min(self.largest_ball, enough);
        let least = LEAST_REACH * reach;
        let mut of_radius = |radius: f64| {
            let center = image + radius * along;
            let clear = self.clearance.clear(center, &mut memory)?.lower;
            let ball = Ball { center, clear, image, error };
            let minorant = Minorant::of_ball(&ball, middle, &self.chart.freedoms)?;
            Some((minorant.row(cell).value, radius, minorant))
        };
        let mut best: Option<(f64, f64, Minorant)> = None;
        let mut radius = upper_max(2.0 * least, most);
        for _ in 0..MAX_BALLS {
            if radius < least {
                break;
            }
            let found = of_radius(radius)?;
            // A ball that is empty up to less than its bulge leaves little to gain.
            if best.is_some_and(|(known, ..)| known >= found.0) {
                break;
            }
            best = Some(found);
            radius /= SHRINK;
        }
        let mut growth = SHRINK;
        for _ in 0..REFINEMENTS {
            growth = growth.sqrt();
            let Some((known, radius, _)) = best else { break };
            let found = of_radius(growth * radius)?;
            if found.0 > known {
                best = Some(found);
            }
        }
        best.map(|(.., minorant)| minorant)
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::alignment::freedoms::Freedoms;
    use crate::model::RigidTransform;

    /// The plane z = 0.
    struct Plane;

    impl Clearance for Plane {
        type Memory = ();
        const SIGNED: bool = false;
        fn clear(&self, point: DVec3, (): &mut ()) -> Option<Clear> {
            let [lower, upper] = [-1e-15, 1e-15].map(|rounding| point.z.abs() * (1.0 + rounding));
            Some(Clear { lower, upper, direction: DVec3::Z * point.z.signum() })
        }
    }

    /// The sphere of radius 5 about the origin.
    struct Sphere;

    impl Clearance for Sphere {
        type Memory = ();
        const SIGNED: bool = false;
        fn clear(&self, point: DVec3, (): &mut ()) -> Option<Clear> {
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
        let (found, in_middle) = contacts.bounds(&chart.cell(angle, shift));
        assert!(found.lower <= in_middle);
        upper_max(found.lower, 0.0)
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
    /// 5 − √(k² + 2h²). The ball about the middle is bent as the sphere is, and takes ½ · 3h² / k off for a shift along
    /// all three axes.
    #[test]
    fn the_bound_within_a_sphere_allows_for_its_curvature() {
        let k = 4.0;
        let points = [k * DVec3::X, -k * DVec3::X];
        for h in [0.02, 0.1] {
            let lower = bound_to(&Sphere, k, &points, 0.0, h);
            let least = 5.0 - (k * k + 2.0 * h * h).sqrt();
            assert!(lower <= least, "{h}: {lower} of {least}");
            assert!(lower >= 5.0 - k - 1.5001 * h * h / k, "{h}: {lower} of {least}");
        }
    }

    /// Turns about the centre of a sphere move no point nearer to it, and the bound does not fall.
    #[test]
    fn turns_about_the_centre_of_a_sphere_take_nothing_off() {
        let k = 4.0;
        let points = [DVec3::X, -DVec3::X, DVec3::Y, DVec3::new(0.6, 0.0, 0.8)].map(|axis| k * axis);
        for h in [0.01, 0.1] {
            let lower = bound_to(&Sphere, k, &points, h, 0.0);
            assert!(lower <= 5.0 - k && lower >= 5.0 - k - 1e-9, "{h}: {lower}");
        }
    }

    /// A point above a plane that is turned about its foot by h about both axes across comes down to z cos √2 h.
    #[test]
    fn the_bound_of_a_turn_allows_for_its_arc() {
        let z = 2.0;
        for h in [0.01, 0.05] {
            let lower = bound(&[z * DVec3::Z], h, 0.0);
            let least = z * (2.0_f64.sqrt() * h).cos();
            // What is left out, of fourth order, and the curvature of the ball.
            let rest = z * (h * 3.0_f64.sqrt()).powi(4) / 24.0 + z * z * h * h / 1e3;
            assert!(lower <= least && lower >= z * (1.0 - h * h) - 1.01 * rest, "{h}: {lower} of {least}");
        }
    }

    /// The ends of two bars of length 6, one 0.5 above a plane and one 0.5 below it. A turn moves the ends of both bars on
    /// one side by the same arc, so that one comes nearer by what the other recedes. What remains is the arc of 0.5.
    #[test]
    fn arcs_on_both_sides_cancel() {
        let ends = [[3.0, 0.5], [3.0, -0.5], [-3.0, 0.5], [-3.0, -0.5]].map(|[x, z]| DVec3::new(x, 0.0, z));
        for h in [0.01, 0.05] {
            let lower = bound(&ends, h, 0.0);
            let least = 0.5 * h.cos();
            // The bound has the arc of a turn about y, too, what is left out, and the curvature of the ball.
            let rest = 3.0 * (3.0_f64.sqrt() * h).powi(3) / 6.0 + 3.0 * (3.0_f64.sqrt() * h).powi(4) / 24.0;
            assert!(lower <= least && lower >= 0.5 * (1.0 - h * h) - rest - 0.01 * h * h, "{h}: {lower}");
        }
    }
}
