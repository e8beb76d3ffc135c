//! Maps of pictures.

use super::measurer::Here;
use super::{BASE_PART, MapPair, MapSearch};
use crate::deviation::{Fineness, KnownDeviation, Map};
use crate::engine::section::Section;
use crate::engine::{Computation, Engine, Signs};
use crate::error::Result;
use glam::DVec3;

/// A map with what its signs stand for.
#[derive(Debug)]
pub struct SignedMap {
    /// The map.
    pub map: Map,
    /// What its signs stand for.
    pub signs: Signs,
}

impl MapPair<'_> {
    /// Returns the map of A or of B for a printed picture, in the coordinates of a result; of a mesh with the normals
    /// of its triangles.
    ///
    /// # Errors
    /// Those of [`Engine::deviation_maps`].
    pub fn drawn(&self, is_of_a: bool, shown: &KnownDeviation) -> Result<SignedMap> {
        let search = self.search(is_of_a, shown, Fineness::PICTURE)?;
        let SignedMap { map, signs } = Engine::cpu().measured_map(search).wait()?;
        let mut map = map.placed(&self.placing(is_of_a));
        if map.is_mesh {
            map.vertices.iter_mut().for_each(|vertex| vertex.normal = DVec3::ZERO);
        }
        Ok(SignedMap { map, signs })
    }
}

impl Engine {
    /// Makes a map to the end, unless nothing of it has a colour.
    pub(super) fn measured_map<'a>(&'a self, mut search: MapSearch<'a>) -> Computation<'a, SignedMap> {
        Computation::new(move |mut watched| {
            Box::pin(async move {
                let mut measurer = Here;
                if search.builder.may_have_colors() {
                    search
                        .measure(
                            &mut measurer,
                            &mut Section { whole: watched.monitor(), part: [0.0, BASE_PART] },
                        )
                        .await?;
                    search.builder.refine();
                    let part = [BASE_PART, 1.0 - BASE_PART];
                    search.measure(&mut measurer, &mut Section { whole: watched.monitor(), part }).await?;
                }
                Ok(SignedMap { signs: search.signs, map: search.builder.finish() })
            })
        })
    }
}
