//! Models with the data that is computed from them once.

use crate::area::{Area, area};
use crate::bezier::{
    BezierModel, LocalDerivativeBounds, PatchGrid, PatchSet, PointError, extract, without_removable_knots,
};
use crate::bvh::Aabb;
use crate::certified::{Operand, SheetCache, Sheets, TrimmedFaces};
use crate::closest::Target;
use crate::error::{Error, Result};
use crate::facets::{Facets, PreparedFacets, weights};
use crate::flatness::{Cuts, FlatPatches, Flatness, MAX_HALVINGS, Places, flatten, recut};
use crate::gpu::{GpuGridTree, GpuSampling, GpuTarget, Resident};
use crate::hierarchy::{GridTree, GridTreeBuilder};
use crate::iteration::{CoveringRadius, Sampling, SamplingRule};
use crate::limits::is_in_range;
use crate::model::{Model, is_unit};
use crate::pieces::{Cuttable, FacePieces};
use crate::progress::Progress;
use crate::read::ReadReport;
use crate::rounding::gamma;
use crate::solid::{Boundary, Edges};
use crate::surface_point::SurfacePoint;
use crate::symmetry::{Revolution, revolutions};
use crate::threads::parallel::map;
use crate::threads::{computed, locked};
use glam::DVec3;
use std::sync::{Arc, Mutex, OnceLock};

/// A model ready for distance computations: its Bézier patches, and, computed at
/// first use and kept, its flat patches, its samples and their copies on the GPU.
#[derive(Debug)]
pub struct PreparedModel {
    name: Option<String>,
    unit: Option<f64>,
    /// The model itself, kept if it states its unit, to be scaled to another.
    source: Option<Model>,
    /// The model in another unit, the last one.
    scaled: Mutex<Option<Arc<PreparedModel>>>,
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
    targets: Mutex<Vec<(Flatness, Arc<PreparedTarget>)>>,
    samplings: Mutex<Vec<(SamplingKey, Arc<PreparedSampling>)>>,
    cells: Mutex<Option<Arc<PreparedCells>>>,
    areas: OnceLock<Vec<Area>>,
    boundary: OnceLock<Boundary>,
    /// The number of updates since cuts and trees were chosen.
    refits: u32,
}

/// The roundings of a coordinate scaled to another unit: the factor and the product.
const SCALE_ROUNDINGS: f64 = 4.0;
/// The number of updates after which cuts and trees are chosen anew, for the shape that
/// the model has by then; they are chosen for an older one meanwhile.
const MAX_REFITS: u32 = 32;

/// The smallest number of Bézier patches of a model for which method `certified` does not
/// subdivide them into flat patches.
///
/// For more patches the subdivision takes longer than it saves: the search looks at few of
/// them, and most of these patches are flat already. Fewer patches are
/// subdivided, A's for closer bounds on their derivatives and B's for better starts.
const MIN_UNCUT_PATCHES: usize = 1000;

type SamplingKey = (usize, SamplingRule);

/// Flat patches, with their copy on the GPU.
#[derive(Debug)]
pub(crate) struct PreparedTarget {
    pub(crate) target: Target,
    places: Places,
    sheets: SheetCache,
    cuts: Cuts,
    bounds: OnceLock<Vec<LocalDerivativeBounds>>,
    pub(crate) resident: Resident<GpuTarget>,
}

impl PreparedTarget {
    fn new(flat: FlatPatches, target: impl FnOnce(PatchSet) -> Target) -> Self {
        Self {
            target: target(flat.patches),
            places: flat.places,
            sheets: SheetCache::default(),
            cuts: flat.cuts,
            bounds: OnceLock::new(),
            resident: Resident::default(),
        }
    }

    /// Returns where the patches are in those that they were cut from.
    pub(crate) fn places(&self) -> &Places {
        &self.places
    }

    /// Returns an upper bound on the distance between a computed point of the patches, which must
    /// have been cut from those of `model`, and the exact one.
    pub(super) fn point_error(&self, model: &PreparedModel) -> f64 {
        model.bezier().point_error.after(MAX_HALVINGS)
    }

    /// Returns a point of a patch, by its parameters there, as a point of a face of `model`.
    pub(super) fn surface_point(
        &self,
        model: &PreparedModel,
        patch: u32,
        parameters: [f64; 2],
        point: DVec3,
    ) -> SurfacePoint {
        let patch = self.target.patches.patch(patch as usize);
        model.surface_point(patch.surface, patch.surface_parameters(parameters), point)
    }

