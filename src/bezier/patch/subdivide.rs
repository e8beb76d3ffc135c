//! Halves and rectangular pieces of a patch.

use crate::axis::Axis;
use crate::bezier::extraction::extract::center_of;
use crate::bezier::patch::relative;
use crate::bezier::{MAX_ORDER, Patch, PatchSet};
use glam::{DVec3, DVec4};

impl Patch<'_> {
    /// Returns the controls of the two halves of the patch along `axis`.
    ///
    /// De Casteljau's algorithm at 1/2 takes averages only, so the halves are
    /// exact up to rounding. O(p q (p + q)).
    #[must_use]
    pub fn halves(&self, axis: Axis) -> [Vec<DVec4>; 2] {
        let columns = self.degree[1] + 1;
        let (lines, order, step, stride) = match axis {
            Axis::U => (columns, self.degree[0] + 1, columns, 1),
            Axis::V => (self.degree[0] + 1, columns, 1, columns),
        };
        let mut low = self.controls.to_vec();
        let mut high = self.controls.to_vec();
        for line in 0..lines {
            let at = |index: usize| line * stride + index * step;
            for level in 1..order {
                for index in 0..order - level {
                    high[at(index)] = 0.5 * (high[at(index)] + high[at(index + 1)]);
                }
                low[at(level)] = high[at(0)];
            }
        }
        [low, high]
    }

    /// Returns the controls of the piece over `s` × `t`, intervals of positive length.
    ///
    /// Control k of a restricted Bézier curve of degree p is the blossom at the
    /// interval's start, p - k times, and its end, k times: convex combinations
    /// only, if the interval lies in [0, 1]. O(p q (p + q)).
    #[must_use]
    pub fn restricted(&self, s: [f64; 2], t: [f64; 2]) -> Vec<DVec4> {
        let mut controls = self.controls.to_vec();
        let (rows, columns) = (self.degree[0] + 1, self.degree[1] + 1);
        if t != [0.0, 1.0] {
            for row in 0..rows {
                restrict_line(&mut controls, row * columns, 1, columns, t);
            }
        }
        if s != [0.0, 1.0] {
            for column in 0..columns {
                restrict_line(&mut controls, column, columns, rows, s);
            }
        }
        controls
    }
}

/// Restricts one line of controls to [start, end] by two steps of de Casteljau's algorithm.
///
/// The first step is the one that keeps the longer part, or that extrapolates.
/// Each step takes both of its factors from the exact ends, so that each has a
/// relative error of at most three roundings and the piece is that of exactly
/// [start, end] (lemma R6 of docs/rounding.md). `1 - start / end` of the rounded
/// quotient would move an end, and leave a gap between neighbouring pieces.
pub(in crate::bezier) fn restrict_line(
    controls: &mut [DVec4],
    first: usize,
    stride: usize,
    order: usize,
    [start, end]: [f64; 2],
) {
    let mut line = [DVec4::ZERO; MAX_ORDER];
    for (index, control) in line.iter_mut().enumerate().take(order) {
        *control = controls[first + index * stride];
    }
    let line = &mut line[..order];
    if end > 1.0 - start {
        keep_low(line, [1.0 - end, end]);
        keep_high(line, [(end - start) / end, start / end]);
    } else {
        keep_high(line, [1.0 - start, start]);
        keep_low(line, [(1.0 - end) / (1.0 - start), (end - start) / (1.0 - start)]);
    }
    for (index, control) in line.iter().enumerate().take(order) {
        controls[first + index * stride] = *control;
    }
}

/// Restricts a line to [start, 1], given 1 - start and start.
fn keep_high(line: &mut [DVec4], [complement, start]: [f64; 2]) {
    for level in 1..line.len() {
        for index in 0..line.len() - level {
            line[index] = complement * line[index] + start * line[index + 1];
        }
    }
}

/// Restricts a line to [0, end], given 1 - end and end.
fn keep_low(line: &mut [DVec4], [complement, end]: [f64; 2]) {
    for level in 1..line.len() {
        for index in (level..line.len()).rev() {
            line[index] = complement * line[index - 1] + end * line[index];
        }
    }
}

/// Returns an upper bound on the length of the control polygons along an axis: the sum
/// of the longest differences of neighbouring controls.
#[cfg(feature = "gpu")]
pub(crate) fn net_length(patch: &Patch<'_>, axis: usize) -> f64 {
    let columns = patch.degree[1] + 1;
    let points: Vec<_> = patch.local_points().collect();
    let (differences, lines, along, across) = if axis == 0 {
        (patch.degree[0], columns, columns, 1)
    } else {
        (patch.degree[1], patch.degree[0] + 1, 1, columns)
    };
    let mut sum = 0.0;
    for k in 0..differences {
        let mut longest = 0.0_f64;
        for line in 0..lines {
            let from = k * along + line * across;
            longest = longest.max(points[from].distance(points[from + along]));
        }
        sum += longest;
    }
    sum
}

impl PatchSet {
    /// Appends `patch` with its centre moved to the middle of its control
    /// points, rounded to the grid of spacing `grid`.
    pub(crate) fn push_centered(&mut self, patch: Patch<'_>, grid: f64) {
        let shift: DVec3 =
            center_of(patch.local_points().map(|point| point + patch.center), grid) - patch.center;
        let controls = relative(patch.controls, shift);
        self.push(Patch { center: patch.center + shift, controls: &controls, ..patch });
    }
}
