//! The pose of one model that fits another best.

mod clear;
mod faces;
mod one_side;
mod options;
mod points;
mod poses;
mod selection;
mod start;
#[cfg(all(test, feature = "shapes", not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests;
mod zone;

use super::prepared::PreparedTarget;
use super::query::Opened;
use super::signs::{SignRule, SignSource, Signs};
use super::{Computation, Engine, PreparedModel};
use crate::alignment::{FootField, LargestFit, LocalFit, Loss, Samples, Step, random_residual};
use crate::error::{Error, Result};
use crate::model::RigidTransform;
use crate::progress::{Monitor, Progress};
use clear::{Kind, ToModel};
use one_side::{Counted, OneSide, OneSideField};
use options::invalid;
pub use options::{BestFit, BestFitOptions, FitNorm, FitPose, FitStart, LeftOut};
use poses::Found;
use selection::Selection;
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

/// The least residual that poses are told apart by, relative to the diagonal: below it is rounding.
const EXACT: f64 = 1e-6;

/// The share of the progress that the search over starts takes; the last fit takes the rest.
const SEARCH_SHARE: f64 = 0.6;

impl Engine {
    /// Fits A to B in the mean: finds the rigid motion of A for which the root mean square of the
    /// distances of A's samples to B is least.
    ///
    /// From [`FitStart::Any`] the best of some 600 starts is fitted, twice as many where A is a part
    /// of B; of equal fits the one nearest to the options' transform. The same input gives the same
    /// answer. All numbers but `zone` are estimates; [`Engine::distance`] says what a pose is worth.
    ///
    /// With `faces_of_a`, `faces_of_b` and `max_distance` poses are searched by all samples; the best of them are compared,
    /// and the last fit is made, by those chosen.
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
            (None, Some(held)) => {
                FootField::Patches { target: &held.target, gap: FIT_GAP * diagonal, size, counted: None }
            }
            (None, None) => return Err(Error::EmptyModel),
        };
        let all = a.fit_samples(options.samples, options.sampling).thinned(MAX_SAMPLES);
        let chosen = Selection::of(options, [a, b], held.as_deref(), &all)?;
        let pair = Pair {
            whole: field,
            field: chosen.patches.as_deref().map_or(field, |patches| field.on_patches(patches)),
            diagonal,
            held: held.as_deref(),
            a,
            all,
            other: b.fit_samples(options.samples, options.sampling),
            b,
            options,
            chosen: &chosen,
        };
        pair.fit(&mut progress).await
    }
}

/// The samples of A and the model that they are laid on.
struct Pair<'a> {
    /// B, as poses are searched on it.
    whole: FootField<'a>,
    /// B, where only the samples count that are nearest to the chosen faces.
    field: FootField<'a>,
    held: Option<&'a PreparedTarget>,
    diagonal: f64,
    /// The samples by which poses are searched.
    all: Samples,
    other: Samples,
    a: &'a PreparedModel,
    b: &'a PreparedModel,
    options: &'a BestFitOptions,
    chosen: &'a Selection,
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
        let start = Start::of(options, [self.a, self.b], [&self.all, &self.other], |motion| {
            Ok(self.local(&self.chosen.compared, 0.0, motion)?.residual())
        })?;
        let found = match start.is_given {
            true => Found { poses: Vec::new(), tried: 1 },
            false => self.search(progress).await?,
        };
        let rms_before = self.local(&self.chosen.samples, 0.0, options.transform)?.rms();
        let mut fit = self.best_start(&found, &start)?;
        progress.section(SEARCH_SHARE, 1.0 - SEARCH_SHARE);
        let last = self.last(&mut fit, &found, &start, progress).await?;
        progress.finish();
        let (rms, scale) = (fit.rms(), fit.scale());
        if rms.is_infinite() {
            return Err(invalid(
                "found no sample of A that is nearest to the faces of B named, expected some",
            ));
        }
        let loss = self.comparable(&fit);
        let (ambiguous, is_only) = self.ambiguous(&found, &fit, loss)?;
        let search_field = self.whole.up_to(SEARCH_GAP * self.diagonal);
        let rms_random =
            random_residual(search_field, (&self.all, &self.other), loss).ok_or(Error::EmptyModel)?;
        let is_fit = rms <= CONVERGED_SHARE * rms_random + EXACT * self.diagonal || is_only;
        let (kept, beyond): (Vec<_>, Vec<_>) = fit.counted().partition(|one| one.distance <= scale);
        Ok(BestFit {
            transform: fit.motion,
            rms,
            largest: kept.iter().map(|one| one.distance).fold(0.0, f64::max),
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
            samples: fit.samples().points.len(),
            counted: kept.len(),
            left_out: LeftOut {
                beyond: scale.is_finite().then_some(scale),
                points: beyond.iter().flat_map(|one| one.point.to_array()).collect(),
            },
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
            && self.local(&self.chosen.compared, 0.0, fit.motion)?.residual() > self.as_good_as(best)
        {
            // From the first pose all samples came to another one than those that are compared.
            *fit = self.local(&self.chosen.samples, self.smallest(), best.motion)?;
            let (more, is_end) = self.descend(fit, progress).await?;
            (steps, ended) = (steps + more, is_end);
        }
        let (smallest, freedoms) = (self.smallest(), &start.freedoms);
        let largest = if let Some(counted) = Counted::of(self.options.norm) {
            let signs = SignSource::new(self.b, 0.0);
            let side = self.one_side(signs.rule(), counted)?;
            let farthest = fit.counted().map(|one| one.distance).fold(0.0, f64::max);
            let reach = self.options.zone.reach(fit.motion, farthest, self.diagonal);
            let field = OneSideField { foot: self.field, rule: side.rule, counted, size: side.to.size };
            let largest = LargestFit::new(field, &self.chosen.samples, freedoms, smallest, fit.motion)
                .ok_or(Error::EmptyModel)?
                .within(reach);
            let points = self.a.fit_samples(self.options.samples, self.options.sampling).points;
            self.zone_pair(To::One(side, points)).fit(largest, freedoms, progress).await?
        } else if self.options.norm == FitNorm::Largest {
            let largest = LargestFit::new(self.field, &self.chosen.samples, freedoms, smallest, fit.motion)
                .ok_or(Error::EmptyModel)?;
            self.zone_pair(To::Both(self.to_model())).fit(largest, freedoms, progress).await?
        } else {
            return Ok(Last { steps, ended, zone: None });
        };
        *fit = LocalFit::new(self.field, fit.samples(), self.chosen.loss, smallest, largest.motion)
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

    fn smallest(&self) -> f64 {
        self.options.last_step(self.diagonal)
    }

    /// The fit near a pose.
    fn local<'s>(
        &self,
        samples: &'s Samples,
        smallest: f64,
        motion: RigidTransform,
    ) -> Result<LocalFit<'s, FootField<'a>>> {
        self.local_by(self.chosen.loss, self.field, samples, smallest, motion)
    }

    /// The same by another rule and on another field.
    fn local_by<'s>(
        &self,
        loss: Loss,
        field: FootField<'a>,
        samples: &'s Samples,
        smallest: f64,
        motion: RigidTransform,
    ) -> Result<LocalFit<'s, FootField<'a>>> {
        let loss = loss.of_some(samples.points.len(), self.chosen.samples.points.len());
        LocalFit::new(field, samples, loss, smallest, motion).ok_or(Error::EmptyModel)
    }
}
