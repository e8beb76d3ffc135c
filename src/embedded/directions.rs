//! The directions in which the points of a piece move along its parameters.

use crate::axis::Axis;
use crate::bezier::binomials;
use crate::rounding::{gamma, lower_min, upper_max, upper_min};
use glam::{DVec3, DVec4, Vec4Swizzles};

/// The roundings of a coefficient of a derivative, relative to the largest length of a control point, beside those of each
/// degree.
const ROUNDINGS: f64 = 256.0;
const ROUNDINGS_PER_DEGREE: f64 = 16.0;

/// The length of a coefficient, in errors of it, up to which it has no direction that is known.
const MIN_ERRORS: f64 = 1024.0;

/// The direction of a coefficient.
#[derive(Debug, Clone, Copy)]
pub(super) struct Direction {
    /// A vector of length 1.
    pub(super) unit: DVec3,
    /// An upper bound on its distance from the exact one.
    pub(super) error: f64,
}

impl Direction {
    /// Returns the direction turned round.
    pub(super) fn back(self) -> Self {
        Self { unit: -self.unit, ..self }
    }
}

/// The directions of a derivative: it is a sum of vectors along them with coefficients of 0 or more, and of a vector that
/// is hardly any (lemma S8 of docs/solids.md).
#[derive(Debug, Clone, Default)]
pub(super) struct Directions {
    pub(super) list: Vec<Direction>,
    /// An upper bound on the length of what has no direction.
    pub(super) rest: f64,
}

impl Directions {
    /// Returns the same directions, turned round if `is_turned`.
    pub(super) fn turned(&self, is_turned: bool) -> impl Iterator<Item = Direction> + '_ {
        self.list.iter().map(move |&direction| if is_turned { direction.back() } else { direction })
    }
}

/// The controls of a net, as its lines see them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Net<'a> {
    /// Homogeneous, t fastest.
    pub(super) controls: &'a [DVec4],
    pub(super) degree: [usize; 2],
    /// Whether the weights differ.
    pub(super) rational: bool,
    /// The largest length of a control point of the patch that this is a piece of.
    pub(super) radius: f64,
}

impl Net<'_> {
    /// Returns the directions of the derivative along an axis of positive degree.
    ///
    /// Where the weights are equal, those of the legs of the net. Else, with p the degree along the axis and q the other
    /// one, the derivative times w² is the sum over i > i', j, j' of `C(p,i) C(p,i') (i - i') C(q,j) C(q,j') w_ij w_i'j'
    /// (P_ij - P_i'j')` with the Bernstein polynomials of the indices i + i' - 1 and j + j', each times a positive number:
    /// the terms of one index are added up. O(p² q²).
    pub(super) fn along(&self, axis: Axis) -> Directions {
        let [of_axis, of_other] = [self.degree[axis], self.degree[axis.other()]];
        let columns = self.degree[1] + 1;
        let at = |i: usize, j: usize| match axis {
            Axis::U => self.controls[i * columns + j],
            Axis::V => self.controls[j * columns + i],
        };
        // Line after line.
        let width = of_other + 1;
        let points: Vec<(DVec3, f64)> = (0..=of_axis)
            .flat_map(|i| (0..width).map(move |j| at(i, j)))
            .map(|control| (control.xyz() / control.w, control.w))
            .collect();
        let error = gamma(ROUNDINGS + ROUNDINGS_PER_DEGREE * (of_axis + of_other) as f64) * self.radius;
        if !self.rational {
            let legs = points.iter().zip(&points[width..]);
            return directions(legs.map(|(from, to)| to.0 - from.0), error, of_axis as f64);
        }
        let [in_axis, in_other] = [of_axis, of_other].map(binomials);
        let columns = 2 * of_other + 1;
        let mut sums = vec![(DVec3::ZERO, 0.0); (2 * of_axis - 1) * columns];
        for (i, high) in points.chunks_exact(width).enumerate() {
            for (k, low) in points.chunks_exact(width).take(i).enumerate() {
                let share = in_axis[i] * in_axis[k] * (i - k) as f64;
                for (j, &(to, weight)) in high.iter().enumerate() {
                    let share = share * in_other[j] * weight;
                    let row = (i + k - 1) * columns + j;
                    for ((&(from, other), of_other), sum) in low.iter().zip(in_other).zip(&mut sums[row..]) {
                        let share = share * of_other * other;
                        sum.0 += share * (to - from);
                        sum.1 += share;
                    }
                }
            }
        }
        let weights = || points.iter().map(|&(_, weight)| weight);
        let ratio = weights().fold(0.0, upper_max) / weights().fold(f64::INFINITY, lower_min);
        // A derivative of unit differences is at most the degree times the square of the ratio of weights.
        let stretch = of_axis as f64 * ratio * ratio;
        directions(sums.into_iter().map(|(sum, shares)| sum / shares), error, stretch)
    }
}

