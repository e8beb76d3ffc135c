//! A loop as runs: curves on which v increases or decreases, between snapped vertices.

use super::Flat;
use super::snapper::Snapper;
use crate::axis::Axis;
use crate::sorting::sort_by_number;
use crate::untrim::curve::{Curve, divided, roots};
use crate::untrim::face::{UnitFace, V_ROUNDING};
use glam::{DVec2, DVec3};

/// A curve of increasing v between two vertices, before chains of runs are joined.
pub(super) struct Run {
    pub(super) curve: Curve,
    /// Its vertices, of smaller and of larger v.
    pub(super) ends: [DVec2; 2],
    /// -1 for increasing v in the loop's direction, 1 for decreasing.
    pub(super) change: i32,
    /// Upper bounds on the moves in u and v of its points.
    pub(super) moved: [f64; 2],
}

/// The runs of a loop in its order, `None` where v is constant.
#[derive(Default)]
pub(super) struct Runs {
    pub(super) runs: Vec<Option<Run>>,
    pub(super) flats: Vec<Flat>,
    /// The values of v of the vertices on knot lines of u.
    pub(super) crossings: Vec<f64>,
    /// The largest moves in u and v of a point of the loop.
    pub(super) moved: [f64; 2],
}

/// The largest sine of the angle between the tangents of runs that are joined.
const MAX_JOINT_SINE: f64 = 0.02;

/// The number of halvings that prove a curve monotone.
const MAX_MONOTONE_DEPTH: usize = 40;

/// The height of a flat curve, in snap tolerances: an end may be moved by one, and a rise that
/// cannot be resolved lies within two more.
const MAX_FLAT_SNAPS: f64 = 4.0;

impl Runs {
    /// Moves the ends of a loop's curves to their snapped vertices.
    pub(super) fn of_loop(face: &UnitFace, snapper: &Snapper, curves: &[Curve]) -> Result<Self, String> {
        let mut runs = Self::default();
        for (curve, next) in curves.iter().zip(curves.iter().cycle().skip(1)) {
            let run = runs.run(face, snapper, curve, [curve.start(), next.start()])?;
            runs.runs.push(run);
        }
        Ok(runs)
    }

    /// Moves the curve's ends to the snapped places of two vertices of its loop; flat
    /// curves are noted and give `None`.
    fn run(
        &mut self,
        face: &UnitFace,
        snapper: &Snapper,
        curve: &Curve,
        vertices: [DVec2; 2],
    ) -> Result<Option<Run>, String> {
        let [from, to] = vertices.map(|vertex| snapper.snapped(vertex));
        for vertex in [from, to] {
            if snapper.is_knot(vertex.x) {
                self.crossings.push(vertex.y);
            }
        }
        let shifts = [(from - vertices[0]).abs(), (to - vertices[1]).abs()];
        let shift = shifts[0].max(shifts[1]);
        if from.y == to.y {
            let [low, high] = curve.hull();
            let moved = shift.y.max(high.y - from.y).max(from.y - low.y);
            self.include([shift.x, moved]);
            if moved > face.tolerances.snap[1] * MAX_FLAT_SNAPS {
                // Only a curve whose rise could not be resolved comes here.
                return Err(format!("a curve near ({}, {}) that turns back", from.x, from.y));
            }
            let u = [low.x.min(from.x).min(to.x), high.x.max(from.x).max(to.x)];
            self.flats.push(Flat { v: from.y, u });
            return Ok(None);
        }
        let is_up = to.y > from.y;
        let ends = if is_up { [from, to] } else { [to, from] };
        let mut curve = if is_up { curve.clone() } else { curve.reversed() };
        let [hull_low, hull_high] = curve.hull();
        let [snap_u, snap_v] = face.tolerances.snap;
        let knot = ends[0].x;
        let on_knot = knot == ends[1].x && snapper.is_knot(knot);
        let mut moved = if on_knot && hull_low.x >= knot - snap_u && hull_high.x <= knot + snap_u {
            curve = Curve::line(ends[0], ends[1]);
            [shift.x.max(knot - hull_low.x).max(hull_high.x - knot), shift.y]
        } else {
            anchor(&mut curve, ends)
        };
        if !rises(&curve, V_ROUNDING, MAX_MONOTONE_DEPTH) {
            // A dip within the tolerance counts as a move by it.
            moved[1] += snap_v;
        }
        if !rises(&curve, snap_v, MAX_MONOTONE_DEPTH) {
            return Err(format!("a curve near ({}, {}) that turns back", from.x, from.y));
        }
        self.include(moved);
        Ok(Some(Run { curve, ends, change: if is_up { -1 } else { 1 }, moved }))
    }

