//! What is computed from a model at first use, and kept.

use super::PreparedModel;
use super::bodies::BodyParts;
use super::measured::MeasuredBody;
use super::shells::KnownShells;
use crate::area::Area;
use crate::bezier::{LocalDerivativeBounds, PatchSet};
use crate::certified::{Operand, SheetCache, Sheets};
use crate::closest::Target;
use crate::deviation::Map;
use crate::embedded::SelfOverlap;
use crate::error::Result;
use crate::facts::Facts;
use crate::flatness::{Cuts, FlatPatches, Flatness, MAX_HALVINGS, Places, flatten, recut};
use crate::gpu::{GpuGridTree, GpuPointTarget, GpuSampling, GpuTarget, Resident};
use crate::hierarchy::{GridTree, GridTreeBuilder};
use crate::iteration::{CoveringRadius, Sampling, SamplingRule};
use crate::progress::Progress;
use crate::solid::{Boundary, Joined};
use crate::surface_point::SurfacePoint;
use crate::threads::{computed, locked};
use glam::DVec3;
use std::sync::{Arc, Mutex, OnceLock};

/// The smallest number of Bézier patches of a model for which method `certified` does not
/// subdivide them into flat patches.
///
/// For more patches the subdivision takes longer than it saves: the search looks at few of
/// them, and most of these patches are flat already. Fewer patches are
/// subdivided, A's for closer bounds on their derivatives and B's for better starts.
const MIN_UNCUT_PATCHES: usize = 1000;

/// The largest number of samplings kept: the one in use and, for a slider moved
/// back and forth, its neighbours.
const MAX_SAMPLINGS: usize = 4;

type SamplingKey = (usize, SamplingRule);

/// What a model has computed at first use.
#[derive(Debug, Default)]
pub(super) struct Kept {
    /// The model in another unit, the last one.
    pub(super) scaled: Mutex<Option<Arc<PreparedModel>>>,
    pub(super) targets: Mutex<Vec<(Flatness, Arc<PreparedTarget>)>>,
    samplings: Mutex<Vec<(SamplingKey, Arc<PreparedSampling>)>>,
    pub(super) cells: Mutex<Option<Arc<PreparedCells>>>,
    /// The triangles of its map.
    pub(super) map_base: Mutex<Option<Arc<Map>>>,
    pub(super) areas: OnceLock<Vec<Area>>,
    pub(super) boundary: OnceLock<Boundary>,
    pub(super) joined: OnceLock<Joined>,
    pub(super) bodies: OnceLock<Vec<BodyParts>>,
    pub(super) measured: OnceLock<Vec<MeasuredBody>>,
    /// Whether the normals of each shell point out of it.
    pub(super) faces_out: OnceLock<Vec<Option<bool>>>,
    pub(super) facts: OnceLock<Facts>,
    pub(super) shells: KnownShells,
    self_overlap: OnceLock<Option<SelfOverlap>>,
}

/// Flat patches, with their copy on the GPU.
#[derive(Debug)]
pub(crate) struct PreparedTarget {
    pub(crate) target: Target,
    places: Places,
    sheets: SheetCache,
    cuts: Cuts,
    bounds: OnceLock<Vec<LocalDerivativeBounds>>,
    pub(crate) resident: Resident<GpuTarget>,
    /// The same, cut finely for closest points.
    pub(crate) located: Resident<GpuPointTarget>,
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
            located: Resident::default(),
        }
    }

    /// Returns the patches that the same cuts make of others on the same knots.
    pub(super) fn refitted(&self, patches: &PatchSet) -> Self {
        Self::new(recut(patches, &self.cuts), |patches| self.target.refitted(patches))
    }

    /// Returns where the patches are in those that they were cut from.
    pub(crate) fn places(&self) -> &Places {
        &self.places
    }

    /// Returns an upper bound on the distance between a computed point of the patches, which must
    /// have been cut from those of `model`, and the exact one.
    pub(in crate::engine) fn point_error(&self, model: &PreparedModel) -> f64 {
        model.bezier().point_error.after(MAX_HALVINGS)
    }

    /// Returns a point of a patch, by its parameters there, as a point of a face of `model`.
    pub(in crate::engine) fn surface_point(
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

impl PreparedModel {
    /// Returns the place at which the boundary meets itself, if one was found at first use.
    pub(in crate::engine) fn kept_self_overlap(
        &self,
        find: impl FnOnce() -> Option<SelfOverlap>,
    ) -> Option<&SelfOverlap> {
        computed::<Option<SelfOverlap>>(&self.kept.self_overlap, find).as_ref()
    }

    /// Returns whether method `certified` does not cut the model into flat patches.
    pub(in crate::engine) fn is_left_uncut(&self) -> bool {
        self.facets.is_some() || self.bezier.patches.len() >= MIN_UNCUT_PATCHES
    }

    /// Returns the patches that method `certified` and closest points search.
    pub(in crate::engine) fn certified_target(&self) -> Arc<PreparedTarget> {
        // Triangles are flat.
        let is_left = self.is_left_uncut() || self.facets.is_some();
        self.target(if is_left { Flatness::None } else { Flatness::Loose })
    }

    /// Returns the flat patches, computed at first use.
    pub(crate) fn target(&self, flatness: Flatness) -> Arc<PreparedTarget> {
        let known = |targets: &[(Flatness, Arc<PreparedTarget>)]| {
            targets.iter().find(|(known, _)| *known == flatness).map(|(_, target)| Arc::clone(target))
        };
        if let Some(target) = known(&locked(&self.kept.targets)) {
            return target;
        }
        let flat = flatten(&self.bezier().patches, flatness);
        let prepared = Arc::new(PreparedTarget::new(flat, Target::new));
        let mut targets = locked(&self.kept.targets);
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
        let kept = locked(&self.kept.cells).clone();
        if let Some(kept) = kept.filter(|kept| kept.tree.grid == grid) {
            return Ok(kept);
        }
        let mut builder = GridTreeBuilder::new(&self.bezier, grid)?;
        while builder.advance() {
            progress.checkpoint(0.0).await?;
        }
        let prepared = Arc::new(PreparedCells { tree: builder.finish(), resident: Resident::default() });
        *locked(&self.kept.cells) = Some(Arc::clone(&prepared));
        Ok(prepared)
    }

    /// Returns the sampling, computed at first use; the last few are kept.
    pub(crate) fn sampling(&self, samples: usize, rule: SamplingRule) -> Arc<PreparedSampling> {
        let key = (samples, rule);
        let known = |samplings: &[(SamplingKey, Arc<PreparedSampling>)]| {
            samplings.iter().find(|(known, _)| *known == key).map(|(_, sampling)| Arc::clone(sampling))
        };
        if let Some(sampling) = known(&locked(&self.kept.samplings)) {
            return sampling;
        }
        let sampling = Sampling::new(&self.bezier, samples, rule);
        let prepared =
            Arc::new(PreparedSampling { sampling, radius: OnceLock::new(), resident: Resident::default() });
        let mut samplings = locked(&self.kept.samplings);
        known(&samplings).unwrap_or_else(|| {
            if samplings.len() == MAX_SAMPLINGS {
                samplings.remove(0);
            }
            samplings.push((key, Arc::clone(&prepared)));
            prepared
        })
    }
}
