//! The bound by heights over a tangent plane of B, for cells that lie on B or nearly so, in
//! whatever parameters.
//!
//! Lemma (3.17 of `docs/method.md`). Let b be a point, P a linear map of space to parameter steps, T two
//! vectors, n a unit vector, `|I - T P - n nᵀ| <= ν` and `|n·T_i| <= ν |T_i|`. Let Y be a box of B's
//! parameters with β, and o_i a bound on how far `β + P (a - b) + (y - β) - P (B(y) - b)` is beyond Y along
//! axis i, for all points a of the cell and all y of Y. For any function `f(b + v) = n·v + v·M v` whose
//! values on the cell differ from those on B(Y) by at most Δ,
//!
//! `d(a, B) <= ((Δ + (ν + μ) l) / (1 - μ_n - ν) + l) / (1 - 6 ν)`, `l = |T_s| o_s + |T_t| o_t`,
//!
//! `μ = |M| r`, `μ_n = |M n| r`, r the sum of the largest distances of the cell's points and of those of B(Y)
//! from b, if `μ <= 1` and `μ_n + ν <= 1/2`.
//!
//! Lemma (3.18). Where B is a trimmed face's whole surface, the bound holds for the face if the box of the
//! fixed points' ranges lies in the face's region.
//!
//! The feet are fixed points (Brouwer), so that no map of the cell into B's parameters is needed. With f that
//! vanishes on a plane, a sphere, a cylinder or a cone, A and B on it are at no distance however their
//! parameters run.

mod fit;
mod frame;
#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod over_faces;
mod piece;
mod quadric;
mod rim;
#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod terms;
#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests;

use crate::certified::cell_context::{CellContext, UpperBound};
use crate::certified::faces::FaceChart;
use crate::certified::rounding::gamma;
use crate::certified::sheets::Chart;
use crate::rounding::upper_max;
use fit::{Fit, ORDERS, POINTS_ALONG};
use frame::{Frame, Image, Part, Placement};
use glam::{DVec3, Vec4Swizzles};
use piece::Piece;
use quadric::{Cubic, Quadric};

/// The largest distance of a cell from B, relative to the cell's radius, at which it is tried.
const MAX_DISTANCE: f64 = 0.0625;

/// The largest height of a first or second order by which a cell may leave B, relative to the threshold.
const MAX_SLOPE: f64 = 4.0;

/// The part of the threshold, for each order, by which a function may vary over a cell: no closer one of that
/// order is looked for.
const SUFFICIENT_SPREAD: f64 = 0.125;

/// The largest length of `T o`, relative to the threshold, that is not looked at more closely.
const MAX_BEYOND: f64 = 0.125;

/// The bound from the nearest known foot. O(p² q²) for each patch of B that is touched.
pub(super) struct Heights;

impl UpperBound for Heights {
    fn evaluate(&self, context: &mut CellContext<'_>, threshold: f64) -> Option<f64> {
        let foot = context.foot();
        let is_near = foot.distance() <= threshold && foot.distance() <= MAX_DISTANCE * context.radius;
        if !is_near {
            return None;
        }
        let chart = Chart::new(context.pair.b.sheets?, foot.patch, foot.parameters);
        let over_face = context.pair.b.faces.and_then(|faces| {
            let face = faces.chart(&chart)?;
            let bound = over(context, face.chart, threshold, Some(&face))?;
            Some(bound + face.point_error)
        });
        over_face.or_else(|| over(context, chart, threshold, None))
    }
}

/// The bound over the part of B in a chart, of a face where it is that of one; `None` where a point of B that
/// is compared with the cell may be beyond the face.
fn over(
    context: &CellContext<'_>,
    chart: Chart<'_>,
    threshold: f64,
    face: Option<&FaceChart<'_>>,
) -> Option<f64> {
    let frame = Frame::new(chart)?;
    if !leaves_slowly(context, &frame, threshold) {
        return None;
    }
    let a = piece_of_a(context, &frame);
    let (image, placement) = frame.image(&a)?;
    let mut over = Over { frame: &frame, a: &a, image: &image, placement, overrun: 0.0 };
    let is_held = |over: &Over<'_>| face.is_none_or(|face| face.holds(over.placement.feet));
    if over.beyond() > MAX_BEYOND * threshold || !is_held(&over) {
        let linear_lag = over.placement.lag;
        over.placement = frame.closer_placement(&a, &image);
        if !is_held(&over) {
            over.overrun = rim::overrun(&over, face?, linear_lag, threshold)?;
        }
    }
    let rest = threshold - over.overrun;
    if !(over.beyond() <= rest) {
        return None;
    }
    Some(over.least_bound(rest) + over.overrun)
}

