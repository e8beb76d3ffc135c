//! Cells over one face of B or several, over the lines between them, and over their corners.
//!
//! Lemma (3.18 of `docs/method.md`). Let faces k have open sides j, none, some or all of their sides, and let q_kj bound,
//! for each point of a cell, how far its fixed point on face k is beyond that side, or F beyond that end of the surface.
//! If of each choice of one open side of every face two have `λ q + (1 - λ) q' <= x` on the cell for a λ of [0, 1], then
//! each point of the cell is beyond no open side of some face by more than x, and is within that face's bound for such
//! points. A face without an open side is enough.
//!
//! Where two faces end at the same line their functions vanish there with opposite slopes, so that x is of second
//! order; on one surface in affine parameters it is of third.

use super::border::{Border, MAX_OPEN, Side};
use super::cell_comparison::CellComparison;
use super::{framed, places};
use crate::certified::cell_context::CellContext;
use crate::certified::nearest::Foot;
use crate::rounding::{upper_max, upper_min};
use glam::DVec3;

/// The largest number of faces: four meet at the corners of a grid.
const MAX_FACES: usize = 4;

/// The largest number of combinations of their borders that are tried.
const MAX_TRIALS: usize = 64;

/// The lines of places along each axis of a cell at which faces are looked for. With fewer, corners of faces between
/// them are missed, and the cell is divided.
const LINES: usize = 7;

/// A face or a surface of B over the cell, and where it may end there.
pub(super) struct FaceOver<'a> {
    cell: CellComparison<'a>,
    /// None where it is not known where the face ends.
    borders: Vec<Border>,
}

impl<'a> FaceOver<'a> {
    pub(super) fn new(cell: CellComparison<'a>, threshold: f64) -> Self {
        let borders = Border::all(&cell, threshold);
        Self { cell, borders }
    }

    /// The bound by this face alone; `None` where each of its borders has an open side.
    pub(super) fn upper_bound(&self, threshold: f64) -> Option<f64> {
        let mut whole = self.borders.iter().filter(|border| border.open.is_empty());
        whole.find_map(|border| border.upper_bound(&self.cell, 0.0, threshold))
    }

    /// The cell's points at the places.
    fn points(&self) -> Vec<DVec3> {
        self.cell.a.samples([LINES; 2])
    }

    /// The least length by which a point of the cell is beyond one of its borders.
    fn beyond(&self, point: DVec3) -> f64 {
        let of_border = |border: &Border| {
            border.open.iter().map(|side| side.at(point)).fold(f64::NEG_INFINITY, upper_max)
        };
        self.borders.iter().map(of_border).fold(f64::INFINITY, upper_min)
    }
}

/// The bound of a cell by the face or the surface about its foot and those on which it goes on.
pub(super) fn upper_bound(context: &CellContext<'_>, first: FaceOver<'_>, threshold: f64) -> Option<f64> {
    let mut farthest = vec![f64::INFINITY; LINES * LINES];
    let mut faces = Vec::with_capacity(MAX_FACES);
    let mut next = first;
    loop {
        if next.borders.is_empty() {
            return None;
        }
        for (beyond, point) in farthest.iter_mut().zip(next.points()) {
            *beyond = upper_min(*beyond, next.beyond(point));
        }
        faces.push(next);
        let Some(place) = place_beyond(&farthest, MAX_OPEN * threshold) else { break };
        if faces.len() == MAX_FACES {
            return None;
        }
        next = FaceOver::new(beyond(context, &faces, place, threshold)?, threshold);
    }
    if faces.len() == 1 {
        return None;
    }
    // Each combination of one border of every face.
    let combinations: usize = faces.iter().map(|face| face.borders.len()).product();
    (0..combinations.min(MAX_TRIALS)).find_map(|number| {
        let mut rest = number;
        let mut chosen = Vec::with_capacity(faces.len());
        for FaceOver { cell, borders } in &faces {
            chosen.push((cell, &borders[rest % borders.len()]));
            rest /= borders.len();
        }
        // One without an open side is enough.
        if let Some(whole) = chosen.iter().position(|(_, border)| border.open.is_empty()) {
            chosen = vec![chosen[whole]];
        }
        let overhang = common_overhang(&chosen, MAX_OPEN * threshold)?;
        let mut bound = 0.0;
        for (cell, border) in chosen {
            bound = upper_max(bound, border.upper_bound(cell, overhang, threshold)?);
        }
        (bound <= threshold).then_some(bound)
    })
}

/// The place in the cell, of those of a grid, that is farthest beyond all faces, if it is so by more than the largest
/// overhang.
fn place_beyond(beyond: &[f64], largest: f64) -> Option<[f64; 2]> {
    let mut farthest = (largest, None);
    for (place, &beyond) in beyond.iter().enumerate() {
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
    known: &[FaceOver<'a>],
    place: [f64; 2],
    threshold: f64,
) -> Option<CellComparison<'a>> {
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
    let is_known = known.iter().any(|FaceOver { cell, .. }| {
        cell.frame.chart.surface() == frame.chart.surface() && cell.face.is_some() == face.is_some()
    });
    if is_known { None } else { CellComparison::new(context, frame, face) }
}

/// A length x, at most the largest, so that each point of the cell is beyond no open side of one of these borders by
/// more than x.
fn common_overhang(faces: &[(&CellComparison<'_>, &Border)], largest: f64) -> Option<f64> {
    let sides: Vec<&[Side]> = faces.iter().map(|(_, border)| &border.open[..]).collect();
    let mut overhang = 0.0;
    let mut chosen = Vec::with_capacity(sides.len());
    let is_met = is_choice_met(&sides, &mut chosen, &mut |one, other| {
        let lesser = one.lesser_overhang(other);
        let is_small = lesser <= largest;
        if is_small {
            overhang = upper_max(overhang, lesser);
        }
        is_small
    });
    is_met.then_some(overhang)
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