    /// Returns the patches as an operand of method `certified`; they must have been
    /// cut from those of `model`.
    pub(crate) fn operand<'a>(&'a self, model: &'a PreparedModel) -> Operand<'a> {
        let bounds = computed(&self.bounds, || self.places.derivative_bounds());
        let operand = Operand::new(&self.target, bounds)
            .with_accuracy(model.control_box, model.bezier().point_error.after(MAX_HALVINGS));
        if model.facets.is_some() {
            // Triangles are patches that no sheet was cut into.
            return operand;
        }
        operand
            .with_revolutions(&model.revolutions)
            .with_faces(model.trimmed_faces.as_ref())
            .with_sheets(Sheets { bezier: model.bezier(), places: &self.places, cache: &self.sheets })
    }
}

/// Samples, with their copy on the GPU.
#[derive(Debug)]
pub(crate) struct PreparedSampling {
    pub(crate) sampling: Sampling,
    /// The samples' covering radius, which only method `iteration` needs, computed at first use.
    radius: OnceLock<CoveringRadius>,
    pub(crate) resident: Resident<GpuSampling>,
}

impl PreparedSampling {
    /// Returns the covering radius over all surfaces of `model`, whose samples these are.
    pub(crate) fn radius(&self, model: &PreparedModel) -> CoveringRadius {
        *computed(&self.radius, || self.sampling.radius(model.bezier()))
    }
}

/// A tree of cells, with its copy on the GPU.
#[derive(Debug)]
pub(crate) struct PreparedCells {
    pub(crate) tree: GridTree,
    pub(crate) resident: Resident<GpuGridTree>,
}

