//! Maps of deviations: the triangles of models with the deviation at each vertex.

#[cfg(not(target_arch = "wasm32"))]
mod drawn;
mod measurer;
mod result;
mod search;

use super::options::at_least_zero;
use super::points::require_in_range;
use super::query::{Query, impl_query};
use super::section::Section;
use super::{Computation, Engine, PreparedModel};
use crate::deviation::{FarthestPoint, Fineness, KnownDeviation};
use crate::error::Result;
use crate::model::RigidTransform;
use crate::progress::{MaybeSend, Monitor};
#[cfg(not(target_arch = "wasm32"))]
pub use drawn::SignedMap;
#[cfg(all(feature = "wasm", target_arch = "wasm32"))]
pub(crate) use measurer::{Here, MapPoints, Measurer};
#[cfg(not(all(feature = "wasm", target_arch = "wasm32")))]
use measurer::{Here, Measurer};
pub use result::{DeviationMap, DeviationMaps};
pub use search::MapPair;
use search::MapSearch;
use serde::Deserialize;

/// The part of the progress that is the bases'.
const BASE_PART: f64 = 0.5;

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

impl_query!(DeviationMapOptions, deviation_maps -> DeviationMaps, [scale_units, transform]);

impl DeviationMapOptions {
    /// # Errors
    /// [`crate::Error::OptionOutOfRange`] for a bound that is not a finite number of at least 0;
    /// [`crate::Error::PointOutOfRange`] for a farthest point, index 0, and its foot, 1.
    fn require_own(&self) -> Result<()> {
        for KnownDeviation { uppers, farthest } in self.a.iter().chain(&self.b) {
            uppers.iter().try_for_each(|&upper| at_least_zero("uppers", upper))?;
            if let Some(FarthestPoint { point, foot, .. }) = *farthest {
                require_in_range([point, foot].as_flattened())?;
            }
        }
        Ok(())
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
    /// [`crate::Error::UnitsDiffer`]; [`crate::Error::OptionOutOfRange`] for a known bound that is not a finite number
    /// of at least 0; [`crate::Error::PointOutOfRange`] for a farthest point, index 0, or its foot, 1, with a coordinate
    /// that is not finite or above 1e100 in size; [`crate::Error::Cancelled`].
    pub fn deviation_maps<'a>(
        &'a self,
        a: &'a PreparedModel,
        b: &'a PreparedModel,
        options: &'a DeviationMapOptions,
    ) -> Computation<'a, DeviationMaps> {
        self.deviation_maps_by(a, b, options, Here, |_| {})
    }

    /// As [`Self::deviation_maps`], with the points measured by `measurer`; calls `on_coarse` with the maps before
    /// their triangles are split, if they will be.
    pub(crate) fn deviation_maps_by<'a>(
        &'a self,
        a: &'a PreparedModel,
        b: &'a PreparedModel,
        options: &'a DeviationMapOptions,
        mut measurer: impl Measurer + 'a,
        mut on_coarse: impl FnMut(DeviationMaps) + MaybeSend + 'a,
    ) -> Computation<'a, DeviationMaps> {
        Computation::new(move |mut watched| {
            Box::pin(async move {
                let pair = MapPair::new(a, b, options.transform, options.scale_units)?;
                pair.maps(options, &mut measurer, &mut on_coarse, watched.monitor()).await
            })
        })
    }
}

impl MapPair<'_> {
    async fn maps(
        &self,
        options: &DeviationMapOptions,
        measurer: &mut dyn Measurer,
        on_coarse: &mut (impl FnMut(DeviationMaps) + MaybeSend),
        monitor: &mut dyn Monitor,
    ) -> Result<DeviationMaps> {
        options.validate()?;
        let nothing = (options.a.is_none() && options.b.is_none()).then(KnownDeviation::default);
        let shown = [(true, options.a.as_ref().or(nothing.as_ref())), (false, options.b.as_ref())];
        let mut searches = Vec::new();
        for (is_of_a, shown) in shown {
            if let Some(shown) = shown {
                searches.push((is_of_a, self.search(is_of_a, shown, Fineness::SCREEN)?));
            }
        }
        let count = searches.len() as f64;
        let maps = |searches: &[(bool, MapSearch<'_>)]| {
            let of = |side: bool| searches.iter().find(|(is_of_a, _)| *is_of_a == side);
            let [a, b] = [true, false].map(|side| of(side).map(|(_, search)| search.map()));
            DeviationMaps { diagonal: self.diagonal(), a, b }
        };
        for (index, (_, search)) in searches.iter_mut().enumerate() {
            let begin = BASE_PART * index as f64 / count;
            let part = [begin, BASE_PART / count];
            search.measure(measurer, &mut Section { whole: monitor, part }).await?;
            search.builder.refine();
        }
        if searches.iter().any(|(_, search)| !search.builder.pending().is_empty()) {
            on_coarse(maps(&searches));
            for (index, (_, search)) in searches.iter_mut().enumerate() {
                let begin = BASE_PART + (1.0 - BASE_PART) * index as f64 / count;
                let part = [begin, (1.0 - BASE_PART) / count];
                search.measure(measurer, &mut Section { whole: monitor, part }).await?;
            }
        }
        monitor.progress(1.0);
        Ok(maps(&searches))
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests;
