//! The pose of one model that fits another best.

mod clear;
mod faces;
mod one_side;
mod options;
mod points;
mod start;
#[cfg(all(test, feature = "shapes", not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests;
mod zone;

use super::prepared::PreparedTarget;
use super::query::Opened;
use super::signs::{SignRule, SignSource, Signs};
use super::{Computation, Engine, PreparedModel};
use crate::alignment::{
    Candidate, FootField, LargestFit, LocalFit, Loss, Samples, Search, Step, distinct, random_residual,
};
use crate::error::{Error, Result};
use crate::model::RigidTransform;
use crate::progress::{Monitor, Progress};
use clear::{Kind, ToModel};
use one_side::{Counted, OneSide, OneSideField};
pub use options::{BestFit, BestFitOptions, FitNorm, FitPose, FitStart, LeftOut};
use start::Start;
use zone::{To, ZonePair};
pub use zone::{Zone, ZoneOptions};

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
    /// answer. All numbers but `zone` are estimates; [`Engine::distance`] says what a pose is worth.
    ///
    /// `pairs`, `datums` and the other starts make the first pose by hand; with [`FitNorm::None`] A stays there.
    /// With [`FitNorm::Largest`] the fit in the mean is followed by that in the largest distance, and `zone`
    /// is a certain interval: the least largest distance of all of A over a box of motions about the pose found. With
    /// [`FitNorm::Outside`] and [`FitNorm::Inside`] it is of the distances of a scan's points on one side.
    ///
    /// `converged` says that the last fit ended by itself, and that its residual is at most a tenth
    /// of that of random poses, or that all poses known come to it.
    /// O(samples log patches) a step.
    ///
    /// # Errors
    /// [`Error::OptionOutOfRange`]; [`Error::OptionInvalid`]; [`Error::UnitsDiffer`]; [`Error::NotClosed`] of a norm of
    /// one side without a body; [`Error::Cancelled`].
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
        let opened = Opened::new([a, b], options)?;
        let [a, b] = opened.models();
        let mut progress = Progress::new(monitor, false);
        progress.checkpoint(0.0).await?;
        let diagonal = opened.forward().diagonal();
        let held = b.facets().is_none().then(|| b.certified_target());
        let size = b.bounding_box().diagonal();
        let field = match (b.facets(), &held) {
            (Some(facets), _) => FootField::Facets { target: &facets.target, size },
            (None, Some(held)) => FootField::Patches { target: &held.target, gap: FIT_GAP * diagonal, size },
            (None, None) => return Err(Error::EmptyModel),
        };
        let samples = a.fit_samples(options.samples, options.sampling).thinned(MAX_SAMPLES);
        let pair = Pair {
            field,
            diagonal,
            held: held.as_deref(),
            a,
            compared: samples.thinned(COMPARED_SAMPLES),
            samples,
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
    held: Option<&'a PreparedTarget>,
    diagonal: f64,
    samples: Samples,
    /// The samples by which the residuals of poses are compared.
    compared: Samples,
    other: Samples,
    a: &'a PreparedModel,
    b: &'a PreparedModel,
    options: &'a BestFitOptions,
    loss: Loss,
}

/// The poses that a search found, the best first, with the number of starts.
struct Found {
    poses: Vec<Candidate>,
    tried: usize,
}

/// The last fit: its pose, whether it ended by itself, and its steps.
struct Last {
    steps: usize,
    ended: bool,
    zone: Option<Zone>,
}

