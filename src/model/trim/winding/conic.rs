//! Conics near arcs of loops.

use super::super::piece::{TrimPiece, point_of};
use super::WindingPiece;
use crate::approximation::bernstein::binomial;
use crate::approximation::least_squares::LeastSquares;
use crate::axis::Axis;
use crate::param_box::ParamBox;
use crate::rounding::{gamma, lower_min, upper_max};
use glam::{DVec2, DVec3};

/// The largest number of halvings of an arc.
pub(super) const MAX_HALVINGS: u32 = 32;

/// The least extent of the places of a conic along an axis, relative to the box: straight arcs may have none.
const MIN_EXTENT: f64 = 1e-3;

/// Steps of Newton's method to a point of the conic.
const STEPS: usize = 2;

/// Roundings of a coefficient besides those for each product, relative to the sizes of its terms.
const COEFFICIENT_ROUNDINGS: f64 = 32.0;

/// The function `v - a - b u - c u² - d u v - f v²` relative to a point.
#[derive(Debug, Clone)]
pub(super) struct Conic {
    /// The axis of v.
    pub(super) axis: Axis,
    pub(super) origin: DVec2,
    /// a, b, c, d and f.
    pub(super) coefficients: [f64; 5],
}

impl Conic {
    /// The conics nearest to points of these pieces for both axes, that across the one along which they run in the box
    /// first.
    pub(super) fn through<'a>(
        pieces: impl Iterator<Item = &'a WindingPiece> + Clone,
        [low, high]: [DVec2; 2],
        origin: DVec2,
    ) -> [Self; 2] {
        let size = 0.5 * (high - low);
        let run: DVec2 = pieces.clone().map(|arc| (arc.ends[1] - arc.ends[0]).abs() / size).sum();
        let axis = if run.x >= run.y { Axis::V } else { Axis::U };
        let points: Vec<DVec2> = pieces.flat_map(points_of).collect();
        // Relative to the box of the points, in which the terms are most independent.
        let least = points.iter().fold(high, |least, point| least.min(*point));
        let largest = points.iter().fold(low, |largest, point| largest.max(*point));
        let middle = 0.5 * (least + largest);
        let half = (0.5 * (largest - least)).max(MIN_EXTENT * size);
        let places: Vec<DVec2> = points.iter().map(|point| (*point - middle) / half).collect();
        [axis, axis.other()].map(|axis| Self::over(axis, &places, [middle, half], origin))
    }

    /// The conic nearest to places relative to a box.
    fn over(axis: Axis, places: &[DVec2], [middle, half]: [DVec2; 2], origin: DVec2) -> Self {
        let (v, u) = (axis.index(), axis.other().index());
        let of_place = |place: &DVec2| {
            let (x, y) = (place[u], place[v]);
            ([1.0, x, x * x, x * y, y * y], y)
        };
        let rows: Vec<([f64; 5], f64)> = places.iter().map(of_place).collect();
        let [h0, h1, h2, h3, h4] = least_squares(&rows);
        // Relative to the point and not to the middle.
        let shift = (origin - middle) / half;
        let (x, y, ratio) = (shift[u], shift[v], half[v] / half[u]);
        let rate = 1.0 - h3 * x - 2.0 * h4 * y;
        let coefficients = [
            half[v] * (h0 + x * (h1 + x * h2 + y * h3) + y * (y * h4 - 1.0)),
            ratio * (h1 + 2.0 * x * h2 + y * h3),
            ratio / half[u] * h2,
            h3 / half[u],
            h4 / half[v],
        ];
        Self { axis, origin, coefficients: coefficients.map(|coefficient| coefficient / rate) }
    }

    /// Its value at u and v relative to the point.
    fn value(&self, u: f64, v: f64) -> f64 {
        let [a, b, c, d, f] = self.coefficients;
        v - a - u * (b + u * c + v * d) - v * v * f
    }

    /// ± its value at a point.
    pub(super) fn at(&self, sign: f64, point: DVec2) -> f64 {
        let place = point - self.origin;
        sign * self.value(place[self.axis.other().index()], place[self.axis.index()])
    }

    /// The corners of a box as (u, v) relative to the point.
    fn corners(&self, region: &ParamBox) -> [[f64; 2]; 4] {
        let along = |axis: Axis| region[axis].map(|end| end - self.origin[axis.index()]);
        let ([u0, u1], [v0, v1]) = (along(self.axis.other()), along(self.axis));
        [[u0, v0], [u0, v1], [u1, v0], [u1, v1]]
    }

    /// The least derivative by v over a box.
    pub(super) fn rate(&self, region: &ParamBox) -> f64 {
        let [.., d, f] = self.coefficients;
        let of_corner = |[u, v]: [f64; 2]| 1.0 - d * u - 2.0 * f * v;
        self.corners(region).map(of_corner).into_iter().fold(f64::INFINITY, lower_min)
    }

    /// The largest derivative by u over a box, up to its sign.
    pub(super) fn slope(&self, region: &ParamBox) -> f64 {
        let [_, b, c, d, _] = self.coefficients;
        let of_corner = |[u, v]: [f64; 2]| (b + 2.0 * c * u + d * v).abs();
        self.corners(region).map(of_corner).into_iter().fold(0.0, upper_max)
    }

    /// About the v of the least ±v where the function vanishes, over a range of the other parameter.
    pub(super) fn lowest(&self, sign: f64, range: [f64; 2]) -> f64 {
        let [a, b, c, d, f] = self.coefficients;
        let (v, u) = (self.origin[self.axis.index()], self.origin[self.axis.other().index()]);
        let [low, high] = range.map(|end| end - u);
        let vertex = vertex_of(b, c, [low, high]);
        let of_place = |u: f64| {
            let mut v = a + u * (b + u * c);
            for _ in 0..STEPS {
                v -= self.value(u, v) / (1.0 - d * u - 2.0 * f * v);
            }
            sign * v
        };
        sign * of_place(low).min(of_place(high)).min(of_place(vertex)) + v
    }

    /// The largest value of ± the function on a line of constant v, over a range of u.
    pub(super) fn highest(&self, sign: f64, v: f64, range: [f64; 2]) -> f64 {
        let [_, b, c, d, _] = self.coefficients;
        let v = v - self.origin[self.axis.index()];
        let [low, high] = range.map(|end| end - self.origin[self.axis.other().index()]);
        let vertex = vertex_of(b + d * v, c, [low, high]);
        let value = |u: f64| sign * self.value(u, v);
        upper_max(upper_max(value(low), value(high)), value(vertex))
    }

    /// A lower bound on ± the function over a piece.
    ///
    /// With homogeneous controls (U, V, W) relative to the point, the coefficients of
    /// `±((V - a W - b U) W - c U² - d U V - f V²)` over those of W².
    pub(super) fn least(&self, piece: &TrimPiece, sign: f64, rounding: f64) -> f64 {
        let [a, b, c, d, f] = self.coefficients;
        let (v, u) = (self.axis.index(), self.axis.other().index());
        let moved = |control: &DVec3| {
            let place = point_of(*control) - self.origin;
            [place[u], place[v], control.z]
        };
        let controls: Vec<[f64; 3]> = piece.controls.iter().map(moved).collect();
        let term = |[x, y, w]: [f64; 3], [other_x, other_y, other_w]: [f64; 3]| {
            let weight = w * other_w;
            (weight * sign * (y - a - b * x - x * (c * other_x + d * other_y) - f * y * other_y), weight)
        };
        let degree = piece.degree();
        let row: Vec<f64> = (0..=degree).map(|k| binomial(degree, k)).collect();
        let (mut values, mut weights) = (vec![0.0; 2 * degree + 1], vec![0.0; 2 * degree + 1]);
        for (i, left) in controls.iter().enumerate() {
            for (k, right) in controls.iter().enumerate() {
                let (value, weight) = term(*left, *right);
                values[i + k] += row[i] * row[k] * value;
                weights[i + k] += row[i] * row[k] * weight;
            }
        }
        let reach = controls.iter().fold(0.0, |reach, [x, ..]| upper_max(reach, x.abs()));
        let height = controls.iter().fold(0.0, |height, [_, y, _]| upper_max(height, y.abs()));
        let [b, c, d, f] = [b, c, d, f].map(f64::abs);
        let slope = 1.0 + b + 2.0 * c * reach + d * (reach + height) + 2.0 * f * height;
        let roundings = (2 * (degree + 1)) as f64 + COEFFICIENT_ROUNDINGS;
        let of_points = rounding + gamma(f64::from(MAX_HALVINGS) * (2.0 * degree as f64 + 4.0));
        let sizes = height * (1.0 + f * height) + a.abs() + reach * (b + reach * c + height * d);
        let error = slope * of_points + gamma(2.0 * roundings) * sizes;
        let mut least = f64::INFINITY;
        for (value, weight) in values.iter().zip(&weights) {
            let value = value / weight;
            // NaN bounds nothing.
            least = if value >= least { least } else { value };
        }
        if least.is_nan() { f64::NEG_INFINITY } else { least - error }
    }
}

