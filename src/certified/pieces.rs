//! Patches cut into pieces that a kernel's float32 is exact enough for.

use super::Cell;
use super::Operand;

use crate::axis::Axis;
use crate::bezier::{Patch, PatchSet, center_grid};
use crate::model::RigidTransform;
use glam::{DVec4, Vec4Swizzles};
use std::ops::Range;

/// Halvings of one patch, at most: 65,536 pieces, more than are allowed in all.
const MAX_HALVINGS: u32 = 16;

/// Where a piece lies on its patch, all numbers dyadic: its (σ, τ) in
/// [-1, 1]^2 are the patch's `low + ½(1 + σ) width`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Place {
    pub(crate) patch: u32,
    pub(crate) low: [f64; 2],
    pub(crate) width: [f64; 2],
}

impl Place {
    /// The patch parameters of the piece's (σ, τ).
    pub(crate) fn at(&self, [s, t]: [f64; 2]) -> [f64; 2] {
        [self.low[0] + 0.5 * (1.0 + s) * self.width[0], self.low[1] + 0.5 * (1.0 + t) * self.width[1]]
    }

    /// The piece's parameters of a place on the patch.
    pub(crate) fn local(&self, axis: usize, parameter: f64) -> f64 {
        2.0 * (parameter - self.low[axis]) / self.width[axis] - 1.0
    }

    fn half(&self, axis: Axis, upper: bool) -> Self {
        let mut half = *self;
        half.width[axis] *= 0.5;
        if upper {
            half.low[axis] += half.width[axis];
        }
        half
    }
}

/// The moved pieces of one side, those of a patch next to each other.
#[derive(Debug)]
pub(crate) struct Pieces {
    pub(crate) patches: PatchSet,
    pub(crate) places: Vec<Place>,
    of_patch: Vec<Range<usize>>,
}

impl Pieces {
    /// Halves every patch until `fits` says so of all its pieces; `None` if
    /// that takes more than `most` pieces or a patch too many halvings.
    pub(crate) fn new(
        side: &Operand<'_>,
        transform: &RigidTransform,
        fits: &dyn Fn(&Patch<'_>) -> bool,
        most: usize,
    ) -> Option<Self> {
        let set = &side.target.patches;
        let grid = center_grid(set.bounding_box().diagonal());
        let mut pieces = Self { patches: PatchSet::default(), places: Vec::new(), of_patch: Vec::new() };
        for (index, patch) in set.iter().enumerate() {
            let first = pieces.places.len();
            let rotate = |control: &DVec4| transform.rotate(control.xyz()).extend(control.w);
            let controls: Vec<DVec4> = patch.controls.iter().map(rotate).collect();
            let moved = Patch { center: transform.apply(patch.center), controls: &controls, ..patch };
            let place = Place { patch: index as u32, low: [0.0; 2], width: [1.0; 2] };
            if !pieces.cut(&moved, place, grid, fits, MAX_HALVINGS, most) {
                return None;
            }
            pieces.of_patch.push(first..pieces.places.len());
        }
        Some(pieces)
    }

    fn cut(
        &mut self,
        patch: &Patch<'_>,
        place: Place,
        grid: f64,
        fits: &dyn Fn(&Patch<'_>) -> bool,
        halvings: u32,
        most: usize,
    ) -> bool {
        let mut centered = PatchSet::default();
        centered.push_centered(*patch, grid);
        let piece = centered.patch(0);
        if fits(&piece) {
            self.patches.push(piece);
            self.places.push(place);
            return self.places.len() <= most;
        }
        let axis = Axis::of_larger(Axis::BOTH.map(|axis| extent(&piece, axis)));
        let halves = piece.halves(axis);
        halvings > 0
            && halves.iter().enumerate().all(|(index, controls)| {
                let half = Patch { controls, ..piece };
                self.cut(&half, place.half(axis, index == 1), grid, fits, halvings - 1, most)
            })
    }

    /// The parts of a cell that lie on one piece each: piece, centre and
    /// half-widths in its parameters.
    pub(crate) fn parts(&self, cell: &Cell) -> impl Iterator<Item = (usize, [f64; 2], [f64; 2])> {
        let (center, half) = (cell.center, cell.half);
        self.of_patch[cell.patch as usize].clone().filter_map(move |piece| {
            let place = &self.places[piece];
            let ends = [0, 1].map(|axis| {
                let low = place.local(axis, center[axis] - half[axis]).max(-1.0);
                let high = place.local(axis, center[axis] + half[axis]).min(1.0);
                [low, high]
            });
            let inside = ends.iter().all(|[low, high]| low < high);
            inside.then(|| {
                (
                    piece,
                    ends.map(|[low, high]| 0.5 * (low + high)),
                    ends.map(|[low, high]| 0.5 * (high - low)),
                )
            })
        })
    }

    /// The cell of a rectangle in a piece's parameters.
    pub(crate) fn cell(&self, piece: usize, center: [f64; 2], half: [f64; 2]) -> Cell {
        let place = &self.places[piece];
        let half = [0, 1].map(|axis| 0.5 * half[axis] * place.width[axis]);
        Cell { patch: place.patch, center: place.at(center), half }
    }
}

/// How long a net is along an axis: the sum of its longest steps.
fn extent(patch: &Patch<'_>, axis: Axis) -> f64 {
    let columns = patch.degree[1] + 1;
    let points: Vec<_> = patch.local_points().collect();
    let (steps, lines, along, across) = if axis == Axis::U {
        (patch.degree[0], columns, columns, 1)
    } else {
        (patch.degree[1], patch.degree[0] + 1, 1, columns)
    };
    let mut sum = 0.0;
    for k in 0..steps {
        let mut longest = 0.0_f64;
        for line in 0..lines {
            let from = k * along + line * across;
            longest = longest.max(points[from].distance(points[from + along]));
        }
        sum += longest;
    }
    sum
}
