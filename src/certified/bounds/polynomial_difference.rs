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
use super::{CellContext, UpperBound};
use crate::bezier::{relative, scaled, squares, unscale};
use glam::{DVec2, DVec4, Vec4Swizzles};

/// How far, relative to its length along the parameter lines, a map may run
/// across them or be clamped at the edge of the patch.
const MAX_SKEW: f64 = 1e-6;

/// Roundings of 2^-53 on the way to one coefficient, per degree and besides.
const ROUNDINGS_PER_DEGREE: f64 = 8.0;
const ROUNDINGS_BESIDES: f64 = 64.0;

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
        let y = Net {
            degree: if map.swapped { [target.degree[1], target.degree[0]] } else { target.degree },
            controls: relative(&controls, jet.point - target.center),
        };
        let [s, t] = context.cell.ranges();
        let mut controls = context.patch.restricted(s, t);
        for control in &mut controls {
            *control = pair.transform.rotate(control.xyz()).extend(control.w);
        }
        let center = pair.transform.apply(context.patch.center);
        let x = Net { degree: context.patch.degree, controls: relative(&controls, jet.point - center) };
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
        let is_constant = context.patch_bounds().first.map(|first| first == 0.0);
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
}

impl Net {
    /// An upper bound on the distance between points of equal parameters;
    /// `None` where a weight is not positive or float64 does not represent it.
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
        let longest = quotient.iter().fold(0.0_f64, |longest, c| longest.max(c.xyz().length_squared()));
        let mut largest = 0.0_f64;
        for (length_squared, weight_squared) in squares(degree, &quotient) {
            largest = largest.max(length_squared / weight_squared);
        }
        let ([reach, heavy, light], [other_reach, other_heavy, other_light]) = (self.sizes(), other.sizes());
        let roundings = f64::EPSILON * (ROUNDINGS_PER_DEGREE * (p + q + m + n) as f64 + ROUNDINGS_BESIDES);
        let lightest = light * other_light;
        let rounding = roundings * (reach * other_heavy + other_reach * heavy) / lightest;
        let rounding_squared = roundings * (largest + longest / (lightest * lightest));
        let bound = (largest + rounding_squared).sqrt() + rounding;
        (light > 0.0 && other_light > 0.0 && bound >= 0.0).then_some(bound)
    }

    /// The longest control, the heaviest weight and the lightest.
    fn sizes(&self) -> [f64; 3] {
        let mut sizes = [0.0, 0.0, f64::INFINITY];
        for control in &self.controls {
            let [longest, heaviest, lightest] = sizes;
            sizes = [control.xyz().length().max(longest), control.w.max(heaviest), control.w.min(lightest)];
        }
        sizes
    }
}
