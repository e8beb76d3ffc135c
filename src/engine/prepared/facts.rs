//! What is known of a prepared model.

use super::PreparedModel;
use crate::area::{Area, area};
use crate::bezier::{BezierModel, Patch, PatchGrid};
use crate::bvh::Aabb;
use crate::certified::OnSheet;
use crate::error::{Error, Result};
use crate::facets::PreparedFacets;
use crate::model::Model;
use crate::pieces::FacePieces;
use crate::solid::{Boundary, Edges, Joined};
use crate::symmetry::Revolution;
use crate::threads::computed;
use crate::threads::parallel::map;

/// The corners of a patch.
const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];

impl PreparedModel {
    /// Returns the model's name, if it has one.
    #[must_use]
    pub fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    /// Returns the model itself; none of a mesh or a cloud.
    pub(in crate::engine) fn source(&self) -> Option<&Model> {
        self.source.as_ref()
    }

    /// Returns the distance, in model units, between the model and its source as its reader states
    /// it: see [`crate::Model::gap`].
    #[must_use]
    pub fn gap(&self) -> f64 {
        self.gap
    }

    /// Returns the gap of each face.
    pub(crate) fn face_gaps(&self) -> &[f64] {
        &self.face_gaps
    }

    /// Returns whether [`Self::gap`] is an upper bound: see [`crate::Model::is_gap_proven`].
    #[must_use]
    pub fn is_gap_proven(&self) -> bool {
        self.is_gap_proven
    }

    /// Returns an upper bound on the Hausdorff distance between the trimmed faces and the
    /// pieces that are measured in their place; 0 for a model without trims. It is part of
    /// every interval.
    #[must_use]
    pub fn deviation(&self) -> f64 {
        self.pieces.deviation()
    }

    /// Returns the numbers of Bézier patches along u and v, one entry per piece, in the
    /// order of the faces; an untrimmed face is one piece.
    pub fn patch_counts(&self) -> impl ExactSizeIterator<Item = [usize; 2]> {
        self.bezier.grids.iter().map(PatchGrid::counts)
    }

    /// Returns the numbers of Bézier patches of the faces.
    pub fn face_patch_counts(&self) -> impl ExactSizeIterator<Item = usize> {
        self.pieces.faces().iter().map(|pieces| {
            self.bezier.grids[pieces.clone()].iter().map(|grid| grid.counts().iter().product::<usize>()).sum()
        })
    }

    /// Returns the areas of the faces' pieces, in squares of the model unit, as intervals of
    /// about 1e-7 of the area; surfaces that fold or whose weights are far apart have wider
    /// ones (docs/area.md).
    ///
    /// Computed at first use, in about 20 µs a patch, on all cores.
    pub fn face_areas(&self) -> &[Area] {
        computed::<Vec<Area>>(&self.kept.areas, || match &self.facets {
            Some(facets) => facets.areas(),
            None => map(self.pieces.faces().len(), |face| self.area_of_face(face)),
        })
    }

    /// Computes [`PreparedModel::face_areas`] unless `is_late` becomes true before, and returns whether they are there.
    pub(in crate::engine) fn has_face_areas(&self, is_late: &(dyn Fn() -> bool + Sync)) -> bool {
        if self.facets.is_some() || self.kept.areas.get().is_some() {
            return true;
        }
        let found = map(self.pieces.faces().len(), |face| (!is_late()).then(|| self.area_of_face(face)));
        let Some(found) = found.into_iter().collect::<Option<Vec<Area>>>() else { return false };
        self.kept.areas.get_or_init(|| found);
        true
    }

    /// Returns the box of the control points of a piece of a face of surfaces.
    pub(in crate::engine) fn box_of_piece(&self, piece: usize) -> Aabb {
        let grid = &self.bezier.grids[piece];
        let count: usize = grid.counts().iter().product();
        let boxes =
            (grid.first..grid.first + count).map(|index| self.bezier.patches.patch(index).bounding_box());
        boxes.fold(Aabb::EMPTY, Aabb::union)
    }

    /// Returns the number of pieces of faces, or of triangles.
    pub(in crate::engine) fn surface_count(&self) -> u32 {
        let count = self.facets.as_ref().map_or(self.bezier.grids.len(), |facets| facets.target.len());
        count as u32
    }

    /// Returns the box of the corners of the patches of a piece, or of a triangle. It is within each box that has all
    /// points of that; the control points may be outside.
    pub(in crate::engine) fn box_of_points(&self, surface: u32) -> Aabb {
        match &self.facets {
            Some(facets) => facets.target.facet(surface).bounding_box(),
            None => {
                let corners = |patch: Patch<'_>| CORNERS.map(|at| patch.point(at));
                self.patches_of(surface).flat_map(corners).fold(Aabb::EMPTY, Aabb::with)
            }
        }
    }

