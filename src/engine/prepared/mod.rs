//! Models with the data that is computed from them once.

mod bodies;
mod facts;
mod forms;
mod kept;
mod map_base;
mod measured;
mod mirrored;
mod points;
mod shells;
mod single;
mod units;

use crate::bezier::{BezierModel, PatchSet, PointError, extract, without_removable_knots};
use crate::bvh::Aabb;
use crate::certified::TrimmedFaces;
use crate::error::{Error, Result};
use crate::facets::{Facets, PreparedFacets};
use crate::gpu::Resident;
use crate::model::{Model, is_unit};
use crate::pieces::{Cuttable, FacePieces};
use crate::read::ReadReport;
use crate::symmetry::{Revolution, revolutions};
use crate::threads::locked;
use crate::threads::parallel::Watch;
use crate::untrim::Untrimmed;
pub(in crate::engine) use bodies::BodyParts;
use kept::Kept;
pub(crate) use kept::{PreparedCells, PreparedSampling, PreparedTarget};
pub(in crate::engine) use mirrored::mirror_image;
pub(in crate::engine) use shells::Shells;
use std::sync::Arc;

/// A model ready for distance computations: its Bézier patches, and, computed at
/// first use and kept, its flat patches, its samples and their copies on the GPU.
#[derive(Debug)]
pub struct PreparedModel {
    name: Option<String>,
    unit: Option<f64>,
    /// The model itself, to be scaled, and to count copies of faces; none of a mesh or a cloud.
    source: Option<Model>,
    gap: f64,
    face_gaps: Vec<f64>,
    is_gap_proven: bool,
    pieces: FacePieces,
    trimmed_faces: Option<TrimmedFaces>,
    /// The triangles or points, if the model is a mesh or a cloud.
    facets: Option<PreparedFacets>,
    bezier: BezierModel,
    revolutions: Vec<Option<Revolution>>,
    bounding_box: Aabb,
    control_box: Aabb,
    kept: Kept,
    /// The number of updates since cuts and trees were chosen.
    refits: u32,
}

/// The number of updates after which cuts and trees are chosen anew, for the shape that
/// the model has by then; they are chosen for an older one meanwhile.
const MAX_REFITS: u32 = 32;

impl PreparedModel {
    /// Cuts trimmed faces into pieces, removes removable knots, extracts the Bézier
    /// patches and detects symmetries. O(patches p q (p + q)), and for trimmed faces the
    /// cutting, on all cores.
    ///
    /// # Errors
    /// [`crate::Error::FaceNotCut`].
    pub fn new(model: &Model) -> Result<Self> {
        let (pieces, untrimmed) = FacePieces::new(model)?;
        Ok(Self::of_pieces(model, pieces, &untrimmed))
    }

    /// Prepares a model that was read from a CAD file, with the report on reading it: faces
    /// that cannot be cut are left out of the model, and listed in the report like those that
    /// could not be read. Returns the model of the faces that are left. As [`PreparedModel::new`].
    ///
    /// # Errors
    /// [`crate::Error::FaceNotCut`] if no face can be cut.
    pub fn new_skipping(model: Model, report: &mut ReadReport) -> Result<(Model, Self)> {
        Self::new_watched(model, report, None)
    }

    /// As [`PreparedModel::new_skipping`]; calls the listener with the cut of each face as soon as it is made.
    ///
    /// # Errors
    /// Those of [`PreparedModel::new_skipping`].
    pub(crate) fn new_watched(
        model: Model,
        report: &mut ReadReport,
        watch: Watch<'_, Result<Untrimmed>>,
    ) -> Result<(Model, Self)> {
        let Cuttable { model, pieces, untrimmed, refused } = FacePieces::of_cuttable(model, watch)?;
        report.leave_out(&refused);
        let prepared = Self::of_pieces(&model, pieces, &untrimmed);
        Ok((model, prepared))
    }

