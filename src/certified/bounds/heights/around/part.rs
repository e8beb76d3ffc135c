//! Parts of B whose border runs around a cell.

use super::super::frame::{Frame, line_of_grid};
use super::super::piece::Piece;
use super::loops::runs_around;
use super::open_side::{Allowances, OpenSide};
use super::shadow::Shadow;
use crate::axis::Axis;
use crate::bezier::Patch;
use crate::certified::faces::FaceChart;
use crate::certified::sheets::Pole;
use crate::rounding::{upper_max, upper_min};
use glam::{DVec2, DVec3};

/// The number of boxes tried, and the size of each relative to the one before.
const MAX_BOXES: usize = 5;
const ENLARGEMENT: f64 = 1.6;

/// The least half width of the first box, by the patch's parameters: where a derivative vanishes the linear map of
/// space to parameters says nothing.
const MIN_EXTENT: f64 = 1e-3;

/// The size of the first part relative to the cell's, to first order.
const FIRST_ENLARGEMENT: f64 = 1.25;

/// How far the pieces of a box go beyond it at most, in parameters: the chart's margin for patches of up to 64
/// times its width.
const BOX_MARGIN: f64 = 1e-6;

/// A part of B.
pub(super) struct Part {
    pub(super) pieces: Vec<Piece>,
    /// How far a point of the cell may be from the nearest point of the part along the plane.
    pub(super) beyond: f64,
}

/// A side of a box: where it is, its curves in the order of its parameter, and their projections in that of the border.
struct Side {
    axis: Axis,
    end: usize,
    curves: Vec<Piece>,
    shadows: Vec<Shadow>,
}

impl Part {
    /// The part around a pole, at first up to this parameter from it.
    pub(super) fn around_pole(
        frame: &Frame<'_>,
        a: &Piece,
        (pole, mut extent): (&Pole<'_>, f64),
        face: Option<&FaceChart<'_>>,
    ) -> Option<Self> {
        let (target, along) = (Shadow::of(a, frame), pole.axis.index());
        let patches: Vec<_> = pole.patches().collect();
        for _ in 0..MAX_BOXES {
            if !(extent <= 1.0) {
                return None;
            }
            let mut ranges = [[0.0, 1.0]; 2];
            ranges[along] = if pole.end == 0 { [0.0, extent] } else { [1.0 - extent, 1.0] };
            let pieces: Vec<Piece> = patches
                .iter()
                .map(|(patch, radius)| {
                    let controls = patch.restricted(ranges[0], ranges[1]);
                    Piece::new(patch.degree, controls, frame.jet.point - patch.center, *radius)
                })
                .collect();
            let curve: Vec<Shadow> =
                pieces.iter().map(|piece| Shadow::of(&piece.side(pole.axis, 1 - pole.end), frame)).collect();
            if runs_around(&curve, &target, pole.gap) {
                let is_held = face.is_none_or(|face| face.holds_around(pole, extent));
                return is_held.then_some(Self { pieces, beyond: pole.gap });
            }
            extent *= ENLARGEMENT;
        }
        None
    }

    /// The part over a box of parameters about the foot.
    pub(super) fn about_foot(
        frame: &Frame<'_>,
        a: &Piece,
        face: Option<&FaceChart<'_>>,
        threshold: f64,
    ) -> Option<Self> {
        let (chart, target) = (&frame.chart, Shadow::of(a, frame));
        let mut extent = frame.steps_to(a).map(|step| upper_max(FIRST_ENLARGEMENT * step, MIN_EXTENT));
        for _ in 0..MAX_BOXES {
            let reach = chart.reach_over_creases(extent);
            let ends = [0, 1].map(|axis| {
                let (at, [low, high]) = (chart.parameters[axis], reach.domain[axis]);
                [(at - extent[axis]).clamp(low, high), (at + extent[axis]).clamp(low, high)]
            });
            let columns = chart.all_touched(extent, &reach)[1].clone().count();
            let parts = frame.parts(&reach, extent, ends)?;
            let gap = chart.gap(&reach, extent);
            let pieces: Vec<Piece> = parts.into_iter().map(|part| part.piece).collect();
            let sides = sides(&pieces, columns, frame);
            let largest = pieces.iter().fold(a.radius, |radius, piece| upper_max(radius, piece.radius));
            let (mut open, mut lacks) = ([None; 4], [false; 2]);
            for (index, side) in sides.iter().enumerate() {
                if side.shadows.iter().all(|shadow| shadow.is_apart(&target, gap)) {
                    continue;
                }
                let axis = side.axis.index();
                if ends[axis][side.end] == reach.domain[axis][side.end] {
                    // What is opposite in the order of the border.
                    let opposite = &sides[(index + 2) % sides.len()];
                    let allowances = Allowances { reach: a.radius + largest, gap, threshold };
                    open[index] =
                        Some(OpenSide::new(frame, [&side.curves, &opposite.curves], a, &allowances)?);
                } else {
                    lacks[axis] = true;
                }
            }
            if lacks == [false; 2] {
                let beyond = OpenSide::beyond([[open[3], open[1]], [open[0], open[2]]])? + gap;
                let curve = border(&sides, &open, 2.0 * (a.radius + largest));
                let feet = ends.map(|[low, high]| [low - BOX_MARGIN, high + BOX_MARGIN]);
                let is_proven = runs_around(&curve, &target, gap) && face.is_none_or(|face| face.holds(feet));
                return is_proven.then_some(Self { pieces, beyond });
            }
            extent = [0, 1].map(|axis| if lacks[axis] { ENLARGEMENT * extent[axis] } else { extent[axis] });
        }
        None
    }
}

/// The parameter from a pole up to which the first part around it goes.
pub(super) fn first_extent(frame: &Frame<'_>, a: &Piece, pole: &Pole<'_>) -> f64 {
    let speed = |patch: &Patch<'_>| {
        let jet = patch.jet(pole.chart.parameters);
        [jet.s, jet.t][pole.axis.index()].length()
    };
    let least = pole.patches().fold(f64::INFINITY, |least, (patch, _)| upper_min(least, speed(&patch)));
    FIRST_ENLARGEMENT * Shadow::of(a, frame).radius() / least
}

