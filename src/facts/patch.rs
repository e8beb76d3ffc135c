//! The moments of the cone from the origin over a patch.

use super::moments::{COUNT, Moments, monomials, order};
use super::nodes::{Dependence, Nodes};
use crate::approximation::chebyshev;
use crate::area::density::{Density, tensor_coefficients};
use crate::area::gauss::rule;
use crate::axis::Axis;
use crate::bezier::Patch;
use crate::param_box::ParamBox;
use crate::rounding::{UNIT_ROUNDOFF, gamma, upper_max};
use glam::{DVec3, DVec4, Vec4Swizzles};

/// The largest number of halvings of a part, and of parts of a patch: weights that are farther apart give wider
/// bounds.
const MAX_DEPTH: u32 = 16;
const MAX_PARTS: usize = 256;

/// The error of a node of a rule in [-1, 1] and that of a weight, relative to it.
const RULE_ERROR: f64 = 8.0 * f64::EPSILON;

/// The roundings of a point of a patch for each degree, and besides them (lemma R5 of docs/rounding.md, and
/// 4 for each degree for the rounding of the parameters).
const POINT_ROUNDINGS: [f64; 2] = [12.0, 8.0];

/// The roundings of a density `|x·N| / w³` with its monomial, and of its sum over the nodes.
const DENSITY_ROUNDINGS: f64 = 32.0;

/// The sizes of a patch about an origin, for bounds.
struct Cone<'a> {
    patch: &'a Patch<'a>,
    density: Density<'a>,
    /// The vector from the origin to the patch's centre.
    center: DVec3,
    /// Upper bounds on the distance of its points from the origin, and on their error.
    radius: f64,
    point_error: f64,
    /// An upper bound on |N| / w³.
    largest: f64,
}

/// Returns the moments of the signed cone over a patch, whose points are off by at most `moved`: lemmas V1 to
/// V3 of docs/facts.md. O(degree³) for each part, of which there is one where weights are near each other.
pub(crate) fn of_patch(patch: &Patch<'_>, origin: DVec3, moved: f64) -> Moments {
    let cone = Cone::new(patch, origin);
    let mut moments = Moments::ZERO;
    let (mut parts, mut count) = (vec![(ParamBox::UNIT, 0)], 1);
    while let Some((part, depth)) = parts.pop() {
        let dependences = Axis::BOTH.map(|axis| cone.dependence(part, axis));
        let nodes = [0, 1].map(|axis: usize| dependences[axis].nodes());
        match nodes {
            [Some(in_s), Some(in_t)] => moments.add(&cone.mean(part, [in_s, in_t]), false),
            _ if depth == MAX_DEPTH || count >= MAX_PARTS => {
                let nodes = [0, 1].map(|axis: usize| dependences[axis].any_nodes());
                moments.add(&cone.mean(part, nodes), false);
            }
            [in_s, _] => {
                let axis = if in_s.is_none() { Axis::U } else { Axis::V };
                parts.extend(part.halves(axis).map(|half| (half, depth + 1)));
                count += 1;
            }
        }
    }
    if moved > 0.0 {
        let radius = cone.radius + moved;
        moments.add_layer(moved, cone.largest, radius);
        moments.add_surface(moved * cone.rim(), radius);
    }
    moments
}

impl<'a> Cone<'a> {
    fn new(patch: &'a Patch<'a>, origin: DVec3) -> Self {
        let density = Density::new(patch);
        let center = patch.center - origin;
        let [p, q] = patch.degree.map(|degree| degree as f64);
        let own = patch.local_points().map(DVec3::length).fold(0.0, upper_max);
        let about = patch.local_points().map(|point| (center + point).length()).fold(0.0, upper_max);
        let [each, more] = POINT_ROUNDINGS;
        let point_error = gamma(each * (p + q) + more) * own + gamma(2.0) * center.length();
        let largest = density.upper_bound(density.largest);
        let radius = about * (1.0 + gamma(DENSITY_ROUNDINGS)) + point_error;
        Self { patch, density, center, radius, point_error, largest }
    }

    /// Returns an upper bound on the length of the patch's edges.
    fn rim(&self) -> f64 {
        let points: Vec<DVec3> = self.patch.local_points().collect();
        let columns = self.patch.degree[1] + 1;
        let rows = self.patch.degree[0] + 1;
        let row = |row: usize| (1..columns).map(move |j| [row * columns + j - 1, row * columns + j]);
        let column =
            |column: usize| (1..rows).map(move |i| [(i - 1) * columns + column, i * columns + column]);
        let all = row(0).chain(row(rows - 1)).chain(column(0)).chain(column(columns - 1));
        all.map(|[a, b]| points[a].distance(points[b])).sum::<f64>() * (1.0 + gamma(DENSITY_ROUNDINGS))
    }

