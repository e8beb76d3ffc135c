//! Whether a body is certainly embedded, or certainly not.

use super::SelfOverlap;
use crate::embedded::{Doubt, Limits, Sheets, Verdict, verdict_on_patches, verdict_on_triangles};
use crate::engine::PreparedModel;
use crate::facets::{Facet, PreparedFacets};
use crate::solid::{Edges, joined_arcs};
use glam::DVec3;
use serde::Serialize;

/// The largest way, as a part of the body's diagonal, that [`Embedding::embedded_within`] may state: about the depth from
/// which on crossings are looked for, so that a larger one would say little.
const RELATIVE_MOST: f64 = 1e-3;

/// The number of times that points of patches are divided from them, for the error of their pieces.
const DIVISIONS: u32 = 1;

/// Whether the boundary of a body meets itself.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct Embedding {
    /// Whether the body is embedded up to its gaps: `Some(true)` and `Some(false)` are certain.
    pub embedded: Option<bool>,
    /// Of a body that is embedded, how far points of its boundary are from each other along it, at most, that are as near
    /// to each other as its gaps: 0 where nothing but exact triangles has to be known.
    pub embedded_within: Option<f64>,
    /// Why neither is certain; `None` where one is.
    pub embedded_unknown: Option<EmbeddedUnknown>,
    /// Of a body that is not embedded, a place at which its boundary meets itself.
    pub self_overlap: Option<SelfOverlap>,
}

/// What is not decided of a body's boundary.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct EmbeddedUnknown {
    /// The reason.
    pub why: EmbeddedDoubt,
    /// The indices of two faces, or of one, of a pair that was not decided; none of a mesh.
    pub faces: Vec<usize>,
    /// A point about where it is, if it is at one.
    pub point: Option<[f64; 3]>,
}

/// The reason for which it is not known whether a body is embedded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum EmbeddedDoubt {
    /// Faces touch, cross, or come as near to each other as the gaps beside all edges and corners that they share; or their
    /// directions from these are too much alike.
    Contact,
    /// The number of pairs of pieces, or the time, was spent before all were decided.
    Budget,
    /// Points of the boundary contradicted what was proven of them, so that nothing is stated: the library has a fault.
    Refuted,
    /// A mesh has gaps, which triangles say nothing about.
    Gaps,
    /// A mesh has more triangles than are joined, 250,000.
    TooLarge,
}

impl PreparedModel {
    /// Decides whether the boundary of a body is embedded up to its gaps, until it is late.
    ///
    /// Guarantee: `Some(true)` by lemmas S8 to S10 of docs/solids.md, `Some(false)` by lemma S7. A body that touches itself
    /// without crossing is neither. Time grows with the pairs of patches, or triangles, that are near each other.
    pub(in crate::engine) fn embedding(&self, is_late: &dyn Fn() -> bool) -> Embedding {
        if self.is_cloud() {
            return Embedding::default();
        }
        let unknown = match self.embedded_verdict(is_late) {
            Ok(Verdict::Embedded { within }) => {
                return Embedding {
                    embedded: Some(true),
                    embedded_within: Some(within),
                    ..Embedding::default()
                };
            }
            Ok(Verdict::Undecided { doubt, parts, point }) => self.unknown(doubt, parts, point),
            Err(why) => EmbeddedUnknown { why, faces: Vec::new(), point: None },
        };
        match if is_late() { None } else { self.self_overlap() } {
            Some(found) => {
                Embedding { embedded: Some(false), self_overlap: Some(found.clone()), ..Embedding::default() }
            }
            None => Embedding { embedded_unknown: Some(unknown), ..Embedding::default() },
        }
    }

    fn embedded_verdict(&self, is_late: &dyn Fn() -> bool) -> Result<Verdict, EmbeddedDoubt> {
        // The search reads the clock once in many pairs. A small body has fewer pairs.
        if is_late() {
            return Err(EmbeddedDoubt::Budget);
        }
        let most = RELATIVE_MOST * self.control_box().diagonal();
        if let Some(facets) = self.facets() {
            if self.gap() > 0.0 {
                return Err(EmbeddedDoubt::Gaps);
            }
            if !facets.may_close() {
                return Err(EmbeddedDoubt::TooLarge);
            }
            let limits = Limits { nearness: 2.0 * facets.error, most, is_late };
            return Ok(verdict_on_triangles(&numbered_triangles(facets), &limits));
        }
        let bezier = self.bezier();
        let edges = Edges::of_surfaces(bezier, |surface| self.pieces().origin(surface));
        // Surfaces have no corners of triangles.
        let joined = joined_arcs(edges, &|_| [DVec3::NAN; 3], &self.control_box(), self.gap());
        let error = bezier.point_error.after(DIVISIONS);
        let nearness = 2.0 * (self.gap() + error);
        let sheets = self.sheets().map(|(model, of_pieces)| {
            let off = error + model.point_error.after(DIVISIONS);
            Sheets { model, of_pieces, off }
        });
        Ok(verdict_on_patches(bezier, joined, sheets.as_ref(), &Limits { nearness, most, is_late }))
    }

    fn unknown(&self, doubt: Doubt, parts: [u32; 2], point: DVec3) -> EmbeddedUnknown {
        let why = match doubt {
            Doubt::Contact => EmbeddedDoubt::Contact,
            Doubt::Budget => EmbeddedDoubt::Budget,
            Doubt::Refuted => EmbeddedDoubt::Refuted,
        };
        let mut faces = match self.facets() {
            Some(_) => Vec::new(),
            None => {
                let surface = |part: u32| self.bezier().patches.patch(part as usize).surface;
                parts.map(|part| self.pieces().face(surface(part))).to_vec()
            }
        };
        faces.dedup();
        EmbeddedUnknown { why, faces, point: Some(point.to_array()) }
    }
}

/// Returns the triangles of a mesh with the numbers of their corners.
fn numbered_triangles(facets: &PreparedFacets) -> Vec<([DVec3; 3], [u32; 3])> {
    let target = &facets.target;
    let triangles = (0..target.len() as u32).filter_map(|place| match target.facet(place) {
        Facet::Triangle(corners) => Some((corners, target.corners(place))),
        Facet::Point(_) => None,
    });
    triangles.collect()
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests;
