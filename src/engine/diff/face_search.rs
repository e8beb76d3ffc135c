//! The search for the distance of one face: over patches, or over facets.

use super::face::FacePatches;
use crate::bezier::PatchSet;
use crate::certified::{BranchAndBound, Operand, Pair};
use crate::engine::PreparedModel;
use crate::facets::{Domain, FacetSearch, FacetTarget, Measured, Source};
use crate::interval::{Interval, Limit};
use crate::model::RigidTransform;
use crate::surface_point::SurfacePoint;
use glam::DVec3;
use web_time::Instant;

/// The faces of one model, and the other model, as the search between them takes them.
#[allow(clippy::large_enum_variant, reason = "there is one of each direction")]
pub(super) enum Faces<'a> {
    /// Patches to patches.
    Patches { whole: Operand<'a>, faces: &'a [FacePatches], other: Operand<'a>, others: &'a [FacePatches] },
    /// Anything to facets, and points to patches.
    Facets { faces: Vec<FacetFace<'a>>, other: Measured<'a> },
}

/// A face of a model that is searched over facets.
#[derive(Clone, Copy)]
pub(super) enum FacetFace<'a> {
    /// A group of facets. `first` is the index of its first facet in the model.
    Group { facets: &'a FacetTarget, first: usize, error: f64 },
    /// The patches of a face.
    Patches(Source<'a>, &'a PatchSet),
}

/// A search.
pub(super) enum FaceSearch<'a> {
    Patches(Box<BranchAndBound<'a>>),
    Facets(Box<FacetSearch<'a>>, FacetFace<'a>),
}

impl<'a> Faces<'a> {
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Patches { faces, .. } => faces.len(),
            Self::Facets { faces, .. } => faces.len(),
        }
    }

    /// Returns the search for an interval of this width, or until a limit is decided.
    pub(super) fn search(
        &self,
        face: usize,
        transform: RigidTransform,
        tolerance: f64,
        limit: Option<Limit>,
    ) -> FaceSearch<'a> {
        match self {
            Self::Patches { whole, faces, other, others } => {
                let offset = transform.apply(DVec3::ZERO);
                let counterpart = faces[face].counterpart(others, offset);
                let b = counterpart.map_or(*other, |face| other.with_uncut(face.patches()));
                let pair = Pair { a: faces[face].operand(whole), b, transform };
                FaceSearch::Patches(Box::new(BranchAndBound::new(pair, tolerance, limit, 0.0)))
            }
            Self::Facets { faces, other } => {
                let face = faces[face];
                let source = match face {
                    FacetFace::Group { facets, error, .. } => Source::Facets { facets, error },
                    FacetFace::Patches(source, _) => source,
                };
                let search = FacetSearch::new(source, *other, transform, tolerance, limit);
                FaceSearch::Facets(Box::new(search), face)
            }
        }
    }
}

impl FaceSearch<'_> {
    pub(super) fn interval(&self) -> Interval {
        match self {
            Self::Patches(search) => search.interval(),
            Self::Facets(search, _) => {
                let [lower, upper] = search.interval();
                Interval { lower, upper }
            }
        }
    }

    /// Bounds no cell from this moment on.
    pub(super) fn stop_at(&mut self, deadline: Instant) {
        match self {
            Self::Patches(search) => search.stop_at(deadline),
            Self::Facets(search, _) => search.stop_at(deadline),
        }
    }

    /// Whether that moment has come.
    fn is_over(&self) -> bool {
        match self {
            Self::Patches(search) => search.is_over(),
            Self::Facets(search, _) => search.is_late(),
        }
    }

    /// The number of cells bounded.
    pub(super) fn cells(&self) -> usize {
        match self {
            Self::Patches(search) => search.work().cells,
            Self::Facets(search, _) => search.work().cells,
        }
    }

    /// Bounds about `cells` more cells; returns whether the search has ended.
    pub(super) fn advance(&mut self, cells: usize) -> bool {
        let end = self.cells() + cells;
        while self.cells() < end {
            let left = end - self.cells();
            let has_ended = match self {
                Self::Patches(search) => search.advance_once(left).is_some(),
                Self::Facets(search, _) => search.advance(left).is_some(),
            };
            if has_ended || self.is_over() {
                return has_ended;
            }
        }
        false
    }

    /// Narrows the interval by what has been found so far.
    pub(super) fn finish(&mut self) {
        if let Self::Patches(search) = self {
            search.finish();
        }
    }

    /// The witness on the face and on the other model, which `models` are in this order; `None` for a
    /// face without patches, which validation rules out.
    pub(super) fn witness(&self, [from, to]: [&PreparedModel; 2]) -> Option<[SurfacePoint; 2]> {
        match self {
            Self::Patches(search) => {
                let witness = search.witness()?;
                let [of_a, of_b] = search.witness_patches(witness);
                let closest = &witness.closest;
                Some([
                    from.surface_point(
                        of_a.surface,
                        of_a.surface_parameters(witness.parameters),
                        witness.point,
                    ),
                    to.surface_point(
                        of_b.surface,
                        of_b.surface_parameters(closest.parameters),
                        closest.point,
                    ),
                ])
            }
            Self::Facets(search, face) => {
                let witness = search.witness()?;
                Some([
                    face.point(from, search, witness.domain, witness.point),
                    to.point_of_b(&witness.closest),
                ])
            }
        }
    }
}

impl FacetFace<'_> {
    /// Returns a point of the face, which was moved to `point`.
    fn point(
        &self,
        model: &PreparedModel,
        search: &FacetSearch<'_>,
        domain: Domain,
        point: DVec3,
    ) -> SurfacePoint {
        match (*self, domain) {
            (Self::Patches(_, patches), Domain::Patch(patch, parameters)) => {
                let patch = patches.patch(patch as usize);
                model.surface_point(patch.surface, patch.surface_parameters(parameters), point)
            }
            (Self::Group { facets, first, .. }, Domain::Facet(place)) => {
                let weights = search.weights(facets.facet(place), point);
                model.point_of_facet(first + facets.index(place), weights, point)
            }
            // No face has points of the other kind.
            (_, Domain::Patch(_, parameters)) => model.surface_point(0, parameters, point),
            (_, Domain::Facet(place)) => model.facet_point(place, [1.0, 0.0, 0.0], point),
        }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::facets::{Facets, TriangleMesh};
    use crate::shapes::sphere;

    /// A search over facets bounds no cell once its time is over, so that it would never have bounded enough.
    #[test]
    fn a_search_over_facets_comes_back_when_its_time_is_over() {
        let ball = PreparedModel::new(&sphere(DVec3::ZERO, 1.0).unwrap()).unwrap();
        let mesh = TriangleMesh::new(&[DVec3::X, DVec3::Y, DVec3::Z], &[[0, 1, 2]]).unwrap();
        let mesh = PreparedModel::of_facets(&Facets::Mesh(mesh), None).unwrap();
        let patches = &ball.bezier().patches;
        let source = ball.patches_as_source(patches);
        let search =
            FacetSearch::new(source, mesh.measured(None).unwrap(), RigidTransform::IDENTITY, 1e-9, None);
        let mut search = FaceSearch::Facets(Box::new(search), FacetFace::Patches(source, patches));
        search.stop_at(Instant::now());
        assert!(!search.advance(1000), "a search that was stopped has not ended");
        assert_eq!(search.cells(), 0);
    }
}
