//! The difference of a cell and one patch of B under a projective map of each parameter.
//!
//! Lemma (3.19 of `docs/method.md`). The map `x = c t / (1 - t + c t)`, c > 0, takes [0, 1] onto itself, and a
//! rational Bézier curve of x with homogeneous controls Y_i to that of t with the controls `c^i Y_i`. So under
//! such a map of either parameter B has the degrees that it has without, and 3.8 applies: exactly where A and
//! B are the same points with weights that are apart by a projective map, as those of conics and of surfaces
//! that are rational along their lines.

use super::super::orientation::Orientation;
use super::net::Net;
use crate::axis::Axis;
use crate::bezier::Patch;
use crate::certified::audit::Lemma;
use crate::certified::cell_context::{CellContext, UpperBound};
use crate::certified::reparametrization::Reparametrization;
use crate::certified::rounding::gamma;
use crate::certified::sheets::Chart;
use crate::closest::newton_below;
use glam::{DVec2, Vec4Swizzles};

/// How far, relative to its length along the parameter lines, a map may run across them.
const MAX_SKEW: f64 = 1e-4;

/// Distance of the centre's foot, in radii of the cell, up to which the bound is tried.
const MAX_DISTANCE_IN_RADII: f64 = 0.0625;

/// Bound on the Newton steps to a foot.
const MAX_ITERATIONS: u32 = 8;

/// The largest factor c, and the distance of c from 1 below which the map is affine.
const MAX_FACTOR: f64 = 16.0;
const MIN_CHANGE: f64 = 1e-7;

/// Roundings of a weight, which moves a point by at most twice the radius times them.
const WEIGHT_ROUNDINGS: f64 = 64.0;

/// The bound by the feet of the cell's centre and of the middles of its sides. O(p^4 q^4).
pub(in crate::certified) struct ProjectiveDifference;

impl UpperBound for ProjectiveDifference {
    fn lemma(&self) -> Lemma {
        Lemma::ProjectiveDifference
    }

    /// `None` where the map does not run along B's parameter lines, or is affine.
    fn evaluate(&self, context: &mut CellContext<'_>, threshold: f64) -> Option<f64> {
        let (foot, pair) = (context.foot(), context.pair);
        let is_near =
            foot.distance() <= threshold && foot.distance() <= MAX_DISTANCE_IN_RADII * context.radius;
        if !is_near {
            return None;
        }
        let chart = Chart::new(pair.b.sheets?, foot.patch, foot.parameters);
        let target = chart.neighbour([0; 2]);
        let map = ProjectiveMap::new(context, &chart, &target, threshold)?;
        let y = map.net(&target, context.jet.point);
        let [s, t] = context.cell.ranges();
        let mut controls = context.patch.restricted(s, t);
        for control in &mut controls {
            *control = pair.transform.rotate(control.xyz()).extend(control.w);
        }
        let center = pair.transform.apply(context.patch.center);
        let x = Net::new(context.patch.degree, controls, context.jet.point - center, 1.0);
        let bound = x.max_difference(&y, threshold)?;
        Some(bound + gamma(WEIGHT_ROUNDINGS) * 2.0 * y.radius)
    }
}

/// A map of the cell along B's parameter lines.
struct ProjectiveMap {
    orientation: Orientation,
    /// The ends of the image and c, by A's axes.
    ends: [[f64; 2]; 2],
    factors: [f64; 2],
}

impl ProjectiveMap {
    fn new(context: &CellContext<'_>, chart: &Chart<'_>, target: &Patch<'_>, threshold: f64) -> Option<Self> {
        let (a, [h, k], jet) = (&context.jet, context.cell.half, chart.jet());
        let tangents = [h * a.s, k * a.t];
        let map = Reparametrization::linearized(&jet, jet.point - a.point, tangents, [false; 2])?;
        let orientation = Orientation::new(&map);
        let (along, across) = (orientation.along(&map), orientation.across(&map));
        let is_aligned = across.abs().max_element() <= MAX_SKEW * along[0].abs().min(along[1].abs());
        if !is_aligned {
            return None;
        }
        let center = DVec2::from_array(chart.parameters);
        let (mut ends, mut factors) = ([[0.0; 2]; 2], [1.0; 2]);
        for axis in Axis::BOTH {
            let (index, on_b) = (axis.index(), orientation.axis_of_b(axis).index());
            for (side, sign) in [-1.0, 1.0].into_iter().enumerate() {
                let mut place = [0.0; 2];
                place[index] = sign;
                let point = context.pair.point_of_a(context.cell.patch, context.cell.at(place));
                let start = (center + sign * [map.p, map.q][index]).clamp(DVec2::ZERO, DVec2::ONE);
                let (foot, _) = newton_below(target, point, start.to_array(), MAX_ITERATIONS, f64::INFINITY);
                if !(foot.distance_squared <= threshold * threshold) {
                    return None;
                }
                ends[index][side] = foot.parameters[on_b];
            }
            let [start, end] = ends[index];
            let fraction = (center[on_b] - start) / (end - start);
            factors[index] = fraction / (1.0 - fraction);
            let is_proper = (MAX_FACTOR.recip()..=MAX_FACTOR).contains(&factors[index])
                && orientation.is_backwards(axis) == (end < start);
            if !is_proper {
                return None;
            }
        }
        let is_affine = factors.iter().all(|factor| (factor - 1.0).abs() < MIN_CHANGE);
        (!is_affine).then_some(Self { orientation, ends, factors })
    }

