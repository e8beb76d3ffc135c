//! The difference of a cell and one patch of B under a projective map of each parameter.
//!
//! Lemma (3.20 of `docs/method.md`). The map `x = c t / (1 - t + c t)`, c > 0, takes [0, 1] onto itself, and a
//! rational Bézier curve of x with homogeneous controls Y_i to that of t with the controls `c^i Y_i`. So under
//! such a map of either parameter B has the degrees that it has without, and 3.8 applies: exactly where A and
//! B are the same points with weights that are apart by a projective map, as those of conics and of surfaces
//! that are rational along their lines.

use super::super::orientation::Orientation;
use super::net::Net;
use crate::axis::Axis;
use crate::bezier::Patch;
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