/// Where `b u + c u²` is least or largest over all u, or the nearest end of the range.
fn vertex_of(b: f64, c: f64, [low, high]: [f64; 2]) -> f64 {
    let vertex = (-b / (2.0 * c)).clamp(low, high);
    if vertex.is_nan() { low } else { vertex }
}

/// Five points of a piece, as many as a conic has factors.
fn points_of(arc: &WindingPiece) -> [DVec2; 5] {
    let [first, second] = arc.piece.halves();
    let quarter = |half: &TrimPiece| half.halves()[0].end();
    [arc.ends[0], quarter(&first), first.end(), quarter(&second), arc.ends[1]]
}

/// The factors of the terms of a value that are nearest to it at all places, 0 for terms that depend on those before, as
/// the last ones do on straight arcs.
fn least_squares<const N: usize>(rows: &[([f64; N], f64)]) -> [f64; N] {
    let mut squares = LeastSquares::new(rows.iter().map(|(_, value)| *value).collect::<Vec<_>>());
    let is_added = std::array::from_fn::<bool, N, _>(|term| {
        squares.add(rows.iter().map(|(terms, _)| terms[term]).collect())
    });
    let mut factors = squares.factors().into_iter();
    is_added.map(|is_added| if is_added { factors.next().unwrap_or(0.0) } else { 0.0 })
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    const ROUNDINGS: [f64; 2] = [0.0, 1e-3];

    /// On a straight piece that lies on the conic, the least value is the allowance: that of the places times
    /// the slope, and the rounding of the coefficients' terms.
    #[test]
    fn the_depth_of_an_arc_has_its_rounding() {
        let coefficients = [0.25, 0.5, 0.0, 0.0, 0.0];
        let conic = Conic { axis: Axis::V, origin: DVec2::ZERO, coefficients };
        let ends = [DVec2::new(-0.5, 0.0), DVec2::new(0.5, 0.5)];
        let piece = TrimPiece { controls: ends.map(|end| end.extend(1.0)).to_vec(), curve: 0 };
        let (slope, sizes) = (1.5, 0.5 + 0.25 + 0.25);
        let of_terms = gamma(2.0 * (4.0 + 32.0)) * sizes;
        for rounding in ROUNDINGS {
            let of_places = slope * (rounding + gamma(32.0 * 6.0));
            for sign in [1.0, -1.0] {
                let depth = -conic.least(&piece, sign, rounding);
                let expected = of_places + of_terms;
                assert!((depth / expected - 1.0).abs() < 1e-3, "{depth:e} {expected:e} of {sign}");
            }
        }
    }

    /// The same on a piece of second order: the slope is that at its end, and the sizes are those there.
    #[test]
    fn the_depth_of_a_parabola_has_its_rounding() {
        let coefficients = [0.25, 0.5, 0.5, 0.0, 0.0];
        let conic = Conic { axis: Axis::V, origin: DVec2::ZERO, coefficients };
        let points = [DVec2::new(-0.5, 0.125), DVec2::new(0.0, 0.125), DVec2::new(0.5, 0.625)];
        let piece = TrimPiece { controls: points.map(|point| point.extend(1.0)).to_vec(), curve: 0 };
        let (slope, sizes) = (1.0 + 0.5 + 0.5, 0.625 + 0.25 + 0.5 * (0.5 + 0.25));
        for rounding in ROUNDINGS {
            let expected = slope * (rounding + gamma(32.0 * 8.0)) + gamma(2.0 * (2.0 * 2.0 + 34.0)) * sizes;
            let depth = -conic.least(&piece, 1.0, rounding);
            assert!((depth / expected - 1.0).abs() < 1e-2, "{depth:e} {expected:e}");
        }
    }

    /// The same on a line on which the last two terms cancel: each counts in the slope, u v by both parameters, and in
    /// the sizes.
    #[test]
    fn the_depth_of_a_conic_has_its_rounding() {
        // On v = u / 2, d u v + f v² vanishes where d = -f / 2.
        let points = [DVec2::new(-0.5, -0.25), DVec2::new(0.5, 0.25)];
        let piece = TrimPiece { controls: points.map(|point| point.extend(1.0)).to_vec(), curve: 0 };
        for (d, f) in [(-2.0, 4.0), (2.0, -4.0)] {
            let conic = Conic { axis: Axis::V, origin: DVec2::ZERO, coefficients: [0.0, 0.5, 0.0, d, f] };
            let slope = 1.0 + 0.5 + 2.0 * (0.5 + 0.25) + 2.0 * 4.0 * 0.25;
            let sizes = 0.25 * (1.0 + 4.0 * 0.25) + 0.5 * (0.5 + 2.0 * 0.25);
            for rounding in ROUNDINGS {
                let expected = slope * (rounding + gamma(32.0 * 6.0)) + gamma(2.0 * (4.0 + 32.0)) * sizes;
                let depth = -conic.least(&piece, 1.0, rounding);
                assert!((depth / expected - 1.0).abs() < 1e-2, "{depth:e} {expected:e}");
            }
        }
    }

    /// No value on a piece is below the least one, and it is near to that of some place.
    #[test]
    fn no_place_of_a_piece_is_below_the_least() {
        let random = &mut fastrand::Rng::with_seed(3192);
        for case in 0..200 {
            let mut number = || random.f64() - 0.5;
            let mut control = |_| DVec2::new(number(), number()).extend(1.0 + number());
            let controls: Vec<DVec3> =
                [0, 1, 2].map(&mut control).map(|c| (c.truncate() * c.z).extend(c.z)).to_vec();
            let axis = if case % 2 == 0 { Axis::U } else { Axis::V };
            let coefficients = [0; 5].map(|_| number());
            let origin = DVec2::new(number(), number());
            let conic = Conic { axis, origin, coefficients };
            let piece = TrimPiece { controls, curve: 0 };
            for sign in [1.0, -1.0] {
                let least = conic.least(&piece, sign, 0.0);
                let mut lowest = f64::INFINITY;
                for step in 0..=64 {
                    let t = f64::from(step) / 64.0;
                    let [a, b, c] = [0, 1, 2].map(|k| piece.controls[k]);
                    let sum = (1.0 - t) * (1.0 - t) * a + 2.0 * t * (1.0 - t) * b + t * t * c;
                    lowest = lowest.min(conic.at(sign, sum.truncate() / sum.z));
                }
                assert!(least <= lowest && lowest - least < 1.0, "{least} {lowest} of case {case}");
            }
        }
    }

    /// The bounds on derivatives over a box, the lowest place of the conic and the highest value on a line are those
    /// of samples.
    #[test]
    fn derivatives_and_extremes_are_those_of_samples() {
        let random = &mut fastrand::Rng::with_seed(3194);
        for case in 0..200 {
            let mut number = || 0.4 * (random.f64() - 0.5);
            let axis = if case % 2 == 0 { Axis::U } else { Axis::V };
            let conic = Conic {
                axis,
                origin: DVec2::new(number(), number()),
                coefficients: [0; 5].map(|_| number()),
            };
            let region = ParamBox::new([number() - 0.4, number() + 0.4], [number() - 0.4, number() + 0.4]);
            let [u, v] = [axis.other(), axis];
            let place = |x: f64, y: f64| {
                let mut place = DVec2::ZERO;
                place[u.index()] = region[u][0] + x * (region[u][1] - region[u][0]);
                place[v.index()] = region[v][0] + y * (region[v][1] - region[v][0]);
                place
            };
            const STEP: f64 = 1e-6;
            let derivative = |at: DVec2, axis: Axis| {
                let step = STEP * DVec2::from_array([[1.0, 0.0], [0.0, 1.0]][axis.index()]);
                (conic.at(1.0, at + step) - conic.at(1.0, at - step)) / (2.0 * STEP)
            };
            let (mut rate, mut slope, mut highest) = (f64::INFINITY, 0.0_f64, f64::NEG_INFINITY);
            for step in 0..=32 {
                for other in 0..=32 {
                    let at = place(f64::from(step) / 32.0, f64::from(other) / 32.0);
                    rate = rate.min(derivative(at, v));
                    slope = slope.max(derivative(at, u).abs());
                }
                highest = highest.max(conic.at(-1.0, place(f64::from(step) / 32.0, 0.0)));
            }
            assert!((conic.rate(&region) - rate).abs() < 1e-8, "case {case}");
            assert!((conic.slope(&region) - slope).abs() < 1e-8, "case {case}");
            let found = conic.highest(-1.0, region[v][0], region[u]);
            assert!((highest - 1e-12..highest + 1e-3).contains(&found), "{found} {highest} of case {case}");
            for sign in [1.0, -1.0] {
                let mut lowest = place(0.0, 0.0);
                lowest[v.index()] = conic.lowest(sign, region[u]);
                lowest[u.index()] = region[u][0];
                assert!(conic.at(sign, lowest) <= 1e-3, "{lowest} of case {case}");
            }
        }
    }
}
