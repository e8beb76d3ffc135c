//! The order of a wire's curves: a circuit in which each begins where the one before it ends.

use super::area::{self, AREA_TOLERANCE, NO_AREA};
use super::frame::Frame;
use crate::faces::uses::TrimUse;
use crate::report::FaceFault;
use glam::DVec3;
use std::cmp::Ordering;

/// The most curves of a wire that are put in order, which takes time in proportion to
/// the square of their number. A wire in order may have any number.
const MAX_DISORDERED: usize = 2000;

/// Maximum walks joined into one circuit; each costs a search over all joints.
const MAX_WALKS: usize = 64;

/// The most curves that are tried in the search of all circuits: a wire of two seams has 6
/// circuits, of 24 curves, and each curve that crosses a seam twice as many.
const MAX_TRIED: usize = 20_000;

/// Curves in order, moved to where they follow each other.
pub(super) struct Circuit {
    pub(super) uses: Vec<TrimUse>,
    /// Whether every curve is where the file places it, and the circuit is closed there.
    pub(super) is_placed: bool,
}

/// Where curves may meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Meeting {
    /// In the parameters of the file, or along a line of them that is one point in space.
    Placed,
    /// In space: up to periods.
    OnSurface,
}

/// Finds a circuit of a wire's curves.
///
/// Circuits of curves where the file places them come first: the winding numbers of placed
/// curves do not depend on their order. Others move curves by periods. On a surface closed both
/// ways these bound different regions of the parameters, and the first is taken whose area is
/// that of a region of the surface, or of a hole in it (lemma B1).
///
/// # Errors
/// `BREP_LOOP_OPEN` for too many curves out of order, `BREP_LOOP_NO_ORDER` if no circuit fits.
pub(super) fn circuit(uses: Vec<TrimUse>, frame: &Frame<'_>) -> Result<Circuit, FaceFault> {
    let uses = with_sides(uses, frame);
    let search = Search { uses: &uses, frame, whole: frame.whole() };
    let in_file: Vec<usize> = (0..uses.len()).collect();
    // Curves that were made from edges are where they are but for periods, which follow from
    // the order of the file.
    if !uses.iter().all(|one| one.is_placed) && search.is_circuit(&in_file, Meeting::OnSurface) {
        let moved = search.moved(&in_file);
        if search.fits(&moved) {
            return Ok(Circuit { uses: moved, is_placed: false });
        }
    }
    let few = uses.len() <= MAX_DISORDERED;
    let placed = search.is_circuit(&in_file, Meeting::Placed).then(|| in_file.clone());
    let placed = placed.or_else(|| few.then(|| search.walks(Meeting::Placed)));
    if let Some(order) = placed.filter(|order| search.is_circuit(order, Meeting::Placed)) {
        let circuit =
            Circuit { uses: order.iter().map(|&index| uses[index].clone()).collect(), is_placed: true };
        if search.fits(&circuit.uses) {
            return Ok(circuit);
        }
    }
    if !few && !search.follows(&in_file) {
        let why = format!("{} curves are out of order, expected at most {MAX_DISORDERED}", uses.len());
        return Err(FaceFault::new("BREP_LOOP_OPEN", why));
    }
    let mut order = search.order_on_surface(in_file);
    // A seam whose ends meet in space alone is not where a circuit begins.
    let edge = |index: usize| uses[index].edge;
    if order.len() > 2 && edge(order[0]).is_some() && edge(order[0]) == edge(order[order.len() - 1]) {
        order.rotate_right(1);
    }
    let moved = search.moved(&order);
    if search.fits(&moved) {
        return Ok(Circuit { uses: moved, is_placed: false });
    }
    let found = search.any().map(|uses| Circuit { uses, is_placed: false });
    found.ok_or_else(|| {
        let why = "no order of the loop's curves bounds a part of the closed surface";
        FaceFault::new("BREP_LOOP_NO_ORDER", why)
    })
}

