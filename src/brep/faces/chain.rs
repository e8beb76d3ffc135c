//! Edges of a wire ordered head to tail, across periods.

use super::uses::TrimUse;
use crate::brep::nurbs::Surface;
use crate::brep::report::FaceFault;
use glam::DVec3;

/// Curves head to tail, and the periods by which the end lies from the start.
#[derive(Debug, Clone)]
pub(super) struct Chain {
    pub(super) uses: Vec<TrimUse>,
    /// The turns of u and of v from start to end; `[0, 0]` is a closed loop.
    pub(super) turns: [i32; 2],
}

/// The most curves of a wire that are put in order, which takes time in proportion to
/// the square of their number. A wire in order may have any number.
const MAX_DISORDERED: usize = 2000;

/// The most walks of which a loop is put together, as each takes a search of all joints.
const MAX_CIRCUITS: usize = 64;

/// The largest distance between the ends of neighbouring curves, relative to the size of
/// the loop's box in each parameter, for them to be taken as neighbours without a search.
const NEAR: f64 = 1e-3;

/// The largest distance of joined ends in space, in tolerances of their edges. OpenCASCADE allows
/// each of both edges to end its tolerance away from the vertex, whose own is larger.
const TOLERANCES: f64 = 10.0;

/// The largest distance between ends that are joined whatever the tolerance, relative to
/// the length of the loop's box in space: the precision of files of IGES in float32.
const RELATIVE_TOLERANCE: f64 = 1e-5;

/// Orders the curves of a wire and moves them by whole periods, so that each begins near
/// the end of the one before it.
///
/// # Errors
/// `BREP_LOOP_OPEN` if a curve begins farther from the end of the one before it than the
/// tolerances of the edges and of their common vertex allow.
pub(super) fn chain(uses: Vec<TrimUse>, surface: &Surface) -> Result<Chain, FaceFault> {
    let frame = Frame::of(&uses, surface);
    let uses = if frame.in_order(&uses) { uses } else { frame.ordered(uses)? };
    let mut chained: Vec<TrimUse> = Vec::with_capacity(uses.len());
    for mut next in uses {
        if let Some(last) = chained.last() {
            let shift = frame.shift(last.curve.end(), next.curve.start());
            if shift != DVec3::ZERO {
                next.curve = next.curve.translated(shift);
            }
        }
        chained.push(next);
    }
    let (start, end) = (chained[0].curve.start(), chained[chained.len() - 1].curve.end());
    let turns = [0, 1].map(|axis| match frame.closures[axis] {
        Some(period) => ((end[axis] - start[axis]) / period).round() as i32,
        None => 0,
    });
    let moved = |point: DVec3| {
        let shift = [0, 1].map(|axis| f64::from(turns[axis]) * frame.closures[axis].unwrap_or(0.0));
        point + DVec3::new(shift[0], shift[1], 0.0)
    };
    let count = chained.len();
    let mut bridged: Vec<TrimUse> = Vec::with_capacity(count);
    for (index, next) in chained.iter().enumerate() {
        bridged.push(next.clone());
        let (from, to) = match chained.get(index + 1) {
            Some(after) => (next.curve.end(), after.curve.start()),
            None => (next.curve.end(), moved(start)),
        };
        let after = &chained[(index + 1) % count];
        bridged.extend(frame.bridge(surface, [next, after], from, to)?);
    }
    Ok(Chain { uses: bridged, turns })
}

/// The scales in which distances between parameters are measured.
struct Frame {
    extents: [f64; 2],
    periods: [Option<f64>; 2],
    closures: [Option<f64>; 2],
    /// The diagonal, in space, of the box of the curves' ends.
    size: f64,
}

impl Frame {
    fn of(uses: &[TrimUse], surface: &Surface) -> Self {
        let points = || uses.iter().flat_map(|trim_use| trim_use.curve.points());
        let low = points().fold(DVec3::INFINITY, DVec3::min);
        let high = points().fold(DVec3::NEG_INFINITY, DVec3::max);
        let middles = uses.iter().map(|trim_use| {
            let [start, end] = trim_use.curve.domain();
            trim_use.curve.point(0.5 * (start + end))
        });
        let in_space = || {
            let ends = uses.iter().map(|trim_use| trim_use.curve.start());
            ends.chain(middles.clone()).map(|point| surface.point(point.x, point.y))
        };
        let size =
            in_space().fold(DVec3::NEG_INFINITY, DVec3::max) - in_space().fold(DVec3::INFINITY, DVec3::min);
        Self {
            extents: [0, 1].map(|axis| (high[axis] - low[axis]).max(f64::MIN_POSITIVE)),
            periods: surface.periods(),
            closures: surface.closures(),
            size: size.length(),
        }
    }

