//! The boundary of a face as arcs of increasing v between snapped ends.

use super::curve::{Curve, divided};
use super::face::{Face, V_ROUNDING};
use super::graph::{self, Graph};
use super::polynomial::polynomial_pieces;
use crate::axis::Axis;
use glam::{DVec2, DVec3};

/// One side of a cell.
#[derive(Debug, Clone)]
pub(super) enum Side {
    /// A polynomial graph over v.
    Graph(Graph),
    /// A curve in its own parameter, with v increasing.
    Own(Curve),
}

/// A part of the boundary on which v increases.
#[derive(Debug, Clone)]
pub(super) struct Arc {
    pub(super) side: Side,
    /// The values of v at its ends, the first smaller.
    pub(super) v: [f64; 2],
    /// The change of the winding number from its left to its right; 0 for a knot line.
    pub(super) change: i32,
}

/// A part of the boundary on which v is constant after snapping.
#[derive(Debug, Clone, Copy)]
pub(super) struct Flat {
    pub(super) v: f64,
    pub(super) u: [f64; 2],
}

/// The boundary of a face, ready for the sweep.
pub(super) struct Boundary {
    pub(super) arcs: Vec<Arc>,
    pub(super) flats: Vec<Flat>,
    /// The values of v at which an arc crosses a knot line of u.
    pub(super) crossings: Vec<f64>,
    /// The largest moves of boundary points in u and v, by snapping and by polynomial pieces.
    pub(super) moved: [f64; 2],
    /// The largest error in u of a graph.
    pub(super) graph_error: f64,
}

/// An arc in the order of its loop, before chains of arcs are joined.
struct Run {
    curve: Curve,
    /// -1 for increasing v in the loop's direction, 1 for decreasing.
    change: i32,
}

/// The largest sine of the angle between the tangents of arcs that are joined.
const MAX_JOINT_SINE: f64 = 0.02;

/// The number of halvings that prove a curve monotone.
const MAX_MONOTONE_DEPTH: usize = 40;

/// The degree up to which boundaries of affine faces stay as they are.
const MAX_EXACT_DEGREE: usize = 3;

/// The largest degree of a composition with a curve in its own parameter.
const MAX_COMPOSED_DEGREE: usize = 120;

/// Splits the loops where v is stationary and at knots, snaps the ends, and joins chains
/// to graphs. `Err` says in words what prevents it.
pub(super) fn boundary(face: &Face) -> Result<Boundary, String> {
    let loops: Vec<Vec<Curve>> = face
        .loops
        .iter()
        .map(|curves| curves.iter().flat_map(|curve| split(face, curve)).collect())
        .collect();
    let snapper = Snapper::new(face, loops.iter().flatten());
    let mut boundary = Boundary {
        arcs: Vec::new(),
        flats: Vec::new(),
        crossings: Vec::new(),
        moved: [0.0; 2],
        graph_error: 0.0,
    };
    for curves in &loops {
        // Each loop as runs of one direction, `None` where v is constant.
        let mut runs: Vec<Option<Run>> = Vec::with_capacity(curves.len());
        for (curve, next) in curves.iter().zip(curves.iter().cycle().skip(1)) {
            runs.push(boundary.anchored(face, &snapper, curve, [curve.start(), next.start()])?);
        }
        let ends_chain = |index: usize| match (&runs[(index + runs.len() - 1) % runs.len()], &runs[index]) {
            (Some(before), Some(after)) => before.change != after.change || !is_smooth(face, before, after),
            _ => true,
        };
        let first = (0..runs.len()).find(|&index| ends_chain(index)).unwrap_or(0);
        let breaks: Vec<bool> = (0..runs.len()).map(|k| ends_chain((first + k) % runs.len())).collect();
        runs.rotate_left(first);
        let mut chain: Vec<Run> = Vec::new();
        for (run, begins) in runs.into_iter().zip(breaks) {
            if begins {
                boundary.add_chain(face, std::mem::take(&mut chain))?;
            }
            chain.extend(run);
        }
        boundary.add_chain(face, chain)?;
    }
    Ok(boundary)
}

