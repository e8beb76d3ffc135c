//! The values of a carrier's function on a piece, in Bernstein form.

use super::Carrier;
use crate::bezier::dot_products;
use crate::overlap::crossing::Affine;
use crate::overlap::piece::{Piece, Whole};
use crate::rounding::{gamma, upper_max};
use glam::{DVec4, Vec4Swizzles};

/// The largest number of control points for which the products of all pairs are computed: their number is its square.
pub(super) const MAX_PRODUCTS: usize = 64;

/// The roundings of a coefficient, a sum of as many products of four factors as there are control points, each of two
/// sums of eight terms; sums add theirs.
const COEFFICIENT_ROUNDINGS: f64 = 64.0;

/// The roundings of a coordinate, relative to those that it is the difference of.
const COORDINATE_ROUNDINGS: f64 = 16.0;

/// The roundings of the quotient of an elevated difference, relative to the sum of sizes.
const DIFFERENCE_ROUNDINGS: f64 = 32.0;

/// A function on a piece: Σ N B / Σ W B with the Bernstein polynomials B, and an error.
#[derive(Debug)]
pub(in crate::overlap) struct Form {
    degree: [usize; 2],
    numerators: Vec<f64>,
    /// Positive.
    weights: Vec<f64>,
    /// An upper bound on what the function is off from f.
    error: f64,
    /// An upper bound on its values.
    size: f64,
}

impl Form {
    /// Returns f on a piece; of the strip about a corner on the hull of its control points, where no parameters count.
    pub(in crate::overlap) fn new(carrier: &Carrier, whole: &Whole, piece: &Piece) -> Self {
        let controls = whole.around(piece, carrier.origin);
        let distance = controls.iter().map(|control| control.xyz().length() / control.w).fold(0.0, upper_max);
        let duals: Vec<DVec4> = controls.iter().map(|&control| carrier.dual(control)).collect();
        let roundings = COEFFICIENT_ROUNDINGS + 4.0 * controls.len() as f64;
        let size = carrier.size(distance) * (1.0 + gamma(roundings));
        // Of coordinates about the carrier's origin, which are differences of larger ones.
        let spread = distance + 2.0 * (whole.center - carrier.origin).length();
        let slope = carrier.gradient.length() + 2.0 * carrier.curvature * distance;
        let error = gamma(roundings) * size + gamma(COORDINATE_ROUNDINGS) * slope * spread;
        let degree = whole.degree();
        if whole.is_hull || controls.len() > MAX_PRODUCTS {
            // f is off its mean at control points by at most the norm times the mean of their squared distances.
            let radius = piece.radius * (1.0 + gamma(DIFFERENCE_ROUNDINGS));
            let weights: Vec<f64> = controls.iter().map(|control| control.w).collect();
            let values = controls.iter().zip(&duals).map(|(&control, dual)| control.dot(*dual) / control.w);
            let error = error + carrier.curvature * radius * radius * (1.0 + gamma(DIFFERENCE_ROUNDINGS));
            return Self { degree, numerators: values.collect(), weights, error, size };
        }
        let ones: Vec<DVec4> = controls.iter().map(|control| DVec4::W * control.w).collect();
        let numerators = dot_products(degree, &controls, &duals).into_iter().map(|(sum, last)| sum + last);
        let weights = dot_products(degree, &ones, &ones).into_iter().map(|(_, product)| product);
        let degree = degree.map(|degree| 2 * degree);
        Self { degree, numerators: numerators.collect(), weights: weights.collect(), error, size }
    }

    /// Returns bounds on the values.
    pub(in crate::overlap) fn range(&self) -> [f64; 2] {
        let quotients =
            self.numerators.iter().zip(&self.weights).map(|(numerator, weight)| numerator / weight);
        let [low, high] = range(quotients);
        [low - self.error, high + self.error]
    }