    /// Returns how the densities over a part depend on a parameter.
    fn dependence(&self, part: ParamBox, axis: Axis) -> Dependence {
        let degree = self.patch.degree[axis];
        if !self.patch.rational || self.is_constant(axis) {
            return Dependence::Polynomial { degree };
        }
        let counts = self.patch.degree.map(|degree| degree + 1);
        let parameters = [0, 1].map(|axis: usize| {
            let [start, end] = part[axis];
            chebyshev::nodes(counts[axis]).map(|x| start + x * (end - start)).collect::<Vec<f64>>()
        });
        let values = self.patch.homogeneous_tangents([&parameters[0], &parameters[1]]);
        let weights: Vec<f64> = values.iter().map(|at| at.point.w).collect();
        let heaviest = weights.iter().copied().fold(0.0, upper_max);
        let coefficients = tensor_coefficients(&weights, counts, counts);
        let transform = gamma(counts.iter().map(|&count| count as f64 + 4.0).sum());
        let rounding = 4.0 * (self.density.weight_rounding + transform * heaviest);
        let mut sizes = vec![0.0; counts[axis]];
        for (index, coefficient) in coefficients.iter().enumerate().skip(1) {
            let place = [index / counts[1], index % counts[1]][axis];
            sizes[place] += coefficient.abs() + rounding;
        }
        Dependence::Rational { degree, sizes, constant: coefficients[0] - rounding }
    }

    /// Returns whether the weights are the same along an axis.
    fn is_constant(&self, axis: Axis) -> bool {
        let columns = self.patch.degree[1] + 1;
        let controls = self.patch.controls;
        let weight = |control: &DVec4| control.w;
        match axis {
            Axis::U => {
                controls.iter().enumerate().all(|(index, control)| control.w == controls[index % columns].w)
            }
            Axis::V => controls
                .chunks_exact(columns)
                .all(|row| row.iter().all(|control| weight(control) == row[0].w)),
        }
    }

    /// Returns the moments of the cone over a part, by Gauss's rules with these numbers of nodes.
    fn mean(&self, part: ParamBox, nodes: [Nodes; 2]) -> Moments {
        let rules = nodes.map(|nodes| rule(nodes.count));
        let [in_s, in_t] = [0, 1].map(|axis: usize| {
            let [start, end] = part[axis];
            rules[axis].nodes.iter().map(|x| start + x * (end - start)).collect::<Vec<f64>>()
        });
        let at = self.patch.homogeneous_tangents([&in_s, &in_t]);
        let mut values = [0.0; COUNT];
        // The mean of bounds on the error of the density of order 0.
        let mut rounding = 0.0;
        for (row, in_s) in at.chunks_exact(rules[1].nodes.len()).zip(&rules[0].weights) {
            for (at, in_t) in row.iter().zip(&rules[1].weights) {
                let w = at.point.w;
                let point = self.center + at.point.xyz() / w;
                let normal = self.density.numerator(at) / (w * w * w);
                let density = point.dot(normal);
                let share = in_s * in_t;
                for (value, monomial) in values.iter_mut().zip(monomials(point)) {
                    *value += share * density * monomial;
                }
                let (length, cube) = (normal.length(), w * w * w);
                let relative = 4.0 * self.density.weight_rounding / w + gamma(DENSITY_ROUNDINGS);
                let of_normal = 2.0 * self.density.rounding / cube + relative * length;
                rounding += share * (self.radius * of_normal + self.point_error * (length + of_normal));
            }
        }
        let sums = gamma(DENSITY_ROUNDINGS + (rules[0].nodes.len() * rules[1].nodes.len()) as f64);
        let [width, height] = part.lengths();
        let size = self.radius * self.largest;
        let rounding = [0, 1, 2].map(|order: usize| {
            // A monomial of order j is off by j times the error of a point, doubled for products of errors.
            let monomial = 2.0 * order as f64 * self.point_error * self.largest;
            let rules: f64 =
                nodes.iter().map(|nodes| nodes.errors[order] + moved_nodes(nodes.slopes[order])).sum();
            self.radius.powi(order as i32) * (rounding + monomial + (rules + sums) * size)
        });
        let scale = |index: usize| width * height / f64::from(3 + order(index));
        Moments {
            values: std::array::from_fn(|index| scale(index) * values[index]),
            errors: std::array::from_fn(|index| {
                let bound = rounding[order(index) as usize] + 4.0 * UNIT_ROUNDOFF * values[index].abs();
                scale(index) * bound * (1.0 + gamma(DENSITY_ROUNDINGS))
            }),
        }
    }
}

