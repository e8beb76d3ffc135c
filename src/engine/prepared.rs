//! Models with the data that is computed from them once.

use crate::bezier::{BezierModel, LocalDerivativeBounds, PatchGrid, extract, without_removable_knots};
use crate::bvh::Aabb;
use crate::certified::{Operand, SheetCache, Sheets};
use crate::closest::Target;
use crate::error::Result;
use crate::flatness::{Flatness, MAX_HALVINGS, Place, flatten_within};
use crate::gpu::{GpuGridTree, GpuSampling, GpuTarget, Resident};
use crate::hierarchy::GridTree;
use crate::iteration::{Sampling, SamplingRule};
use crate::model::Model;
use crate::param_box::ParamBox;
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
    control_box: Aabb,
    targets: RefCell<Vec<(TargetKey, Rc<PreparedTarget>)>>,
    samplings: RefCell<Vec<(SamplingKey, Rc<PreparedSampling>)>>,
    cells: RefCell<Option<Rc<PreparedCells>>>,
}

type SamplingKey = (usize, SamplingRule);

/// The criterion of flatness, and the number of halvings of a patch.
type TargetKey = (Flatness, u32);

/// Flat patches, with their copy on the GPU.
#[derive(Debug)]
pub(crate) struct PreparedTarget {
    pub(crate) target: Target,
    extensions: Vec<ParamBox>,
    places: Vec<Place>,
    sheets: SheetCache,
    bounds: OnceCell<Vec<LocalDerivativeBounds>>,
    pub(crate) resident: Resident<GpuTarget>,
}

impl PreparedTarget {
    /// Returns the patches as an operand of method `certified`; they must have been
    /// cut from those of `model`.
    pub(crate) fn operand<'a>(&'a self, model: &'a PreparedModel) -> Operand<'a> {
        let bounds = || self.extensions.iter().copied().map(LocalDerivativeBounds::new).collect();
        Operand::new(&self.target, self.bounds.get_or_init(bounds))
            .with_accuracy(model.control_box, model.bezier.point_error.after(MAX_HALVINGS))
            .with_revolutions(&model.revolutions)
            .with_sheets(Sheets { bezier: &model.bezier, places: &self.places, cache: &self.sheets })
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
    /// Removes removable knots, extracts the Bézier patches and detects symmetries.
    /// O(patches p q (p + q)).
    #[must_use]
    pub fn new(model: &Model) -> Self {
        let reduced = without_removable_knots(model);
        let (simple, error) =
            reduced.as_ref().map_or((model, 0.0), |reduced| (&reduced.model, reduced.error));
        let mut bezier = extract(simple);
        bezier.point_error.include_knot_removal(error);
        Self {
            name: model.name().map(str::to_owned),
            revolutions: revolutions(&bezier),
            bezier,
            bounding_box: model.bounding_box(),
            control_box: model.bounding_box().union(simple.bounding_box()),
            targets: RefCell::default(),
            samplings: RefCell::default(),
            cells: RefCell::default(),
        }
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

    pub(crate) fn bezier(&self) -> &BezierModel {
        &self.bezier
    }

    /// Returns the box of the model's control points.
    #[must_use]
    pub fn bounding_box(&self) -> Aabb {
        self.bounding_box
    }

    /// Returns a box around the model's control points and those of its patches.
    pub(crate) fn control_box(&self) -> Aabb {
        self.control_box
    }

    /// Returns the flat patches, computed at first use.
    pub(crate) fn target(&self, flatness: Flatness) -> Rc<PreparedTarget> {
        self.target_within(flatness, MAX_HALVINGS)
    }

    /// Returns patches that are flat or halved so many times, computed at first use.
    pub(crate) fn target_within(&self, flatness: Flatness, halvings: u32) -> Rc<PreparedTarget> {
        let key = (flatness, halvings);
        let mut targets = self.targets.borrow_mut();
        if let Some((_, target)) = targets.iter().find(|(known, _)| *known == key) {
            return Rc::clone(target);
        }
        let flat = flatten_within(&self.bezier.patches, flatness, halvings);
        let prepared = Rc::new(PreparedTarget {
            target: Target::new(flat.patches),
            extensions: flat.extensions,
            places: flat.places,
            sheets: SheetCache::default(),
            bounds: OnceCell::new(),
            resident: Resident::default(),
        });
        targets.push((key, Rc::clone(&prepared)));
        prepared
    }

    /// Returns the tree over `grid` × `grid` cells per surface; the last one is kept.
    ///
    /// # Errors
    /// Those of [`GridTree::new`].
    pub(crate) fn cells(&self, grid: usize) -> Result<Rc<PreparedCells>> {
        let mut cells = self.cells.borrow_mut();
        if let Some(kept) = cells.as_ref()
            && kept.tree.grid == grid
        {
            return Ok(Rc::clone(kept));
        }
        let prepared = Rc::new(PreparedCells {
            tree: GridTree::new(&self.bezier, grid)?,
            resident: Resident::default(),
        });
        *cells = Some(Rc::clone(&prepared));
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
