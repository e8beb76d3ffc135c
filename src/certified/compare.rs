//! A bound for cells that keep their distance to B by a change of parameters:
//! copies and offsets, with other knots, degrees or pieces.

use super::feet::Foot;
use super::foot_map::FootMap;
use super::region::Cell;
use super::side::Operand;
use crate::bezier::{Jet, Patch, relative, scaled, squares, unscale};
use crate::model::RigidTransform;
use glam::{DVec2, DVec4, Vec4Swizzles};

/// How much of a foot's way may be along the other parameter, and be cut off
/// at the edge of the patch, for the map to count as one along the axes.
const ASKEW: f64 = 1e-6;

/// Roundings of 2^-53 on the way to one coefficient, per degree and besides.
const ROUNDINGS_PER_DEGREE: f64 = 8.0;
const ROUNDINGS_BESIDES: f64 = 64.0;

/// At least the distance to B of every point of the cell, infinite where the
/// feet's linearisation does not go along B's parameter lines or a corner of
/// the cell tells that the bound is above `prune_threshold`.
///
/// For such a map φ, `B∘φ` has the controls of B restricted to the image of
/// the cell, as A has those of the cell. With `A = X/w` and `B∘φ = Y/v`,
///
/// `|A - B∘φ|² = |X v - Y w|² / (w v)²`,
///
/// a quotient of Bernstein polynomials of twice the degrees' sums, at most its
/// coefficients' largest quotient, as the denominator's are positive. Up to
/// rounding that is exact where the distance is the same all over: zero where
/// A and B are the same polynomials or rational functions. O(p^4 q^4).
pub(super) fn compare(
    cell: &Cell,
    patch: &Patch<'_>,
    transform: &RigidTransform,
    jet: &Jet,
    b: &Operand<'_>,
    foot: &Foot,
    prune_threshold: f64,
) -> f64 {
    if foot.distance_squared > prune_threshold * prune_threshold {
        return f64::INFINITY;
    }
    let target = b.patch(foot.patch);
    let foot_jet = target.jet(foot.parameters);
    let [h, k] = cell.half;
    let tangents = [h * jet.s, k * jet.t];
    let Some(map) = FootMap::linearised(&foot_jet, foot_jet.point - jet.point, tangents, [false; 2]) else {
        return f64::INFINITY;
    };
    let fitted = map.fitted(foot.parameters, b.room(foot.patch));
    let cut = (map.width() - fitted.width()).abs().max_element();
    let (p, q) = (fitted.p, fitted.q);
    let swapped = p.y.abs() > p.x.abs();
    let (along, across) = if swapped { ([p.y, q.x], [p.x, q.y]) } else { ([p.x, q.y], [p.y, q.x]) };
    // The edge of a patch has one direction.
    let mut least = f64::INFINITY;
    for (half, way) in cell.half.into_iter().zip(along) {
        if half > 0.0 {
            least = least.min(way.abs());
        }
    }
    if across[0].abs().max(across[1].abs()).max(cut) > ASKEW * least || least == 0.0 {
        return f64::INFINITY;
    }
    let is_too_far = |corner: DVec2| {
        let from = transform.apply(patch.point(cell.at(corner.to_array())));
        let image = DVec2::from_array(foot.parameters) + corner.x * p + corner.y * q;
        from.distance_squared(target.point(image.to_array())) > prune_threshold * prune_threshold
    };
    if [DVec2::ONE, DVec2::new(1.0, -1.0)].into_iter().any(|corner| is_too_far(corner) || is_too_far(-corner))
    {
        return f64::INFINITY;
    }
    // `along` by A's axes; the image by B's.
    let reach = if swapped { [along[1], along[0]] } else { along };
    let image = [0, 1].map(|axis| {
        let [middle, reach] = [foot.parameters[axis], reach[axis].abs()];
        [middle - reach, middle + reach]
    });
    let controls = target.restricted(image[0], image[1]);
    let origin = jet.point;
    let controls = turned(&controls, target.degree, swapped, along.map(|way| way < 0.0));
    let y = Net {
        degree: if swapped { [target.degree[1], target.degree[0]] } else { target.degree },
        controls: relative(&controls, origin - target.center),
    };
    let range = [0, 1].map(|axis| [cell.center[axis] - cell.half[axis], cell.center[axis] + cell.half[axis]]);
    let mut controls = patch.restricted(range[0], range[1]);
    for control in &mut controls {
        *control = transform.rotate(control.xyz()).extend(control.w);
    }
    let x =
        Net { degree: patch.degree, controls: relative(&controls, origin - transform.apply(patch.center)) };
    x.largest_difference(&y)
}

/// The controls of a patch with its parameters swapped and turned around.
fn turned(controls: &[DVec4], [p, q]: [usize; 2], swapped: bool, backwards: [bool; 2]) -> Vec<DVec4> {
    let [rows, columns] = if swapped { [q, p] } else { [p, q] };
    let mut turned = Vec::with_capacity(controls.len());
    for i in 0..=rows {
        for j in 0..=columns {
            let i = if backwards[0] { rows - i } else { i };
            let j = if backwards[1] { columns - j } else { j };
            let [i, j] = if swapped { [j, i] } else { [i, j] };
            turned.push(controls[i * (q + 1) + j]);
        }
    }
    turned
}

/// Homogeneous controls, t fastest.
struct Net {
    degree: [usize; 2],
    controls: Vec<DVec4>,
}

impl Net {
    /// At least the largest distance between points of equal parameters.
    fn largest_difference(&self, other: &Self) -> f64 {
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
        let (mut largest, mut longest) = (0.0_f64, 0.0_f64);
        for coefficient in &quotient {
            longest = longest.max(coefficient.xyz().length_squared());
        }
        for (length_squared, weight_squared) in squares(degree, &quotient) {
            largest = largest.max(length_squared / weight_squared);
        }
        let ([reach, heavy, light], [other_reach, other_heavy, other_light]) = (self.sizes(), other.sizes());
        let roundings = f64::EPSILON * (ROUNDINGS_PER_DEGREE * (p + q + m + n) as f64 + ROUNDINGS_BESIDES);
        let lightest = light * other_light;
        let lost = roundings * (reach * other_heavy + other_reach * heavy) / lightest;
        let lost_squared = roundings * (largest + longest / (lightest * lightest));
        let bound = (largest + lost_squared).sqrt() + lost;
        // What is no number bounds nothing.
        if light > 0.0 && other_light > 0.0 && bound >= 0.0 { bound } else { f64::INFINITY }
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
