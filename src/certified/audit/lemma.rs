//! The lemmas of upper bounds, by which a search names, counts and strikes them.

use serde::ser::SerializeSeq;
use serde::{Serialize, Serializer};
use std::fmt::{Display, Formatter};

/// A lemma that a bound rests on: of section 3 of `docs/method.md` where none other is named.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Lemma {
    /// 3.1, the boxes of both models.
    ModelBoxes,
    /// 3.2, the triangle inequality on a node of A's tree.
    TreeNode,
    /// 3.3, equal control nets.
    SameNet,
    /// 3.4, a sphere in closed form.
    Sphere,
    /// 3.5, the triangle inequality on a cell.
    Lipschitz,
    /// 3.6, Taylor's theorem on one patch.
    Taylor,
    /// 3.12, Taylor's theorem over seams.
    TaylorAcrossSeams,
    /// 3.7, a convex combination of several feet.
    ConvexCombination,
    /// 3.8, the polynomial difference of two patches.
    PolynomialDifference,
    /// 3.13, the same over knot lines.
    DifferenceOverKnotLines,
    /// 3.19, the same under projective maps.
    ProjectiveDifference,
    /// 3.17 and 3.18, heights over a tangent plane.
    Heights,
    /// 3.9, bilinear maps to one patch or two.
    Bilinear,
    /// 3.16, the difference of a block as a spline.
    OneSpline,
    /// 3.14, the difference of a block piece by piece.
    DifferenceByPieces,
    /// 3.11, surfaces of revolution reduced to a generatrix.
    Generatrix,
    /// S1 to S4 of `docs/meshes.md`, statistics of cells before surfaces.
    Spread,
    /// F8, F12 and F13 of `docs/meshes.md`, statistics of triangles before facets.
    SpreadToFacets,
}

impl Lemma {
    /// All of them.
    pub const ALL: [Self; 18] = [
        Self::ModelBoxes,
        Self::TreeNode,
        Self::SameNet,
        Self::Sphere,
        Self::Lipschitz,
        Self::Taylor,
        Self::TaylorAcrossSeams,
        Self::ConvexCombination,
        Self::PolynomialDifference,
        Self::DifferenceOverKnotLines,
        Self::ProjectiveDifference,
        Self::Heights,
        Self::Bilinear,
        Self::OneSpline,
        Self::DifferenceByPieces,
        Self::Generatrix,
        Self::Spread,
        Self::SpreadToFacets,
    ];

    /// Returns the sections that state and prove it, of `docs/method.md` or by letters of `docs/meshes.md`.
    #[must_use]
    pub fn sections(self) -> &'static str {
        match self {
            Self::ModelBoxes => "3.1",
            Self::TreeNode => "3.2",
            Self::SameNet => "3.3",
            Self::Sphere => "3.4",
            Self::Lipschitz => "3.5",
            Self::Taylor => "3.6",
            Self::TaylorAcrossSeams => "3.12",
            Self::ConvexCombination => "3.7",
            Self::PolynomialDifference => "3.8",
            Self::DifferenceOverKnotLines => "3.13",
            Self::ProjectiveDifference => "3.19",
            Self::Heights => "3.17 and 3.18",
            Self::Bilinear => "3.9",
            Self::OneSpline => "3.16",
            Self::DifferenceByPieces => "3.14",
            Self::Generatrix => "3.11",
            Self::Spread => "S1 to S4",
            Self::SpreadToFacets => "F8, F12 and F13",
        }
    }

    /// Whether the bound rests on one distance and a bound of first or second derivatives alone: the share
    /// of bounds that every search audits leaves these out.
    #[must_use]
    pub fn is_elementary(self) -> bool {
        matches!(self, Self::ModelBoxes | Self::TreeNode | Self::Lipschitz | Self::Taylor)
    }

    fn bit(self) -> u32 {
        1 << self as u32
    }
}

impl Display for Lemma {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.sections())
    }
}

/// A set of lemmas. In JSON it is the list of their sections.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Lemmas(u32);

impl Lemmas {
    /// Whether it holds a lemma.
    #[must_use]
    pub fn contains(self, lemma: Lemma) -> bool {
        self.0 & lemma.bit() != 0
    }

    /// Whether it holds none.
    #[must_use]
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Returns its lemmas.
    pub fn iter(self) -> impl Iterator<Item = Lemma> {
        Lemma::ALL.into_iter().filter(move |lemma| self.contains(*lemma))
    }

    pub(crate) fn insert(&mut self, lemma: Lemma) {
        self.0 |= lemma.bit();
    }

    pub(crate) fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl Serialize for Lemmas {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut list = serializer.serialize_seq(None)?;
        for lemma in self.iter() {
            list.serialize_element(lemma.sections())?;
        }
        list.end()
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn a_set_holds_what_was_inserted() {
        let mut set = Lemmas::default();
        assert!(set.is_empty());
        for (index, lemma) in Lemma::ALL.into_iter().enumerate() {
            assert!(!set.contains(lemma));
            set.insert(lemma);
            assert_eq!(set.iter().count(), index + 1);
        }
        let mut one = Lemmas::default();
        one.insert(Lemma::Heights);
        assert_eq!(serde_json::to_string(&one).ok().as_deref(), Some(r#"["3.17 and 3.18"]"#));
        assert_eq!(one.union(set), set);
    }
}
