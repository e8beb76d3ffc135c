//! Feet that slide along B by the tangential part of a difference.
//!
//! A fit keeps neither the parameters nor the feet of its surface: `D = A - B∘φ` is often
//! many times as long along B as it is across, and only the latter counts.
//!
//! Lemma (sliding feet, 3.15 of docs/method.md). Let φ map a piece to a box of a surface's
//! parameters, let `P` be any linear map of space to parameter steps, `δ = P D`, and let δ' be δ
//! with each parameter of φ + δ clamped to a box in which the surface lies and φ does. Let o_i bound how far φ_i + δ_i is beyond
//! that box. With T the surface's derivatives at the middle of the image and `N = I - T P`,
//!
//! `d(·, B) <= max |N D| + |T_s| o_s + |T_t| o_t + max |B(φ + δ') - B(φ) - T δ'|` ,
//!
//! The lemma on steps over seams ([`Chart::step_error`]) bounds the last term, for
//! |δ'_i| <= |δ_i|.
//!
//! With homogeneous coefficients n_k of D and d_k > 0 of its denominator, `max |N D|` is at most the
//! largest `|N n_k| / d_k`, and `max |δ_i|` the largest `|(P n_k)_i| / d_k`, as N and P are linear.
//! φ_i runs from e to f along one axis, of degree p. Its product with the denominator has degree p + 1, and
//! the values of φ_i + δ_i are convex combinations of
//! `((p + 1 - k) (e d_k + (P n_k)_i) + k (f d_{k-1} + (P n_{k-1})_i)) / ((p + 1 - k) d_k + k d_{k-1})`.
//!
//! With P the pseudo-inverse of T, N projects on the normal, and the excess over the part of D across
//! B is the turn of B's tangents over the piece times the part along it: of second order where
//! |D| is of first.

#[cfg(all(test, not(target_arch = "wasm32")))]
mod attained;

use super::orientation::Orientation;
use crate::axis::Axis;
use crate::certified::reparametrization::pseudo_inverse;
use crate::certified::rounding::{UNIT_ROUNDOFF, gamma};
use crate::certified::sheets::{Chart, Over};
use crate::rounding::upper_max;
use glam::{DVec3, DVec4, Vec4Swizzles};

/// Roundings of `N n_k / d_k`, relative to the sizes of its terms: one of the quotient, three of a dot
/// product, a product and two sums, and the length's.
const RESIDUAL_ROUNDINGS: f64 = 16.0;

/// Roundings of a value of φ + δ, relative to the sizes of its terms.
const PLACE_ROUNDINGS: f64 = 16.0;

/// The error of steps by derivatives over whole patches, relative to what the threshold leaves, up to
/// which it is computed over boxes: these cost more than the piece, and are seldom closer by more.
const MAX_EXCESS: f64 = 4.0;

/// The distance from the ends of a surface at which the rounding of a place is inside.
const MARGIN: f64 = 16.0 * UNIT_ROUNDOFF;

/// A factor by which boxes, steps and sums of bounds are widened for their rounding.
const WIDENED: f64 = 1.0 + 16.0 * UNIT_ROUNDOFF;

/// The image of a piece on a surface of B, and the tangents about which feet slide.
#[derive(Debug)]
pub(super) struct Sliding<'a> {
    /// About the middle of the image.
    chart: Chart<'a>,
    /// Half the widths of the image.
    half: [f64; 2],
    /// The parameters at the start and the end of A's ranges, and the axes of A, by B's axes.
    ends: [[f64; 2]; 2],
    axes: [Axis; 2],
    tangents: [DVec3; 2],
    /// The rows of P.
    inverse: [DVec3; 2],
}

impl<'a> Sliding<'a> {
    /// Takes the image of a piece in the patch at an offset from that of a chart:
    /// by B's axes, from the start to the end of A's ranges.
    pub(super) fn new(
        chart: &Chart<'a>,
        offsets: [isize; 2],
        ends: [[f64; 2]; 2],
        orientation: Orientation,
    ) -> Self {
        let middle = ends.map(|[start, end]| 0.5 * (start + end));
        let half = [0, 1].map(|axis| {
            let [to_start, to_end] = ends[axis].map(|end| (end - middle[axis]).abs());
            WIDENED * to_start.max(to_end)
        });
        let chart = chart.moved(offsets, middle);
        let jet = chart.jet();
        let axes = if orientation.swapped { [Axis::V, Axis::U] } else { Axis::BOTH };
        let tangents = [jet.s, jet.t];
        Self { chart, half, ends, axes, tangents, inverse: pseudo_inverse(tangents) }
    }

