//! The poses that a fit starts from, and those that fit as well.

use super::selection::Selection;
use super::start::Start;
use super::{EXACT, FitPose, Pair, SEARCH_GAP, SEARCH_SHARE};
use crate::alignment::{
    Candidate, FootField, LocalFit, Loss, MAX_OUTLIERS, Robust, Samples, Search, distinct, near_symmetries,
};
use crate::error::{Error, Result};
use crate::model::RigidTransform;
use crate::progress::Progress;
use crate::sorting::sort_by_number;
use crate::threads::MaybeSync;
use crate::threads::parallel::map;
use glam::DVec3;

/// The factor of the best residual up to which another pose counts as a fit too.
const AMBIGUOUS: f64 = 2.0;

/// Steps from the given pose before it is compared with others.
const NEAR_STEPS: usize = 30;

/// Steps of the poses found with the samples that count, where these are not those of the search.
const CHOSEN_STEPS: usize = 12;

/// The part by which another pose has to be better than the fit near the given one.
const NEARLY_EQUAL: f64 = 0.02;

/// The distance above which a sample is far from B, as a multiple of the residual. Normal noise
/// puts no sample of 20,000 there.
const FAR: f64 = 6.0;

/// The largest number of far samples that decide between near symmetries.
const MOST_FAR: usize = 64;

/// The largest number of near symmetries that take steps: a ring of 36 bores has 36 on each side.
const MOST_TRIED: usize = 72;

/// The number of these steps.
const NEAR_SYMMETRY_STEPS: usize = 4;

/// The largest number of near symmetries that are fitted.
const MOST_FITTED: usize = 4;

/// The poses that a search found, the best first, with the number of starts.
pub(super) struct Found {
    pub(super) poses: Vec<Candidate>,
    pub(super) tried: usize,
}

impl<'a> Pair<'a> {
    /// Searches poses from the given one and from all rotations, by all samples; where the options choose some, the best
    /// poses take further steps with these.
    pub(super) async fn search(&self, progress: &mut Progress<'_>) -> Result<Found> {
        progress.section(0.0, SEARCH_SHARE);
        let field = self.whole.up_to(SEARCH_GAP * self.diagonal);
        let given = [self.options.transform];
        let samples = (&self.all, &self.other);
        let loss = self.options.loss();
        let mut search =
            Search::new(field, self.b.bounding_box(), samples, &given, loss).ok_or(Error::EmptyModel)?;
        while !search.advance() {
            progress.checkpoint(search.done()).await?;
        }
        progress.checkpoint(search.done()).await?;
        let (poses, tried) = (search.best(), search.tried());
        if !self.options.selects() {
            return Ok(Found { poses: self.ranked(poses, progress).await?, tried });
        }
        let mut of_chosen = Vec::with_capacity(poses.len());
        for pose in &poses {
            let mut fit = self.local(&self.chosen.compared, 0.0, pose.motion)?;
            fit.run(CHOSEN_STEPS);
            of_chosen.push(Candidate { motion: fit.motion, rms: fit.residual() });
            progress.checkpoint(1.0).await?;
        }
        Ok(Found { poses: distinct(of_chosen, &self.chosen.compared, poses.len()), tried })
    }

    /// Ranks poses with nearly equal residuals by the residual of all samples, and adds the fits from near symmetries.
    ///
    /// The search compares poses by 2,000 samples. A feature that breaks a symmetry may have few of them. If samples are far
    /// from B in the best pose, they decide between the candidates of [`near_symmetries`].
    async fn ranked(&self, poses: Vec<Candidate>, progress: &mut Progress<'_>) -> Result<Vec<Candidate>> {
        let Some(best) = poses.first() else { return Ok(poses) };
        let exact = EXACT * self.diagonal;
        let most = AMBIGUOUS * best.rms + exact;
        let count = poses.len();
        let (alike, others): (Vec<_>, Vec<_>) = poses.into_iter().partition(|one| one.rms <= most);
        let field = self.whole.up_to(SEARCH_GAP * self.diagonal);
        let (all, compared, loss) = (&self.all, &self.chosen.compared, self.options.loss());
        let fit = |samples, motion| self.local_by(loss, field, samples, 0.0, motion);
        let by_all = |motion| Ok(Candidate { motion, rms: fit(all, motion)?.rms() });
        let mut known = measured(&motions(&alike), by_all)?;
        progress.checkpoint(1.0).await?;
        sort_by_number(&mut known, |one| one.rms);
        let far = match known.first() {
            Some(best) if loss.outliers == 0.0 && best.rms > exact => far_samples(&fit(all, best.motion)?),
            _ => Vec::new(),
        };
        if !far.is_empty() {
            let few = with_points(&compared.thinned(far.len()), &far);
            let many = with_points(compared, &far);
            let by_few = |motion| Ok(Candidate { motion, rms: fit(&few, motion)?.rms() });
            let after_steps = |motion, steps| {
                let mut near = fit(&many, motion)?;
                near.run(steps);
                Ok(Candidate { motion: near.motion, rms: near.rms() })
            };
            let tried = measured(&near_symmetries(&known, all), by_few)?;
            let tried = distinct(tried, compared, MOST_TRIED);
            progress.checkpoint(1.0).await?;
            // The far samples lie on B in several poses. Steps with more samples distinguish these.
            let mut fitted = measured(&motions(&tried), |motion| after_steps(motion, NEAR_SYMMETRY_STEPS))?;
            progress.checkpoint(1.0).await?;
            sort_by_number(&mut fitted, |one| one.rms);
            fitted.truncate(MOST_FITTED);
            known.extend(measured(&motions(&fitted), |motion| {
                by_all(after_steps(motion, CHOSEN_STEPS)?.motion)
            })?);
        }
        known.extend(others);
        Ok(distinct(known, compared, count))
    }

