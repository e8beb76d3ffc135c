//! The poses that a fit starts from, and those that fit as well.

use super::selection::Selection;
use super::start::Start;
use super::{EXACT, FitPose, Pair, SEARCH_GAP, SEARCH_SHARE};
use crate::alignment::{Candidate, FootField, LocalFit, Loss, MAX_OUTLIERS, Robust, Search, distinct};
use crate::error::{Error, Result};
use crate::model::RigidTransform;
use crate::progress::Progress;

/// The factor of the best residual up to which another pose counts as a fit too.
const AMBIGUOUS: f64 = 2.0;

/// Steps from the given pose before it is compared with others.
const NEAR_STEPS: usize = 30;

/// Steps of the poses found with the samples that count, where these are not those of the search.
const CHOSEN_STEPS: usize = 12;

/// The part by which another pose has to be better than the fit near the given one.
const NEARLY_EQUAL: f64 = 0.02;

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
            return Ok(Found { poses, tried });
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

    /// Returns the fit that the steps continue: that from the first pose unless a pose that was found is better by
    /// more than rounding.
    pub(super) fn best_start(&self, found: &Found, start: &Start) -> Result<LocalFit<'_, FootField<'a>>> {
        let smallest = self.smallest();
        let Selection { samples, compared, .. } = self.chosen;
        let given = || Ok(self.local(samples, smallest, start.motion)?.within(&start.freedoms));
        let Some(best) = found.poses.first() else { return given() };
        let mut near = self.local(compared, smallest, start.motion)?;
        near.run(NEAR_STEPS);
        if near.residual() <= self.as_good_as(best) {
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
        let compared = &self.chosen.compared;
        let field = self.field.up_to(SEARCH_GAP * self.diagonal);
        let of = |motion: RigidTransform| {
            let fit = self.local_by(loss, field, compared, 0.0, motion)?;
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
