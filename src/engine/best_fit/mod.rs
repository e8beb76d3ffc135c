//! The pose of one model that fits another best.

mod options;
mod points;
#[cfg(all(test, feature = "shapes", not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests;

use super::direction::Direction;
use super::{Computation, Engine, PreparedModel};
use crate::alignment::{
    Candidate, FootField, LocalFit, Loss, Samples, Search, Step, distinct, random_residual,
};
use crate::error::{Error, Result};
use crate::model::RigidTransform;
use crate::progress::{Monitor, Progress};
use options::DEFAULT_RELATIVE_TOLERANCE;
pub use options::{BestFit, BestFitOptions, FitPose, FitStart, LeftOut};

/// The largest number of samples of a fit: more change the pose by less than the accuracy of a scan.
const MAX_SAMPLES: usize = 20_000;

/// The number of samples that other poses are compared by.
const COMPARED_SAMPLES: usize = 2000;

/// The excess of the distances while poses are searched, relative to the diagonal.
const SEARCH_GAP: f64 = 1e-6;

/// The excess of the distances of the last fit, relative to the diagonal.
const FIT_GAP: f64 = 1e-9;

/// The part of the residual of random poses that a fit may have. Right poses of the parts of
/// `benches/alignment.rs`, with noise of a thousandth of the diagonal, have at most 0.02 of it.
const CONVERGED_SHARE: f64 = 0.1;

/// The factor of the best residual up to which another pose counts as a fit too.
const AMBIGUOUS: f64 = 2.0;

/// The least residual that poses are told apart by, relative to the diagonal: below it is rounding.
const EXACT: f64 = 1e-6;

/// The share of the progress that the search over starts takes; the last fit takes the rest.
const SEARCH_SHARE: f64 = 0.6;

/// Steps from the given pose before it is compared with others.
const NEAR_STEPS: usize = 30;

/// The part by which another pose has to be better than the fit near the given one.
const NEARLY_EQUAL: f64 = 0.02;

impl Engine {
    /// Fits A to B in the mean: finds the rigid motion of A for which the root mean square of the
    /// distances of A's samples to B is least.
    ///
    /// From [`FitStart::Any`] the best of some 600 starts is fitted, twice as many where A is a part
    /// of B; of equal fits the one nearest to the options' transform. The same input gives the same
    /// answer. All numbers are estimates; [`Engine::distance`] says what a pose is worth.
    ///
    /// `converged` says that the last fit ended by itself, and that its residual is at most a tenth
    /// of that of random poses, or that all poses known come to it.
    /// O(samples log patches) a step.
    ///
    /// # Errors
    /// [`Error::OptionOutOfRange`]; [`Error::OptionInvalid`]; [`Error::UnitsDiffer`];
    /// [`Error::Cancelled`].
    pub fn best_fit<'a>(
        &'a self,
        a: &'a PreparedModel,
        b: &'a PreparedModel,
        options: &'a BestFitOptions,
    ) -> Computation<'a, BestFit> {
        Computation::new(move |mut watched| {
            Box::pin(async move { Self::best_fit_of(a, b, options, watched.monitor()).await })
        })
    }

    pub(super) async fn best_fit_of(
        a: &PreparedModel,
        b: &PreparedModel,
        options: &BestFitOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<BestFit> {
        options.validate()?;
        let scaled = b.in_unit_of(a, options.scale_units)?;
        let b = scaled.as_deref().unwrap_or(b);
        let mut progress = Progress::new(monitor, false);
        progress.checkpoint(0.0).await?;
        let diagonal = Direction { from: a, to: b, transform: options.transform }.diagonal();
        let held = b.facets().is_none().then(|| b.certified_target());
        let size = b.bounding_box().diagonal();
        let field = match (b.facets(), &held) {
            (Some(facets), _) => FootField::Facets { target: &facets.target, size },
            (None, Some(held)) => FootField::Patches { target: &held.target, gap: FIT_GAP * diagonal, size },
            (None, None) => return Err(Error::EmptyModel),
        };
        let pair = Pair {
            field,
            diagonal,
            samples: a.fit_samples(options.samples, options.sampling).thinned(MAX_SAMPLES),
            other: b.fit_samples(options.samples, options.sampling),
            b,
            options,
            loss: options.loss(),
        };
        pair.fit(&mut progress).await
    }
}

/// The samples of A and the model that they are laid on.
struct Pair<'a> {
    field: FootField<'a>,
    diagonal: f64,
    samples: Samples,
    other: Samples,
    b: &'a PreparedModel,
    options: &'a BestFitOptions,
    loss: Loss,
}

