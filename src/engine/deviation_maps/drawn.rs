//! Maps of pictures.

use super::measurer::Here;
use super::{BASE_PART, MapSearch};
use crate::deviation::Map;
use crate::engine::section::Section;
use crate::engine::{Computation, Engine, Signs};

/// A map with what its signs stand for.
#[derive(Debug)]
pub(crate) struct SignedMap {
    pub(crate) map: Map,
    pub(crate) signs: Signs,
}

impl Engine {
    /// Makes a map to the end, unless nothing of it has a colour.
    pub(crate) fn measured_map<'a>(&'a self, mut search: MapSearch<'a>) -> Computation<'a, SignedMap> {
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
