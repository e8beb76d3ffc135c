//! The curves of a wire head to tail, across periods.

use super::frame::Frame;
use super::order::{self, Circuit};
use crate::digits::three_digits;
use crate::faces::gap::Gap;
use crate::faces::uses::TrimUse;
use crate::nurbs::Surface;
use crate::report::{FaceFault, Remark};
use glam::DVec3;

/// Curves head to tail, and the periods by which the end lies from the start.
#[derive(Debug, Clone)]
pub(super) struct Chain {
    pub(super) uses: Vec<TrimUse>,
    /// The turns of u and of v from start to end; `[0, 0]` is a closed loop.
    pub(super) turns: [i32; 2],
    /// What the report says of the curves.
    pub(super) remarks: Vec<Remark>,
}

/// Orders the curves of a wire and moves them by whole periods, so that each begins near
/// the end of the one before it.
///
/// # Errors
/// `BREP_LOOP_OPEN` if a curve begins farther from the end of the one before it than the
/// tolerances of the edges and of their common vertex allow; those of [`order::circuit`].
pub(super) fn chain(uses: Vec<TrimUse>, surface: &Surface) -> Result<Chain, FaceFault> {
    let frame = Frame::of(&uses, surface);
    let Circuit { uses: mut circuit, is_placed } = order::circuit(uses, &frame)?;
    let (start, end) = (circuit[0].curve.start(), circuit[circuit.len() - 1].curve.end());
    // A chain whose ends are one point in space, as at a pole, closes along that and does not turn.
    let ends = [&circuit[circuit.len() - 1], &circuit[0]];
    let closes = is_placed
        || frame.reach(end, start) <= frame.allowed(ends)
        || turned_at_pole(&mut circuit, frame.turns(start, end), &frame);
    let turns = if closes { [0, 0] } else { frame.turns(start, end) };
    let moved = |point: DVec3| {
        let shift = [0, 1].map(|axis| f64::from(turns[axis]) * frame.closures[axis].unwrap_or(0.0));
        point + DVec3::new(shift[0], shift[1], 0.0)
    };
    let count = circuit.len();
    let mut chain = Chain { uses: Vec::with_capacity(count), turns, remarks: Vec::new() };
    for (index, next) in circuit.iter().enumerate() {
        chain.uses.push(next.clone());
        let (from, to) = match circuit.get(index + 1) {
            Some(after) => (next.curve.end(), after.curve.start()),
            None => (next.curve.end(), moved(start)),
        };
        let after = &circuit[(index + 1) % count];
        chain.bridge(&frame, [next, after], [from, to])?;
    }
    Ok(chain)
}

/// Turns a chain that passes a pole back there, so that it closes; returns whether it did.
///
/// Around its pole a surface has all parameters in one point, so that a loop without an edge of it, as
/// along a cone's seam to the apex and back, may be taken to turn there.
fn turned_at_pole(circuit: &mut [TrimUse], turns: [i32; 2], frame: &Frame<'_>) -> bool {
    let [u, v] = [0, 1].map(|axis| -f64::from(turns[axis]) * frame.closures[axis].unwrap_or(0.0));
    let back = DVec3::new(u, v, 0.0);
    let is_pole = |[last, next]: [&TrimUse; 2]| {
        let end = last.curve.end();
        frame.reach(end, end + back) <= frame.allowed([last, next])
    };
    let Some(place) = (1..circuit.len()).find(|&next| is_pole([&circuit[next - 1], &circuit[next]])) else {
        return false;
    };
    for after in &mut circuit[place..] {
        after.curve = after.curve.clone().translated(back);
    }
    true
}

impl Chain {
    /// Adds the segment that joins two curves where they are far apart in the parameters: along
    /// one point of space, as at a pole, or within the tolerance, which is its gap, or between both
    /// sides of a seam at whose end the file has no edge, which is remarked.
    fn bridge(
        &mut self,
        frame: &Frame<'_>,
        [last, next]: [&TrimUse; 2],
        [from, to]: [DVec3; 2],
    ) -> Result<(), FaceFault> {
        let allowed = frame.allowed([last, next]);
        let is_near = Frame::is_near(frame.distance(from, to));
        let apart = frame.distance_in_space(from, to);
        let mut gap = if is_near { apart } else { frame.reach(from, to) };
        let is_seam_end = last.edge.is_some() && last.edge == next.edge && apart <= allowed;
        if !(gap <= allowed) && is_seam_end {
            gap = apart;
            let [[u, v], [end_u, end_v]] = [from, to].map(|point| [point.x, point.y]);
            let why = format!(
                "the loop is closed along ({u:?}, {v:?}) to ({end_u:?}, {end_v:?}), where the seam ends without an edge"
            );
            self.remarks.push(Remark::new("BREP_SEAM_END", why));
        }
        if gap.is_nan() || gap > allowed {
            let [gap, allowed] = [gap, allowed].map(three_digits);
            let why = format!("a loop is open by {gap}, expected at most {allowed}");
            return Err(FaceFault::new("BREP_LOOP_OPEN", why));
        }
        if !is_near {
            let gap = Gap::measured(gap);
            self.uses.push(TrimUse { gap, ..TrimUse::segment(from, to) });
        }
        Ok(())
    }
}
