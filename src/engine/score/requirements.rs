//! Verdicts about numbers that have to be large or small enough.

use super::numbers::Known;
use super::{ScoreNumber, ScoreOptions};
use crate::interval::Interval;
use serde::Serialize;

/// A number that has to be large or small enough.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct Requirement {
    /// The number.
    pub number: ScoreNumber,
    /// The least permitted value, if that is required.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_least: Option<f64>,
    /// The largest permitted value, if that is required.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_most: Option<f64>,
    /// What is known of the number: where the work ended early, only that much.
    pub found: Interval,
    /// Whether it is met; `None` where the interval does not decide that.
    pub met: Option<bool>,
}

/// Returns the requirements of the options, judged by what is known.
pub(super) fn judged(options: &ScoreOptions, known: &Known) -> Vec<Requirement> {
    let least = options.at_least.iter().map(|(&number, &bound)| {
        let found = known.of(number);
        let met = decided(found.lower >= bound, found.upper < bound);
        Requirement { number, at_least: Some(bound), at_most: None, found, met }
    });
    let most = options.at_most.iter().map(|(&number, &bound)| {
        let found = known.of(number);
        let met = decided(found.upper <= bound, found.lower > bound);
        Requirement { number, at_least: None, at_most: Some(bound), found, met }
    });
    least.chain(most).collect()
}

fn decided(is_met: bool, is_missed: bool) -> Option<bool> {
    if is_missed { Some(false) } else { is_met.then_some(true) }
}

/// Returns whether all requirements are met: `Some(false)` as soon as one is certainly missed, `None` if one is
/// undecided or if there are none.
pub(super) fn verdict(requirements: &[Requirement]) -> Option<bool> {
    if requirements.iter().any(|one| one.met == Some(false)) {
        return Some(false);
    }
    let all = !requirements.is_empty() && requirements.iter().all(|one| one.met == Some(true));
    all.then_some(true)
}

/// Returns whether a requirement is certainly missed.
pub(super) fn is_missed(options: &ScoreOptions, known: &Known) -> bool {
    verdict(&judged(options, known)) == Some(false)
}