    /// Returns an affine function of the parameters, and bounds on the differences of the values from it.
    ///
    /// The product of the affine function with the denominator has the degree 1 more in each parameter, as the raised
    /// numerator has: the difference is a mean of quotients of coefficients.
    pub(in crate::overlap) fn affine(&self) -> (Affine, [f64; 2]) {
        let [p, q] = self.degree;
        let columns = q + 1;
        let value = |place: usize| self.numerators[place] / self.weights[place];
        let [one, two, three, four] = [0, q, p * columns, p * columns + q].map(value);
        let function = Affine {
            middle: 0.25 * (one + two + three + four),
            slopes: [0.5 * ((three + four) - (one + two)), 0.5 * ((two + four) - (one + three))],
        };
        let ends = [0.0, 1.0].map(|s| [0.0, 1.0].map(|t| function.at([s, t])));
        // The shares of coefficients k and k − 1 in coefficient k of the raised polynomial.
        let shares = |k: usize, degree: usize| {
            let share = k as f64 / (degree + 1) as f64;
            [(k, 1.0 - share, 0), (k.wrapping_sub(1), share, 1)]
                .into_iter()
                .filter(move |&(k, ..)| k <= degree)
        };
        let places = (0..=p + 1).flat_map(|i| (0..=q + 1).map(move |j| [i, j]));
        let quotients = places.map(|[i, j]| {
            let (mut sum, mut weight) = (0.0, 0.0);
            for (i, of_row, s) in shares(i, p) {
                for (j, of_column, t) in shares(j, q) {
                    let (place, share) = (i * columns + j, of_row * of_column);
                    sum += share * (self.numerators[place] - ends[s][t] * self.weights[place]);
                    weight += share * self.weights[place];
                }
            }
            sum / weight
        });
        let [low, high] = range(quotients);
        let error = self.error + gamma(DIFFERENCE_ROUNDINGS) * (self.size + function.size());
        (function, [low - error, high + error])
    }
}