impl<'a> Pair<'a> {
    async fn fit(&self, progress: &mut Progress<'_>) -> Result<BestFit> {
        let options = self.options;
        let search_field = self.field.up_to(SEARCH_GAP * self.diagonal);
        let rms_random = random_residual(search_field, (&self.samples, &self.other), self.loss)
            .ok_or(Error::EmptyModel)?;
        let start = Start::of(options, [self.a, self.b], [&self.samples, &self.other], |motion| {
            Ok(self.local(&self.compared, 0.0, motion)?.rms())
        })?;
        let found = match start.is_given {
            true => Found { poses: Vec::new(), tried: 1 },
            false => self.search(search_field, progress).await?,
        };
        let rms_before = self.local(&self.samples, 0.0, options.transform)?.rms();
        let mut fit = self.best_start(&found, &start)?;
        progress.section(SEARCH_SHARE, 1.0 - SEARCH_SHARE);
        let last = self.last(&mut fit, &found, &start, progress).await?;
        progress.finish();
        let rms = fit.rms();
        let (ambiguous, is_only) = self.ambiguous(&found, &fit, search_field)?;
        let scale = fit.scale();
        let is_fit = rms <= CONVERGED_SHARE * rms_random + EXACT * self.diagonal || is_only;
        let kept = fit.distances().iter().copied().filter(|distance| *distance <= scale);
        Ok(BestFit {
            transform: fit.motion,
            rms,
            largest: kept.fold(0.0, f64::max),
            zone: last.zone,
            zone_proven: last.zone.map(|zone| zone.is_proven(EXACT * self.diagonal)),
            taken: start.taken,
            rms_before,
            rms_random,
            steps: last.steps,
            converged: last.ended && is_fit,
            ambiguous,
            freedoms: fit.freedoms(),
            tried: found.tried,
            samples: self.samples.points.len(),
            left_out: self.left_out(fit.distances(), scale),
        })
    }

    /// Takes the steps of a fit in the mean; returns their number, and whether the fit ended by itself.
    async fn descend(
        &self,
        fit: &mut LocalFit<'_, FootField<'a>>,
        progress: &mut Progress<'_>,
    ) -> Result<(usize, bool)> {
        let most = self.options.max_steps;
        let (mut steps, mut ended) = (0, self.options.norm == FitNorm::None);
        while !ended && steps < most {
            if fit.advance() == Step::Converged {
                ended = true;
                break;
            }
            steps += 1;
            progress.step(steps, fit.rms());
            progress.checkpoint(steps as f64 / most as f64).await?;
        }
        Ok((steps, ended))
    }

