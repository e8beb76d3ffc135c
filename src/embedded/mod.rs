//! Whether a body is embedded: whether its boundary, faces that are joined along edges, meets itself nowhere else.
//!
//! Patches are identified along the edges that were joined, and at the corners that follow from them ([`complex`]). Pairs
//! of pieces of them ([`piece`]) are divided until each is decided by a lower bound on the distance, or by the directions
//! ([`directions`]) in which both go from what they share ([`search`]); what is stated of a pair is compared with points of
//! both ([`audit`]). Triangles are decided by signs of determinants
//! ([`triangles`]). docs/solids.md, section 2, has the lemmas S8 and S9. Nothing here knows of files or options.

mod audit;
mod complex;
mod directions;
mod piece;
mod search;
mod sheets;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests;
mod triangles;

use self::complex::Complex;
use self::search::Search;
use self::sheets::SheetSearch;
use crate::bezier::BezierModel;
use crate::solid::JoinedArc;
use glam::DVec3;

pub(crate) use sheets::Sheets;
pub(crate) use triangles::verdict_on_triangles;

/// Whether a body is embedded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Verdict {
    /// It certainly is, up to its gaps.
    Embedded {
        /// The length of the way along the boundary between two points of it that are near each other, at most.
        within: f64,
    },
    /// It is not known.
    Undecided {
        doubt: Doubt,
        /// The patches, or triangles, of a pair that was not decided.
        parts: [u32; 2],
        /// A point about where they come near each other.
        point: DVec3,
    },
}

/// The reason for which a pair is not decided.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Doubt {
    /// Two parts come as near to each other as is known of them, not beside a common edge: they touch, cross, or have no
    /// direction from it.
    Contact,
    /// Too many pairs, or too late.
    Budget,
    /// Points of a pair contradict what was stated of it, which they do only if the library has a fault.
    Refuted,
}

/// What is decided, and until when.
pub(crate) struct Limits<'a> {
    /// The distance up to which points are near each other: that by which faces may be off, twice.
    pub(crate) nearness: f64,
    /// The largest number that the verdict may state.
    pub(crate) most: f64,
    pub(crate) is_late: &'a dyn Fn() -> bool,
}

/// Decides whether patches whose surfaces are joined at these arcs are embedded.
///
/// Guarantee (lemma S8 of docs/solids.md): if the verdict is [`Verdict::Embedded`], every two points of the patches that
/// are at most `nearness` apart are joined by a way on the patches of length `within` or less, apart from steps of at most
/// the edges' widths where patches are joined. Time grows with the pairs of patches that are near each other.
pub(crate) fn verdict_on_patches(
    model: &BezierModel,
    joined: Vec<JoinedArc>,
    sheets: Option<&Sheets<'_>>,
    limits: &Limits<'_>,
) -> Verdict {
    let sheets = sheets.map(|sheets| SheetSearch::new(sheets, &model.patches));
    let complex = Complex::new(model, joined, |patch| sheets.as_ref()?.sheet(patch));
    Search::new(&model.patches, &complex, sheets.as_ref(), limits).run()
}