    /// Returns the fit that the steps continue: that from the first pose unless a pose that was found is better by
    /// more than rounding.
    pub(super) fn best_start(&self, found: &Found, start: &Start) -> Result<LocalFit<'_, FootField<'a>>> {
        let smallest = self.smallest();
        let Selection { samples, compared, .. } = self.chosen;
        let given = || Ok(self.local(samples, smallest, start.motion)?.within(&start.freedoms));
        let Some(best) = found.poses.first() else { return given() };
        let mut near = self.local(compared, smallest, start.motion)?;
        near.run(NEAR_STEPS);
        if self.local(samples, smallest, near.motion)?.residual() <= self.as_good_as(best) {
            return given();
        }
        self.local(samples, smallest, best.motion)
    }

    /// Returns the residual up to which a pose counts as equal to one that was found.
    pub(super) fn as_good_as(&self, best: &Candidate) -> f64 {
        (1.0 + NEARLY_EQUAL) * best.rms + EXACT * self.diagonal
    }

    /// Returns the rule by which the residuals of other poses are comparable with that of a fit: where that left out what
    /// is beyond a largest distance, they leave out the same share.
    pub(super) fn comparable(&self, fit: &LocalFit<'_, FootField<'_>>) -> Loss {
        let loss = self.chosen.loss;
        if loss.max_distance.is_none() {
            return loss;
        }
        let scale = fit.scale();
        let all: f64 = fit.counted().map(|one| one.weight).sum();
        let beyond: f64 = fit.counted().filter(|one| one.distance > scale).map(|one| one.weight).sum();
        Loss { robust: Robust::Trimmed, outliers: (beyond / all).min(MAX_OUTLIERS), max_distance: None }
    }

    /// Returns the other poses that fit nearly as well, and whether all that the search kept fit as well as this one.
    pub(super) fn ambiguous(
        &self,
        found: &Found,
        fit: &LocalFit<'_, FootField<'_>>,
        loss: Loss,
    ) -> Result<(Vec<FitPose>, bool)> {
        let Selection { samples, compared, .. } = self.chosen;
        // The samples by which the poses are ranked.
        let ranking = if self.options.selects() { compared } else { samples };
        let field = self.field.up_to(SEARCH_GAP * self.diagonal);
        let of = |motion: RigidTransform| {
            let fit = self.local_by(loss, field, ranking, 0.0, motion)?;
            Ok(Candidate { motion, rms: fit.rms() })
        };
        let best = of(fit.motion)?;
        let poses = match self.options.max_distance {
            Some(_) => found.poses.iter().map(|one| of(one.motion)).collect::<Result<Vec<_>>>()?,
            None => found.poses.clone(),
        };
        let most = AMBIGUOUS * best.rms + EXACT * self.diagonal;
        let is_equal = |one: &Candidate| one.rms <= self.as_good_as(&best);
        let is_only = !poses.is_empty() && poses.iter().all(is_equal);
        let others = poses.into_iter().filter(|one| one.rms <= most);
        let all = std::iter::once(Candidate { rms: -1.0, ..best }).chain(others).collect();
        let kept = compared.without_farthest(loss.outliers);
        let others = distinct(all, &kept, usize::MAX).into_iter().skip(1);
        let poses = others.map(|Candidate { motion, rms }| FitPose { transform: motion, rms });
        Ok((poses.collect(), is_only))
    }
}

/// Returns the farthest samples of a fit among those whose distance is large compared with the residual.
fn far_samples(fit: &LocalFit<'_, FootField<'_>>) -> Vec<DVec3> {
    let least = FAR * fit.rms();
    let mut far: Vec<_> = fit.counted().filter(|one| one.distance > least).collect();
    sort_by_number(&mut far, |one| -one.distance);
    far.into_iter().take(MOST_FAR).map(|one| one.point).collect()
}

fn motions(candidates: &[Candidate]) -> Vec<RigidTransform> {
    candidates.iter().map(|one| one.motion).collect()
}

/// Applies a function to motions, on all cores.
fn measured(
    motions: &[RigidTransform],
    measure: impl Fn(RigidTransform) -> Result<Candidate> + MaybeSync,
) -> Result<Vec<Candidate>> {
    map(motions.len(), |index| measure(motions[index])).into_iter().collect()
}

/// Returns samples together with further points, each with the mean weight of the samples.
fn with_points(samples: &Samples, more: &[DVec3]) -> Samples {
    let weight = 1.0 / samples.points.len().max(1) as f64;
    let points = samples.points.iter().chain(more).copied().collect();
    let weights = samples.weights.iter().copied().chain(more.iter().map(|_| weight)).collect();
    Samples::new(points, weights)
}
