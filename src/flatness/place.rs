//! Where flat pieces are in the patches that they were cut from.

use crate::axis::Axis;
use crate::bezier::LocalDerivativeBounds;
use crate::param_box::ParamBox;
use crate::threads::parallel::map;
use std::ops::Range;

/// A part of a patch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// The patch.
    pub patch: u32,
    /// Its parameters at the part's start, a multiple of the width.
    pub low: [f64; 2],
    /// The width along each axis, a power of two.
    pub width: [f64; 2],
    /// The parameters at which the part's controls give points of the patch: [0, 1]², and
    /// a little more beyond an edge at which it was cut.
    pub extension: ParamBox,
}

impl Place {
    /// The whole of a patch.
    pub(super) fn whole(patch: usize) -> Self {
        Self { patch: patch as u32, low: [0.0; 2], width: [1.0; 2], extension: ParamBox::UNIT }
    }

    pub(super) fn is_whole(&self) -> bool {
        self.width == [1.0; 2]
    }

    /// The halves along an axis, with its own extension.
    pub(super) fn halves(&self, axis: Axis) -> [Self; 2] {
        let mut halves = [*self; 2];
        for half in &mut halves {
            half.width[axis] *= 0.5;
        }
        halves[1].low[axis] += halves[1].width[axis];
        halves
    }
}

/// The places of all flat pieces of a set of patches, in the order of both.
#[derive(Debug, Clone)]
pub enum Places {
    /// Each of the `count` pieces is a whole patch.
    Whole(usize),
    /// Some patches were cut.
    Cut(Vec<Place>),
}

impl Places {
    /// Returns the number of pieces.
    #[must_use]
    pub fn count(&self) -> usize {
        match self {
            Self::Whole(count) => *count,
            Self::Cut(places) => places.len(),
        }
    }

    /// Returns the place of a piece, whose index must be below [`Places::count`].
    #[must_use]
    pub fn get(&self, piece: u32) -> Place {
        match self {
            Self::Whole(_) => Place::whole(piece as usize),
            Self::Cut(places) => places[piece as usize],
        }
    }

    /// Iterates over the places of all pieces.
    pub fn iter(&self) -> impl Iterator<Item = Place> + '_ {
        (0..self.count()).map(|piece| self.get(piece as u32))
    }

    /// Returns bounds on the derivatives of all pieces, none of them computed yet.
    pub(crate) fn derivative_bounds(&self) -> Vec<LocalDerivativeBounds> {
        map(self.count(), |piece| LocalDerivativeBounds::new(self.get(piece as u32).extension))
    }

    /// Returns the pieces of a patch. O(log pieces).
    pub(crate) fn pieces(&self, patch: usize) -> Range<u32> {
        match self {
            Self::Whole(_) => patch as u32..patch as u32 + 1,
            Self::Cut(places) => {
                let start =
                    |patch: usize| places.partition_point(|place| (place.patch as usize) < patch) as u32;
                start(patch)..start(patch + 1)
            }
        }
    }
}
