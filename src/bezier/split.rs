//! Halving a patch.

use super::extract::center_of;
use super::patch::relative;
use super::{Patch, PatchSet};
use crate::axis::Axis;
use glam::{DVec3, DVec4};

impl Patch<'_> {
    /// The controls of the two halves of the patch along `axis` (0: s, else t),
    /// by de Casteljau at 1/2: averages only, so exact up to rounding.
    #[must_use]
    pub fn halves(&self, axis: Axis) -> [Vec<DVec4>; 2] {
        let columns = self.degree[1] + 1;
        let (lines, length, step, stride) = if axis == Axis::U {
            (columns, self.degree[0] + 1, columns, 1)
        } else {
            (self.degree[0] + 1, columns, 1, columns)
        };
        let mut low = self.controls.to_vec();
        let mut high = self.controls.to_vec();
        for line in 0..lines {
            let at = |index: usize| line * stride + index * step;
            for level in 1..length {
                for index in 0..length - level {
                    high[at(index)] = 0.5 * (high[at(index)] + high[at(index + 1)]);
                }
                low[at(level)] = high[at(0)];
            }
        }
        [low, high]
    }
}

impl PatchSet {
    /// Appends `patch` moved to a centre of its own on the grid of spacing `grid`.
    pub(crate) fn push_centered(&mut self, patch: Patch<'_>, grid: f64) {
        let shift: DVec3 =
            center_of(patch.local_points().map(|point| point + patch.center), grid) - patch.center;
        let controls = relative(patch.controls, shift);
        self.push(Patch { center: patch.center + shift, controls: &controls, ..patch });
    }
}