/// The largest number of samplings kept: the one in use and, for a slider moved
/// back and forth, its neighbours.
const MAX_SAMPLINGS: usize = 4;

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
        let Cuttable { model, pieces, untrimmed, refused } = FacePieces::of_cuttable(model)?;
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
        Ok(Self::with_facets(PreparedFacets::new(facets), unit))
    }

    fn with_facets(facets: PreparedFacets, unit: Option<f64>) -> Self {
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
            scaled: Mutex::default(),
            gap: 0.0,
            face_gaps: vec![0.0; facets.groups().len()],
            is_gap_proven: true,
            trimmed_faces: None,
            pieces: FacePieces::of_facets(facets.groups().iter().map(|group| group.name.clone()).collect()),
            revolutions: Vec::new(),
            facets: Some(facets),
            bezier: empty,
            bounding_box,
            control_box: bounding_box,
            targets: Mutex::default(),
            samplings: Mutex::default(),
            cells: Mutex::default(),
            areas: OnceLock::new(),
            boundary: OnceLock::new(),
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
            source: model.unit().map(|_| model.clone()),
            scaled: Mutex::default(),
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
            targets: Mutex::default(),
            samplings: Mutex::default(),
            cells: Mutex::default(),
            areas: OnceLock::new(),
            boundary: OnceLock::new(),
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
        for (flatness, kept) in locked(&self.targets).clone() {
            let flat = recut(&updated.bezier.patches, &kept.cuts);
            let target = PreparedTarget::new(flat, |patches| kept.target.refitted(patches));
            locked(&updated.targets).push((flatness, Arc::new(target)));
        }
        if let Some(kept) = locked(&self.cells).clone() {
            let tree = kept.tree.refitted(&updated.bezier);
            *locked(&updated.cells) = Some(Arc::new(PreparedCells { tree, resident: Resident::default() }));
        }
        Ok(updated)
    }

    /// Returns the model's name, if it has one.
    #[must_use]
    pub fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    /// Returns the metres per coordinate unit, if they are known.
    #[must_use]
    pub fn unit(&self) -> Option<f64> {
        self.unit
    }

    /// Returns this model in the unit of `other` if both state different units, else
    /// `None`; the last one is kept.
    ///
    /// # Errors
    /// [`Error::UnitsDiffer`] if the units differ and must not be scaled; those of
    /// [`Model::scaled_to_unit`] and [`PreparedModel::new`].
    pub(crate) fn in_unit_of(&self, other: &Self, scale: bool) -> Result<Option<Arc<Self>>> {
        let (Some(a), Some(b)) = (other.unit, self.unit) else { return Ok(None) };
        if a == b {
            return Ok(None);
        }
        if !scale {
            return Err(Error::UnitsDiffer { a, b });
        }
        let kept = locked(&self.scaled).clone();
        if let Some(kept) = kept.filter(|kept| kept.unit == Some(a)) {
            return Ok(Some(kept));
        }
        let prepared = Arc::new(self.scaled_by(b / a, a)?);
        *locked(&self.scaled) = Some(Arc::clone(&prepared));
        Ok(Some(prepared))
    }

    /// Returns this model in the unit `unit`, which is `1 / factor` times as long.
    fn scaled_by(&self, factor: f64, unit: f64) -> Result<Self> {
        if let Some(facets) = &self.facets {
            let scaled = facets.scaled(factor);
            let length = scaled.target.bounding_box().farthest_from_origin();
            if !is_in_range(length) {
                return Err(Error::PointOutOfRange { index: 0, found: length });
            }
            return Ok(Self::with_facets(scaled, Some(unit)));
        }
        let source = self.source.as_ref().ok_or(Error::EmptyModel)?;
        let mut prepared = Self::new(&source.scaled_to_unit(unit)?)?;
        let rounding = gamma(SCALE_ROUNDINGS) * prepared.bounding_box.farthest_from_origin();
        prepared.bezier.point_error.include_deviation(rounding);
        Ok(prepared)
    }

    /// Returns the distance, in model units, between the model and its source as its reader states
    /// it: see [`Model::gap`].
    #[must_use]
    pub fn gap(&self) -> f64 {
        self.gap
    }

    /// Returns the gap of each face.
    pub(crate) fn face_gaps(&self) -> &[f64] {
        &self.face_gaps
    }

    /// Returns whether [`Self::gap`] is an upper bound: see [`Model::is_gap_proven`].
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
        computed::<Vec<Area>>(&self.areas, || {
            if let Some(facets) = &self.facets {
                return facets.areas();
            }
            let (faces, bezier) = (self.pieces.faces(), &self.bezier);
            map(faces.len(), |face| {
                let grids = bezier.grids[faces[face].clone()].iter();
                let patches = grids.flat_map(|grid| {
                    let [rows, columns] = grid.counts();
                    (grid.first..grid.first + rows * columns).map(|index| bezier.patches.patch(index))
                });
                area(patches)
            })
        })
    }

    /// Returns the sum of [`PreparedModel::face_areas`].
    pub fn area(&self) -> Area {
        self.face_areas().iter().fold(Area::default(), |sum, &area| sum + area)
    }

    /// Returns the edges of the faces, joined where they meet, computed at first use.
    pub(super) fn boundary(&self) -> &Boundary {
        computed(&self.boundary, || {
            if let Some(facets) = &self.facets {
                let edges = Edges::of_triangles(facets.joined_triangles());
                return Boundary::new(edges, facets.point_error(), &self.control_box, self.gap, 1);
            }
            let degrees = self.bezier.patches.iter().flat_map(|patch| patch.degree);
            let (edges, point_error) = (Edges::of_surfaces(&self.bezier), self.bezier.point_error);
            Boundary::new(edges, point_error, &self.control_box, self.gap, degrees.max().unwrap_or(0))
        })
    }

    /// Returns the number of faces.
    #[must_use]
    pub fn face_count(&self) -> usize {
        self.pieces.face_count()
    }

    /// Returns the name of a face in its source, if it has one.
    #[must_use]
    pub fn face_name(&self, face: usize) -> Option<&str> {
        self.pieces.face_name(face)
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
    pub(super) fn require_faces(&self, found: &'static str) -> Result<()> {
        if self.is_cloud() { Err(Error::FacetsUnsupported { found }) } else { Ok(()) }
    }

    /// Returns the face of one of the surfaces of [`PreparedModel::bezier`].
    pub(super) fn face_of(&self, surface: usize) -> usize {
        match &self.facets {
            Some(facets) => facets.group(facets.target.index(surface as u32)),
            None => self.pieces.face(surface),
        }
    }

    /// Returns a point of one of the surfaces of [`PreparedModel::bezier`] as a point of a face.
    pub(super) fn surface_point(&self, surface: usize, parameters: [f64; 2], point: DVec3) -> SurfacePoint {
        match &self.facets {
            Some(_) => self.facet_point(surface as u32, weights(parameters), point),
            None => self.pieces.surface_point(surface, parameters, point),
        }
    }

    /// Returns a point of a facet, by its place in the order of the leaves.
    pub(super) fn facet_point(&self, place: u32, weights: [f64; 3], point: DVec3) -> SurfacePoint {
        self.point_of_facet(
            self.facets.as_ref().map_or(0, |facets| facets.target.index(place)),
            weights,
            point,
        )
    }

    /// Returns a point of a facet, by its index in the model.
    pub(super) fn point_of_facet(&self, index: usize, weights: [f64; 3], point: DVec3) -> SurfacePoint {
        let is_cloud = self.is_cloud();
        let [_, u, v] = if is_cloud { [1.0, 0.0, 0.0] } else { weights };
        let face = self.facets.as_ref().map_or(0, |facets| facets.group(index));
        SurfacePoint {
            face,
            face_name: self.face_name(face).map(str::to_owned),
            u,
            v,
            triangle: (!is_cloud).then_some(index),
            barycentric: (!is_cloud).then_some(weights),
            index: is_cloud.then_some(index),
            point: point.to_array(),
        }
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

    /// Returns whether method `certified` does not cut the model into flat patches.
    pub(super) fn is_left_uncut(&self) -> bool {
        self.facets.is_some() || self.bezier.patches.len() >= MIN_UNCUT_PATCHES
    }

    /// Returns the patches that method `certified` and closest points search.
    pub(super) fn certified_target(&self) -> Arc<PreparedTarget> {
        // Triangles are flat.
        let is_left = self.is_left_uncut() || self.facets.is_some();
        self.target(if is_left { Flatness::None } else { Flatness::Loose })
    }

    /// Returns the flat patches, computed at first use.
    pub(crate) fn target(&self, flatness: Flatness) -> Arc<PreparedTarget> {
        let known = |targets: &[(Flatness, Arc<PreparedTarget>)]| {
            targets.iter().find(|(known, _)| *known == flatness).map(|(_, target)| Arc::clone(target))
        };
        if let Some(target) = known(&locked(&self.targets)) {
            return target;
        }
        let flat = flatten(&self.bezier().patches, flatness);
        let prepared = Arc::new(PreparedTarget::new(flat, Target::new));
        let mut targets = locked(&self.targets);
        // Another thread may have been first, whose copy on the GPU is to be the only one.
        known(&targets).unwrap_or_else(|| {
            targets.push((flatness, Arc::clone(&prepared)));
            prepared
        })
    }

    /// Returns the tree over `grid` × `grid` cells per surface; the last one is kept.
    ///
    /// # Errors
    /// Those of [`GridTree::new`], [`crate::Error::Cancelled`].
    pub(crate) async fn cells(&self, grid: usize, progress: &mut Progress<'_>) -> Result<Arc<PreparedCells>> {
        let kept = locked(&self.cells).clone();
        if let Some(kept) = kept.filter(|kept| kept.tree.grid == grid) {
            return Ok(kept);
        }
        let mut builder = GridTreeBuilder::new(&self.bezier, grid)?;
        while builder.advance() {
            progress.checkpoint(0.0).await?;
        }
        let prepared = Arc::new(PreparedCells { tree: builder.finish(), resident: Resident::default() });
        *locked(&self.cells) = Some(Arc::clone(&prepared));
        Ok(prepared)
    }

    /// Returns the sampling, computed at first use; the last few are kept.
    pub(crate) fn sampling(&self, samples: usize, rule: SamplingRule) -> Arc<PreparedSampling> {
        let key = (samples, rule);
        let known = |samplings: &[(SamplingKey, Arc<PreparedSampling>)]| {
            samplings.iter().find(|(known, _)| *known == key).map(|(_, sampling)| Arc::clone(sampling))
        };
        if let Some(sampling) = known(&locked(&self.samplings)) {
            return sampling;
        }
        let sampling = Sampling::new(&self.bezier, samples, rule);
        let prepared =
            Arc::new(PreparedSampling { sampling, radius: OnceLock::new(), resident: Resident::default() });
        let mut samplings = locked(&self.samplings);
        known(&samplings).unwrap_or_else(|| {
            if samplings.len() == MAX_SAMPLINGS {
                samplings.remove(0);
            }
            samplings.push((key, Arc::clone(&prepared)));
            prepared
        })
    }
}
