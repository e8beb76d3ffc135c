//! Models with the data that is computed from them once.

use crate::bezier::{BezierModel, LocalDerivativeBounds, PatchGrid, PatchSet, extract};
use crate::bvh::Aabb;
use crate::certified::Operand;
use crate::closest::Target;
use crate::error::Result;
use crate::flatness::{Cuts, FlatPatches, Flatness, MAX_HALVINGS, flatten, recut};
use crate::gpu::{GpuGridTree, GpuSampling, GpuTarget, Resident};
use crate::hierarchy::{GridTree, GridTreeBuilder};
use crate::iteration::{Sampling, SamplingRule};
use crate::model::Model;
use crate::param_box::ParamBox;
use crate::progress::Progress;
use crate::symmetry::{Revolution, revolutions};
use std::cell::{OnceCell, RefCell};
use std::rc::Rc;

/// A model ready for distance computations: its Bézier patches, and, computed at
/// first use and kept, its flat patches, its samples and their copies on the GPU.
#[derive(Debug)]
pub struct PreparedModel {
    name: Option<String>,
    bezier: BezierModel,
    revolutions: Vec<Option<Revolution>>,
    bounding_box: Aabb,
    targets: RefCell<Vec<(Flatness, Rc<PreparedTarget>)>>,
    samplings: RefCell<Vec<(SamplingKey, Rc<PreparedSampling>)>>,
    cells: RefCell<Option<Rc<PreparedCells>>>,
    /// The number of updates since cuts and trees were chosen.
    refits: u32,
}

/// The number of updates after which cuts and trees are chosen anew, for the shape that
/// the model has by then; they are chosen for an older one meanwhile.
const MAX_REFITS: u32 = 32;

type SamplingKey = (usize, SamplingRule);

/// Flat patches, with their copy on the GPU.
#[derive(Debug)]
pub(crate) struct PreparedTarget {
    pub(crate) target: Target,
    extensions: Vec<ParamBox>,
    cuts: Cuts,
    bounds: OnceCell<Vec<LocalDerivativeBounds>>,
    pub(crate) resident: Resident<GpuTarget>,
}

impl PreparedTarget {
    fn new(flat: FlatPatches, target: impl FnOnce(PatchSet) -> Target) -> Self {
        Self {
            target: target(flat.patches),
            extensions: flat.extensions,
            cuts: flat.cuts,
            bounds: OnceCell::new(),
            resident: Resident::default(),
        }
    }

    /// Returns the extension of every patch.
    pub(crate) fn extensions(&self) -> &[ParamBox] {
        &self.extensions
    }

    /// Returns the patches as an operand of method `certified`; they must have been
    /// cut from those of `model`.
    pub(crate) fn operand<'a>(&'a self, model: &'a PreparedModel) -> Operand<'a> {
        let bounds = || self.extensions.iter().copied().map(LocalDerivativeBounds::new).collect();
        Operand::new(&self.target, self.bounds.get_or_init(bounds))
            .with_accuracy(model.bounding_box, model.bezier.point_error.after(MAX_HALVINGS))
            .with_revolutions(&model.revolutions)
    }
}

/// Samples, with their copy on the GPU.
#[derive(Debug)]
pub(crate) struct PreparedSampling {
    pub(crate) sampling: Sampling,
    pub(crate) resident: Resident<GpuSampling>,
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
    /// Extracts the Bézier patches and detects symmetries. O(patches p q (p + q)).
    #[must_use]
    pub fn new(model: &Model) -> Self {
        let bezier = extract(model);
        Self {
            name: model.name().map(str::to_owned),
            revolutions: revolutions(&bezier),
            bezier,
            bounding_box: model.bounding_box(),
            targets: RefCell::default(),
            samplings: RefCell::default(),
            cells: RefCell::default(),
            refits: 0,
        }
    }

