//! Maps of deviations: the triangles of models with the deviation at each vertex.

#[cfg(not(target_arch = "wasm32"))]
mod drawn;
mod result;

use super::options::at_least_zero;
use super::points::ClosestPoints;
use super::section::Section;
use super::{ClosestPointOptions, Computation, Engine, PreparedModel, Signs};
use crate::deviation::{FLOOR, Fineness, MapBuilder, Placing};
use crate::deviation::{FarthestPoint, KnownDeviation};
use crate::error::{Error, Result};
use crate::model::RigidTransform;
use crate::progress::{MaybeSend, Monitor};
#[cfg(not(target_arch = "wasm32"))]
pub(crate) use drawn::SignedMap;
pub use result::{DeviationMap, DeviationMaps};
use serde::Deserialize;

/// The permitted excess of a distance, in diagonals: a tenth of the least deviation that has a colour. Points
/// that are off a model by the rounding of float32 alone take several times as long at the default.
const EXCESS: f64 = 5e-8;

/// The parts of the progress that are the bases', and that a round of splitting takes of the rest.
const BASE_PART: f64 = 0.5;
const ROUND_PART: f64 = 0.25;

/// Options of [`Engine::deviation_maps`]; names in camelCase when deserialized.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct DeviationMapOptions {
    /// What is known of A, whose map is made. Without this of either model, nothing is known and A's is made.
    pub a: Option<KnownDeviation>,
    /// What is known of B, whose map is made.
    pub b: Option<KnownDeviation>,
    /// Whether B is scaled to the unit of A where both state different ones; else they are
    /// an error.
    pub scale_units: bool,
    /// Moves A before it is measured. It is not deserialized, because only
    /// [`RigidTransform::new`] makes one.
    #[serde(skip)]
    pub transform: RigidTransform,
}

impl DeviationMapOptions {
    /// # Errors
    /// [`Error::OptionOutOfRange`] for a bound that is not a finite number of at least 0, and
    /// [`Error::PointOutOfRange`] for a farthest point that is not finite.
    fn validate(&self) -> Result<()> {
        for KnownDeviation { uppers, farthest } in self.a.iter().chain(&self.b) {
            uppers.iter().try_for_each(|&upper| at_least_zero("uppers", upper))?;
            let coordinates =
                farthest.iter().flat_map(|FarthestPoint { point, foot, .. }| point.iter().chain(foot));
            if let Some(&found) = coordinates.into_iter().find(|coordinate| !coordinate.is_finite()) {
                return Err(Error::PointOutOfRange { index: 0, found });
            }
        }
        Ok(())
    }
}

/// A map that is being made.
pub(crate) struct MapSearch<'a> {
    builder: MapBuilder,
    other: &'a PreparedModel,
    options: ClosestPointOptions,
    signs: Signs,
}

