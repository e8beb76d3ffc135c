//! Feet: points of B near a point of A.

use crate::closest::Status;

/// A point of B near a target point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Foot {
    pub(crate) patch: u32,
    pub(crate) parameters: [f64; 2],
    /// Squared distance to the target.
    pub(crate) distance_squared: f64,
    pub(crate) status: Status,
}

impl Foot {
    /// A start for an iteration, at no known distance.
    pub(crate) fn start(patch: u32, parameters: [f64; 2]) -> Self {
        Self { patch, parameters, distance_squared: f64::INFINITY, status: Status::IterationLimit }
    }

    pub(in crate::certified) fn distance(&self) -> f64 {
        self.distance_squared.sqrt()
    }
}

/// A point of a patch of A, with a foot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::certified) struct Sample {
    pub(in crate::certified) patch: u32,
    pub(in crate::certified) parameters: [f64; 2],
    pub(in crate::certified) foot: Foot,
}

/// Capacity for the feet of one point: enough directions to choose three from.
const MAX_FEET: usize = 8;

/// The nearest known feet of one point on different patches, nearest first; at
/// least one.
#[derive(Debug, Clone)]
pub(in crate::certified) struct Feet {
    list: [Foot; MAX_FEET],
    count: usize,
}

impl Feet {
    pub(in crate::certified) fn new(foot: Foot) -> Self {
        Self { list: [foot; MAX_FEET], count: 1 }
    }

    pub(in crate::certified) fn nearest(&self) -> Foot {
        self.list[0]
    }

    pub(in crate::certified) fn all(&self) -> &[Foot] {
        &self.list[..self.count]
    }

    pub(in crate::certified) fn has(&self, patch: u32) -> bool {
        self.all().iter().any(|foot| foot.patch == patch)
    }

    /// Adds a foot; it replaces a farther one on its patch, or the farthest of
    /// all where there are [`MAX_FEET`].
    pub(in crate::certified) fn add(&mut self, foot: Foot) {
        let known = self.all().iter().position(|other| other.patch == foot.patch);
        let mut place = known.unwrap_or(self.count);
        if place == MAX_FEET {
            place -= 1;
        }
        if place < self.count && self.list[place].distance_squared <= foot.distance_squared {
            return;
        }
        self.count = self.count.max(place + 1);
        while place > 0 && self.list[place - 1].distance_squared > foot.distance_squared {
            self.list[place] = self.list[place - 1];
            place -= 1;
        }
        self.list[place] = foot;
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// As a sorted list of each patch's nearest foot, cut off.
    #[test]
    fn the_nearest_feet_of_different_patches_are_kept() {
        let random = &mut fastrand::Rng::with_seed(11);
        for _ in 0..200 {
            let mut foot =
                |_| Foot { distance_squared: random.f64(), ..Foot::start(random.u32(0..12), [0.5; 2]) };
            let given: Vec<Foot> = (0..40).map(&mut foot).collect();
            let mut feet = Feet::new(given[0]);
            given[1..].iter().for_each(|foot| feet.add(*foot));
            let mut nearest: Vec<Foot> = given.clone();
            nearest.sort_by(|a, b| a.distance_squared.total_cmp(&b.distance_squared));
            assert_eq!(feet.nearest(), nearest[0]);
            assert!(
                feet.all().len() <= MAX_FEET && feet.all().is_sorted_by_key(|foot| foot.distance_squared)
            );
            // One that was pushed out may come back nearer, so only the first are sure.
            let of_patch = |foot: &Foot| nearest.iter().find(|other| other.patch == foot.patch).copied();
            assert!(feet.all().iter().all(|foot| of_patch(foot).is_some()));
            let mut patches: Vec<u32> = feet.all().iter().map(|foot| foot.patch).collect();
            patches.sort_unstable();
            patches.dedup();
            assert_eq!(patches.len(), feet.all().len());
        }
    }
}
