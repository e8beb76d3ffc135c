//! The first pose of a fit, by hand or not.

use super::faces::resolved;
use super::options::{BestFitOptions, FitNorm, FitStart};
use crate::alignment::{Freedoms, Samples, by_datums, principal_poses};
use crate::engine::PreparedModel;
use crate::error::{Error, Result};
use crate::model::RigidTransform;
use glam::DVec3;

/// Where a fit starts, and in which freedoms it moves A.
pub(super) struct Start {
    pub(super) motion: RigidTransform,
    pub(super) freedoms: Freedoms,
    /// The number of freedoms that each datum took.
    pub(super) taken: Vec<usize>,
    /// Whether no other pose is searched.
    pub(super) is_given: bool,
}

impl Start {
    /// Makes the first pose of the options; `residual` is that of a pose.
    ///
    /// # Errors
    /// Those of [`RigidTransform::from_point_pairs`] and [`RigidTransform::from_datums`], and of `residual`.
    pub(super) fn of(
        options: &BestFitOptions,
        models: [&PreparedModel; 2],
        [samples, other]: [&Samples; 2],
        residual: impl Fn(RigidTransform) -> Result<f64>,
    ) -> Result<Self> {
        let given = options.transform;
        let motion = match options.start {
            _ if !options.pairs.is_empty() => RigidTransform::from_point_pairs(&options.pairs)?,
            FitStart::Axes => {
                let mut best = (f64::INFINITY, given);
                for motion in principal_poses(samples, other) {
                    let found = residual(motion)?;
                    if found < best.0 {
                        best = (found, motion);
                    }
                }
                best.1
            }
            FitStart::Boxes => {
                let from = samples.middle(&given).ok_or(Error::EmptyModel)?;
                let to = other.middle(&RigidTransform::IDENTITY).ok_or(Error::EmptyModel)?;
                given.followed(DVec3::ZERO, DVec3::ZERO, to - from)
            }
            FitStart::Any | FitStart::Given => given,
        };
        let is_by_hand = !options.pairs.is_empty() || !options.datums.is_empty();
        let is_given = is_by_hand || options.start != FitStart::Any || options.norm == FitNorm::None;
        if options.datums.is_empty() {
            return Ok(Self { motion, freedoms: Freedoms::all(), taken: Vec::new(), is_given });
        }
        let (fit, freedoms) = by_datums(&resolved(&options.datums, models, &motion)?, &motion)?;
        Ok(Self { motion: fit.transform, freedoms, taken: fit.taken, is_given })
    }
}