/// Returns the directions of vectors that are known up to an error; those of no direction count `stretch` times.
fn directions(vectors: impl Iterator<Item = DVec3>, error: f64, stretch: f64) -> Directions {
    let mut found = Directions { list: Vec::with_capacity(vectors.size_hint().0), rest: 0.0 };
    for vector in vectors {
        let length = vector.length();
        if length > MIN_ERRORS * error {
            found.list.push(Direction { unit: vector / length, error: 2.0 * error / length });
        } else {
            found.rest = upper_max(found.rest, stretch * (length + error));
        }
    }
    found
}

/// Returns a vector of length 1 on whose side all these directions are, with the least product with one of them, less
/// its error; none if none is found or there are no directions.
///
/// Guarantee: the number is positive, and the product of the vector with each exact direction is at least that. The
/// vector is that of the mean, or that of Gilbert, Johnson and Keerthi's iteration toward the point of the hull that is
/// nearest to the origin; any is valid.
pub(super) fn common_side(directions: &[Direction]) -> Option<(DVec3, f64)> {
    let units = || directions.iter().map(|direction| direction.unit);
    let mean = units().sum::<DVec3>().try_normalize().unwrap_or(DVec3::X);
    let of_mean = least_product(mean, directions)?;
    if of_mean >= GOOD_MARGIN {
        return Some((mean, of_mean));
    }
    let units: Vec<DVec3> = units().collect();
    let hull = crate::clearance::hull_distance(&units, &[DVec3::ZERO], mean, GOOD_MARGIN, 0.0);
    let side = hull.direction.try_normalize()?;
    let margin = least_product(side, directions)?;
    let (side, margin) = if margin > of_mean { (side, margin) } else { (mean, of_mean) };
    (margin > 0.0).then_some((side, margin))
}

/// The margin from which on a better one is not looked for.
const GOOD_MARGIN: f64 = 0.1;

/// The roundings of the product of two unit vectors and of their lengths.
pub(super) const PRODUCT_ROUNDINGS: f64 = 32.0;

/// Returns a lower bound on the products of a unit vector with directions; none without directions.
fn least_product(side: DVec3, directions: &[Direction]) -> Option<f64> {
    let products = directions.iter().map(|direction| side.dot(direction.unit) - direction.error);
    let least = products.fold(f64::INFINITY, lower_min);
    (least < f64::INFINITY).then_some(least - gamma(PRODUCT_ROUNDINGS))
}

/// A direction along an edge, and how far those of the edge turn from it.
#[derive(Debug, Clone, Copy)]
pub(super) struct EdgeCone {
    axis: DVec3,
    /// An upper bound on the tangent of the angle to any direction of the edge.
    tangent: f64,
}

impl EdgeCone {
    /// Returns the cone of the directions of an edge, if they are all less than a right angle from their mean.
    pub(super) fn of(edge: &[Direction]) -> Option<Self> {
        let axis = edge.iter().map(|direction| direction.unit).sum::<DVec3>().try_normalize()?;
        let tangents = edge.iter().map(|&Direction { unit, error }| {
            let along = axis.dot(unit);
            let [error, across] = [error + gamma(PRODUCT_ROUNDINGS), (unit - along * axis).length()];
            if along > error { (across + error) / (along - error) } else { f64::INFINITY }
        });
        let tangent = tangents.fold(0.0, upper_max);
        (tangent < f64::INFINITY).then_some(Self { axis, tangent })
    }