/// Whether the derivatives of A's height over B up to second order may let a bound reach the threshold.
fn leaves_slowly(context: &CellContext<'_>, frame: &Frame<'_>, threshold: f64) -> bool {
    let (a, [h, k]) = (&context.jet, context.cell.half);
    let [s, t] = [h * a.s, k * a.t];
    let paraboloid = frame.osculating(frame.normal);
    let height = |vector: DVec3| frame.normal.dot(vector);
    let second = |own: DVec3, x: DVec3, y: DVec3| 0.5 * height(own) + x.dot(paraboloid.form * y);
    let first = height(s).abs() + height(t).abs();
    let [ss, st, tt] = [second(h * h * a.ss, s, s), second(h * k * a.st, s, t), second(k * k * a.tt, t, t)];
    first <= MAX_SLOPE * threshold && ss.abs() + 2.0 * st.abs() + tt.abs() <= MAX_SLOPE * threshold
}

/// The cell about the foot.
fn piece_of_a(context: &CellContext<'_>, frame: &Frame<'_>) -> Piece {
    let (patch, transform) = (&context.patch, &context.pair.transform);
    let [s, t] = context.cell.ranges();
    let mut controls = patch.restricted(s, t);
    for control in &mut controls {
        *control = transform.rotate(control.xyz()).extend(control.w);
    }
    let shift = frame.jet.point - transform.apply(patch.center);
    Piece::new(patch.degree, controls, shift, context.patch_bounds().radius)
}

/// A cell and the part of B over it.
struct Over<'a> {
    frame: &'a Frame<'a>,
    a: &'a Piece,
    image: &'a Image,
    placement: Placement,
    /// How far the points of B that are compared with the cell's may be from its face.
    overrun: f64,
}

impl Over<'_> {
    /// l of the lemma.
    fn beyond(&self) -> f64 {
        (0..2).map(|axis| self.frame.tangents[axis].length() * self.placement.overshoot[axis]).sum()
    }

    /// The least bound, or the first that is at most the threshold, by functions of rising order.
    fn least_bound(&self, threshold: f64) -> f64 {
        let plane = Cubic::of(Quadric::of_plane(self.frame.normal));
        let mut least = self.upper_bound(&plane, threshold);
        if least <= threshold {
            return least;
        }
        let samples = self.a.samples(POINTS_ALONG);
        let Some(mut fit) = Fit::new(self.frame.normal, self.frame.tangents[0], &samples) else {
            return least;
        };
        let mut sufficient = threshold;
        for terms in ORDERS {
            sufficient *= SUFFICIENT_SPREAD;
            fit.add(terms, sufficient);
            let function = fit.function();
            if fit.spread() > threshold {
                continue;
            }
            let bound = self.upper_bound(&function, threshold);
            least = if bound < least { bound } else { least };
            if least <= threshold {
                break;
            }
        }
        least
    }

    /// The lemma's bound; infinite where it does not apply or is not expected to reach the threshold.
    fn upper_bound(&self, function: &Cubic, threshold: f64) -> f64 {
        let Self { frame: &Frame { skew, normal, tangents, .. }, a, .. } = *self;
        let is_quadric = function.size() == 0.0;
        let range = |piece: &Piece| {
            if is_quadric { piece.values(&function.quadric) } else { piece.values_of_cubic(function) }.range()
        };
        let [low, high] = range(a);
        if high - low > 2.0 * threshold {
            return f64::INFINITY;
        }
        let (mut difference, mut radius) = (0.0_f64, 0.0_f64);
        for Part { piece, .. } in &self.image.parts {
            let [least, largest] = range(piece);
            difference = upper_max(difference, upper_max(largest - low, high - least));
            radius = upper_max(radius, piece.radius);
        }
        let reach = a.radius + radius;
        let Quadric { linear, form } = function.quadric;
        let tilt = linear - normal;
        let turn = tilt.length() + function.quadric.size() * reach + function.size() * reach * reach;
        let turn_of_normal = normal.dot(tilt).abs()
            + (form * normal).length() * reach
            + function.size_along(normal) * reach * reach
            + gamma(TURN_ROUNDINGS) * (1.0 + turn);
        let bend: f64 =
            (0..2).map(|axis| tangents[axis].length() * self.placement.functions[axis].size() * reach).sum();
        let beyond = self.beyond();
        let shrunk = 1.0 - turn_of_normal;
        let rest = 1.0 - bend - skew - (skew * (1.0 + bend) + turn * (bend + skew)) / shrunk;
        let applies = turn <= 1.0 && turn_of_normal <= 0.5 && rest >= 0.5;
        if !applies {
            return f64::INFINITY;
        }
        ((difference + (skew + turn) * beyond) / shrunk + beyond) / rest
    }
}

/// Roundings of the turns, relative to the sizes of their terms.
const TURN_ROUNDINGS: f64 = 64.0;