    /// Returns the whole periods to add to `start` so that it is nearest to `end`.
    fn shift(&self, end: DVec3, start: DVec3) -> DVec3 {
        let [u, v] = [0, 1].map(|axis| match self.periods[axis] {
            Some(period) => period * ((end[axis] - start[axis]) / period).round(),
            None => 0.0,
        });
        DVec3::new(u, v, 0.0)
    }

    /// Returns the distance between an end and a start, relative to the extents.
    fn distance(&self, end: DVec3, start: DVec3) -> f64 {
        let difference = end - start - self.shift(end, start);
        let [u, v] = [0, 1].map(|axis| difference[axis].abs() / self.extents[axis]);
        u.max(v)
    }

    fn in_order(&self, uses: &[TrimUse]) -> bool {
        uses.windows(2).all(|pair| self.distance(pair[0].curve.end(), pair[1].curve.start()) <= NEAR)
    }

    /// Returns the curves, each followed by the one that begins nearest to its end, of
    /// those that begin in its last vertex if there are any. Of curves that are near, another
    /// edge than the last one comes first, then one that is near without crossing a period:
    /// else the loop would return along a seam, or run around the period, before its other
    /// curves. Curves left over when the walk has closed are a walk of their own from one of
    /// its joints (C. Hierholzer, Math. Ann. 6 (1873)), as of a ring that the seam ends at.
    fn ordered(&self, mut uses: Vec<TrimUse>) -> Result<Vec<TrimUse>, FaceFault> {
        if uses.len() > MAX_DISORDERED {
            let why = format!("{} curves are out of order, expected at most {MAX_DISORDERED}", uses.len());
            return Err(FaceFault::new("BREP_LOOP_OPEN", why));
        }
        let mut ordered = vec![uses.remove(0)];
        let (mut last, mut circuits) = (0, 0);
        while !uses.is_empty() {
            let (mut index, near) = self.next(&ordered[last], &uses);
            if !near && circuits < MAX_CIRCUITS {
                circuits += 1;
                // The walk came back to a joint that it had passed: the others begin at one.
                let joints = ordered.iter().map(|joint| self.next(joint, &uses));
                let joint = joints.enumerate().find(|(_, (_, near))| *near);
                (last, index) =
                    joint.map_or((ordered.len() - 1, index), |(joint, (index, _))| (joint, index));
            }
            ordered.insert(last + 1, uses.remove(index));
            last += 1;
        }
        Ok(ordered)
    }

    /// Returns the index of the curve to follow another one, and whether it begins near the
    /// end of that.
    fn next(&self, last: &TrimUse, uses: &[TrimUse]) -> (usize, bool) {
        let vertex = last.vertices[1];
        let connected = |next: &TrimUse| vertex.is_some() && next.vertices[0] == vertex;
        let any = uses.iter().any(connected);
        let distance = |next: &TrimUse| self.distance(last.curve.end(), next.curve.start());
        let candidates = uses.iter().enumerate().filter(|(_, next)| !any || connected(next));
        let shifted = |next: &TrimUse| self.shift(last.curve.end(), next.curve.start()) != DVec3::ZERO;
        let returns = |next: &TrimUse| next.edge.is_some() && next.edge == last.edge;
        let rank = |next: &TrimUse| {
            let near = distance(next) <= NEAR;
            (!near, near && returns(next), near && shifted(next))
        };
        let nearest = candidates
            .min_by(|(_, a), (_, b)| rank(a).cmp(&rank(b)).then(distance(a).total_cmp(&distance(b))));
        nearest.map_or((0, false), |(index, next)| (index, distance(next) <= NEAR))
    }

    /// Returns the segment that joins two curves where they are far apart in the
    /// parameters, and equal in space, as at a pole, or within the tolerance, which is its
    /// gap; none where they are near.
    fn bridge(
        &self,
        surface: &Surface,
        [last, next]: [&TrimUse; 2],
        from: DVec3,
        to: DVec3,
    ) -> Result<Option<TrimUse>, FaceFault> {
        let in_space = |point: DVec3| surface.point(point.x, point.y);
        let found = in_space(from).distance(in_space(to));
        let tolerance = TOLERANCES * (last.tolerance + next.tolerance);
        // Both ends lie in the ball of a common vertex.
        let joined = last.vertices[1].is_some() && last.vertices[1] == next.vertices[0];
        let at_vertex = if joined { 2.0 * last.end_tolerance } else { 0.0 };
        let allowed = tolerance.max(at_vertex).max(RELATIVE_TOLERANCE * self.size);
        if found.is_nan() || found > allowed {
            let why = format!("a loop is open by {found:e}, expected at most {allowed:e}");
            return Err(FaceFault::new("BREP_LOOP_OPEN", why));
        }
        let apart = [0, 1].map(|axis| (from[axis] - to[axis]).abs() / self.extents[axis]);
        let near = apart[0].max(apart[1]) <= NEAR;
        Ok((!near).then(|| TrimUse { gap: found, ..TrimUse::segment(from, to) }))
    }
}