    /// `N` times a vector: the vector without its part along the tangents.
    pub(super) fn residual(&self, vector: DVec3) -> DVec3 {
        let [along_s, along_t] = self.inverse.map(|row| row.dot(vector));
        vector - along_s * self.tangents[0] - along_t * self.tangents[1]
    }

    /// The lemma's bound, given the homogeneous coefficients of D, if it is at most `threshold`.
    /// O(p q).
    pub(super) fn upper_bound(&self, degree: [usize; 2], quotient: &[DVec4], threshold: f64) -> Option<f64> {
        let [mut residual, mut longest] = [0.0_f64; 2];
        for control in quotient {
            let difference = control.xyz() / control.w;
            residual = upper_max(residual, self.residual(difference).length());
            longest = upper_max(longest, difference.length());
        }
        let sizes = self.inverse.map(DVec3::length);
        let [s, t] = [0, 1].map(|axis| sizes[axis] * self.tangents[axis].length());
        let residual = residual + gamma(RESIDUAL_ROUNDINGS * (1.0 + s + t)) * longest;
        let is_small = residual <= threshold;
        if !is_small {
            return None;
        }
        let steps = self.steps(quotient, longest);
        let extent = [0, 1].map(|axis| WIDENED * (self.half[axis] + steps[axis]));
        let reach = self.chart.reach_over_creases(extent);
        let mut bound = residual;
        for (axis, extent) in extent.into_iter().enumerate() {
            let (domain, at) = (reach.domain[axis], self.chart.parameters[axis]);
            let is_inside = domain[0] + MARGIN <= at - extent && at + extent <= domain[1] - MARGIN;
            if !is_inside {
                let beyond = self.overshoot(axis, degree, quotient, domain);
                bound += WIDENED * beyond * self.tangents[axis].length();
            }
        }
        let error = |over| self.chart.step_error(&reach, self.half, steps, over);
        let mut of_steps = error(Over::Patches);
        let margin = threshold - bound;
        if of_steps > margin && of_steps <= MAX_EXCESS * margin {
            of_steps = error(Over::Boxes);
        }
        let bound = WIDENED * (bound + of_steps);
        (bound <= threshold).then_some(bound)
    }

    /// Bounds on |δ_i|, no difference being longer than `longest`. O(p q).
    pub(super) fn steps(&self, quotient: &[DVec4], longest: f64) -> [f64; 2] {
        self.inverse.map(|row| {
            let step = |control: &DVec4| row.dot(control.xyz() / control.w).abs();
            let rounding = gamma(RESIDUAL_ROUNDINGS) * row.length() * longest;
            quotient.iter().map(step).fold(0.0, upper_max) + rounding
        })
    }

