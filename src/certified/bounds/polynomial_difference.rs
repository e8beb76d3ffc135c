//! The bound by the difference of two patches as a rational function: cells
//! that keep their distance to B under a change of parameters, as on copies and
//! offsets with other knots, degrees or pieces.
//!
//! Where the feet's linearization runs along B's parameter lines, `B∘φ` has the
//! control net of B restricted to the image of the cell, as A has that of the
//! cell. With `A = X/w` and `B∘φ = Y/v`,
//!
//! `|A - B∘φ|² = |X v - Y w|² / (w v)²`,
//!
//! a quotient of Bernstein polynomials of twice the degrees' sums. It is at most
//! the largest quotient of coefficients, as those of the denominator are
//! positive. Up to rounding that is exact where the distance is the same
//! everywhere: zero where A and B are the same polynomials or rational functions.

use super::super::reparametrization::Reparametrization;
use super::super::rounding::gamma;
use super::{CellContext, UpperBound};
use crate::axis::Axis;
use crate::bezier::{power_of_two_below, relative, scaled, squares, unscale};
use crate::rounding::upper_max;
use glam::{DVec2, DVec3, DVec4, Vec4Swizzles};

/// How far, relative to its length along the parameter lines, a map may run
/// across them or be clamped at the edge of the patch.
const MAX_SKEW: f64 = 1e-6;

/// Roundings of a coefficient of `X v - Y w` besides one for each of its
/// products, and of a square besides one for each (lemmas R10, R11); both with
/// the 6 that binomials of more than 54 are off.
const PRODUCT_ROUNDINGS: f64 = 16.0;
const SQUARE_ROUNDINGS: f64 = 19.0;

/// Sum of the absolute coefficients of a restriction that goes beyond the patch
/// in its extension, at most (lemma R6).
const EXTENSION_GROWTH: f64 = 46.0;

/// The bound from the nearest known foot. O(p^4 q^4).
pub(super) struct PolynomialDifference;

impl UpperBound for PolynomialDifference {
    /// `None` where the map does not run along B's parameter lines, or a corner
    /// of the cell shows that the bound exceeds the threshold.
    fn evaluate(&self, context: &mut CellContext<'_>, threshold: f64) -> Option<f64> {
        let foot = context.foot();
        if foot.distance_squared > threshold * threshold {
            return None;
        }
        let map = AlignedMap::new(context)?;
        if map.is_beyond(context, threshold) {
            return None;
        }
        let (pair, jet) = (context.pair, &context.jet);
        let target = pair.b.patch(foot.patch);
        let [s, t] = map.image(foot.parameters);
        let controls = target.restricted(s, t);
        let controls = map.oriented(&controls, target.degree);
        let degree = if map.swapped { [target.degree[1], target.degree[0]] } else { target.degree };
        let growth = if map.is_inside(foot.parameters) { 1.0 } else { EXTENSION_GROWTH };
        let y = Net::new(degree, &controls, jet.point - target.center, growth);
        let [s, t] = context.cell.ranges();
        let mut controls = context.patch.restricted(s, t);
        for control in &mut controls {
            *control = pair.transform.rotate(control.xyz()).extend(control.w);
        }
        let center = pair.transform.apply(context.patch.center);
        let x = Net::new(context.patch.degree, &controls, jet.point - center, 1.0);
        x.max_difference(&y)
    }
}

/// A map of the cell along B's parameter lines.
struct AlignedMap {
    /// The derivatives by σ and τ along the lines.
    p: DVec2,
    q: DVec2,
    /// Whether σ runs along B's second parameter.
    swapped: bool,
    /// Their sizes and signs by A's axes.
    along: [f64; 2],
}

impl AlignedMap {
    /// The feet's linearization if it is one. An axis along which A's patch is
    /// constant may be mapped to a point.
    fn new(context: &CellContext<'_>) -> Option<Self> {
        let (foot, a, [h, k]) = (context.foot(), &context.jet, context.cell.half);
        let jet = context.pair.b.patch(foot.patch).jet(foot.parameters);
        let tangents = [h * a.s, k * a.t];
        let map = Reparametrization::linearized(&jet, jet.point - a.point, tangents, [false; 2])?;
        let clamped = map.clamped_to(context.pair.b.room(foot.patch), foot.parameters);
        let clamping = (map.extent() - clamped.extent()).abs().max_element();
        let Reparametrization { p, q } = clamped;
        let swapped = p.y.abs() > p.x.abs();
        let (along, across) = if swapped { ([p.y, q.x], [p.x, q.y]) } else { ([p.x, q.y], [p.y, q.x]) };
        let is_constant = Axis::BOTH.map(|axis| context.patch.is_constant(axis));
        let mut least = f64::INFINITY;
        for axis in 0..2 {
            if !is_constant[axis] {
                least = least.min(along[axis].abs());
            }
        }
        let skew = across[0].abs().max(across[1].abs()).max(clamping);
        (skew <= MAX_SKEW * least && least > 0.0).then_some(Self { p, q, swapped, along })
    }

    /// Whether a corner of the cell is farther than the threshold from its image.
    fn is_beyond(&self, context: &CellContext<'_>, threshold: f64) -> bool {
        let foot = context.foot();
        let target = context.pair.b.patch(foot.patch);
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        corners.into_iter().any(|corner| {
            let from = context.pair.point_of_a(context.cell.patch, context.cell.at(corner));
            let image = DVec2::from_array(foot.parameters) + corner[0] * self.p + corner[1] * self.q;
            from.distance_squared(target.point(image.to_array())) > threshold * threshold
        })
    }

