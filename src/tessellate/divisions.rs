//! How finely each knot span is divided.

use crate::axis::Axis;
use crate::bezier::{BezierModel, Patch, PatchGrid};

/// Triangles of a model, about and at most, unless it has more patches: what
/// an integrated GPU still turns smoothly.
const MAX_TRIANGLES: f64 = (1 << 20) as f64;

/// Parts of one span, at most, so that their number fits any integer.
const MAX_PARTS: f64 = 4096.0;

/// Halvings of a patch, at most, to bound it more closely.
const MAX_HALVINGS: u32 = 6;

/// Parts in both directions up to which a closer bound is not worth its time.
const ENOUGH: f64 = 3.0;

/// Each round of coarsening takes away at least a tenth.
const MIN_COARSENING: f64 = 0.9;

/// Numbers of equal parts of the spans of one surface.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Divisions {
    /// One number a span in u and v, each at least 1.
    pub(super) parts: [Vec<usize>; 2],
}

impl Divisions {
    /// For every surface of `model`. O(patches p q).
    pub(super) fn of_model(model: &BezierModel, tolerance: f64) -> Vec<Self> {
        let mut all: Vec<Self> = model.grids.iter().map(|grid| Self::new(model, grid, tolerance)).collect();
        loop {
            let triangles: f64 = all.iter().map(Self::triangles).sum();
            if triangles <= MAX_TRIANGLES || all.iter().all(Self::is_coarsest) {
                return all;
            }
            let factor = (MAX_TRIANGLES / triangles).sqrt().min(MIN_COARSENING);
            for parts in all.iter_mut().flat_map(|divisions| &mut divisions.parts).flatten() {
                *parts = ((*parts as f64 * factor) as usize).max(1);
            }
        }
    }

    fn new(model: &BezierModel, grid: &PatchGrid, tolerance: f64) -> Self {
        let [rows, columns] = grid.counts();
        let mut parts = [vec![1; rows], vec![1; columns]];
        for row in 0..rows {
            for column in 0..columns {
                let patch = model.patches.patch(grid.first + row * columns + column);
                let [s, t] = parts_of(&patch, tolerance, MAX_HALVINGS);
                // No number, of a model that is one point, becomes 0 and loses to 1.
                parts[0][row] = parts[0][row].max(s.min(MAX_PARTS) as usize);
                parts[1][column] = parts[1][column].max(t.min(MAX_PARTS) as usize);
            }
        }
        Self { parts }
    }

    fn triangles(&self) -> f64 {
        let [rows, columns] = [0, 1].map(|axis| self.parts[axis].iter().sum::<usize>() as f64);
        2.0 * rows * columns
    }

    fn is_coarsest(&self) -> bool {
        self.parts.iter().flatten().all(|&parts| parts == 1)
    }
}

/// Numbers of equal parts along s and t that keep triangles within `tolerance`.
///
/// A triangle of sides h and k along s and t is off the surface by at most
/// `(h^2 |x_ss| + 2 h k |x_st| + k^2 |x_tt|) / 8` (Filip, Magedson and Markot
/// 1986). As `2 h k <= r h^2 + k^2 / r` for every r, it is enough that
/// `h^2 (|x_ss| + r |x_st|)` and `k^2 (|x_tt| + |x_st| / r)` are each at most
/// four times the tolerance; r is the patch's ratio of sides. Where the bounds
/// of the derivatives ask for many parts, those of the patch's halves may ask
/// for fewer.
fn parts_of(patch: &Patch<'_>, tolerance: f64, halvings: u32) -> [f64; 2] {
    let bounds = patch.derivative_bounds();
    let [ss, st, tt] = bounds.second;
    let ratio = bounds.first[0] / bounds.first[1];
    let ratio = if ratio.is_normal() { ratio } else { 1.0 };
    let of = |second: f64| (second / (4.0 * tolerance)).sqrt();
    let parts = [of(ss + ratio * st), of(tt + st / ratio)];
    if halvings == 0 || parts.iter().all(|&parts| parts <= ENOUGH) {
        return parts.map(f64::ceil);
    }
    let axis = Axis::of_larger(parts);
    let mut of_halves = [0.0_f64; 2];
    for controls in patch.halves(axis) {
        let half = Patch { controls: &controls, ..*patch };
        let of_half = parts_of(&half, tolerance, halvings - 1);
        of_halves = [0, 1].map(|axis| of_halves[axis].max(of_half[axis]));
    }
    of_halves[axis] *= 2.0;
    [0, 1].map(|axis| parts[axis].ceil().min(of_halves[axis]))
}
