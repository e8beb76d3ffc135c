//! Whether a body is embedded: whether its boundary, faces that are joined along edges, meets itself nowhere else.
//!
//! Patches are identified along the edges that were joined, and at the corners that follow from them ([`complex`]). Pairs
//! of pieces of them ([`piece`]) are divided ([`division`]) until each is decided by a lower bound on the distance, or by
//! the directions ([`directions`]) in which both go from what they share ([`search`]); what is stated of a pair is compared
//! with points of both ([`audit`]). Triangles are decided by signs of determinants ([`triangles`]). What is stated of
//! trimmed faces holds along their surfaces, so that their rims must not meet themselves ([`rims`]). docs/solids.md,
//! section 2, has the lemmas S8 to S10. Nothing here knows of files or options.

mod audit;
mod complex;
mod directions;
mod division;
mod piece;
mod rims;
mod search;
mod self_overlap;
mod sheets;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests;
mod triangles;

use self::complex::Complex;
use self::rims::RimSearch;
use self::search::Search;
use self::sheets::SheetSearch;
use crate::bezier::BezierModel;
use crate::rounding::upper_max;
use crate::solid::JoinedArc;
use glam::DVec3;

pub use self_overlap::SelfOverlap;
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
/// Guarantee (lemmas S8 and S10 of docs/solids.md): if the verdict is [`Verdict::Embedded`], every two points of the patches
/// that are at most `nearness` apart are joined by a way on the patches and the surfaces of faces of length `within` or less,
/// apart from steps of at most the edges' widths where patches are joined; and rims of faces do not meet themselves. Time
/// grows with the pairs of patches that are near each other.
pub(crate) fn verdict_on_patches(
    model: &BezierModel,
    joined: Vec<JoinedArc>,
    sheets: Option<&Sheets<'_>>,
    limits: &Limits<'_>,
) -> Verdict {
    let sheets = sheets.map(|sheets| SheetSearch::new(sheets, &model.patches));
    let complex = Complex::new(model, joined, |patch| sheets.as_ref()?.sheet(patch), limits.nearness);
    if let Some((parts, point)) = complex.pinch() {
        return Verdict::Undecided { doubt: Doubt::Contact, parts, point };
    }
    let search = Search::new(&model.patches, &complex, sheets.as_ref(), limits.nearness);
    let apart = search.apart();
    search.run(limits).and(|| RimSearch::new(&model.patches, &complex, apart).run(limits))
}

impl Verdict {
    /// Returns the verdict on two parts of what is to be proven; the second is sought only where the first is.
    fn and(self, second: impl FnOnce() -> Self) -> Self {
        let Self::Embedded { within: first } = self else { return self };
        match second() {
            Self::Embedded { within } => Self::Embedded { within: upper_max(first, within) },
            undecided => undecided,
        }
    }
}