    /// Returns the area of the pieces of a face of surfaces.
    fn area_of_face(&self, face: usize) -> Area {
        let grids = self.bezier.grids[self.pieces.faces()[face].clone()].iter();
        area(grids.flat_map(|grid| {
            let [rows, columns] = grid.counts();
            (grid.first..grid.first + rows * columns).map(|index| self.bezier.patches.patch(index))
        }))
    }

    /// Returns the sum of [`PreparedModel::face_areas`].
    pub fn area(&self) -> Area {
        self.face_areas().iter().fold(Area::default(), |sum, &area| sum + area)
    }

    /// Returns the edges of the faces, joined where they meet, computed at first use.
    pub(in crate::engine) fn boundary(&self) -> &Boundary {
        computed(&self.kept.boundary, || {
            if let Some(facets) = &self.facets {
                let edges = Edges::of_triangles(facets.joined_triangles());
                return Boundary::new(edges, facets.point_error(), &self.control_box, self.gap, 1);
            }
            let degrees = self.bezier.patches.iter().flat_map(|patch| patch.degree);
            let edges = Edges::of_surfaces(&self.bezier, |surface| self.pieces.origin(surface));
            Boundary::new(
                edges,
                self.bezier.point_error,
                &self.control_box,
                self.gap,
                degrees.max().unwrap_or(0),
            )
        })
    }

    /// Returns the surfaces that joined edges connect: pieces of faces, or triangles by their places. Those of
    /// a mesh too large for [`Self::boundary`] are joined along edges of the same vertices only.
    pub(in crate::engine) fn joined(&self) -> &Joined {
        match &self.facets {
            Some(facets) if !facets.may_close() => {
                computed::<Joined>(&self.kept.joined, || facets.joined_exactly())
            }
            _ => self.boundary().joined(),
        }
    }

    /// Returns the number of faces.
    #[must_use]
    pub fn face_count(&self) -> usize {
        self.pieces.face_count()
    }

    /// Returns the surface of revolution that a face lies on, if it lies on one.
    pub(in crate::engine) fn revolution_of(&self, face: usize) -> Option<&Revolution> {
        let pieces = self.revolutions.iter().enumerate();
        pieces.filter(|(piece, _)| self.pieces.face(*piece) == face).find_map(|(_, found)| found.as_ref())
    }

    /// Returns the name of a face in its source, if it has one.
    #[must_use]
    pub fn face_name(&self, face: usize) -> Option<&str> {
        self.pieces.face_name(face)
    }

    /// Returns the colour of a face in its source, if it has one: red, green and blue of sRGB, each from 0
    /// to 1.
    #[must_use]
    pub fn face_color(&self, face: usize) -> Option<[f64; 3]> {
        self.pieces.face_color(face)
    }

    /// Returns the surfaces of trimmed faces, and the one of each piece: see [`TrimmedFaces::sheets`].
    ///
    /// [`TrimmedFaces::sheets`]: crate::certified::TrimmedFaces::sheets
    pub(in crate::engine) fn sheets(&self) -> Option<(&BezierModel, Vec<OnSheet<'_>>)> {
        self.trimmed_faces.as_ref()?.sheets()
    }

    /// Returns the pieces of the faces.
    pub(crate) fn pieces(&self) -> &FacePieces {
        &self.pieces
    }

    /// Returns the Bézier patches; those of a mesh are its triangles.
    pub(crate) fn bezier(&self) -> &BezierModel {
        self.facets.as_ref().map_or(&self.bezier, PreparedFacets::bezier)
    }

    /// Returns the triangles or points, if the model is a mesh or a cloud.
    pub(crate) fn facets(&self) -> Option<&PreparedFacets> {
        self.facets.as_ref()
    }

    /// Returns whether the model is a cloud of points.
    pub(crate) fn is_cloud(&self) -> bool {
        self.facets.as_ref().is_some_and(|facets| facets.target.is_cloud())
    }

    /// Refuses a mesh or a cloud for a computation that has none.
    ///
    /// # Errors
    /// [`Error::FacetsUnsupported`].
    pub(crate) fn require_surfaces(&self, found: &'static str) -> Result<()> {
        if self.facets.is_some() { Err(Error::FacetsUnsupported { found }) } else { Ok(()) }
    }

    /// Refuses a cloud of points for a computation that needs faces or triangles.
    ///
    /// # Errors
    /// [`Error::FacetsUnsupported`].
    pub(in crate::engine) fn require_faces(&self, found: &'static str) -> Result<()> {
        if self.is_cloud() { Err(Error::FacetsUnsupported { found }) } else { Ok(()) }
    }

    /// Returns the box of the control points of the model's pieces.
    #[must_use]
    pub fn bounding_box(&self) -> Aabb {
        self.bounding_box
    }

    /// Returns a box around the model's control points and those of its patches.
    pub(crate) fn control_box(&self) -> Aabb {
        self.control_box
    }
}