/// Points around a pole at this parameter from it, about the frame's foot.
pub(super) fn points_around(frame: &Frame<'_>, pole: &Pole<'_>, extent: f64) -> Vec<DVec3> {
    let mut parameters = pole.chart.parameters;
    parameters[pole.axis.index()] += if pole.end == 0 { extent } else { -extent };
    pole.patches().map(|(patch, _)| patch.point(parameters) - frame.jet.point).collect()
}

/// The sides of a box of pieces in the order of its border.
fn sides(pieces: &[Piece], columns: usize, frame: &Frame<'_>) -> [Side; 4] {
    [(Axis::V, 0, false), (Axis::U, 1, false), (Axis::V, 1, true), (Axis::U, 0, true)].map(
        |(axis, end, is_reversed)| {
            let line = line_of_grid(pieces, columns, axis, end);
            let curves: Vec<Piece> = line.into_iter().map(|piece| piece.side(axis, end)).collect();
            let mut shadows: Vec<Shadow> = curves.iter().map(|curve| Shadow::of(curve, frame)).collect();
            if is_reversed {
                shadows.reverse();
                shadows.iter_mut().for_each(|shadow| shadow.points.reverse());
            }
            Side { axis, end, curves, shadows }
        },
    )
}

/// The border with its open sides moved outwards by a length.
fn border(sides: &[Side; 4], open: &[Option<OpenSide>; 4], length: f64) -> Vec<Shadow> {
    let moves = open.map(|open| open.map_or(DVec2::ZERO, |open| length * open.outwards));
    let mut border = Vec::new();
    for (index, side) in sides.iter().enumerate() {
        let (own, next) = (moves[index], moves[(index + 1) % sides.len()]);
        border.extend(side.shadows.iter().map(|shadow| shadow.moved(own)));
        let Some(last) = side.shadows.last() else { continue };
        let corner = last.points[last.points.len() - 1];
        for [from, to] in [[own, own + next], [own + next, next]] {
            if from != to {
                let segment = vec![corner + from, corner + to];
                border.push(Shadow::new(segment, last.error).moved(DVec2::ZERO));
            }
        }
    }
    border
}