    /// Returns the number by which what is between two points of two pieces beside the edge is to be divided for an upper
    /// bound on the ways from both to the edge, from the directions in which one piece goes from the edge, and those of
    /// the other turned round; none where the two may lie on one side (lemma S8, b).
    pub(super) fn margin(&self, directions: &[Direction]) -> Option<f64> {
        let across = |&Direction { unit, error }: &Direction| {
            let unit = (unit - self.axis.dot(unit) * self.axis).try_normalize()?;
            Some(Direction { unit, error })
        };
        let flat: Vec<Direction> = directions.iter().map(across).collect::<Option<_>>()?;
        let (side, _) = common_side(&flat)?;
        let side = (side - self.axis.dot(side) * self.axis).try_normalize()?;
        let products = directions.iter().map(|&Direction { unit, error }| {
            let along = self.tangent * self.axis.dot(unit).abs();
            side.dot(unit) - along - (1.0 + self.tangent) * (error + gamma(PRODUCT_ROUNDINGS))
        });
        let least = products.fold(f64::INFINITY, lower_min);
        (least > 0.0 && least < f64::INFINITY).then_some(upper_min(1.0, least / (1.0 + self.tangent)))
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::bezier::{Patch, quarter_of_cylinder};
    use std::f64::consts::FRAC_PI_2;

    /// The excess of a margin that the iteration may leave.
    const TINY: f64 = 1e-6;

    fn exact(vectors: &[DVec3]) -> Vec<Direction> {
        vectors.iter().map(|vector| Direction { unit: vector.normalize(), error: 0.0 }).collect()
    }

    fn in_plane(degrees: f64) -> DVec3 {
        let (sin, cos) = degrees.to_radians().sin_cos();
        DVec3::new(cos, sin, 0.0)
    }

    /// The cosine of half the angle between two directions; none from half a turn on.
    #[test]
    fn the_margin_of_two_directions_is_that_of_their_bisector() {
        for degrees in [0.0, 60.0, 150.0, 179.0] {
            let (_, margin) = common_side(&exact(&[in_plane(20.0), in_plane(20.0 + degrees)])).unwrap();
            let cosine = (0.5 * degrees).to_radians().cos();
            assert!(cosine - TINY < margin && margin <= cosine, "{degrees}: {margin} for {cosine}");
        }
        assert_eq!(common_side(&exact(&[in_plane(20.0), in_plane(200.0)])), None);
        assert_eq!(common_side(&exact(&[in_plane(0.0), in_plane(120.0), in_plane(240.0)])), None);
        assert_eq!(common_side(&[]), None);
    }

    /// The mean of many directions on one side and one on the other is no good side of all.
    #[test]
    fn the_side_is_not_that_of_the_mean_alone() {
        let mut all = exact(&[in_plane(0.0); 9]);
        all.extend(exact(&[in_plane(170.0)]));
        let (_, margin) = common_side(&all).unwrap();
        assert!((margin - 85.0_f64.to_radians().cos()).abs() < TINY, "{margin}");
    }

    /// An error of a direction comes off the margin, and one as large as the margin leaves none.
    #[test]
    fn the_error_of_a_direction_comes_off_the_margin() {
        let with = |error: f64| {
            let mut both = exact(&[in_plane(-60.0), in_plane(60.0)]);
            both[1].error = error;
            common_side(&both).map(|(_, margin)| margin)
        };
        assert!((with(0.2).unwrap() - 0.3).abs() < TINY);
        assert_eq!(with(0.7), None);
    }

    /// Two half planes at an angle about a straight edge, skew to it: the sine of half the angle.
    #[test]
    fn the_margin_of_a_wedge_is_the_sine_of_half_its_angle() {
        let cone = EdgeCone::of(&exact(&[DVec3::Z, DVec3::Z])).unwrap();
        for degrees in [1.0, 90.0, 180.0, 270.0, 359.0] {
            let margin = cone.margin(&exact(&[in_plane(0.0), -in_plane(degrees)])).unwrap();
            let sine = (0.5_f64 * degrees).to_radians().sin();
            assert!(sine - TINY < margin && margin <= sine, "{degrees}: {margin} for {sine}");
            // Along the edge by as much as across it.
            let skew = [in_plane(0.0) + DVec3::Z, -in_plane(degrees) + DVec3::Z];
            let margin = cone.margin(&exact(&skew)).unwrap();
            assert!(sine / 2.0_f64.sqrt() - TINY < margin && margin <= sine, "{degrees}: {margin}");
        }
        assert_eq!(cone.margin(&exact(&[in_plane(0.0), -in_plane(0.0)])), None);
    }

    /// An edge that turns by as much as a piece is skew to it may run along that piece. Where the edge turns by less,
    /// the margin is the remainder, divided by one and its tangent.
    #[test]
    fn an_edge_that_turns_takes_from_the_margin_what_is_skew() {
        let turning = |tangent: f64| {
            EdgeCone::of(&exact(&[DVec3::Z + tangent * DVec3::X, DVec3::Z - tangent * DVec3::X])).unwrap()
        };
        // 45 degrees to the edge on both sides of it.
        let skew = exact(&[DVec3::X + DVec3::Z, DVec3::X - DVec3::Z]);
        let margin = turning(0.25).margin(&skew).unwrap();
        assert!((margin - 0.75 / 2.0_f64.sqrt() / 1.25).abs() < TINY, "{margin}");
        assert_eq!(turning(1.0).margin(&skew), None);
        assert_eq!(turning(1.5).margin(&skew), None);
        assert!(EdgeCone::of(&exact(&[DVec3::Z, -DVec3::Z])).is_none());
    }

    /// The tangents of a quarter of a circle turn by a quarter, and those along the axis do not. The legs of its
    /// polygon, on whose weights nothing depends, are not all directions: between the second and the first point too.
    #[test]
    fn the_directions_of_a_quarter_of_a_cylinder_are_those_of_its_tangents() {
        let controls = quarter_of_cylinder();
        let patch = Patch::whole([2, 1], DVec3::ZERO, &controls);
        for radius in [1.0, 4.0] {
            let net = Net { controls: &controls, degree: [2, 1], rational: patch.rational, radius };
            let [around, along] = Axis::BOTH.map(|axis| net.along(axis));
            assert_eq!([around.rest, along.rest], [0.0; 2]);
            let spread = |found: &Directions| {
                let pairs =
                    found.list.iter().flat_map(|one| found.list.iter().map(|other| one.unit.dot(other.unit)));
                pairs.fold(1.0, f64::min).clamp(-1.0, 1.0).acos()
            };
            assert!((spread(&around) - FRAC_PI_2).abs() < 1e-7, "{}", spread(&around));
            assert!(spread(&along) < 1e-7);
        }
    }

    /// The derivative of a rational net with one heavy weight is a sum of its directions with coefficients of 0 or more:
    /// it has no negative product with what is on the side of all.
    #[test]
    fn derivatives_are_on_the_side_of_their_directions() {
        let random = &mut fastrand::Rng::with_seed(7);
        let mut seen = 0;
        for _ in 0..400 {
            let degree = [random.usize(1..4), random.usize(1..4)];
            let controls: Vec<DVec4> = (0..(degree[0] + 1) * (degree[1] + 1))
                .map(|k| {
                    let place = DVec3::new((k / (degree[1] + 1)) as f64, (k % (degree[1] + 1)) as f64, 0.0);
                    let off = DVec3::new(random.f64(), random.f64(), random.f64());
                    let weight = 8.0_f64.powf(random.f64() * 2.0 - 1.0);
                    (weight * (place + 0.8 * off)).extend(weight)
                })
                .collect();
            let patch = Patch::whole(degree, DVec3::ZERO, &controls);
            let net = Net { controls: &controls, degree, rational: true, radius: 10.0 };
            for axis in Axis::BOTH {
                let found = net.along(axis);
                let Some((side, margin)) = common_side(&found.list) else { continue };
                seen += 1;
                for _ in 0..8 {
                    let jet = patch.jet([random.f64(), random.f64()]);
                    let derivative = if axis == Axis::U { jet.s } else { jet.t };
                    assert!(side.dot(derivative) >= (margin - 1e-12) * derivative.length());
                }
            }
        }
        assert!(seen > 200, "{seen}");
    }

    /// A row that is a point has no direction, and counts with its length.
    #[test]
    fn points_have_no_direction() {
        let at = |x: f64, y: f64| DVec4::new(x, y, 0.0, 1.0);
        let net = |apart: f64| {
            let controls = [at(0.0, 0.0), at(0.0, apart), at(1.0, 0.0), at(1.0, 1.0)];
            Net { controls: &controls, degree: [1, 1], rational: false, radius: 2.0 }.along(Axis::V)
        };
        let collapsed = net(0.0);
        assert_eq!(collapsed.list.len(), 1);
        assert!(collapsed.rest > 0.0 && collapsed.rest < 1e-12);
        let nearly = net(1e-13);
        assert!(nearly.list.len() == 1 && nearly.rest > 1e-13, "{nearly:?}");
        assert_eq!(net(1e-3).list.len(), 2);
    }
}