/// Returns the curves with the two sides of every seam exchanged if that alone makes them a circuit where
/// the file places them: formats do not say which of both curves belongs to which direction.
fn with_sides(uses: Vec<TrimUse>, frame: &Frame<'_>) -> Vec<TrimUse> {
    let in_file: Vec<usize> = (0..uses.len()).collect();
    let is_circuit = |uses: &[TrimUse]| {
        let search = Search { uses, frame, whole: frame.whole() };
        search.is_circuit(&in_file, Meeting::Placed) && search.fits(uses)
    };
    if !uses.iter().all(|one| one.is_placed) || is_circuit(&uses) {
        return uses;
    }
    let mut exchanged = uses.clone();
    for (index, one) in uses.iter().enumerate() {
        let is_other_side = |other: &&TrimUse| other.edge == one.edge && other.reversed != one.reversed;
        if let Some(other) = uses.iter().find(is_other_side).filter(|_| one.edge.is_some()) {
            exchanged[index].curve = other.curve.clone().reversed();
        }
    }
    if is_circuit(&exchanged) { exchanged } else { uses }
}

/// The curves of a wire whose order is sought.
struct Search<'a> {
    uses: &'a [TrimUse],
    frame: &'a Frame<'a>,
    /// The area of the parameters of a surface closed both ways.
    whole: Option<f64>,
}

