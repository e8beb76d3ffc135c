//! Stage `claim`: a far point that cells are bounded by before it is certified.
//!
//! A certificate looks at every patch of B that may be nearer, which takes one
//! thread as long as some hundred cells take. Mostly a farther point is found
//! before, or the last cells leave a thread to spare. So a climb's distance is
//! taken on trust at first, and what is dropped only because of it is held:
//! should the certificate say less, all of that waits again.

use super::BranchAndBound;
use super::feet::Sample;
use super::region::SearchNode;
use super::search::Farthest;
use crate::closest::{Closest, Target, closest_above};
use glam::DVec3;

/// A point of A that seems to be the farthest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Claim {
    pub(super) patch: u32,
    pub(super) sample: Sample,
    /// The moved point.
    pub(super) point: DVec3,
    /// What its certificate is to tell at least.
    pub(super) lower: f64,
    /// Cells bounded before it.
    pub(super) cells: usize,
}

/// A claim's certificate, still to be made.
#[derive(Clone, Copy)]
pub(super) struct Proof<'a> {
    target: &'a Target,
    point: DVec3,
    width: f64,
    known: (u32, [f64; 2]),
    floor: f64,
}

impl Proof<'_> {
    /// The closest point of B, as narrow as asked if it is farther than the floor.
    pub(super) fn closest(self) -> Option<Closest> {
        closest_above(self.target, self.point, self.width, Some(self.known), self.floor, None)
    }
}

impl<'a> BranchAndBound<'a> {
    /// The largest distance found, certified or claimed.
    pub(super) fn believed(&self) -> f64 {
        self.claim.map_or(0.0, |claim| claim.lower).max(self.lower())
    }

    /// The point of that distance, which is the distance there or more.
    pub(super) fn believed_point(&self) -> Option<(DVec3, f64)> {
        let claimed = self.claim.map(|claim| (claim.point, claim.sample.foot.distance()));
        claimed.or(self.farthest.map(|farthest| (farthest.point, farthest.closest.upper)))
    }

    /// Takes a point for the farthest if it seems to be, or there is none yet.
    pub(super) fn offer(&mut self, patch: u32, sample: Sample) {
        let point = self.transform.apply(self.a.patch(patch).point(sample.parameters));
        // What its certificate may lose.
        let lost = 2.0 * (self.width() + self.rounding);
        let lower = sample.foot.distance() - lost;
        let is_first = self.claim.is_none() && self.farthest.is_none();
        if is_first || lower > self.believed() {
            self.claim = Some(Claim { patch, sample, point, lower, cells: self.cells });
        }
        if !self.trusting {
            self.prove();
        }
    }

    /// The certificate to be made of a claim.
    pub(super) fn proof(&self, claim: &Claim) -> Proof<'a> {
        let foot = claim.sample.foot;
        let known = (foot.patch, foot.parameters);
        Proof { target: self.b.target, point: claim.point, width: self.width(), known, floor: self.lower() }
    }

    /// Certifies what is claimed.
    pub(super) fn prove(&mut self) {
        if let Some(claim) = self.claim {
            self.take(claim, self.proof(&claim).closest());
        }
    }

    /// Takes a claim's certificate: drops what was held, or has it wait again
    /// if the certificate says less; then nothing is taken on trust any more.
    pub(super) fn take(&mut self, claim: Claim, closest: Option<Closest>) {
        self.claim = None;
        if let Some(mut closest) = closest {
            closest.lower = (closest.lower - self.rounding).max(0.0);
            if self.farthest.is_none_or(|best| closest.lower > best.closest.lower) {
                let Claim { patch, sample, point, .. } = claim;
                self.farthest = Some(Farthest { patch, parameters: sample.parameters, point, closest });
            }
        }
        let held = std::mem::take(&mut self.held);
        if self.lower() >= claim.lower {
            self.dropped = held.iter().fold(self.dropped, |dropped, region| dropped.max(region.upper));
        } else {
            self.trusting = false;
            self.queue.extend(held);
        }
    }

    /// Ends a region with its bound, for good only if no claim was needed.
    pub(super) fn drop_region(&mut self, region: SearchNode) {
        if self.claim.is_some() && region.upper > self.lower() + self.tolerance {
            self.held.push(region);
        } else {
            self.dropped = self.dropped.max(region.upper);
        }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::super::feet::Foot;
    use super::super::{Interval, Operand};
    use super::*;
    use crate::bezier::{LocalDerivativeBounds, PatchSet, extract};
    use crate::closest::closest;
    use crate::model::RigidTransform;
    use crate::param_box::ParamBox;
    use crate::shapes::shape;

    const TOLERANCE: f64 = 1e-5;

    fn patches(name: &str) -> PatchSet {
        let Ok(model) = shape(name) else { unreachable!() };
        extract(&model).patches
    }

    /// However much is claimed and whenever, the interval is as narrow as asked
    /// and no sample is farther than its end.
    #[test]
    fn a_false_claim_is_found_out() {
        let random = &mut fastrand::Rng::with_seed(2);
        let targets = [Target::new(patches("wavy-sheet")), Target::new(patches("torus"))];
        let bounds = targets.each_ref().map(|target| {
            target.patches.iter().map(|_| LocalDerivativeBounds::new(ParamBox::UNIT)).collect::<Vec<_>>()
        });
        let mut found_out = 0;
        for _ in 0..20 {
            let [a, b] = [0, 1].map(|side| Operand::new(&targets[side], &bounds[side]));
            let mut search = BranchAndBound::new(a, b, RigidTransform::IDENTITY, TOLERANCE, None);
            let claimed_at = random.usize(1..5);
            let mut rounds = 0;
            while search.advance().is_none() {
                rounds += 1;
                if rounds == claimed_at {
                    let patch = random.usize(..targets[1].patches.len()) as u32;
                    let parameters = [random.f64(), random.f64()];
                    let distance = search.interval().upper * random.f64();
                    let foot = Foot { distance_squared: distance * distance, ..Foot::start(patch, [0.5; 2]) };
                    search.offer(0, Sample { parameters, foot });
                }
            }
            search.finish();
            let Interval { lower, upper } = search.interval();
            assert!(upper - lower <= TOLERANCE, "{lower} {upper}");
            for patch in targets[0].patches.iter() {
                for _ in 0..10 {
                    let point = patch.point([random.f64(), random.f64()]);
                    assert!(closest(&targets[1], point, 1e-9).is_some_and(|found| found.lower <= upper));
                }
            }
            found_out += usize::from(!search.trusting);
        }
        assert!((3..20).contains(&found_out), "{found_out}");
    }
}
