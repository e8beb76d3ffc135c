//! The search of a map: its points are measured from the other model.

use super::DeviationMap;
use super::measurer::{MapPoints, Measurer};
use crate::deviation::{FLOOR, Fineness, KnownDeviation, MapBuilder, Placing};
use crate::engine::section::Section;
use crate::engine::{ClosestPointOptions, ClosestPoints, PreparedModel, Signs};
use crate::error::Result;
use crate::model::RigidTransform;
use crate::progress::Monitor;

/// The permitted excess of a distance, in diagonals: a tenth of the least deviation that has a colour. Points
/// that are off a model by the rounding of float32 alone take several times as long at the default.
const EXCESS: f64 = 5e-8;

/// The part of the rest of the progress that a round of splitting takes.
const ROUND_PART: f64 = 0.25;

/// A map that is being made.
pub(crate) struct MapSearch<'a> {
    pub(super) builder: MapBuilder,
    other: &'a PreparedModel,
    options: ClosestPointOptions,
    pub(super) signs: Signs,
}

/// Two models whose maps are made.
#[derive(Debug, Clone, Copy)]
pub struct MapPair<'a> {
    pub(crate) a: &'a PreparedModel,
    pub(crate) b: &'a PreparedModel,
    /// A's units in one of B's.
    pub(crate) scale: f64,
    /// Moves A.
    pub(crate) transform: RigidTransform,
}

impl<'a> MapPair<'a> {
    /// Returns the pair; with `scale_units` B is in A's unit.
    ///
    /// # Errors
    /// [`crate::Error::UnitsDiffer`] if the units differ and must not be scaled.
    pub fn new(
        a: &'a PreparedModel,
        b: &'a PreparedModel,
        transform: RigidTransform,
        scale_units: bool,
    ) -> Result<Self> {
        let scale = b.factor_to_unit_of(a, scale_units)?.unwrap_or(1.0);
        Ok(Self { a, b, scale, transform })
    }

    /// Returns the larger diagonal of both models, in A's unit.
    #[must_use]
    pub fn diagonal(&self) -> f64 {
        self.a.bounding_box().diagonal().max(self.scale * self.b.bounding_box().diagonal())
    }

    pub(crate) fn placing(&self, is_of_a: bool) -> Placing {
        Placing { transform: self.transform, scale: self.scale, is_of_a }
    }

    /// Begins the map of A or of B.
    ///
    /// # Errors
    /// Those of [`crate::tessellate`].
    pub(crate) fn search(
        &self,
        is_of_a: bool,
        shown: &KnownDeviation,
        fineness: Fineness,
    ) -> Result<MapSearch<'a>> {
        let (model, other) = if is_of_a { (self.a, self.b) } else { (self.b, self.a) };
        let (placing, diagonal) = (self.placing(is_of_a), self.diagonal());
        // Deviations without a colour need no sign.
        let sign_tolerance = FLOOR * diagonal / if is_of_a { self.scale } else { 1.0 };
        let options = ClosestPointOptions {
            relative_tolerance: Some(EXCESS),
            sign_tolerance,
            ..ClosestPointOptions::default()
        };
        let base = model.map_base()?;
        let builder = MapBuilder::new(&base, shown, placing, diagonal, fineness);
        Ok(MapSearch { builder, other, options, signs: Signs::default() })
    }
}

impl MapSearch<'_> {
    /// Measures all pending points; of a map that is refined round after round, each a part of the rest of the
    /// progress.
    pub(super) async fn measure(
        &mut self,
        measurer: &mut dyn Measurer,
        monitor: &mut dyn Monitor,
    ) -> Result<()> {
        let mut begin = 0.0;
        while !self.builder.pending().is_empty() {
            let part = if self.is_refined() { ROUND_PART * (1.0 - begin) } else { 1.0 };
            let mut section = Section { whole: &mut *monitor, part: [begin, part] };
            begin += part;
            let points = self.builder.pending();
            let asked = MapPoints { other: self.other, points, options: &self.options };
            let found = measurer.measure(asked, &mut section).await?;
            let ClosestPoints { signed, distances, feet, signs, .. } = found;
            self.builder.measured(&signed, &distances, &feet);
            self.signs = signs;
        }
        Ok(())
    }

    fn is_refined(&self) -> bool {
        !self.builder.map().values.is_empty()
    }

    /// Returns what has been measured.
    pub(super) fn map(&self) -> DeviationMap {
        DeviationMap::new(self.builder.map(), self.builder.placing(), self.signs)
    }
}