impl Search<'_> {
    /// Returns whether each curve begins where the one before it ends, and the first where the
    /// last does.
    fn is_circuit(&self, order: &[usize], meeting: Meeting) -> bool {
        let next = order.iter().cycle().skip(1);
        order.iter().zip(next).all(|(&last, &next)| self.meet(&self.uses[last], &self.uses[next], meeting))
    }

    /// Returns whether each curve but the first begins on the surface where the one before it ends.
    fn follows(&self, order: &[usize]) -> bool {
        let meet = |pair: &[usize]| self.meet(&self.uses[pair[0]], &self.uses[pair[1]], Meeting::OnSurface);
        order.windows(2).all(meet)
    }

    /// Returns the order of the file if its curves follow each other on the surface, else that of a walk.
    ///
    /// Where no walk follows them, as their ends are farther from common vertices than neighbours are, the
    /// vertices decide; on a surface closed both ways they may all be one.
    fn order_on_surface(&self, in_file: Vec<usize>) -> Vec<usize> {
        if self.follows(&in_file) {
            return in_file;
        }
        let walk = self.walks(Meeting::OnSurface);
        let is_linked = self.whole.is_none() && self.is_linked(&in_file);
        if is_linked && !self.follows(&walk) { in_file } else { walk }
    }

    /// Returns whether each curve begins in the vertex in which the one before it ends, and the first where
    /// the last does.
    fn is_linked(&self, order: &[usize]) -> bool {
        let next = order.iter().cycle().skip(1);
        order.iter().zip(next).all(|(&last, &next)| {
            let vertex = self.uses[last].vertices[1];
            vertex.is_some() && vertex == self.uses[next].vertices[0]
        })
    }

    fn distance(&self, last: &TrimUse, next: &TrimUse, meeting: Meeting) -> f64 {
        let (end, start) = (last.curve.end(), next.curve.start());
        match meeting {
            Meeting::Placed => self.frame.distance(end, start),
            Meeting::OnSurface => self.frame.distance_on_surface(end, start),
        }
    }

    fn meet(&self, last: &TrimUse, next: &TrimUse, meeting: Meeting) -> bool {
        let near = Frame::is_near(self.distance(last, next, meeting));
        // A curve that was made from an edge is where it is but for periods, also at a pole.
        let at_pole = meeting == Meeting::Placed || !last.is_placed || !next.is_placed;
        near || (at_pole && self.is_point(last, next))
    }

    /// Returns whether the line between two curves that meet in a vertex is one point in space, as
    /// at a pole whose edge the file leaves out.
    fn is_point(&self, last: &TrimUse, next: &TrimUse) -> bool {
        let common = last.vertices[1].is_some() && last.vertices[1] == next.vertices[0];
        let (end, start) = (last.curve.end(), next.curve.start());
        common
            && self.frame.reach(end, start) <= self.frame.allowed([last, next])
            && self.frame.may_be_pole(end, start)
    }

    /// Returns the curves, each followed by the one that begins nearest to its end, of
    /// those that begin in its last vertex if there are any. Curves left over when the walk has
    /// closed are a walk of their own from one of its joints (C. Hierholzer, Math. Ann. 6
    /// (1873)), as of a ring that the seam ends at.
    fn walks(&self, meeting: Meeting) -> Vec<usize> {
        let mut left: Vec<usize> = (1..self.uses.len()).collect();
        let mut order = vec![0];
        let (mut last, mut walks) = (0, 0);
        while !left.is_empty() {
            let (mut index, near) = self.next(order[last], &left, meeting);
            if !near && walks < MAX_WALKS {
                walks += 1;
                // The walk came back to a joint that it had passed: the others begin at one.
                let joints = order.iter().map(|&joint| self.next(joint, &left, meeting));
                let joint = joints.enumerate().find(|(_, (_, near))| *near);
                (last, index) = joint.map_or((order.len() - 1, index), |(joint, (index, _))| (joint, index));
            }
            order.insert(last + 1, left.remove(index));
            last += 1;
        }
        order
    }

    /// Returns the place in `left` of the curve to follow another one, and whether it begins where
    /// that ends.
    fn next(&self, last: usize, left: &[usize], meeting: Meeting) -> (usize, bool) {
        let last = &self.uses[last];
        let vertex = last.vertices[1];
        let connected = |next: usize| vertex.is_some() && self.uses[next].vertices[0] == vertex;
        let any = left.iter().any(|&next| connected(next));
        let candidates = left.iter().enumerate().filter(|(_, next)| !any || connected(**next));
        let nearest = candidates.min_by(|(_, a), (_, b)| self.preferred(last, [**a, **b], meeting));
        nearest.map_or((0, false), |(place, &next)| (place, self.meet(last, &self.uses[next], meeting)))
    }

    /// Compares two curves to follow another one. Of those that are near, another edge than the
    /// last one comes first, then one that is near without crossing a period: else the loop would
    /// return along a seam, or run around the period, before its other curves.
    fn preferred(&self, last: &TrimUse, next: [usize; 2], meeting: Meeting) -> Ordering {
        let rank = |next: usize| {
            let next = &self.uses[next];
            let distance = self.distance(last, next, meeting);
            let near = Frame::is_near(distance);
            let returns = next.edge.is_some() && next.edge == last.edge;
            let shifted = self.frame.shift(last.curve.end(), next.curve.start()) != DVec3::ZERO;
            ((!near, near && returns, near && shifted), distance)
        };
        let [(a, near_a), (b, near_b)] = next.map(rank);
        a.cmp(&b).then(near_a.total_cmp(&near_b))
    }

    /// Returns curves in this order, each moved by periods to the end of the one before it.
    fn moved(&self, order: &[usize]) -> Vec<TrimUse> {
        let mut moved: Vec<TrimUse> = Vec::with_capacity(order.len());
        for &index in order {
            let mut next = self.uses[index].clone();
            if let Some(last) = moved.last() {
                let shift = self.frame.shift(last.curve.end(), next.curve.start());
                if shift != DVec3::ZERO {
                    next.curve = next.curve.translated(shift);
                }
            }
            moved.push(next);
        }
        moved
    }

    /// Returns whether curves bound a region of the surface or a hole in it: on a surface closed
    /// both ways, whether the area within them is in (-W, 0) or (0, W], unless they run around a
    /// period, as they then do in every order.
    fn fits(&self, uses: &[TrimUse]) -> bool {
        let (Some(whole), [first, .., last]) = (self.whole, uses) else { return true };
        if self.frame.turns(first.curve.start(), last.curve.end()) != [0, 0] {
            return true;
        }
        let part = area::of_loop(uses) / whole;
        part.abs() > NO_AREA && part <= 1.0 + AREA_TOLERANCE && part > AREA_TOLERANCE - 1.0
    }

    /// Returns the first circuit that fits, of all that begin with the first curve.
    fn any(&self) -> Option<Vec<TrimUse>> {
        let mut tried = 0;
        let mut path = vec![0];
        let mut is_used = vec![false; self.uses.len()];
        is_used[0] = true;
        self.extended(&mut path, &mut is_used, &mut tried)
    }

    /// Extends a path in all ways until one is a circuit that fits.
    fn extended(
        &self,
        path: &mut Vec<usize>,
        is_used: &mut [bool],
        tried: &mut usize,
    ) -> Option<Vec<TrimUse>> {
        let last = &self.uses[*path.last()?];
        if path.len() == self.uses.len() {
            let moved = self.moved(path);
            let closed = self.meet(last, &self.uses[path[0]], Meeting::OnSurface);
            return (closed && self.fits(&moved)).then_some(moved);
        }
        for next in 0..self.uses.len() {
            if is_used[next] || !self.meet(last, &self.uses[next], Meeting::OnSurface) {
                continue;
            }
            *tried += 1;
            if *tried > MAX_TRIED {
                return None;
            }
            is_used[next] = true;
            path.push(next);
            let found = self.extended(path, is_used, tried);
            path.pop();
            is_used[next] = false;
            if found.is_some() {
                return found;
            }
        }
        None
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::nurbs::{Curve, Frame as Placement, Surface};
    use std::f64::consts::{FRAC_PI_2, TAU};

    /// A quarter of a cylinder of radius 1e-3 and length 1000 whose one line lies a period off: it is moved
    /// there, not joined around the cylinder, which is thinner than what files of this size may be off.
    #[test]
    fn a_thin_cylinder_is_no_pole() {
        let placement = Placement { origin: DVec3::ZERO, x: DVec3::X, y: DVec3::Y, z: DVec3::Z };
        let profile = Curve::Line { point: 1e-3 * DVec3::X, direction: DVec3::Z };
        let surface = Surface::Revolution { frame: placement, profile, kind: "cylinder" };
        let corners = [[0.0, 0.0], [FRAC_PI_2, 0.0], [FRAC_PI_2, 1e3], [0.0, 1e3]];
        let uses: Vec<TrimUse> = (0..4)
            .map(|index| {
                let shift = if index == 3 { TAU } else { 0.0 };
                let at = |corner: usize| {
                    let [u, v] = corners[corner % 4];
                    DVec3::new(u + shift, v, 0.0)
                };
                let vertices = [Some(index), Some((index + 1) % 4)];
                TrimUse { edge: Some(index as u32), vertices, ..TrimUse::segment(at(index), at(index + 1)) }
            })
            .collect();
        let frame = Frame::of(&uses, &surface);
        let found = circuit(uses, &frame).ok().unwrap();
        let starts: Vec<[f64; 2]> =
            found.uses.iter().map(|one| [one.curve.start().x, one.curve.start().y]).collect();
        assert!(!found.is_placed);
        for (start, corner) in starts.iter().zip(corners) {
            assert!((start[0] - corner[0]).abs() < 1e-12 && start[1] == corner[1], "{starts:?}");
        }
    }

    /// A band of a cylinder between two rings and its seam: the seam's sides are where they close the loop,
    /// whichever of both the file gives to which direction.
    #[test]
    fn the_sides_of_a_seam_are_those_that_close_the_loop() {
        let placement = Placement { origin: DVec3::ZERO, x: DVec3::X, y: DVec3::Y, z: DVec3::Z };
        let profile = Curve::Line { point: DVec3::X, direction: DVec3::Z };
        let surface = Surface::Revolution { frame: placement, profile, kind: "cylinder" };
        let side = |edge: u32, reversed: bool, [from, to]: [[f64; 2]; 2]| TrimUse {
            edge: Some(edge),
            reversed,
            ..TrimUse::segment(DVec3::new(from[0], from[1], 0.0), DVec3::new(to[0], to[1], 0.0))
        };
        for seam in [[TAU, 0.0], [0.0, TAU]] {
            let uses = vec![
                side(1, false, [[0.0, 0.0], [TAU, 0.0]]),
                side(2, false, [[seam[0], 0.0], [seam[0], 1.0]]),
                side(3, true, [[TAU, 1.0], [0.0, 1.0]]),
                side(2, true, [[seam[1], 1.0], [seam[1], 0.0]]),
            ];
            let frame = Frame::of(&uses, &surface);
            let found = circuit(uses, &frame).ok().unwrap();
            assert!(found.is_placed);
            let starts: Vec<f64> = found.uses.iter().map(|one| one.curve.start().x).collect();
            assert_eq!(starts, [0.0, TAU, TAU, 0.0]);
        }
    }
}