    /// The net of B over the image in the cell's parameters.
    fn net(&self, target: &Patch<'_>, origin: glam::DVec3) -> Net {
        let Self { orientation, ends, factors } = self;
        let sorted = ends.map(|[start, end]| if start < end { [start, end] } else { [end, start] });
        let [s, t] = orientation.by_axes_of_b(sorted);
        let mut controls = orientation.oriented(&target.restricted(s, t), target.degree);
        let degree = orientation.by_axes_of_b(target.degree);
        for (index, control) in controls.iter_mut().enumerate() {
            let [i, j] = [index / (degree[1] + 1), index % (degree[1] + 1)];
            *control *= factors[0].powi(i as i32) * factors[1].powi(j as i32);
        }
        Net::new(degree, controls, origin - target.center, 1.0)
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::certified::nearest::{Foot, NearestPoint};
    use crate::certified::testing::{Surfaces, clamped};
    use crate::certified::{Cell, Pair};
    use crate::flatness::Flatness;
    use crate::model::{RigidTransform, SurfaceArrays};

    /// The patch with these points and weights, t fastest.
    fn surface(degree: [usize; 2], control_points: Vec<[f64; 4]>) -> Surfaces {
        let arrays = SurfaceArrays {
            degree,
            counts: degree.map(|degree| degree + 1),
            knots: degree.map(|degree| clamped(degree, &[])),
            control_points,
        };
        Surfaces::new(vec![arrays], Flatness::None)
    }

    /// A graph over [0, 3] × [0, 2] with weights.
    fn graph(random: &mut fastrand::Rng, [p, q]: [usize; 2]) -> Vec<[f64; 4]> {
        let place = |i: usize, j: usize| [3.0 * i as f64 / p as f64, 2.0 * j as f64 / q as f64];
        (0..(p + 1) * (q + 1))
            .map(|index| place(index / (q + 1), index % (q + 1)))
            .map(|[x, y]| [x, y, 0.4 * random.f64(), 0.8 + 0.4 * random.f64()])
            .collect()
    }

    /// The same points by projective maps of both parameters, in one of eight orders.
    fn mapped(
        [p, q]: [usize; 2],
        controls: &[[f64; 4]],
        factors: [f64; 2],
        order: usize,
    ) -> ([usize; 2], Vec<[f64; 4]>) {
        let at = |i: usize, j: usize| {
            let [i, j] = [if order & 1 > 0 { p - i } else { i }, if order & 2 > 0 { q - j } else { j }];
            let mut control = controls[i * (q + 1) + j];
            control[3] *= factors[0].powi(i as i32) * factors[1].powi(j as i32);
            control
        };
        if order & 4 > 0 {
            ([q, p], (0..=q).flat_map(|j| (0..=p).map(move |i| (i, j))).map(|(i, j)| at(i, j)).collect())
        } else {
            ([p, q], (0..=p).flat_map(|i| (0..=q).map(move |j| (i, j))).map(|(i, j)| at(i, j)).collect())
        }
    }

    fn evaluate(a: &Surfaces, b: &Surfaces, threshold: f64) -> Option<f64> {
        let pair = Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY };
        let nearest = NearestPoint::new(pair.b);
        let start = nearest.nearest(pair.point_of_a(0, [0.5; 2]), Foot::start(0, [0.5; 2]), 0.0);
        let mut context = CellContext::new(&pair, &nearest, Cell::whole(0), &start);
        ProjectiveDifference.evaluate(&mut context, threshold)
    }

