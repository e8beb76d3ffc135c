//! The bounds of a search that are to be audited at its end.

use super::super::rounding::UNIT_ROUNDOFF;
use super::{CellBound, Lemma};

/// The largest cells of a lemma that are audited, and the bounds nearest to the threshold.
const LARGEST: usize = 4;
const TIGHTEST: usize = 4;

/// The most cells of a lemma that are drawn at random.
const MAX_RANDOM: usize = 256;

/// The bounds of one lemma.
#[derive(Debug, Default)]
struct Sample {
    count: u64,
    largest: Vec<(f64, CellBound)>,
    tightest: Vec<(f64, CellBound)>,
    random: Vec<CellBound>,
}

/// The bounds by lemmas that are not elementary: the largest cells, those nearest to the threshold, and a random
/// sample of the others.
#[derive(Debug, Default)]
pub(in crate::certified) struct Ledger {
    samples: Vec<(Lemma, Sample)>,
}

impl Ledger {
    /// Enters the bound of a cell of this size, found at this threshold. O(1).
    pub(in crate::certified) fn enter(&mut self, bound: CellBound, size: f64, threshold: f64) {
        if bound.lemma.is_elementary() {
            return;
        }
        let index = self.samples.iter().position(|(lemma, _)| *lemma == bound.lemma).unwrap_or_else(|| {
            self.samples.push((bound.lemma, Sample::default()));
            self.samples.len() - 1
        });
        let sample = &mut self.samples[index].1;
        keep(&mut sample.largest, LARGEST, size, bound);
        keep(&mut sample.tightest, TIGHTEST, bound.upper / threshold.max(UNIT_ROUNDOFF), bound);
        // A reservoir: each bound is kept with the same probability.
        sample.count += 1;
        if sample.random.len() < MAX_RANDOM {
            sample.random.push(bound);
        } else {
            let place = mixed(sample.count) % sample.count;
            if let Some(kept) = sample.random.get_mut(place as usize) {
                *kept = bound;
            }
        }
    }

    /// Takes out what is to be audited: of each lemma the largest and the tightest, and together at most `count`
    /// random ones more.
    pub(in crate::certified) fn take(&mut self, count: usize) -> Vec<CellBound> {
        let samples = std::mem::take(&mut self.samples);
        let share = count.div_ceil(samples.len().max(1));
        let mut bounds: Vec<CellBound> = Vec::new();
        for (_, sample) in samples {
            let random = spread(&sample.random, share);
            let kept = sample.largest.into_iter().chain(sample.tightest).map(|(_, bound)| bound);
            for bound in kept.chain(random) {
                if !bounds.contains(&bound) {
                    bounds.push(bound);
                }
            }
        }
        bounds
    }
}

/// Keeps the bounds with the largest keys. A key that is NaN replaces no other.
fn keep(kept: &mut Vec<(f64, CellBound)>, most: usize, key: f64, bound: CellBound) {
    if kept.len() < most {
        kept.push((key, bound));
        return;
    }
    let mut least = 0;
    for (index, (other, _)) in kept.iter().enumerate() {
        if *other < kept[least].0 {
            least = index;
        }
    }
    if key > kept[least].0 {
        kept[least] = (key, bound);
    }
}

/// About `count` bounds evenly from a list.
fn spread(bounds: &[CellBound], count: usize) -> impl Iterator<Item = CellBound> + '_ {
    let step = bounds.len().div_ceil(count.max(1)).max(1);
    bounds.iter().copied().step_by(step).take(count)
}

/// A number whose bits depend evenly on all of another's: the finaliser of SplitMix64 (Steele, Lea and Flood 2014).
fn mixed(seed: u64) -> u64 {
    let mut bits = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::super::super::{Cell, Foot};
    use super::*;

    fn bound(patch: u32, upper: f64, lemma: Lemma) -> CellBound {
        CellBound { cell: Cell::whole(patch), upper, lemma, foot: Foot::start(0, [0.5; 2]) }
    }

    /// Of many bounds the largest cells and those nearest to the threshold are taken, and no more random ones
    /// than were allowed; elementary ones are not entered.
    #[test]
    fn the_largest_and_the_tightest_are_audited() {
        let mut ledger = Ledger::default();
        for index in 0..10_000_u32 {
            let size = f64::from(index * 7919 % 10_000);
            ledger.enter(bound(index, f64::from(index) / 1e4, Lemma::Heights), size, 1.0);
            ledger.enter(bound(index, 0.5, Lemma::Taylor), size, 1.0);
        }
        let taken = ledger.take(16);
        assert!(taken.len() <= 16 + LARGEST + TIGHTEST && taken.len() > 16, "{}", taken.len());
        let largest = (0..10_000_u32).find(|index| index * 7919 % 10_000 == 9999).map(Cell::whole);
        assert!(taken.iter().any(|bound| Some(bound.cell) == largest));
        assert!(taken.iter().any(|bound| bound.cell == Cell::whole(9999)));
        assert!(taken.iter().all(|bound| bound.lemma == Lemma::Heights));
        assert!(ledger.take(16).is_empty());
    }

    /// The random ones are spread over the whole search.
    #[test]
    fn the_sample_is_spread() {
        let mut ledger = Ledger::default();
        for index in 0..100_000_u32 {
            ledger.enter(bound(index, 0.5, Lemma::Bilinear), 1.0, 1.0);
        }
        let taken = ledger.take(100);
        let late = taken.iter().filter(|bound| bound.cell.patch >= 50_000).count();
        assert!((30..75).contains(&late), "{late} of {}", taken.len());
    }
}
