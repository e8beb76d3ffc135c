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

mod frame;
#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod over_faces;
mod quadric;
#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests;

use crate::certified::cell_context::{CellContext, UpperBound};
use crate::certified::sheets::Chart;
use crate::rounding::upper_max;
use frame::Frame;
use glam::{DMat3, DVec3, Vec4Swizzles};
use quadric::{Piece, Quadric};

/// The largest distance of a cell from B, relative to the cell's radius, at which it is tried.
const MAX_DISTANCE: f64 = 0.0625;

/// The largest height of a first or second order by which a cell may leave B, relative to the threshold.
const MAX_SLOPE: f64 = 4.0;

/// The part of the sum of the eigenvalues that is added to the normal equations of a tilt.
const REGULARIZATION: f64 = 1e-12;

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
            let bound = over(context, face.chart, threshold, |feet| face.holds(feet))?;
            Some(bound + face.point_error)
        });
        over_face.or_else(|| over(context, chart, threshold, |_| true))
    }
}

/// The bound over the part of B in a chart; `None` where not all feet, by the ranges of their parameters,
/// belong to B.
fn over(
    context: &CellContext<'_>,
    chart: Chart<'_>,
    threshold: f64,
    holds: impl FnOnce([[f64; 2]; 2]) -> bool,
) -> Option<f64> {
    let frame = Frame::new(chart)?;
    if !leaves_slowly(context, &frame, threshold) {
        return None;
    }
    let a = piece_of_a(context, &frame);
    let image = frame.image(&a)?;
    let beyond: f64 = (0..2).map(|axis| frame.tangents[axis].length() * image.overshoot[axis]).sum();
    let is_over = beyond <= threshold && holds(image.feet);
    if !is_over {
        return None;
    }
    let over = Over { skew: frame.skew, beyond, a: &a, b: &image.pieces };
    let mut least = over.upper_bound(&frame.plane());
    let at_center = frame.normal.dot(context.jet.point - frame.jet.point);
    for level in 0..2 {
        if least <= threshold {
            break;
        }
        let paraboloid = frame.paraboloid();
        let quadric = if level == 0 { paraboloid } else { tilted(&paraboloid, &a, at_center) };
        let bound = over.upper_bound(&quadric);
        least = if bound < least { bound } else { least };
    }
    Some(least)
}

/// Whether the derivatives of A's height over B up to second order may let a bound reach the threshold.
fn leaves_slowly(context: &CellContext<'_>, frame: &Frame<'_>, threshold: f64) -> bool {
    let (a, [h, k]) = (&context.jet, context.cell.half);
    let [s, t] = [h * a.s, k * a.t];
    let paraboloid = frame.paraboloid();
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
    skew: f64,
    /// l of the lemma.
    beyond: f64,
    a: &'a Piece,
    b: &'a [Piece],
}

impl Over<'_> {
    /// The lemma's bound; infinite where it does not apply.
    fn upper_bound(&self, quadric: &Quadric) -> f64 {
        let &Self { skew, beyond, a, b } = self;
        let ranges = |piece: &Piece| {
            if quadric.form == DMat3::ZERO { piece.range(quadric.normal) } else { piece.range_of(quadric) }
        };
        let [low, high] = ranges(a);
        let (mut difference, mut radius) = (0.0_f64, 0.0_f64);
        for piece in b {
            let [least, largest] = ranges(piece);
            difference = upper_max(difference, upper_max(largest - low, high - least));
            radius = upper_max(radius, piece.radius);
        }
        let reach = a.radius + radius;
        let turn = quadric.size() * reach;
        let turn_of_normal = ROUNDED_UP * (quadric.form * quadric.normal).length() * reach;
        let applies = turn <= 1.0 && turn_of_normal + skew <= 0.5;
        if !applies {
            return f64::INFINITY;
        }
        let height = (difference + (skew + turn) * beyond) / (1.0 - turn_of_normal - skew);
        (height + beyond) / (1.0 - 6.0 * skew)
    }
}

/// A factor that covers the rounding of the product of a matrix with a vector beside the norm of either.
const ROUNDED_UP: f64 = 1.0 + 1e-12;

/// A paraboloid with `(n·Y) (c·Y)` added, by which the corners of a cell of A come closest to the value at
/// the cell's centre.
fn tilted(paraboloid: &Quadric, a: &Piece, at_center: f64) -> Quadric {
    let (mut matrix, mut right) = (DMat3::ZERO, DVec3::ZERO);
    for corner in a.corners() {
        let row = paraboloid.normal.dot(corner) * corner;
        matrix += DMat3::from_cols(row.x * row, row.y * row, row.z * row);
        right -= (paraboloid.value(corner) - at_center) * row;
    }
    let trace = matrix.x_axis.x + matrix.y_axis.y + matrix.z_axis.z;
    let c = (matrix + DMat3::from_diagonal(DVec3::splat(REGULARIZATION * trace))).inverse() * right;
    if c.is_finite() { paraboloid.tilted(c) } else { *paraboloid }
}
