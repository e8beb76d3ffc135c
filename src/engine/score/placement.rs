//! The candidate laid on the truth.

use super::{ScoreAlignment, ScoreOptions};
use crate::engine::section::Section;
use crate::engine::{BestFit, BestFitOptions, Engine, PreparedModel};
use crate::error::Result;
use crate::interval::Interval;
use crate::model::RigidTransform;
use crate::progress::Monitor;
use glam::DVec3;
use serde::{Serialize, Serializer};

/// The map of the candidate: its coordinates times the scale, then a motion. The numbers of a score are those
/// of the candidate so mapped, whatever the map is worth.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct Placement {
    /// The rule by which it was found.
    pub align: ScoreAlignment,
    /// The factor of all coordinates; 1 unless the rule is `box`.
    pub scale: f64,
    /// The motion that follows.
    #[serde(flatten, serialize_with = "parts")]
    pub transform: RigidTransform,
    /// The best fit with the other poses that fit as well, if that is the rule. Its numbers are estimates.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fit: Option<BestFit>,
}

/// The candidate where it is measured.
pub(super) struct Placed {
    pub(super) placement: Placement,
    /// The candidate scaled, if it is.
    pub(super) scaled: Option<PreparedModel>,
}

impl Engine {
    /// Lays the candidate on the truth.
    pub(super) async fn placed(
        candidate: &PreparedModel,
        truth: &PreparedModel,
        options: &ScoreOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Placed> {
        let align = options.align;
        let rigid = |transform, fit| Placed {
            placement: Placement { align, scale: 1.0, transform, fit },
            scaled: None,
        };
        match align {
            ScoreAlignment::None => Ok(rigid(options.transform, None)),
            ScoreAlignment::BestFit => {
                let fit_options =
                    BestFitOptions { transform: options.transform, ..BestFitOptions::default() };
                let mut section = Section { whole: monitor, part: [0.0, super::search::FIT_PART] };
                let fit = Self::best_fit_of(candidate, truth, &fit_options, &mut section).await?;
                Ok(rigid(fit.transform, Some(fit)))
            }
            ScoreAlignment::Box => boxed(candidate, truth),
        }
    }
}

/// Scales and shifts the candidate so that the middles and the longest sides of both boxes agree; one without
/// a size is shifted only.
fn boxed(candidate: &PreparedModel, truth: &PreparedModel) -> Result<Placed> {
    let [(from, own), (to, other)] = [candidate, truth].map(|model| {
        let facts = model.facts();
        let middle = |axis: usize| 0.5 * (facts.min[axis].middle() + facts.max[axis].middle());
        let longest = facts.extents.iter().map(Interval::middle).fold(0.0, f64::max);
        (DVec3::new(middle(0), middle(1), middle(2)), longest)
    });
    let factor = other / own;
    let scale = if factor.is_normal() { factor } else { 1.0 };
    let transform = RigidTransform::translation(to - scale * from)?;
    let scaled = if scale == 1.0 { None } else { Some(candidate.scaled(scale)?) };
    Ok(Placed { placement: Placement { align: ScoreAlignment::Box, scale, transform, fit: None }, scaled })
}

/// Serializes a motion as its rotation, a unit quaternion x, y, z, w, and its translation.
fn parts<S: Serializer>(transform: &RigidTransform, serializer: S) -> std::result::Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct Parts {
        rotation: [f64; 4],
        translation: [f64; 3],
    }
    let (rotation, translation) = (transform.rotation().to_array(), transform.offset().to_array());
    Parts { rotation, translation }.serialize(serializer)
}