/// Two models of which maps are made.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MapPair<'a> {
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
    /// [`Error::UnitsDiffer`] if the units differ and must not be scaled.
    pub(crate) fn new(
        a: &'a PreparedModel,
        b: &'a PreparedModel,
        transform: RigidTransform,
        scale_units: bool,
    ) -> Result<Self> {
        let scale = match (a.unit(), b.unit()) {
            (Some(of_a), Some(of_b)) if of_a != of_b && !scale_units => {
                return Err(Error::UnitsDiffer { a: of_a, b: of_b });
            }
            (Some(of_a), Some(of_b)) => of_b / of_a,
            _ => 1.0,
        };
        Ok(Self { a, b, scale, transform })
    }

    /// Returns the larger diagonal of both models, in A's unit.
    pub(crate) fn diagonal(&self) -> f64 {
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
    async fn measure(&mut self, engine: &Engine, monitor: &mut dyn Monitor) -> Result<()> {
        let mut begin = 0.0;
        while !self.builder.pending().is_empty() {
            let part = if self.is_refined() { ROUND_PART * (1.0 - begin) } else { 1.0 };
            let mut section = Section { whole: &mut *monitor, part: [begin, part] };
            begin += part;
            let points = self.builder.pending();
            let found = engine.closest_points_of(self.other, points, &self.options, &mut section).await?;
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
    fn map(&self) -> DeviationMap {
        DeviationMap::new(self.builder.map(), self.builder.placing(), self.signs)
    }
}

impl Engine {
    /// Returns the maps of the models that the options name, with the deviation of each from the other one at
    /// the vertices of triangles that are split where the deviation between them is not linear: for pictures.
    ///
    /// Guarantee: the distance at a vertex is that of its point to 5e-8 of the other model's diagonal, unless
    /// a known bound is less. Between vertices it is an estimate. All in float64 on the CPU.
    /// O(points log patches) in general position; the points of a map are the vertices of triangles within 5e-4 of
    /// the diagonal and with edges of at most a thirtieth of it, and at most 180,000 between them.
    ///
    /// # Errors
    /// [`Error::UnitsDiffer`]; [`Error::Cancelled`].
    pub fn deviation_maps<'a>(
        &'a self,
        a: &'a PreparedModel,
        b: &'a PreparedModel,
        options: &'a DeviationMapOptions,
    ) -> Computation<'a, DeviationMaps> {
        self.deviation_maps_told(a, b, options, |_| {})
    }

    /// As [`Self::deviation_maps`]; calls the function with the maps before their triangles are split, if they
    /// will be.
    pub(crate) fn deviation_maps_told<'a>(
        &'a self,
        a: &'a PreparedModel,
        b: &'a PreparedModel,
        options: &'a DeviationMapOptions,
        mut told: impl FnMut(DeviationMaps) + MaybeSend + 'a,
    ) -> Computation<'a, DeviationMaps> {
        Computation::new(move |mut watched| {
            Box::pin(async move {
                let pair = MapPair::new(a, b, options.transform, options.scale_units)?;
                self.maps_of(&pair, options, &mut told, watched.monitor()).await
            })
        })
    }

    async fn maps_of(
        &self,
        pair: &MapPair<'_>,
        options: &DeviationMapOptions,
        told: &mut (impl FnMut(DeviationMaps) + MaybeSend),
        monitor: &mut dyn Monitor,
    ) -> Result<DeviationMaps> {
        options.validate()?;
        let nothing = (options.a.is_none() && options.b.is_none()).then(KnownDeviation::default);
        let shown = [(true, options.a.as_ref().or(nothing.as_ref())), (false, options.b.as_ref())];
        let mut searches = Vec::new();
        for (is_of_a, shown) in shown {
            if let Some(shown) = shown {
                searches.push((is_of_a, pair.search(is_of_a, shown, Fineness::SCREEN)?));
            }
        }
        let count = searches.len() as f64;
        let maps = |searches: &[(bool, MapSearch<'_>)]| {
            let of = |side: bool| searches.iter().find(|(is_of_a, _)| *is_of_a == side);
            let [a, b] = [true, false].map(|side| of(side).map(|(_, search)| search.map()));
            DeviationMaps { diagonal: pair.diagonal(), a, b }
        };
        for (index, (_, search)) in searches.iter_mut().enumerate() {
            let begin = BASE_PART * index as f64 / count;
            search.measure(self, &mut Section { whole: monitor, part: [begin, BASE_PART / count] }).await?;
            search.builder.refine();
        }
        if searches.iter().any(|(_, search)| !search.builder.pending().is_empty()) {
            told(maps(&searches));
            for (index, (_, search)) in searches.iter_mut().enumerate() {
                let begin = BASE_PART + (1.0 - BASE_PART) * index as f64 / count;
                search
                    .measure(self, &mut Section { whole: monitor, part: [begin, (1.0 - BASE_PART) / count] })
                    .await?;
            }
        }
        monitor.progress(1.0);
        Ok(maps(&searches))
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests;