    /// Takes the steps of the last fit, or of two where the norm is the largest distance.
    async fn last<'s>(
        &'s self,
        fit: &mut LocalFit<'s, FootField<'a>>,
        found: &Found,
        start: &Start,
        progress: &mut Progress<'_>,
    ) -> Result<Last> {
        let (mut steps, mut ended) = self.descend(fit, progress).await?;
        if let Some(best) = found.poses.first()
            && self.local(&self.compared, 0.0, fit.motion)?.rms() > self.as_good_as(best)
        {
            // From the first pose all samples came to another one than those that are compared.
            *fit = self.local(&self.samples, self.smallest(), best.motion)?;
            let (more, is_end) = self.descend(fit, progress).await?;
            (steps, ended) = (steps + more, is_end);
        }
        let (smallest, freedoms) = (self.smallest(), &start.freedoms);
        let largest = if let Some(counted) = Counted::of(self.options.norm) {
            let signs = SignSource::new(self.b, 0.0);
            let side = self.one_side(signs.rule(), counted)?;
            let field = OneSideField { foot: self.field, rule: side.rule, counted, size: side.to.size };
            let largest = LargestFit::new(field, &self.samples, freedoms, smallest, fit.motion)
                .ok_or(Error::EmptyModel)?;
            let points = self.a.fit_samples(self.options.samples, self.options.sampling).points;
            self.zone_pair(To::One(side, points)).fit(largest, freedoms, progress).await?
        } else if self.options.norm == FitNorm::Largest {
            let largest = LargestFit::new(self.field, &self.samples, freedoms, smallest, fit.motion)
                .ok_or(Error::EmptyModel)?;
            self.zone_pair(To::Both(self.to_model())).fit(largest, freedoms, progress).await?
        } else {
            return Ok(Last { steps, ended, zone: None });
        };
        *fit = LocalFit::new(self.field, fit.samples(), self.loss, smallest, largest.motion)
            .ok_or(Error::EmptyModel)?
            .within(&start.freedoms);
        Ok(Last { steps: steps + largest.steps, ended: ended && largest.ended, zone: Some(largest.zone) })
    }

    /// Returns B as what is measured on one side.
    fn one_side<'b>(&'b self, rule: SignRule<'b>, counted: Counted) -> Result<OneSide<'b>> {
        if self.a.facets().is_none() {
            let found =
                "found a norm of one side and surfaces of A, expected a scan, whose points are measured";
            return Err(Error::OptionInvalid { found: found.to_owned() });
        }
        if rule.signs() != Signs::Solid {
            return Err(Error::NotClosed { found: self.b.solid().free_edges.len() });
        }
        Ok(OneSide { to: self.to_model(), rule, counted })
    }

    fn to_model(&self) -> ToModel<'_> {
        let (kind, error) = match (self.b.facets(), self.held) {
            (None, Some(held)) => (Kind::Patches(&held.target), held.point_error(self.b)),
            (facets, _) => {
                let length = facets.map_or(0.0, |facets| facets.target.bounding_box().farthest_from_origin());
                (Kind::Facets(facets, length), facets.map_or(0.0, |facets| facets.error))
            }
        };
        let size = self.b.bounding_box().diagonal();
        ToModel { kind, error, gap: SEARCH_GAP * self.diagonal, size }
    }

    fn zone_pair<'b>(&'b self, to: To<'b>) -> ZonePair<'b> {
        ZonePair {
            a: self.a,
            b: self.b,
            to,
            diagonal: self.diagonal,
            options: &self.options.zone,
            max_steps: self.options.max_steps,
        }
    }

    /// Returns the other poses that fit nearly as well, and whether all that the search kept fit as well as this one.
    fn ambiguous(
        &self,
        found: &Found,
        fit: &LocalFit<'_, FootField<'_>>,
        field: FootField<'_>,
    ) -> Result<(Vec<FitPose>, bool)> {
        let rms = self.local_on(field, &self.compared, 0.0, fit.motion)?.rms();
        let best = Candidate { motion: fit.motion, rms };
        let most = AMBIGUOUS * best.rms + EXACT * self.diagonal;
        let near = |one: &Candidate| one.rms <= most;
        let is_equal = |one: &Candidate| one.rms <= self.as_good_as(&best);
        let is_only = !found.poses.is_empty() && found.poses.iter().all(is_equal);
        let others = found.poses.iter().copied().filter(near);
        let all = std::iter::once(Candidate { rms: -1.0, ..best }).chain(others).collect();
        let kept = self.compared.without_farthest(self.loss.outliers);
        let others = distinct(all, &kept, usize::MAX).into_iter().skip(1);
        let poses = others.map(|Candidate { motion, rms }| FitPose { transform: motion, rms });
        Ok((poses.collect(), is_only))
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

    fn smallest(&self) -> f64 {
        self.options.last_step(self.diagonal)
    }

    fn local<'s>(
        &self,
        samples: &'s Samples,
        smallest: f64,
        motion: RigidTransform,
    ) -> Result<LocalFit<'s, FootField<'a>>> {
        self.local_on(self.field, samples, smallest, motion)
    }

    /// The fit on a field near a pose.
    fn local_on<'s, 'f>(
        &self,
        field: FootField<'f>,
        samples: &'s Samples,
        smallest: f64,
        motion: RigidTransform,
    ) -> Result<LocalFit<'s, FootField<'f>>> {
        let loss = self.loss.of_some(samples.points.len(), self.samples.points.len());
        LocalFit::new(field, samples, loss, smallest, motion).ok_or(Error::EmptyModel)
    }

    /// Returns the fit that the steps continue: that from the first pose unless a pose that was found is better by
    /// more than rounding.
    fn best_start(&self, found: &Found, start: &Start) -> Result<LocalFit<'_, FootField<'a>>> {
        let smallest = self.smallest();
        let given = || Ok(self.local(&self.samples, smallest, start.motion)?.within(&start.freedoms));
        let Some(best) = found.poses.first() else { return given() };
        let mut near = self.local(&self.compared, smallest, start.motion)?;
        near.run(NEAR_STEPS);
        if near.rms() <= self.as_good_as(best) {
            return given();
        }
        self.local(&self.samples, smallest, best.motion)
    }

    /// Returns the residual up to which a pose counts as equal to one that was found.
    fn as_good_as(&self, best: &Candidate) -> f64 {
        (1.0 + NEARLY_EQUAL) * best.rms + EXACT * self.diagonal
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