/// Returns the least and the largest of numbers; NaN bounds nothing.
fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let (low, high) = values.fold((f64::NEG_INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (upper_max(low, -value), upper_max(high, value))
    });
    [-low, high]
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::bezier::extract;
    use crate::overlap::BoundarySide;
    use crate::overlap::piece::Patches;
    use crate::shapes;
    use crate::solid::Ruled;
    use glam::{DMat3, DVec3};

    fn number(random: &mut fastrand::Rng) -> f64 {
        2.0 * random.f64() - 1.0
    }

    fn vector(random: &mut fastrand::Rng) -> DVec3 {
        DVec3::new(number(random), number(random), number(random))
    }

    fn carrier(random: &mut fastrand::Rng) -> Carrier {
        let matrix = DMat3::from_cols(vector(random), vector(random), vector(random));
        let matrix = 0.5 * (matrix + matrix.transpose());
        let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(DVec3::length_squared);
        let [origin, gradient] = [(); 2].map(|()| vector(random));
        Carrier { origin, constant: number(random), gradient, matrix, curvature: (x + y + z).sqrt() }
    }

    /// The value of a homogeneous net, as a sum of Bernstein polynomials.
    fn point(whole: &Whole, piece: &Piece, [s, t]: [f64; 2]) -> DVec3 {
        let [p, q] = whole.degree();
        let basis = |degree: usize, t: f64| -> Vec<f64> {
            let power = |k: usize| t.powi(k as i32) * (1.0 - t).powi((degree - k) as i32);
            crate::bezier::binomials(degree).iter().enumerate().map(|(k, share)| share * power(k)).collect()
        };
        let (rows, columns) = (basis(p, s), basis(q, t));
        let shares = rows.iter().flat_map(|row| columns.iter().map(move |column| row * column));
        let sum =
            shares.zip(&piece.controls).fold(DVec4::ZERO, |sum, (share, &control)| sum + share * control);
        whole.center + sum.xyz() / sum.w
    }

    #[test]
    fn values_are_in_their_range_and_within_their_bounds_of_the_affine_function() {
        let random = &mut fastrand::Rng::with_seed(11);
        let models = [shapes::sphere(DVec3::X, 2.0), shapes::torus(2.0, 0.5), shapes::cylinder(1.0, 3.0)];
        for model in models.map(Result::unwrap) {
            let patches =
                Patches::new(&extract(&model).patches, std::iter::empty(), None, |_| BoundarySide::Outward);
            for whole in patches.faces() {
                let halves = whole.halves(&whole.root).unwrap();
                for piece in [&whole.root, halves[0], whole.halves(halves[1]).unwrap()[0]] {
                    let carrier = carrier(random);
                    let form = Form::new(&carrier, whole, piece);
                    let ([low, high], (function, [least, most])) = (form.range(), form.affine());
                    for _ in 0..50 {
                        let place = [random.f64(), random.f64()];
                        let value = carrier.at(point(whole, piece, place));
                        assert!(low - 1e-13 <= value && value <= high + 1e-13);
                        let off = value - function.at(place);
                        assert!(least - 1e-13 <= off && off <= most + 1e-13, "{least} {off} {most}");
                    }
                }
            }
        }
    }

    /// The difference from an affine function falls as the square of the size, weights or not.
    #[test]
    fn what_is_not_affine_falls_as_the_square_of_the_size() {
        let random = &mut fastrand::Rng::with_seed(12);
        let model = shapes::sphere(DVec3::X, 2.0).unwrap();
        let patches =
            Patches::new(&extract(&model).patches, std::iter::empty(), None, |_| BoundarySide::Outward);
        let whole = patches.faces().next().unwrap();
        let carrier = carrier(random);
        let mut piece = &whole.root;
        let mut sizes = Vec::new();
        for _ in 0..6 {
            let (_, [least, most]) = Form::new(&carrier, whole, piece).affine();
            sizes.push(most - least);
            piece = whole.halves(whole.halves(piece).unwrap()[0]).unwrap()[1];
        }
        assert!(sizes[5] < sizes[1] / 150.0, "{sizes:?}");
    }

    fn strip(degree: usize, controls: Vec<DVec4>, is_hull: bool) -> Patches {
        let strip = Ruled { center: DVec3::new(0.2, 0.4, -0.3), degree, controls, is_hull };
        let none = &extract(&shapes::cylinder(1.0, 1.0).unwrap()).patches;
        Patches::new(none, std::iter::once(strip), None, |_| BoundarySide::Outward)
    }

    /// A corner lies in the hull of its control points: any mean of these has a value in the range.
    #[test]
    fn hulls_of_corners_have_their_values_in_the_range() {
        let random = &mut fastrand::Rng::with_seed(13);
        let mut widest = 0.0_f64;
        for _ in 0..100 {
            let controls: Vec<DVec4> = (0..4).map(|_| vector(random).extend(1.0)).collect();
            let patches = strip(1, controls, true);
            let whole = patches.wholes.last().unwrap();
            let carrier = carrier(random);
            let [low, high] = Form::new(&carrier, whole, &whole.root).range();
            let at = |point: DVec3| carrier.at(point);
            let values: Vec<f64> = whole.root.points.iter().map(|&point| at(point)).collect();
            let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            for _ in 0..50 {
                let shares: Vec<f64> = (0..4).map(|_| random.f64()).collect();
                let sum: f64 = shares.iter().sum();
                let points = shares.iter().zip(&whole.root.points);
                let value = at(points.fold(DVec3::ZERO, |sum, (share, point)| sum + *share * *point) / sum);
                assert!(low <= value && value <= high, "{low} {value} {high}");
                widest = widest.max(value - most);
            }
        }
        // Hulls have larger values than any control point.
        assert!(widest > 0.1, "{widest}");
    }

    /// The strip between two curves with weights is the set of the segments between their points at one parameter: these
    /// have their values in the range, and nearly all of it.
    #[test]
    fn segments_of_strips_have_their_values_in_the_range() {
        let random = &mut fastrand::Rng::with_seed(14);
        let mut fullest = 0.0_f64;
        for _ in 0..100 {
            let weighted = |random: &mut fastrand::Rng| {
                let weight = 0.5 + random.f64();
                (vector(random) * weight).extend(weight)
            };
            let rows: [Vec<DVec4>; 2] = [(); 2].map(|()| (0..3).map(|_| weighted(random)).collect());
            let patches = strip(2, rows.concat(), false);
            let whole = patches.wholes.last().unwrap();
            let carrier = carrier(random);
            let [low, high] = Form::new(&carrier, whole, &whole.root).range();
            let on = |row: &[DVec4], t: f64| {
                let shares = [(1.0 - t) * (1.0 - t), 2.0 * t * (1.0 - t), t * t];
                let sum =
                    shares.iter().zip(row).fold(DVec4::ZERO, |sum, (share, &control)| sum + *share * control);
                whole.center + sum.xyz() / sum.w
            };
            let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
            for place in 0..400 {
                let (along, across) = (f64::from(place % 20) / 19.0, f64::from(place / 20) / 19.0);
                let value = carrier.at(on(&rows[0], along).lerp(on(&rows[1], along), across));
                assert!(low - 1e-13 <= value && value <= high + 1e-13, "{low} {value} {high}");
                (least, most) = (least.min(value), most.max(value));
            }
            fullest = fullest.max((most - least) / (high - low));
        }
        assert!(fullest > 0.9, "{fullest}");
    }
}