    /// The image of the cell, by B's axes.
    fn image(&self, foot: [f64; 2]) -> [[f64; 2]; 2] {
        let [first, second] = self.along;
        let extent = if self.swapped { [second, first] } else { [first, second] };
        [0, 1].map(|axis| [foot[axis] - extent[axis].abs(), foot[axis] + extent[axis].abs()])
    }

    /// Whether the image lies in B's patch, not only in its extension.
    fn is_inside(&self, foot: [f64; 2]) -> bool {
        self.image(foot).as_flattened().iter().all(|parameter| (0.0..=1.0).contains(parameter))
    }

    /// The control net of B's patch in the order of A's parameters.
    fn oriented(&self, controls: &[DVec4], [p, q]: [usize; 2]) -> Vec<DVec4> {
        let [rows, columns] = if self.swapped { [q, p] } else { [p, q] };
        let backwards = self.along.map(|derivative| derivative < 0.0);
        let mut oriented = Vec::with_capacity(controls.len());
        for i in 0..=rows {
            for j in 0..=columns {
                let i = if backwards[0] { rows - i } else { i };
                let j = if backwards[1] { columns - j } else { j };
                let [i, j] = if self.swapped { [j, i] } else { [i, j] };
                oriented.push(controls[i * (q + 1) + j]);
            }
        }
        oriented
    }
}

/// A homogeneous control net, t fastest.
struct Net {
    degree: [usize; 2],
    controls: Vec<DVec4>,
    /// The rounding error of its points: restriction and change of origin.
    point_error: f64,
}

impl Net {
    /// Takes a restricted net relative to another point. The weights are scaled
    /// by a power of two, which is exact, so that the largest is about 1.
    ///
    /// `growth` bounds the sum of the absolute coefficients of a restriction
    /// beyond [0, 1], 1 inside (lemma R6).
    fn new(degree: [usize; 2], controls: &[DVec4], shift: DVec3, growth: f64) -> Self {
        let heaviest = controls.iter().fold(0.0_f64, |heaviest, control| heaviest.max(control.w));
        let scale = power_of_two_below(heaviest.max(f64::MIN_POSITIVE)).recip();
        let controls: Vec<DVec4> = controls.iter().map(|&control| scale * control).collect();
        let (mut radius, mut lightest) = (0.0_f64, f64::INFINITY);
        for control in &controls {
            radius = upper_max(radius, control.xyz().length() / control.w);
            lightest = lightest.min(control.w);
        }
        let spread = if growth > 1.0 { growth * scale * heaviest / lightest } else { 1.0 };
        let restriction = 16.0 * (degree[0] + degree[1]) as f64 * spread + 8.0;
        let point_error = gamma(restriction * radius + 4.0 * shift.length());
        Self { degree, controls: relative(&controls, shift), point_error }
    }

    /// An upper bound on the distance between points of equal parameters, by
    /// lemma R11; `None` where a weight is not positive or a number overflows.
    fn max_difference(&self, other: &Self) -> Option<f64> {
        let ([p, q], [m, n]) = (self.degree, other.degree);
        let (degree, columns) = ([p + m, q + n], q + n + 1);
        // `X v - Y w` and `w v`.
        let mut quotient = vec![DVec4::ZERO; (p + m + 1) * columns];
        let (of_x, of_y) = (scaled(self.degree, &self.controls), scaled(other.degree, &other.controls));
        for (a, x) in of_x.iter().enumerate() {
            let (i, j) = (a / (q + 1), a % (q + 1));
            for (b, y) in of_y.iter().enumerate() {
                let (k, l) = (b / (n + 1), b % (n + 1));
                let product = (y.w * x.xyz() - x.w * y.xyz()).extend(x.w * y.w);
                quotient[(i + k) * columns + j + l] += product;
            }
        }
        unscale(degree, &mut quotient);
        let length = |control: &DVec4| control.xyz().length() / control.w;
        let longest = quotient.iter().map(length).fold(0.0, upper_max);
        let largest = squares(degree, &quotient)
            .into_iter()
            .map(|(length_squared, weight_squared)| length_squared / weight_squared)
            .fold(0.0, upper_max);
        let product_terms = ((p.min(m) + 1) * (q.min(n) + 1)) as f64;
        let square_terms = ((degree[0] / 2 + 1) * (degree[1] + 1)) as f64;
        let of_products = gamma(product_terms + PRODUCT_ROUNDINGS);
        let of_squares = gamma(square_terms + SQUARE_ROUNDINGS);
        let under_root = (1.0 + of_squares) * largest + of_squares * longest * longest;
        let bound = (1.0 + of_products) * under_root.sqrt()
            + of_products * (self.radius() + other.radius())
            + self.point_error
            + other.point_error;
        (self.is_positive() && other.is_positive() && bound < f64::INFINITY).then_some(bound)
    }

    /// The largest distance of a control point from the origin.
    fn radius(&self) -> f64 {
        self.controls.iter().map(|control| control.xyz().length() / control.w).fold(0.0, upper_max)
    }

    fn is_positive(&self) -> bool {
        self.controls.iter().all(|control| control.w > 0.0)
    }
}
