//! Surfaces as sheets of Bézier patches that join along their knot lines.

mod chart;
mod lines;
mod slope;

pub(super) use chart::{Chart, Over, Reach};

use super::rounding::JetScale;
use crate::axis::Axis;
use crate::bezier::{BezierModel, LocalDerivativeBounds, Patch, SeamJumps};
use crate::flatness::Places;
use crate::param_box::ParamBox;
use crate::threads::LazyTable;
use std::ops::Range;

/// What the sheets of a model have, each computed at its first use.
#[derive(Debug, Default)]
pub(crate) struct SheetCache {
    /// Derivative bounds of the patches as extracted.
    bounds: LazyTable<LocalDerivativeBounds>,
    /// The jumps at the end of each patch along either axis.
    seams: [LazyTable<SeamJumps>; 2],
}

/// The sheets of a model, and where its flat patches are in them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sheets<'a> {
    pub(crate) bezier: &'a BezierModel,
    pub(crate) places: &'a Places,
    pub(crate) cache: &'a SheetCache,
}

impl<'a> Sheets<'a> {
    /// The index of a patch as extracted, by its surface, row and column.
    pub(super) fn index(&self, surface: u32, [row, column]: [u32; 2]) -> usize {
        let grid = &self.bezier.grids[surface as usize];
        grid.first + row as usize * grid.counts()[1] + column as usize
    }

    /// The patch as extracted of a surface, a row and a column.
    pub(super) fn patch(&self, surface: u32, place: [u32; 2]) -> Patch<'a> {
        self.bezier.patches.patch(self.index(surface, place))
    }

    /// The flat patches that a patch as extracted was cut into. O(log patches).
    pub(super) fn flat_patches(&self, index: usize) -> Range<u32> {
        self.places.pieces(index)
    }

    /// The flat patch that holds a point of a patch as extracted, with the point's parameters in it;
    /// `None` for parameters outside the patch. O(log patches + flat patches of the patch).
    pub(super) fn flat_place(&self, index: usize, parameters: [f64; 2]) -> Option<(u32, [f64; 2])> {
        self.flat_patches(index).find_map(|flat| {
            let place = self.places.get(flat);
            let local = [0, 1].map(|axis| (parameters[axis] - place.low[axis]) / place.width[axis]);
            local.iter().all(|parameter| (0.0..=1.0).contains(parameter)).then_some((flat, local))
        })
    }

    /// Derivative bounds of a patch as extracted.
    fn bounds(&self, patch: usize) -> &'a LocalDerivativeBounds {
        let new = || LocalDerivativeBounds::new(ParamBox::UNIT);
        self.cache.bounds.get(self.bezier.patches.len(), patch, new)
    }

    /// What the rounding of a patch's derivatives depends on.
    fn jet_scale(&self, index: usize) -> JetScale {
        let patch = self.bezier.patches.patch(index);
        JetScale::new(&patch, self.bounds(index).whole(&patch).radius)
    }

    /// The jumps between a patch and the next one along an axis, cyclically, of
    /// derivatives by the parameters of the first of them. `ratio` is its
    /// width over that of the next.
    fn jumps(&self, [low, high]: [usize; 2], axis: Axis, ratio: f64) -> &'a SeamJumps {
        self.cache.seams[axis].get(self.bezier.patches.len(), low, || {
            let [before, after] = [low, high].map(|index| self.bezier.patches.patch(index));
            SeamJumps::between(&before, &after, self.bounds(high).whole(&after), axis, ratio)
        })
    }
}
