//! The number of divisions of each knot span.

use crate::axis::Axis;
use crate::bezier::{BezierModel, Patch, PatchGrid};

/// The approximate largest number of triangles of a model, unless it has more
/// patches: an integrated GPU still rotates them smoothly.
const MAX_TRIANGLES: f64 = (1 << 20) as f64;

/// The largest number of parts of one span, so that products of numbers fit an integer.
const MAX_PARTS: f64 = 4096.0;

/// The largest number of halvings of a patch for closer bounds.
const MAX_HALVINGS: u32 = 6;

/// The number of parts along both axes up to which closer bounds do not pay.
const FEW_PARTS: f64 = 3.0;

/// The largest factor of a round of coarsening, which removes at least a tenth.
const MAX_COARSENING: f64 = 0.9;

/// The numbers of equal parts of the spans of one surface.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Divisions {
    /// One number per span in u and v, each at least 1.
    pub(super) parts: [Vec<usize>; 2],
}

impl Divisions {
    /// Returns the divisions of every surface of `model`. O(patches p q).
    pub(super) fn of_model(model: &BezierModel, tolerance: f64) -> Vec<Self> {
        let mut all: Vec<Self> = model.grids.iter().map(|grid| Self::new(model, grid, tolerance)).collect();
        loop {
            let triangles: f64 = all.iter().map(Self::triangles).sum();
            if triangles <= MAX_TRIANGLES || all.iter().all(Self::is_coarsest) {
                return all;
            }
            let factor = (MAX_TRIANGLES / triangles).sqrt().min(MAX_COARSENING);
            for parts in all.iter_mut().flat_map(|divisions| &mut divisions.parts).flatten() {
                *parts = ((*parts as f64 * factor) as usize).max(1);
            }
        }
    }

    /// Returns the divisions of one surface for this tolerance.
    fn new(model: &BezierModel, grid: &PatchGrid, tolerance: f64) -> Self {
        let [rows, columns] = grid.counts();
        let mut parts = [vec![1; rows], vec![1; columns]];
        for row in 0..rows {
            for column in 0..columns {
                let patch = model.patches.patch(grid.first + row * columns + column);
                let [s, t] = parts_of(&patch, tolerance, MAX_HALVINGS);
                // NaN, which a model that is one point gives, is converted to 0 and raised to 1.
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

/// Returns the numbers of equal parts along s and t that keep triangles within
/// `tolerance`.
///
/// The distance of a triangle with sides h and k along s and t from the surface is
/// at most `(h² |x_ss| + 2 h k |x_st| + k² |x_tt|) / 8` (Filip, Magedson and
/// Markot, *Surface algorithms using bounds on derivatives*, Computer Aided
/// Geometric Design 3 (1986)). As `2 h k <= r h² + k² / r` for every r > 0, it
/// suffices that `h² (|x_ss| + r |x_st|)` and `k² (|x_tt| + |x_st| / r)` are each
/// at most four times the tolerance; r is the patch's ratio of sides. Where the
/// bounds on the derivatives require many parts, bounds over the patch's halves may
/// require fewer.
fn parts_of(patch: &Patch<'_>, tolerance: f64, halvings: u32) -> [f64; 2] {
    let bounds = patch.derivative_bounds();
    let [ss, st, tt] = bounds.second;
    let ratio = bounds.first[0] / bounds.first[1];
    let ratio = if ratio.is_normal() { ratio } else { 1.0 };
    let count = |second: f64| (second / (4.0 * tolerance)).sqrt();
    let parts = [count(ss + ratio * st), count(tt + st / ratio)];
    if halvings == 0 || parts.iter().all(|&parts| parts <= FEW_PARTS) {
        return parts.map(f64::ceil);
    }
    let axis = Axis::of_larger(parts);
    let mut half_parts = [0.0_f64; 2];
    for controls in patch.halves(axis) {
        let half_patch = Patch { controls: &controls, ..*patch };
        let half = parts_of(&half_patch, tolerance, halvings - 1);
        half_parts = [0, 1].map(|axis| half_parts[axis].max(half[axis]));
    }
    half_parts[axis] *= 2.0;
    [0, 1].map(|axis| parts[axis].ceil().min(half_parts[axis]))
}
