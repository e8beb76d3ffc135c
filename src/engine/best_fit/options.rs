//! The options and the result of a best fit.

use super::zone::{Zone, ZoneOptions};
use crate::alignment::{Datum, Loss, MAX_OUTLIERS, PointPair, Robust};
use crate::engine::options::{at_least_zero, require_samples};
use crate::engine::query::{Query, impl_query};
use crate::error::{Error, Result};
use crate::iteration::SamplingRule;
use crate::model::RigidTransform;
use serde::{Deserialize, Serialize, Serializer};

/// The length of a step that ends a fit, as a fraction of the diagonal: the accuracy of the distances.
const DEFAULT_RELATIVE_TOLERANCE: f64 = 1e-9;

/// The number of samples along a direction unless the options name another.
const DEFAULT_SAMPLES: usize = 16;

/// The largest number of steps unless the options name another.
const DEFAULT_MAX_STEPS: usize = 100;

/// The poses from which a fit starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum FitStart {
    /// The pose of the options and those of a search over all rotations.
    #[default]
    Any,
    /// The pose of the options alone: the fit is the local one near it.
    Given,
    /// The pose of least residual among those in which A's principal axes lie on B's.
    Axes,
    /// The pose of the options, moved so that the middles of the boxes of both models' samples agree.
    Boxes,
}

/// The distance of a pose that a fit makes least.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum FitNorm {
    /// The root mean square of the distances of A's samples: least squares.
    #[default]
    Mean,
    /// The largest distance of A's points: Chebyshev's norm, the minimum zone of ISO 1101.
    Largest,
    /// The largest distance of A's points outside of B's body: how far A stands out. It is negative if all points lie within
    /// the body. A is a cloud, or a mesh, whose vertices are measured. B is closed.
    Outside,
    /// The largest distance of A's points within B's body. It is negative if all points lie outside: A has stock everywhere.
    /// A and B are as above.
    Inside,
    /// None: A stays in its first pose, and the fit only states the residual there.
    None,
}

/// Options of [`crate::Engine::best_fit`]; names in camelCase when deserialized.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct BestFitOptions {
    /// Samples along each direction of every surface of A, 2 to 1024. A mesh is sampled at its
    /// vertices, and each group in at least their square of triangles; a cloud at its points. Of
    /// more than 20,000 those at equal steps of the area are taken.
    pub samples: usize,
    /// The rule by which they are spread.
    pub sampling: SamplingRule,
    /// The poses from which the fit starts.
    pub start: FitStart,
    /// What the fit makes least.
    pub norm: FitNorm,
    /// Points of A with those of B on which they belong, none or at least three: the pose in which the
    /// sum of their squared distances is least takes the place of `start`.
    pub pairs: Vec<PointPair>,
    /// Datums of A on those of B in their order, which A keeps: they take the place of `start`, from the
    /// pose of `pairs` or else of `transform`, and the fit moves A only in the freedoms that they leave.
    pub datums: Vec<Datum>,
    /// The motions over which the least largest distance is bounded, if the norm is one of it.
    pub zone: ZoneOptions,
    /// The length, in model units, below which a step ends the fit, positive.
    pub tolerance: Option<f64>,
    /// The same as a fraction of the larger diagonal; 1e-9 if neither is given. Both at once are an
    /// error.
    pub relative_tolerance: Option<f64>,
    /// The largest number of steps of the last fit, at least 1.
    pub max_steps: usize,
    /// The share of A's samples, from 0 to 0.95, that lie on nothing of B and are left out.
    pub outliers: f64,
    /// The rule by which samples far from B lose their weight; `None` is `trimmed` with outliers, and
    /// `none` without.
    pub robust: Option<Robust>,
    /// The faces of A, by their indices, whose samples count in the last fit; all if none are named. A has surfaces.
    pub faces_of_a: Vec<usize>,
    /// The faces of B, by their indices: in the last fit the samples count whose closest points on B lie there; all if
    /// none are named. B has surfaces.
    pub faces_of_b: Vec<usize>,
    /// The distance from B, in model units, positive, beyond which a sample does not count in the last fit.
    pub max_distance: Option<f64>,
    /// Whether B is scaled to the unit of A where both state different ones; else they are an error.
    pub scale_units: bool,
    /// Where A is at first. It is not deserialized, because only [`RigidTransform::new`] makes one.
    #[serde(skip)]
    pub transform: RigidTransform,
}

impl Default for BestFitOptions {
    fn default() -> Self {
        Self {
            samples: DEFAULT_SAMPLES,
            sampling: SamplingRule::default(),
            start: FitStart::default(),
            norm: FitNorm::default(),
            pairs: Vec::new(),
            datums: Vec::new(),
            zone: ZoneOptions::default(),
            tolerance: None,
            relative_tolerance: None,
            max_steps: DEFAULT_MAX_STEPS,
            outliers: 0.0,
            robust: None,
            faces_of_a: Vec::new(),
            faces_of_b: Vec::new(),
            max_distance: None,
            scale_units: false,
            transform: RigidTransform::IDENTITY,
        }
    }
}

impl_query!(BestFitOptions, best_fit -> BestFit, [tolerance, relative_tolerance, scale_units, transform]);

