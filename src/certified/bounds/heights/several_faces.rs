//! Cells over lines between faces of B, and over their corners.
//!
//! Lemma (3.21 of `docs/method.md`). Let faces k have sides j, and let q_kj bound, for each point of a cell, how far
//! its fixed point on face k is beyond that side, or F beyond that end of the surface. If of each choice of one
//! side of every face two have `λ q + (1 - λ) q' <= x` on the cell for a λ of [0, 1], then each point of the cell is
//! beyond no side of some face by more than x, and is within that face's bound for such points.
//!
//! Where two faces end at the same line their functions vanish there with opposite slopes, so that x is of second
//! order; on one surface in affine parameters it is of third.

use super::border::{Border, Side};
use super::over::Over;
use super::{framed, places};
use crate::certified::cell_context::CellContext;
use crate::certified::nearest::Foot;
use crate::rounding::{upper_max, upper_min};
use glam::DVec3;

/// The largest distance, relative to the threshold, by which a point may be beyond an open side of the face
/// that it is compared with.
const MAX_EXCESS: f64 = 0.125;

/// The largest number of faces: four meet at the corners of a grid.
const MAX_FACES: usize = 4;

/// The largest number of combinations of their borders that are tried.
const MAX_TRIALS: usize = 64;

/// The lines of places along each axis of a cell at which faces are looked for. With fewer, corners of faces between
/// them are missed, and the cell is divided.
const LINES: usize = 7;

/// A face or a surface of B over the cell, and where it may end there.
struct Candidate<'a> {
    over: Over<'a>,
    /// One at least.
    borders: Vec<Border>,
    /// The cell's points at the places.
    points: Vec<DVec3>,
}

impl<'a> Candidate<'a> {
    /// `None` where it is not known where the face ends.
    fn new(over: Over<'a>, largest: f64, threshold: f64) -> Option<Self> {
        let borders = Border::all(&over, largest, threshold);
        if borders.is_empty() {
            return None;
        }
        let points = over.a.samples([LINES; 2]);
        Some(Self { over, borders, points })
    }

    /// The least length by which the point at a place is beyond one of its borders.
    fn beyond(&self, place: usize) -> f64 {
        let of_border = |border: &Border| {
            border.open.iter().map(|side| side.at(self.points[place])).fold(f64::NEG_INFINITY, upper_max)
        };
        self.borders.iter().map(of_border).fold(f64::INFINITY, upper_min)
    }
}

/// The bound of a cell by the face or the surface about its foot and those on which it goes on.
pub(super) fn upper_bound(context: &CellContext<'_>, first: Over<'_>, threshold: f64) -> Option<f64> {
    if first.face.is_none() && first.linear.beyond.iter().flatten().all(|beyond| *beyond <= 0.0) {
        return None;
    }
    let largest = MAX_EXCESS * threshold;
    let mut candidates = vec![Candidate::new(first, largest, threshold)?];
    while let Some(place) = place_beyond(&candidates, largest) {
        if candidates.len() == MAX_FACES {
            return None;
        }
        let over = beyond(context, &candidates, place, threshold)?;
        candidates.push(Candidate::new(over, largest, threshold)?);
    }
    if candidates.len() == 1 {
        return None;
    }
    // Each combination of one border of every face.
    let combinations: usize = candidates.iter().map(|candidate| candidate.borders.len()).product();
    (0..combinations.min(MAX_TRIALS)).find_map(|number| {
        let mut rest = number;
        let mut faces = Vec::with_capacity(candidates.len());
        for Candidate { over, borders, .. } in &candidates {
            faces.push((over, &borders[rest % borders.len()]));
            rest /= borders.len();
        }
        // One without an open side is enough.
        if let Some(whole) = faces.iter().position(|(_, border)| border.open.is_empty()) {
            faces = vec![faces[whole]];
        }
        let excess = common_excess(&faces, largest)?;
        let mut bound = 0.0;
        for (over, border) in faces {
            bound = upper_max(bound, border.upper_bound(over, excess, threshold)?);
        }
        (bound <= threshold).then_some(bound)
    })
}

/// The place in the cell, of those of a grid, that is farthest beyond all faces, if it is so by more than the largest
/// excess.
fn place_beyond(candidates: &[Candidate<'_>], largest: f64) -> Option<[f64; 2]> {
    let mut farthest = (largest, None);
    for place in 0..LINES * LINES {
        let beyond =
            candidates.iter().map(|candidate| candidate.beyond(place)).fold(f64::INFINITY, upper_min);
        if beyond > farthest.0 {
            farthest = (beyond, Some(place));
        }
    }
    let along = |line: usize| 2.0 * line as f64 / (LINES - 1) as f64 - 1.0;
    farthest.1.map(|place| [along(place / LINES), along(place % LINES)])
}

/// The face or surface of the nearest foot of a place, about its foot of the cell's centre, if it is another one.
fn beyond<'a>(
    context: &CellContext<'a>,
    known: &[Candidate<'a>],
    place: [f64; 2],
    threshold: f64,
) -> Option<Over<'a>> {
    let point = context.pair.point_of_a(context.cell.patch, context.cell.at(place));
    let start = context.foot();
    let start = context.nearest.on_patch(point, start.patch, start.parameters);
    let Foot { patch, parameters, distance_squared, .. } = context.nearest.nearest(point, start, threshold);
    if !(distance_squared <= threshold * threshold) {
        return None;
    }
    let foot = context.nearest.on_patch(context.jet.point, patch, parameters);
    let [face, piece] = places(context, &foot)?;
    let (frame, face) = framed(face.or(piece)?)?;
    let is_known = known.iter().any(|Candidate { over, .. }| {
        over.frame.chart.surface() == frame.chart.surface() && over.face.is_some() == face.is_some()
    });
    if is_known { None } else { Over::new(context, frame, face) }
}

/// A length x, at most the largest, so that each point of the cell is beyond no open side of one of these borders by
/// more than x.
fn common_excess(faces: &[(&Over<'_>, &Border)], largest: f64) -> Option<f64> {
    let sides: Vec<&[Side]> = faces.iter().map(|(_, border)| &border.open[..]).collect();
    let mut excess = 0.0;
    let mut chosen = Vec::with_capacity(sides.len());
    let is_met = is_choice_met(&sides, &mut chosen, &mut |one, other| {
        let lesser = one.lesser_excess(other);
        let is_small = lesser <= largest;
        if is_small {
            excess = upper_max(excess, lesser);
        }
        is_small
    });
    is_met.then_some(excess)
}

/// Whether each choice of one side of every face that begins with the chosen ones has a pair that meets.
fn is_choice_met<'s>(
    sides: &[&'s [Side]],
    chosen: &mut Vec<&'s Side>,
    meet: &mut impl FnMut(&Side, &Side) -> bool,
) -> bool {
    let Some(of_face) = sides.get(chosen.len()) else { return false };
    of_face.iter().all(|side| {
        if chosen.iter().any(|other| meet(side, other)) {
            return true;
        }
        chosen.push(side);
        let is_met = is_choice_met(sides, chosen, meet);
        chosen.pop();
        is_met
    })
}