    /// The same points with other weights are at no distance, along either parameter, however it runs; above
    /// them the bound is the height.
    #[test]
    fn projective_changes_of_weights_are_at_no_distance() {
        let random = &mut fastrand::Rng::with_seed(320);
        let mut bounded = 0;
        for case in 0..48 {
            let degree = [[3, 1], [2, 3], [1, 2]][case % 3];
            let factors = [[2.5, 1.0], [1.0, 0.4], [0.6, 1.9]][case / 8 % 3];
            let controls = graph(random, degree);
            let b = surface(degree, controls.clone());
            let (mapped_degree, mut controls) = mapped(degree, &controls, factors, case % 8);
            let Some(on) = evaluate(&surface(mapped_degree, controls.clone()), &b, 1e-6) else { continue };
            bounded += 1;
            assert!(on <= 1e-6, "{on:e} of case {case}");
            for control in &mut controls {
                control[2] += 1e-3;
            }
            let above = evaluate(&surface(mapped_degree, controls), &b, 2e-3);
            assert!(above.is_none_or(|above| (0.9e-3..=1.1e-3).contains(&above)), "{above:?} of case {case}");
        }
        assert!(bounded >= 8, "{bounded}");
    }

    /// The rounding of weights, γ₆₄ of twice the radius, is added to the difference of both nets.
    #[test]
    fn the_rounding_of_weights_is_added() {
        const THRESHOLD: f64 = 2e-3;
        let random = &mut fastrand::Rng::with_seed(322);
        let mut bounded = 0;
        for case in 0..24 {
            let controls = graph(random, [1, 2]);
            let b = surface([1, 2], controls.clone());
            let (degree, mut controls) = mapped([1, 2], &controls, [0.6, 1.9], case % 8);
            for control in &mut controls {
                control[2] += 1e-3;
            }
            let a = surface(degree, controls);
            let pair = Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY };
            let nearest = NearestPoint::new(pair.b);
            let start = nearest.nearest(pair.point_of_a(0, [0.5; 2]), Foot::start(0, [0.5; 2]), 0.0);
            let mut context = CellContext::new(&pair, &nearest, Cell::whole(0), &start);
            let Some(bound) = ProjectiveDifference.evaluate(&mut context, THRESHOLD) else { continue };
            bounded += 1;
            let foot = context.foot();
            let chart = Chart::new(pair.b.sheets.unwrap(), foot.patch, foot.parameters);
            let target = chart.neighbour([0; 2]);
            let map = ProjectiveMap::new(&context, &chart, &target, THRESHOLD).unwrap();
            let y = map.net(&target, context.jet.point);
            let controls = context.patch.restricted([0.0, 1.0], [0.0, 1.0]);
            let x = Net::new(degree, controls, context.jet.point - context.patch.center, 1.0);
            let farthest = y.controls.iter().map(|control| (control.xyz() / control.w).length());
            let lemma = 2.0 * gamma(64.0) * farthest.fold(0.0, f64::max);
            let found = bound - x.max_difference(&y, THRESHOLD).unwrap();
            assert!((found / lemma - 1.0).abs() < 1e-3, "{found:e} {lemma:e}");
        }
        assert!(bounded > 0);
    }

    /// No point is farther than the bound, where points are moved at random.
    #[test]
    fn no_point_is_farther_than_the_bound() {
        let random = &mut fastrand::Rng::with_seed(321);
        let mut bounded = 0;
        for case in 0..100 {
            let degree = [[3, 1], [2, 2]][case % 2];
            let controls = graph(random, degree);
            let b = surface(degree, controls.clone());
            let factors = [0.5 + random.f64(), 0.5 + random.f64()];
            let (mapped_degree, mut controls) = mapped(degree, &controls, factors, case % 8);
            for control in &mut controls {
                for coordinate in &mut control[..3] {
                    *coordinate += 1e-5 * (random.f64() - 0.5);
                }
            }
            let a = surface(mapped_degree, controls);
            let Some(upper) = evaluate(&a, &b, 1.0) else { continue };
            bounded += 1;
            let nearest = NearestPoint::new(b.operand());
            for _ in 0..30 {
                let target = a.operand().patch(0).point([random.f64(), random.f64()]);
                let foot = nearest.nearest(target, Foot::start(0, [0.5; 2]), 0.0);
                assert!(nearest.certified(target, foot, 1e-10).distance() <= upper + 1e-10, "case {case}");
            }
        }
        assert!(bounded > 40, "{bounded}");
    }
}