    /// Includes moves of points of the loop.
    fn include(&mut self, moved: [f64; 2]) {
        self.moved = [0, 1].map(|axis| self.moved[axis].max(moved[axis]));
    }
}

/// Splits a curve at stationary v and at knot lines.
pub(super) fn split(face: &UnitFace, curve: &Curve) -> Vec<Curve> {
    let mut parameters = vec![0.0, 1.0];
    let hull = curve.hull();
    // What is flat is not split for its waves.
    if curve.degree() > 1 && hull[1].y - hull[0].y > 0.5 * face.tolerances.snap[1] {
        parameters.extend(roots(&curve.rise()));
    }
    for (axis, normal) in [(Axis::U, DVec2::X), (Axis::V, DVec2::Y)] {
        let breaks = &face.breaks[axis];
        let (low, high) = (hull[0][axis.index()], hull[1][axis.index()]);
        for &knot in &breaks[1..breaks.len() - 1] {
            if low < knot && knot < high {
                parameters.extend(curve.crossings(normal, knot));
            }
        }
    }
    sort_by_number(&mut parameters, |parameter| *parameter);
    parameters.dedup();
    let mut parts: Vec<Curve> =
        parameters.windows(2).map(|pair| curve.restricted(pair[0], pair[1])).collect();
    // One joint is one point in floats.
    for index in 1..parts.len() {
        let joint = parts[index].controls[0];
        if let Some(last) = parts[index - 1].controls.last_mut() {
            *last = joint;
        }
    }
    parts
}

/// Returns whether v increases along the curve, but for dips of at most `tolerance`.
fn rises(curve: &Curve, tolerance: f64, depth: usize) -> bool {
    if curve.rise().iter().all(|&value| value >= 0.0) {
        return true;
    }
    let [low, high] = curve.hull();
    if high.y - low.y <= tolerance {
        return true;
    }
    if curve.end().y < curve.start().y - tolerance {
        return false;
    }
    depth > 0
        && [[0.0, 0.5], [0.5, 1.0]]
            .iter()
            .all(|part| rises(&curve.restricted(part[0], part[1]), tolerance, depth - 1))
}

/// Returns whether the tangents agree where the run `after` follows `before`.
pub(super) fn is_smooth(face: &UnitFace, before: &Run, after: &Run) -> bool {
    let scale = DVec2::from(face.lipschitz);
    let tangent = |curve: &Curve, at_end: bool| {
        let controls = &curve.controls;
        let last = controls.len() - 1;
        let ends = if at_end { [last - 1, last] } else { [0, 1] };
        (divided(controls[ends[1]]) - divided(controls[ends[0]])) * scale
    };
    // Both curves are stored with increasing v, whatever the loop's direction.
    let (low, high) = if before.change < 0 { (before, after) } else { (after, before) };
    let (from, to) = (tangent(&low.curve, true), tangent(&high.curve, false));
    from.perp_dot(to).abs() <= MAX_JOINT_SINE * from.length() * to.length()
}

/// Returns whether all controls lie on the line between the ends, up to a few roundings.
pub(super) fn is_straight(curve: &Curve) -> bool {
    let (start, end) = (curve.start(), curve.end());
    let chord = end - start;
    let allowed = 16.0 * f64::EPSILON * chord.length();
    curve.controls.iter().all(|&control| chord.perp_dot(divided(control) - start).abs() <= allowed)
}

/// Moves the ends of a curve of increasing v to two vertices, and returns upper bounds on the
/// moves in u and v of its points: those of the control points, whose weights stay.
///
/// v is mapped affinely, and u is sheared along v, so that each point moves by about
/// as much as an end does.
pub(super) fn anchor(curve: &mut Curve, [low, high]: [DVec2; 2]) -> [f64; 2] {
    let (start, end) = (curve.start(), curve.end());
    if start == low && end == high {
        return [0.0; 2];
    }
    let given = curve.clone();
    let rise = end.y - start.y;
    for control in &mut curve.controls {
        let w = control.z;
        let share = if rise > 0.0 { (control.y - start.y * w) / rise } else { 0.0 };
        control.x += (low.x - start.x) * (w - share) + (high.x - end.x) * share;
        control.y = low.y * (w - share) + high.y * share;
    }
    let last = curve.degree();
    let fixed = |point: DVec2, w: f64| DVec3::new(point.x * w, point.y * w, w);
    curve.controls[0] = fixed(low, curve.controls[0].z);
    curve.controls[last] = fixed(high, curve.controls[last].z);
    let moves = given.controls.iter().zip(&curve.controls).map(|(&a, &b)| (divided(b) - divided(a)).abs());
    moves.fold(DVec2::ZERO, DVec2::max).into()
}