    /// Prepares a mesh or a cloud of points: builds its tree. `unit` is metres per unit of its
    /// coordinates, if they are known. O(n log n), on all cores.
    ///
    /// # Errors
    /// [`Error::UnitInvalid`].
    pub fn of_facets(facets: &Facets, unit: Option<f64>) -> Result<Self> {
        if let Some(found) = unit.filter(|&unit| !is_unit(unit)) {
            return Err(Error::UnitInvalid { found });
        }
        let gap = match facets {
            Facets::Mesh(mesh) => mesh.gap(),
            Facets::Cloud(_) => 0.0,
        };
        Ok(Self::with_facets(PreparedFacets::new(facets), gap, unit))
    }

    /// Returns the model of facets that stand for a surface within this gap.
    fn with_facets(facets: PreparedFacets, gap: f64, unit: Option<f64>) -> Self {
        let bounding_box = facets.target.bounding_box();
        let empty = BezierModel {
            patches: PatchSet::default(),
            grids: Vec::new(),
            point_error: PointError::default(),
        };
        Self {
            name: None,
            unit,
            source: None,
            gap,
            face_gaps: vec![gap; facets.groups().len()],
            is_gap_proven: true,
            trimmed_faces: None,
            pieces: FacePieces::of_facets(facets.groups().iter().map(|group| group.name.clone()).collect()),
            revolutions: Vec::new(),
            facets: Some(facets),
            bezier: empty,
            bounding_box,
            control_box: bounding_box,
            kept: Kept::default(),
            refits: 0,
        }
    }

    fn of_pieces(model: &Model, pieces: FacePieces, untrimmed: &Model) -> Self {
        let reduced = without_removable_knots(untrimmed);
        let (simple, knot_removal) =
            reduced.as_ref().map_or((untrimmed, 0.0), |reduced| (&reduced.model, reduced.error));
        let mut bezier = extract(simple);
        bezier.point_error.include_deviation(pieces.deviation() + knot_removal);
        for (grid, shares) in bezier.grids.iter_mut().zip(pieces.shares(untrimmed.surfaces())) {
            grid.shares = shares;
        }
        let control_box = untrimmed.bounding_box().union(simple.bounding_box());
        Self {
            name: model.name().map(str::to_owned),
            unit: model.unit(),
            source: Some(model.clone()),
            gap: model.gap(),
            face_gaps: model.faces().map(|face| face.gap()).collect(),
            is_gap_proven: model.is_gap_proven(),
            trimmed_faces: model.is_trimmed().then(|| pieces.trimmed_faces(model)),
            pieces,
            revolutions: revolutions(&bezier),
            facets: None,
            bezier,
            bounding_box: untrimmed.bounding_box(),
            control_box,
            kept: Kept::default(),
            refits: 0,
        }
    }

    /// Returns `model`, which has other control points on the same knots, prepared with
    /// the cuts, the trees and the cells of this one. Equal to [`PreparedModel::new`] but
    /// for the time that both take, here and in a search.
    ///
    /// O(patches p q (p + q)); a model of other patches is prepared anew.
    ///
    /// # Errors
    /// Those of [`PreparedModel::new`].
    pub fn updated(&self, model: &Model) -> Result<Self> {
        let mut updated = Self::new(model)?;
        if self.refits == MAX_REFITS || self.bezier.grids != updated.bezier.grids {
            return Ok(updated);
        }
        updated.refits = self.refits + 1;
        for (flatness, kept) in locked(&self.kept.targets).clone() {
            let target = kept.refitted(&updated.bezier.patches);
            locked(&updated.kept.targets).push((flatness, Arc::new(target)));
        }
        if let Some(kept) = locked(&self.kept.cells).clone() {
            let tree = kept.tree.refitted(&updated.bezier);
            *locked(&updated.kept.cells) =
                Some(Arc::new(PreparedCells { tree, resident: Resident::default() }));
        }
        Ok(updated)
    }
}
