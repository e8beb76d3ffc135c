//! What stands in the place of the GPU without the feature `gpu`: types without a value, so that nothing of a device is
//! compiled and engines compute on the CPU.

use crate::bezier::BezierModel;
use crate::certified::BranchAndBound;
use crate::closest::{Located, Target};
use crate::error::{Error, Result};
use crate::hierarchy::{GridTree, LevelBounds};
use crate::iteration::{Candidate, Projected, Rule, Sampling, StatusCounts};
use crate::model::RigidTransform;
use crate::progress::Progress;
use glam::DVec3;
use std::marker::PhantomData;
use std::ops::Range;
use std::sync::Arc;

/// A device.
#[derive(Debug)]
pub(crate) enum Gpu {}

/// The sole use of a device.
pub(crate) enum Turn {}

impl Gpu {
    /// Fails, as there is none.
    ///
    /// # Errors
    /// [`Error::NoAdapter`].
    pub(crate) async fn new() -> Result<Self> {
        Err(Error::NoAdapter { found: "the library was compiled without the feature gpu".to_owned() })
    }

    /// Returns the name of the adapter.
    pub(crate) fn adapter(&self) -> Option<String> {
        match *self {}
    }

    pub(crate) fn is_software(&self) -> bool {
        match *self {}
    }

    pub(crate) async fn turn(&self) -> Turn {
        match *self {}
    }

    pub(crate) fn upload_grid_tree(&self, _: &BezierModel, _: &GridTree) -> GpuGridTree {
        match *self {}
    }

    pub(crate) fn upload_sampling(&self, _: &BezierModel, _: &Sampling) -> GpuSampling {
        match *self {}
    }

    pub(crate) fn upload_point_target(&self, _: &Target) -> GpuPointTarget {
        match *self {}
    }

    pub(crate) fn upload_target(&self, _: &Target) -> GpuTarget {
        match *self {}
    }
}

/// The copy of something on a device.
#[derive(Debug)]
pub(crate) struct Resident<T>(PhantomData<T>);

impl<T> Default for Resident<T> {
    fn default() -> Self {
        Self(PhantomData)
    }
}

impl<T> Resident<T> {
    pub(crate) fn on(&self, gpu: &Gpu, _: impl FnOnce(&Gpu) -> T) -> Result<Arc<T>> {
        match *gpu {}
    }
}

/// Samples on a device.
#[derive(Debug)]
pub(crate) enum GpuSampling {}

/// Patches on a device.
#[derive(Debug)]
pub(crate) enum GpuTarget {}

/// Patches on a device, cut finely.
#[derive(Debug)]
pub(crate) enum GpuPointTarget {}

/// A tree of cells on a device.
#[derive(Debug)]
pub(crate) enum GpuGridTree {}

/// The motion of a model, with the errors of its points.
pub(crate) struct Placement {
    pub(crate) transform: RigidTransform,
    pub(crate) coordinate_error: f64,
}

/// The stages of method `certified` on a device.
pub(crate) enum GpuCertified {}

impl GpuCertified {
    pub(crate) fn new(gpu: &Arc<Gpu>, _: &BranchAndBound<'_>) -> Result<Option<Self>> {
        match **gpu {}
    }

    pub(crate) async fn advance(&mut self, _: &mut BranchAndBound<'_>) -> Result<()> {
        match *self {}
    }
}

/// The kernel of closest points on a device.
pub(crate) enum GpuPoints {}

impl GpuPoints {
    pub(crate) async fn new(
        gpu: &Arc<Gpu>,
        _: Arc<GpuPointTarget>,
        _: f64,
        _: usize,
    ) -> Result<Option<Self>> {
        match **gpu {}
    }

    pub(crate) async fn locate(&self, _: &[DVec3]) -> Result<Vec<Located>> {
        match *self {}
    }
}

/// The stages of method `iteration` on a device.
pub(crate) enum GpuIteration {}

impl GpuIteration {
    pub(crate) async fn new(
        gpu: &Arc<Gpu>,
        _: Arc<GpuSampling>,
        _: Arc<GpuTarget>,
        _: RigidTransform,
        _: Rule,
    ) -> Result<Self> {
        match **gpu {}
    }

    pub(crate) fn compile_seconds(&self) -> f64 {
        match *self {}
    }

    pub(crate) fn distance_error(&self) -> f64 {
        match *self {}
    }

    pub(crate) async fn project(&mut self, _: usize, _: &Range<usize>, _: &mut Progress<'_>) -> Result<()> {
        match *self {}
    }

    pub(crate) async fn reduce(&mut self) -> Result<Vec<Candidate>> {
        match *self {}
    }

    pub(crate) fn set_distance_squared(&mut self, _: usize, _: f64) {
        match *self {}
    }

    pub(crate) fn statuses(&self) -> StatusCounts {
        match *self {}
    }

    pub(crate) async fn field(&self) -> Result<Vec<Projected>> {
        match *self {}
    }
}

/// The stages of method `hierarchy` on a device.
pub(crate) enum GpuHierarchy {}

impl GpuHierarchy {
    pub(crate) async fn new(
        gpu: &Arc<Gpu>,
        _: [Arc<GpuGridTree>; 2],
        _: &Placement,
        _: &mut Progress<'_>,
    ) -> Result<Self> {
        match **gpu {}
    }

    pub(crate) fn compile_seconds(&self) -> f64 {
        match *self {}
    }

    pub(crate) fn levels(&self) -> usize {
        match *self {}
    }

    pub(crate) async fn descend(&mut self, _: usize, _: &mut Progress<'_>) -> Result<LevelBounds> {
        match *self {}
    }

    pub(crate) async fn farthest(&self, _: &mut Progress<'_>) -> Result<[usize; 2]> {
        match *self {}
    }
}