/// Returns what the errors of a rule move the mean of a density by, relative to a bound on its size: that of its
/// weights, and of its nodes x by the slope, which is at most `slope` / √(1 − x²).
fn moved_nodes(slope: f64) -> f64 {
    RULE_ERROR * (1.0 + MEAN_OF_SLOPES * slope)
}

/// An upper bound on the mean of 1 / √(1 − x²) at the nodes of a rule, π / 2 in the limit of many.
const MEAN_OF_SLOPES: f64 = 2.0;

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::area::gauss::MAX_RULE;

    #[test]
    fn the_mean_of_slopes_is_bounded_at_the_nodes_of_all_rules() {
        for count in 1..=MAX_RULE {
            let rule = rule(count);
            // x = 2 n − 1 for a node n in [0, 1].
            let terms = rule.nodes.iter().zip(&rule.weights);
            let mean: f64 = terms.map(|(node, weight)| weight / (4.0 * node * (1.0 - node)).sqrt()).sum();
            assert!((0.9..0.8 * MEAN_OF_SLOPES).contains(&mean), "{count}: {mean}");
        }
    }

    /// Lemma V1, attained: the density of x² over (s², s² t, s) has the degree 8 in s, which four nodes are too
    /// few for. With x·N = s⁴ all moments are products of two integrals of powers.
    #[test]
    fn moments_of_the_highest_degree_are_exact() {
        let (squares, ones) = ([0.0, 0.0, 1.0], [0.0, 0.5, 1.0]);
        let control = |i: usize, t: f64| DVec4::new(squares[i], t * squares[i], ones[i], 1.0);
        let controls: Vec<DVec4> = (0..3).flat_map(|i| [0.0, 1.0].map(|t| control(i, t))).collect();
        let found = of_patch(&Patch::whole([2, 1], DVec3::ZERO, &controls), DVec3::ZERO, 0.0);
        let exact = [15.0, 28.0, 56.0, 24.0, 45.0, 135.0, 35.0, 90.0, 80.0, 40.0].map(f64::recip);
        for (index, (interval, exact)) in found.intervals().iter().zip(exact).enumerate() {
            assert!(interval.contains(exact) && interval.width() < 1e-11, "{index}: {interval:?} {exact}");
        }
    }

    /// The rounding of densities: all moments of the cone over a patch in a plane through the origin are 0, while
    /// its terms are not.
    #[test]
    fn the_rounding_of_densities_is_in_the_errors() {
        let random = &mut fastrand::Rng::with_seed(46);
        let mut most = 0;
        for _ in 0..50 {
            // The plane x + 2 y = 3 z, with whole coordinates.
            let mut in_plane = || {
                let [a, b] = [0; 2].map(|_| f64::from(random.i32(-1000..1000)));
                DVec3::new(3.0 * a, 3.0 * b, a + 2.0 * b)
            };
            let center = in_plane();
            let controls = [(); 4].map(|()| in_plane().extend(1.0));
            let found = of_patch(&Patch::whole([1, 1], center, &controls), DVec3::ZERO, 0.0);
            let wrong = found.values.iter().zip(found.errors).filter(|(value, error)| value.abs() > *error);
            assert_eq!(wrong.count(), 0, "{found:?}");
            most = most.max(found.values.iter().filter(|value| **value != 0.0).count());
        }
        assert!(most > COUNT / 2, "{most}");
    }

    /// Lemma V3 for a rim: a square at the height 100 whose sides move outward in its plane sweeps a hundredth of
    /// its volume, and no layer.
    #[test]
    fn what_the_rim_sweeps_is_in_the_errors() {
        let square = |side: f64| {
            let corner = |x: f64, y: f64| DVec4::new(side * (x - 0.5), side * (y - 0.5), 0.0, 1.0);
            [corner(0.0, 0.0), corner(0.0, 1.0), corner(1.0, 0.0), corner(1.0, 1.0)]
        };
        let (height, outward) = (DVec3::new(0.0, 0.0, 100.0), 1e-3);
        let volume = |side: f64, moved: f64| {
            of_patch(&Patch::whole([1, 1], height, &square(side)), DVec3::ZERO, moved).volume()
        };
        let larger = volume(1.0 + 2.0 * outward, 0.0);
        let known = volume(1.0, outward * 2.0_f64.sqrt());
        assert!(known.contains(larger.middle()), "{known:?} {larger:?}");
        assert!(known.width() < 4.0 * (larger.middle() - volume(1.0, 0.0).middle()).abs(), "{known:?}");
    }
}
