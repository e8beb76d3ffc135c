//! Parts that are bounded and halved on all cores, a page of them at a time.

use crate::error::{Error, Result};
use crate::progress::Progress;
use crate::threads::parallel::map_ranges;
use std::ops::Range;

/// Returns the bounds of all points, facets or patches.
pub(in crate::engine) async fn bounded<T: Send>(
    count: usize,
    at_once: usize,
    progress: &mut Progress<'_>,
    bound: impl Fn(Range<usize>) -> Option<Vec<T>> + Sync,
) -> Result<Vec<T>> {
    let mut bounded = Vec::with_capacity(count);
    while bounded.len() < count {
        let first = bounded.len();
        let found =
            map_ranges(at_once.min(count - first), |range| bound(first + range.start..first + range.end));
        for found in found {
            bounded.append(&mut found.ok_or(Error::EmptyModel)?);
        }
        progress.checkpoint(0.0).await?;
    }
    Ok(bounded)
}

/// Halves the parts of these indices by `halves`, one half in the place of each part and one at the end; those without
/// halves stay. Returns the number of parts that were halved.
pub(in crate::engine) fn halve_page<T: Send + Sync>(
    parts: &mut Vec<T>,
    page: &[usize],
    halves: impl Fn(&T) -> Option<[T; 2]> + Sync + Send,
) -> usize {
    let found = map_ranges(page.len(), |range: Range<usize>| {
        page[range].iter().map(|&index| halves(&parts[index])).collect::<Vec<_>>()
    });
    let mut count = 0;
    for (&index, halves) in page.iter().zip(found.into_iter().flatten()) {
        let Some([one, other]) = halves else { continue };
        parts[index] = one;
        parts.push(other);
        count += 1;
    }
    count
}