/// The poses that a search found, the best first, with the number of starts.
struct Found {
    poses: Vec<Candidate>,
    tried: usize,
}

impl Pair<'_> {
    async fn fit(&self, progress: &mut Progress<'_>) -> Result<BestFit> {
        let options = self.options;
        let search_field = self.field.up_to(SEARCH_GAP * self.diagonal);
        let rms_random = random_residual(search_field, (&self.samples, &self.other), self.loss)
            .ok_or(Error::EmptyModel)?;
        let found = match options.start {
            FitStart::Given => Found { poses: Vec::new(), tried: 1 },
            FitStart::Any => self.search(search_field, progress).await?,
        };
        let (mut fit, rms_before) = self.best_start(&found)?;
        progress.section(SEARCH_SHARE, 1.0 - SEARCH_SHARE);
        let (mut steps, mut ended) = (0, false);
        while steps < options.max_steps {
            if fit.advance() == Step::Converged {
                ended = true;
                break;
            }
            steps += 1;
            progress.step(steps, fit.rms());
            progress.checkpoint(steps as f64 / options.max_steps as f64).await?;
        }
        progress.finish();
        let rms = fit.rms();
        let compared = self.samples.thinned(COMPARED_SAMPLES);
        let best =
            LocalFit::new(search_field, &compared, self.loss, 0.0, fit.motion).ok_or(Error::EmptyModel)?;
        let best = Candidate { motion: fit.motion, rms: best.rms() };
        let most = AMBIGUOUS * best.rms + EXACT * self.diagonal;
        let near = |one: &Candidate| one.rms <= most;
        let of_one_basin = !found.poses.is_empty() && found.poses.iter().all(near);
        let others = found.poses.iter().copied().filter(near);
        let others = distinct(
            std::iter::once(Candidate { rms: -1.0, ..best }).chain(others).collect(),
            &compared,
            usize::MAX,
        );
        let ambiguous =
            others.into_iter().skip(1).map(|Candidate { motion, rms }| FitPose { transform: motion, rms });
        let scale = fit.scale();
        let is_fit = rms <= CONVERGED_SHARE * rms_random + EXACT * self.diagonal || of_one_basin;
        Ok(BestFit {
            transform: fit.motion,
            rms,
            rms_before,
            rms_random,
            steps,
            converged: ended && is_fit,
            ambiguous: ambiguous.collect(),
            freedoms: fit.freedoms(),
            tried: found.tried,
            samples: self.samples.points.len(),
            left_out: self.left_out(fit.distances(), scale),
        })
    }

    /// Searches poses from the given one and from all rotations.
    async fn search(&self, field: FootField<'_>, progress: &mut Progress<'_>) -> Result<Found> {
        progress.section(0.0, SEARCH_SHARE);
        let given = [self.options.transform];
        let samples = (&self.samples, &self.other);
        let mut search =
            Search::new(field, self.b.bounding_box(), samples, &given, self.loss).ok_or(Error::EmptyModel)?;
        while !search.advance() {
            progress.checkpoint(search.done()).await?;
        }
        progress.checkpoint(search.done()).await?;
        Ok(Found { poses: search.best(), tried: search.tried() })
    }

    /// Returns the fit that the steps continue, with the residual at the given pose: that from the
    /// given pose unless a pose that was found is better by more than rounding.
    fn best_start(&self, found: &Found) -> Result<(LocalFit<'_, FootField<'_>>, f64)> {
        let smallest = self.options.permitted_width().in_units(self.diagonal, DEFAULT_RELATIVE_TOLERANCE);
        let start = |motion: RigidTransform| {
            LocalFit::new(self.field, &self.samples, self.loss, smallest, motion).ok_or(Error::EmptyModel)
        };
        let given = start(self.options.transform)?;
        let before = given.rms();
        let Some(best) = found.poses.first() else { return Ok((given, before)) };
        let compared = self.samples.thinned(COMPARED_SAMPLES);
        let mut near = LocalFit::new(self.field, &compared, self.loss, smallest, self.options.transform)
            .ok_or(Error::EmptyModel)?;
        near.run(NEAR_STEPS);
        if near.rms() <= (1.0 + NEARLY_EQUAL) * best.rms + EXACT * self.diagonal {
            return Ok((given, before));
        }
        Ok((start(best.motion)?, before))
    }

    fn left_out(&self, distances: &[f64], scale: f64) -> LeftOut {
        let points = self.samples.points.iter().zip(distances);
        let beyond = points.filter(|(_, distance)| !(**distance <= scale));
        LeftOut {
            beyond: scale.is_finite().then_some(scale),
            points: beyond.flat_map(|(point, _)| point.to_array()).collect(),
        }
    }
}