/// Splits a curve at stationary v and at knot lines.
fn split(face: &Face, curve: &Curve) -> Vec<Curve> {
    let mut parameters = vec![0.0, 1.0];
    let hull = curve.hull();
    // What is flat is not split for its waves.
    if curve.degree() > 1 && hull[1].y - hull[0].y > 0.5 * face.tolerances.snap[1] {
        parameters.extend(super::curve::roots(&curve.rise()));
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
    parameters.sort_by(f64::total_cmp);
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
fn is_smooth(face: &Face, before: &Run, after: &Run) -> bool {
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

impl Boundary {
    /// Moves the curve's ends to the snapped places of two vertices of its loop; flat
    /// curves are noted and give `None`.
    fn anchored(
        &mut self,
        face: &Face,
        snapper: &Snapper,
        curve: &Curve,
        [from, to]: [DVec2; 2],
    ) -> Result<Option<Run>, String> {
        let [new_from, new_to] = [snapper.snapped(from), snapper.snapped(to)];
        for (old, new) in [(from, new_from), (to, new_to)] {
            let shift = (new - old).abs();
            self.moved = [self.moved[0].max(shift.x), self.moved[1].max(shift.y)];
            if snapper.is_knot(new.x) {
                self.crossings.push(new.y);
            }
        }
        if new_from.y == new_to.y {
            let [low, high] = curve.hull();
            self.moved[1] = self.moved[1].max(high.y - new_from.y).max(new_from.y - low.y);
            if self.moved[1] > face.tolerances.snap[1] * 4.0 {
                // Only a curve whose rise could not be resolved comes here.
                return Err(format!("a curve near ({}, {}) that turns back", from.x, from.y));
            }
            let u = [low.x.min(new_from.x).min(new_to.x), high.x.max(new_from.x).max(new_to.x)];
            self.flats.push(Flat { v: new_from.y, u });
            return Ok(None);
        }
        let is_up = new_to.y > new_from.y;
        let mut curve = if is_up { curve.clone() } else { curve.reversed() };
        let (low, high) = if is_up { (new_from, new_to) } else { (new_to, new_from) };
        let [hull_low, hull_high] = curve.hull();
        let [snap_u, snap_v] = face.tolerances.snap;
        let on_knot = low.x == high.x && snapper.is_knot(low.x);
        if on_knot && hull_low.x >= low.x - snap_u && hull_high.x <= low.x + snap_u {
            self.moved[0] = self.moved[0].max(low.x - hull_low.x).max(hull_high.x - low.x);
            curve = Curve::line(low, high);
        } else {
            anchor(&mut curve, low, high);
        }
        if !rises(&curve, V_ROUNDING, MAX_MONOTONE_DEPTH) {
            // A dip within the tolerance counts as a move by it.
            self.moved[1] = self.moved[1].max(snap_v);
        }
        if !rises(&curve, snap_v, MAX_MONOTONE_DEPTH) {
            return Err(format!("a curve near ({}, {}) that turns back", from.x, from.y));
        }
        Ok(Some(Run { curve, change: if is_up { -1 } else { 1 } }))
    }

    /// Adds a chain of runs of one direction, in the order of their loop.
    fn add_chain(&mut self, face: &Face, mut chain: Vec<Run>) -> Result<(), String> {
        let Some(first) = chain.first() else { return Ok(()) };
        let change = first.change;
        if change > 0 {
            chain.reverse();
        }
        let curves: Vec<Curve> = chain.into_iter().map(|run| run.curve).collect();
        self.add_curves(face, &curves, change)
    }

    /// Adds curves of increasing v head to tail as one graph, or as the graphs of their halves.
    fn add_curves(&mut self, face: &Face, curves: &[Curve], change: i32) -> Result<(), String> {
        let v = [curves[0].start().y, curves[curves.len() - 1].end().y];
        let is_exact = curves.len() == 1
            && face.affine
            && curves[0].degree() <= MAX_EXACT_DEGREE
            && !is_straight(&curves[0]);
        if !is_exact && let Some((graph, error)) = graph::fit(curves, face.tolerances.graph) {
            self.graph_error = self.graph_error.max(error);
            self.arcs.push(Arc { side: Side::Graph(graph), v, change });
            return Ok(());
        }
        if curves.len() > 1 {
            let (low, high) = curves.split_at(curves.len() / 2);
            self.add_curves(face, low, change)?;
            return self.add_curves(face, high, change);
        }
        let curve = &curves[0];
        let patch_degree: usize = face.patch([0, 0]).degree.iter().sum();
        let is_cheap = curve.is_polynomial() && curve.degree() * patch_degree <= MAX_COMPOSED_DEGREE;
        if face.affine || is_cheap {
            self.arcs.push(Arc { side: Side::Own(curve.clone()), v, change });
            return Ok(());
        }
        let (pieces, error) = polynomial_pieces(curve, face.tolerances.snap)?;
        self.moved = [0, 1].map(|axis| self.moved[axis].max(error[axis]));
        for piece in pieces {
            let v = [piece.start().y, piece.end().y];
            self.arcs.push(Arc { side: Side::Own(piece), v, change });
        }
        Ok(())
    }
}

/// Returns whether all controls lie on the line between the ends, up to a few roundings.
fn is_straight(curve: &Curve) -> bool {
    let (start, end) = (curve.start(), curve.end());
    let chord = end - start;
    let allowed = 16.0 * f64::EPSILON * chord.length();
    curve.controls.iter().all(|&control| chord.perp_dot(divided(control) - start).abs() <= allowed)
}

/// Moves the ends of a curve of increasing v to `low` and `high` by an affine map.
///
/// v is mapped affinely, and u is sheared along v, so that each point moves by at most
/// as much as an end does.
fn anchor(curve: &mut Curve, low: DVec2, high: DVec2) {
    let (start, end) = (curve.start(), curve.end());
    if start == low && end == high {
        return;
    }
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
}

/// Moves coordinates to knots and common values.
struct Snapper {
    /// The values of v that occur, increasing, with those that represent them.
    v: Vec<(f64, f64)>,
    /// The knots in u, and the distance within which a value is moved to one.
    knots: Vec<f64>,
    snap_u: f64,
}

impl Snapper {
    /// Clusters the values of v at the ends of `curves`: knots represent what is near
    /// them, and the first of a cluster what follows it within the tolerance.
    fn new<'a>(face: &Face, curves: impl Iterator<Item = &'a Curve>) -> Self {
        let [snap_u, snap_v] = face.tolerances.snap;
        let mut values: Vec<f64> = curves.flat_map(|curve| [curve.start().y, curve.end().y]).collect();
        values.sort_by(f64::total_cmp);
        values.dedup();
        let mut first = f64::NEG_INFINITY;
        let v = values
            .into_iter()
            .map(|value| {
                let knot = nearest(&face.breaks[1], value);
                if (knot - value).abs() <= snap_v {
                    return (value, knot);
                }
                if value - first > snap_v {
                    first = value;
                }
                (value, first)
            })
            .collect();
        Self { v, knots: face.breaks[0].clone(), snap_u }
    }

    fn snapped(&self, point: DVec2) -> DVec2 {
        let knot = nearest(&self.knots, point.x);
        let x = if (knot - point.x).abs() <= self.snap_u { knot } else { point.x };
        let index = self.v.partition_point(|&(value, _)| value < point.y).min(self.v.len() - 1);
        DVec2::new(x, self.v[index].1)
    }

    fn is_knot(&self, u: f64) -> bool {
        nearest(&self.knots, u) == u
    }
}

/// Returns the nearest of these increasing values.
fn nearest(values: &[f64], value: f64) -> f64 {
    let after = values.partition_point(|&other| other < value);
    let low = values[after.saturating_sub(1)];
    let high = values[after.min(values.len() - 1)];
    if value - low <= high - value { low } else { high }
}
