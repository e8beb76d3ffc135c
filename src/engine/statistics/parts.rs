//! Triangles or patches in parts, measured to triangles.

use super::cover::Cover;
use super::formula::{moved, oriented, points_of};
use crate::certified::Lemma;
use crate::facets::{Facet, PartOf, Parts, Source, Start, WeightedPart};
use crate::normals::{NormalCone, OrientedPoint, Shape};
use glam::DVec3;
use std::ops::Range;

/// The points of a triangle that are always looked at in an audit: its corners.
const CORNERS_OF_TRIANGLE: usize = 3;

impl Cover for Parts<'_> {
    type Part = WeightedPart;

    fn len(&self) -> usize {
        Self::len(self)
    }

    fn rounding(&self) -> f64 {
        Self::rounding(self)
    }

    /// Each is searched from the place on B that the one before found.
    fn first(&self, range: Range<usize>, is_late: &dyn Fn() -> bool) -> Option<Vec<WeightedPart>> {
        let mut start = Start::default();
        let mut next = |index: usize| {
            if is_late() {
                return Some(Self::unmeasured(self, index as u32));
            }
            let (part, found) = Self::first(self, index as u32, start)?;
            start = found;
            Some(part)
        };
        range.map(&mut next).collect()
    }

    fn unmeasured(&self, index: usize) -> WeightedPart {
        Self::unmeasured(self, index as u32)
    }

    fn halves(&self, part: &WeightedPart) -> Option<[WeightedPart; 2]> {
        Self::halves(self, part)
    }

    fn cuts(&self, part: &WeightedPart) -> [Option<[WeightedPart; 2]>; 2] {
        Self::cuts(self, part)
    }

    fn measured(&self, half: &WeightedPart) -> WeightedPart {
        Self::measured(self, half)
    }

    fn weighed(&self, half: &WeightedPart) -> WeightedPart {
        Self::weighed(self, half)
    }

    fn shape(&self, part: &WeightedPart) -> Shape {
        let (source, transform) = self.source();
        match (self.part_of(part), source) {
            (PartOf::Triangle(place, corners), Source::Facets { facets, error }) => {
                let cone = NormalCone::of_facet(facets, place, error).map(|cone| cone.moved(transform));
                Shape::of_points(corners.to_vec(), cone)
            }
            (PartOf::Patch(patch, range), Source::Patches { patches, .. }) => {
                Shape::of_part(&patches.patch(patch as usize), range, transform)
            }
            // No part is of the other kind.
            _ => Shape::UNKNOWN,
        }
    }

    fn points(&self, part: &WeightedPart) -> Vec<DVec3> {
        let (source, transform) = self.source();
        match (self.part_of(part), source) {
            (PartOf::Triangle(_, corners), _) => {
                let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
                corners.into_iter().chain([middle]).collect()
            }
            (PartOf::Patch(patch, range), Source::Patches { patches, .. }) => {
                points_of(&patches.patch(patch as usize), range, transform)
            }
            // No part is of the other kind.
            _ => Vec::new(),
        }
    }

    fn beside(&self, part: &WeightedPart) -> Option<[OrientedPoint; 2]> {
        let (source, transform) = self.source();
        let middle = match (self.part_of(part), source) {
            (PartOf::Triangle(_, corners), _) => {
                let point = corners.iter().sum::<DVec3>() / corners.len() as f64;
                OrientedPoint { point, normal: Facet::Triangle(corners).normal()? }
            }
            (PartOf::Patch(patch, range), Source::Patches { patches, .. }) => {
                moved(oriented(&patches.patch(patch as usize), range.middle())?, transform)
            }
            // No part is of the other kind.
            _ => return None,
        };
        Some([middle, Self::beside(self, part, middle.point)?])
    }

    fn lemma(&self) -> Lemma {
        Lemma::SpreadToFacets
    }

    fn corners(&self) -> usize {
        CORNERS_OF_TRIANGLE
    }

    fn refutation(&self, part: &WeightedPart, further: usize, mean: bool) -> Option<String> {
        Self::refutation(self, part, further, mean)
    }

    fn strike(&mut self) {
        Self::strike(self);
    }
}