impl BestFitOptions {
    /// # Errors
    /// [`Error::OptionOutOfRange`] naming the option; [`Error::OptionInvalid`] for samples far off that no rule leaves
    /// out, for a choice of samples in the largest distance, which is that of all points, and for a zone without that
    /// norm.
    fn require_own(&self) -> Result<()> {
        require_samples(self.samples)?;
        at_least_zero("outliers", self.outliers)?;
        if self.outliers > MAX_OUTLIERS {
            return Err(Error::out_of_range("outliers", self.outliers, "0 to 0.95"));
        }
        if let Some(most) = self.max_distance
            && !(most > 0.0 && most.is_finite())
        {
            return Err(Error::out_of_range("maxDistance", most, "positive"));
        }
        if self.leaves_out() && self.robust == Some(Robust::None) {
            return Err(invalid(
                "found outliers or a largest distance with robust none, expected a rule that leaves samples out",
            ));
        }
        let has_zone = matches!(self.norm, FitNorm::Largest | FitNorm::Outside | FitNorm::Inside);
        let is_of_some = self.loss().robust != Robust::None || self.selects();
        if has_zone && is_of_some {
            return Err(invalid(
                "found a norm of the largest distance with a choice of samples, expected all points to count",
            ));
        }
        self.zone.validate(has_zone && self.norm != FitNorm::Largest)?;
        if !has_zone && self.zone != ZoneOptions::default() {
            return Err(invalid(
                "found a limit or a box of motions, expected a norm of the largest distance, whose zone alone has them",
            ));
        }
        if self.max_steps == 0 {
            return Err(Error::out_of_range("maxSteps", 0, "at least 1"));
        }
        Ok(())
    }

    /// Returns the length of a step that ends a fit, for models of this diagonal.
    pub(super) fn last_step(&self, diagonal: f64) -> f64 {
        self.common().width(diagonal, DEFAULT_RELATIVE_TOLERANCE)
    }

    /// Returns whether the last fit is of some of the samples that poses are searched by.
    pub(super) fn selects(&self) -> bool {
        self.max_distance.is_some() || !self.faces_of_a.is_empty() || !self.faces_of_b.is_empty()
    }

    /// Returns the rule by which poses are searched.
    pub(super) fn loss(&self) -> Loss {
        Loss { robust: self.rule(self.outliers > 0.0), outliers: self.outliers, max_distance: None }
    }

    /// Returns the rule of the last fit.
    pub(super) fn last_loss(&self) -> Loss {
        let Self { outliers, max_distance, .. } = *self;
        Loss { robust: self.rule(self.leaves_out()), outliers, max_distance }
    }

    fn leaves_out(&self) -> bool {
        self.outliers > 0.0 || self.max_distance.is_some()
    }

    fn rule(&self, leaves_out: bool) -> Robust {
        self.robust.unwrap_or(if leaves_out { Robust::Trimmed } else { Robust::None })
    }
}

pub(super) fn invalid(found: &str) -> Error {
    Error::OptionInvalid { found: found.to_owned() }
}

/// A pose of A that fits B.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct FitPose {
    /// Moves A there.
    #[serde(serialize_with = "parts")]
    pub transform: RigidTransform,
    /// The root mean square of the samples' distances there: an estimate.
    pub rms: f64,
}

/// The samples that a fit left out.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct LeftOut {
    /// The distance beyond which a sample is left out; `None` where all count.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beyond: Option<f64>,
    /// Their points, x, y, z each, where A lies in its own file.
    pub points: Vec<f64>,
}

/// The pose of A that fits B best.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct BestFit {
    /// Moves A to its best fit.
    #[serde(serialize_with = "parts")]
    pub transform: RigidTransform,
    /// The root mean square there of the distances of A's samples to B, weighted by area, without
    /// those left out: an estimate.
    pub rms: f64,
    /// The largest distance of A's samples there, of those not left out: an estimate.
    pub largest: f64,
    /// The interval of the least largest distance, if that is the norm, on both sides or on one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub zone: Option<Zone>,
    /// Whether that interval is narrow: its width at most a hundredth of the upper bound. Else `zone.upper`
    /// is the zone that was found, and that none is less has not been shown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub zone_proven: Option<bool>,
    /// The number of freedoms, of six, that each datum took, in their order.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub taken: Vec<usize>,
    /// The root mean square where A was at first.
    pub rms_before: f64,
    /// The root mean square in a pose that nothing determines: the median of 48 rotations spread over all, A's
    /// centre beside B's by half of A's radius of gyration. With a largest distance the share of samples is left out there
    /// that the fit left out.
    pub rms_random: f64,
    /// The number of steps of the last fit.
    pub steps: usize,
    /// Whether the last fit ended by itself, and in a pose that a random one is not: see
    /// [`crate::Engine::best_fit`].
    pub converged: bool,
    /// The other poses found whose residual is at most twice the best one: those of symmetric parts.
    pub ambiguous: Vec<FitPose>,
    /// The number of independent motions that change no distance to first order: 1 of a part of
    /// revolution, 3 of a ball and of a plane.
    pub freedoms: usize,
    /// The number of poses that the fit started from.
    pub tried: usize,
    /// The number of samples of A, or of its faces that the options name.
    pub samples: usize,
    /// The number of those that count in the pose found: they are not left out, and are nearest to the faces of B that
    /// the options name.
    pub counted: usize,
    /// The samples that are left out as they are far from B.
    pub left_out: LeftOut,
}

/// Serializes a transform as its rotation, a unit quaternion x, y, z, w, and its translation.
fn parts<S: Serializer>(transform: &RigidTransform, serializer: S) -> std::result::Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct Parts {
        rotation: [f64; 4],
        translation: [f64; 3],
    }
    let (rotation, translation) = (transform.rotation().to_array(), transform.offset().to_array());
    Parts { rotation, translation }.serialize(serializer)
}
