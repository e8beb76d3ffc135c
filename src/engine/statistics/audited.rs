//! The audit of the parts that statistics rest on.

use super::cover::Cover;
use crate::certified::{Audit, AuditReport};
use crate::facets::Weighted;
use crate::sorting::sort_by_number;
use crate::threads::parallel::map_ranges;
use std::ops::Range;

/// The parts of a result for each that is looked at, and the fewest: of as many points as the bounds of a part take
/// closest points about this is a hundredth of the search.
const PARTS_PER_AUDIT: usize = 128;
const MIN_AUDITS: usize = 16;

/// The points of a part besides its corners, of a share of the parts and of all.
const FURTHER_OF_SHARE: usize = 3;
const FURTHER_OF_ALL: usize = 8;

/// The parts that are looked at, the heaviest first, then others at even steps.
fn chosen<T: Weighted>(parts: &[T], extent: Audit) -> Vec<usize> {
    if extent == Audit::All {
        return (0..parts.len()).collect();
    }
    let mut by_weight: Vec<(f64, usize)> = parts.iter().map(|part| part.weight().upper).zip(0..).collect();
    sort_by_number(&mut by_weight, |one| -one.0);
    let heaviest = by_weight.iter().take(MIN_AUDITS).map(|(_, index)| *index);
    let step = parts.len().div_ceil((parts.len() / PARTS_PER_AUDIT).max(1)).max(1);
    heaviest.chain((step / 2..parts.len()).step_by(step)).collect()
}

/// Looks at a share of the parts or at all, and returns in words what refutes their bounds, if anything does.
/// O(closest point) a part that is looked at.
pub(in crate::engine) fn audit<C: Cover>(
    cover: &C,
    parts: &[C::Part],
    extent: Audit,
    report: &mut AuditReport,
) -> Option<String> {
    let chosen = chosen(parts, extent);
    let is_all = extent == Audit::All;
    let further = if is_all { FURTHER_OF_ALL } else { FURTHER_OF_SHARE };
    let of_range = |range: Range<usize>| {
        let refutation = |&index: &usize| cover.refutation(&parts[index], further, is_all);
        chosen[range].iter().find_map(refutation)
    };
    let found = map_ranges(chosen.len(), of_range).into_iter().flatten().next();
    for _ in &chosen {
        report.count(cover.lemma(), cover.corners() + further);
    }
    if found.is_some() {
        report.strike(cover.lemma());
    }
    found.map(|what| {
        let lemma = cover.lemma();
        format!(
            "a bound of lemma {lemma} is refuted: {what}; the intervals were computed without that lemma and are valid. \
             This is a fault of the library: please report this pair of models"
        )
    })
}