    /// How far a parameter of φ + δ is beyond the domain, at most. O(p q).
    pub(super) fn overshoot(
        &self,
        axis: usize,
        degree: [usize; 2],
        quotient: &[DVec4],
        domain: [f64; 2],
    ) -> f64 {
        let (row, [start, end]) = (self.inverse[axis], self.ends[axis]);
        let order = degree[self.axes[axis]] + 1;
        let columns = degree[1] + 1;
        // The coefficients along A's axis, line by line.
        let (lines, between, step) = match self.axes[axis] {
            Axis::U => (columns, 1, columns),
            Axis::V => (degree[0] + 1, columns, 1),
        };
        let (mut beyond, mut size) = (0.0_f64, 0.0_f64);
        for line in 0..lines {
            let at = |k: usize| quotient[line * between + k * step];
            let mut last = None;
            for k in 0..=order {
                let mut sum = [0.0; 2];
                let here = (k < order).then(|| at(k));
                for (control, place, share) in [(here, start, order - k), (last, end, k)] {
                    if let Some(control) = control {
                        let weight = share as f64 * control.w;
                        let parameter = place + row.dot(control.xyz()) / control.w;
                        size = upper_max(size, row.length() * control.xyz().length() / control.w);
                        sum = [sum[0] + weight * parameter, sum[1] + weight];
                    }
                }
                let parameter = sum[0] / sum[1];
                beyond = upper_max(beyond, upper_max(domain[0] - parameter, parameter - domain[1]));
                last = here;
            }
        }
        // Both ends are parameters of a patch.
        beyond + gamma(PLACE_ROUNDINGS) * (1.0 + size)
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::certified::nearest::{Foot, NearestPoint};
    use crate::certified::reparametrization::Reparametrization;
    use crate::certified::testing::{Surfaces, clamped, closed};
    use crate::flatness::Flatness;
    use crate::model::SurfaceArrays;
    use glam::DVec2;

    /// The orientation of the identity, or of the map that exchanges the axes.
    fn orientation(swapped: bool) -> Orientation {
        let map = if swapped {
            Reparametrization { p: DVec2::Y, q: DVec2::X }
        } else {
            Reparametrization { p: DVec2::X, q: DVec2::Y }
        };
        Orientation::new(&map)
    }

    /// The graph z = h(s, t), biquadratic, over the unit square, of these coefficients.
    fn graph(heights: [[f64; 3]; 3]) -> Surfaces {
        let at = [0.0, 0.5, 1.0];
        let points = (0..3).flat_map(|i| (0..3).map(move |j| [at[i], at[j], heights[i][j], 1.0]));
        let knots = clamped(2, &[]);
        let arrays = SurfaceArrays {
            degree: [2, 2],
            counts: [3, 3],
            knots: [knots.clone(), knots],
            control_points: points.collect(),
        };
        Surfaces::new(vec![arrays], Flatness::None)
    }

    /// Coefficients of a difference that is the same everywhere.
    fn constant(difference: DVec3) -> Vec<DVec4> {
        vec![difference.extend(1.0); 4]
    }

    /// A difference along B's tangent at the middle of the image leaves what B bends away from
    /// the tangent: of s² and of t² at the end of the image, of s t at its sides. One of these
    /// terms alone attains the bound.
    #[test]
    fn a_step_along_a_tangent_leaves_the_bend() {
        const BEND: f64 = 0.5;
        const STEP: f64 = 0.05;
        let squares = [[0.0; 3], [0.0; 3], [BEND; 3]];
        let transposed = [[0.0, 0.0, BEND]; 3];
        let twisted = [[0.0; 3], [0.0, 0.25 * BEND, 0.5 * BEND], [0.0, 0.5 * BEND, BEND]];
        // Of s² at s = 3/4: (3/4 + d)² - (3/4)² - 2 (1/2) d.
        let of_square = BEND * STEP * (0.5 + STEP);
        // Of s t at t = 3/4: d (3/4 - 1/2).
        let of_product = BEND * STEP * 0.25;
        for (heights, axis, truth) in [
            (squares, 0, of_square),
            (transposed, 1, of_square),
            (twisted, 0, of_product),
            (twisted, 1, of_product),
        ] {
            let b = graph(heights);
            let chart = Chart::new(b.sheets(), 0, [0.5; 2]);
            for swapped in [false, true] {
                let sliding = Sliding::new(&chart, [0, 0], [[0.25, 0.75]; 2], orientation(swapped));
                let quotient = constant(STEP * sliding.tangents[axis]);
                assert!(sliding.residual(quotient[0].xyz()).length() <= 1e-15);
                let bound = sliding.upper_bound([1, 1], &quotient, truth * (1.0 + 1e-6)).unwrap();
                assert!((truth * (1.0 - 1e-12)..truth * (1.0 + 1e-6)).contains(&bound), "{bound} {truth}");
                assert_eq!(sliding.upper_bound([1, 1], &quotient, truth * (1.0 - 1e-6)), None);
            }
        }
    }

    /// The square [0, 1]² of two patches along x that meet at 1/2. The second rises.
    fn bent(rise: f64) -> Surfaces {
        let points = [[0.0, 0.0], [0.5, 0.0], [1.0, 0.5 * rise]];
        let arrays = SurfaceArrays {
            degree: [1, 1],
            counts: [3, 2],
            knots: [clamped(1, &[0.5]), clamped(1, &[])],
            control_points: points.iter().flat_map(|&[x, z]| [0.0, 1.0].map(|y| [x, y, z, 1.0])).collect(),
        };
        Surfaces::new(vec![arrays], Flatness::None)
    }

    /// A step beyond a crease at the end of the image leaves the rise behind it.
    #[test]
    fn a_step_over_a_crease_leaves_its_rise() {
        const RISE: f64 = 1e-2;
        let b = bent(RISE);
        let chart = Chart::new(b.sheets(), 0, [0.5; 2]);
        let sliding = Sliding::new(&chart, [0, 0], [[0.9, 1.0], [0.25, 0.75]], orientation(false));
        let bound = sliding.upper_bound([1, 1], &constant(0.2 * sliding.tangents[0]), 1.0).unwrap();
        let truth = 0.1 * RISE;
        assert!((truth..truth * (1.0 + 1e-6)).contains(&bound), "{bound} {truth}");
        // And back from the start of the second patch.
        let sliding = Sliding::new(&chart, [1, 0], [[0.0, 0.1], [0.25, 0.75]], orientation(false));
        let bound = sliding.upper_bound([1, 1], &constant(-0.2 * sliding.tangents[0]), 1.0).unwrap();
        assert!((truth..truth * (1.0 + 1e-6)).contains(&bound), "{bound} {truth}");
    }

    /// Feet do not slide beyond an end of a surface: of a difference that points outwards there, all
    /// remains, and of one that grows from the end inwards nothing.
    #[test]
    fn feet_stay_on_the_surface() {
        let b = graph([[0.0; 3]; 3]);
        let chart = Chart::new(b.sheets(), 0, [0.5; 2]);
        for (axis, direction) in [(0, DVec3::X), (1, DVec3::Y)] {
            for (ends, outwards) in
                [([0.5, 1.0], 1.0), ([1.0, 0.5], 1.0), ([0.5, 0.0], -1.0), ([0.0, 0.5], -1.0)]
            {
                for swapped in [false, true] {
                    let mut image = [[0.25, 0.75]; 2];
                    image[axis] = ends;
                    let sliding = Sliding::new(&chart, [0, 0], image, orientation(swapped));
                    let outside = 0.1 * outwards * direction;
                    let bound = sliding.upper_bound([1, 1], &constant(outside), 1.0).unwrap();
                    assert!((0.1..0.1 + 1e-12).contains(&bound), "{bound}");
                    let inside = sliding.upper_bound([1, 1], &constant(-outside), 1.0).unwrap();
                    assert!(inside < 1e-12, "{inside}");
                    // None at the end of the surface: along A's axis that runs along B's.
                    let is_along_s = (axis == 0) != swapped;
                    let at_start = ends[0] == 0.0 || ends[0] == 1.0;
                    let quotient: Vec<DVec4> = (0..4)
                        .map(|index| if is_along_s { index / 2 } else { index % 2 })
                        .map(|end| (if (end == 0) == at_start { DVec3::ZERO } else { outside }).extend(1.0))
                        .collect();
                    let bound = sliding.upper_bound([1, 1], &quotient, 1.0).unwrap();
                    assert!(bound < 1e-12, "{bound}");
                }
            }
        }
    }

    /// No point is farther than the bound: random images on closed surfaces, polynomial and rational,
    /// over seams, and random differences with weights.
    #[test]
    fn no_point_is_farther_than_the_bound() {
        let random = &mut fastrand::Rng::with_seed(16);
        let (mut bounded, mut closer) = (0, 0);
        for case in 0..40 {
            let b = Surfaces::new(vec![closed(300 + case, case % 2 == 1)], Flatness::None);
            let nearest = NearestPoint::new(b.operand());
            for _ in 0..20 {
                let flat = random.u32(0..b.places.count() as u32);
                let chart = Chart::new(b.sheets(), flat, [0.5; 2]);
                let ends = [(); 2].map(|()| {
                    let [start, width] = [random.f64(), 0.3 * random.f64()];
                    let end = (start + if random.bool() { width } else { -width }).clamp(0.0, 1.0);
                    if random.bool() { [start, end] } else { [start, end.round()] }
                });
                if ends.iter().any(|[start, end]| start == end) {
                    continue;
                }
                let swapped = random.bool();
                let sliding = Sliding::new(&chart, [0, 0], ends, orientation(swapped));
                let size = 10.0_f64.powf(-1.0 - 3.0 * random.f64());
                let [s, t] = sliding.tangents.map(DVec3::normalize);
                let normal = s.cross(t).normalize();
                let degree = [random.usize(1..4), random.usize(1..4)];
                let quotient: Vec<DVec4> = (0..(degree[0] + 1) * (degree[1] + 1))
                    .map(|_| {
                        let mut number = || size * (random.f64() - 0.5);
                        let difference = number() * s + number() * t + 0.1 * number() * normal;
                        (0.5 + random.f64()) * difference.extend(1.0)
                    })
                    .collect();
                let Some(bound) = sliding.upper_bound(degree, &quotient, 2.0 * size) else { continue };
                bounded += 1;
                let net = crate::bezier::Patch::whole(degree, DVec3::ZERO, &quotient);
                let mut farthest = 0.0_f64;
                for _ in 0..20 {
                    let place = [random.f64(), random.f64()];
                    let of_b = if swapped { [place[1], place[0]] } else { place };
                    let image =
                        [0, 1].map(|axis| (1.0 - of_b[axis]) * ends[axis][0] + of_b[axis] * ends[axis][1]);
                    let difference = net.point(place);
                    farthest = farthest.max(difference.length());
                    let target = chart.neighbour([0, 0]).point(image) + difference;
                    let foot = nearest.nearest(target, Foot::start(flat, image), 0.0);
                    let foot = nearest.certified(target, foot, 1e-9);
                    assert!(foot.distance() <= bound + 1e-9, "{} {bound} case {case}", foot.distance());
                }
                closer += usize::from(bound < 0.5 * farthest);
            }
        }
        assert!(bounded > 200 && closer > 100, "{bounded} {closer}");
    }
}