    /// Returns `model`, which has other control points on the same knots, prepared with
    /// the cuts, the trees and the cells of this one. Equal to [`PreparedModel::new`] but
    /// for the time that both take, here and in a search.
    ///
    /// O(patches p q (p + q)); a model of other patches is prepared anew.
    #[must_use]
    pub fn updated(&self, model: &Model) -> Self {
        let mut updated = Self::new(model);
        if self.refits == MAX_REFITS || !self.patch_counts().eq(updated.patch_counts()) {
            return updated;
        }
        updated.refits = self.refits + 1;
        for (flatness, kept) in &*self.targets.borrow() {
            let flat = recut(&updated.bezier.patches, &kept.cuts);
            let target = PreparedTarget::new(flat, |patches| kept.target.refitted(patches));
            updated.targets.get_mut().push((*flatness, Rc::new(target)));
        }
        if let Some(kept) = &*self.cells.borrow() {
            let tree = kept.tree.refitted(&updated.bezier);
            *updated.cells.get_mut() = Some(Rc::new(PreparedCells { tree, resident: Resident::default() }));
        }
        updated
    }

    /// Returns the model's name, if it has one.
    #[must_use]
    pub fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    /// Returns the numbers of Bézier patches along u and v, one entry per surface.
    pub fn patch_counts(&self) -> impl ExactSizeIterator<Item = [usize; 2]> {
        self.bezier.grids.iter().map(PatchGrid::counts)
    }

    /// Returns the number of faces.
    pub(crate) fn face_count(&self) -> usize {
        self.bezier.grids.len()
    }

    pub(crate) fn bezier(&self) -> &BezierModel {
        &self.bezier
    }

    /// Returns the box of the model's control points.
    #[must_use]
    pub fn bounding_box(&self) -> Aabb {
        self.bounding_box
    }

    /// Returns the flat patches, computed at first use.
    pub(crate) fn target(&self, flatness: Flatness) -> Rc<PreparedTarget> {
        let mut targets = self.targets.borrow_mut();
        if let Some((_, target)) = targets.iter().find(|(key, _)| *key == flatness) {
            return Rc::clone(target);
        }
        let flat = flatten(&self.bezier.patches, flatness);
        let prepared = Rc::new(PreparedTarget::new(flat, Target::new));
        targets.push((flatness, Rc::clone(&prepared)));
        prepared
    }

    /// Returns the tree over `grid` × `grid` cells per surface; the last one is kept.
    ///
    /// # Errors
    /// Those of [`GridTree::new`], [`crate::Error::Cancelled`].
    pub(crate) async fn cells(&self, grid: usize, progress: &mut Progress<'_>) -> Result<Rc<PreparedCells>> {
        if let Some(kept) = self.cells.borrow().as_ref()
            && kept.tree.grid == grid
        {
            return Ok(Rc::clone(kept));
        }
        let mut builder = GridTreeBuilder::new(&self.bezier, grid)?;
        while builder.advance() {
            progress.checkpoint(0.0).await?;
        }
        let prepared = Rc::new(PreparedCells { tree: builder.finish(), resident: Resident::default() });
        *self.cells.borrow_mut() = Some(Rc::clone(&prepared));
        Ok(prepared)
    }

    /// Returns the sampling, computed at first use; the last few are kept.
    pub(crate) fn sampling(&self, samples: usize, rule: SamplingRule) -> Rc<PreparedSampling> {
        let mut samplings = self.samplings.borrow_mut();
        if let Some((_, sampling)) = samplings.iter().find(|(key, _)| *key == (samples, rule)) {
            return Rc::clone(sampling);
        }
        let sampling = Sampling::new(&self.bezier, samples, rule);
        let prepared = Rc::new(PreparedSampling { sampling, resident: Resident::default() });
        if samplings.len() == MAX_SAMPLINGS {
            samplings.remove(0);
        }
        samplings.push(((samples, rule), Rc::clone(&prepared)));
        prepared
    }
}
