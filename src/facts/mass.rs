//! Volume, centroid and inertia from moments.

use super::Matrix;
use super::moments::IntervalMoments;
use super::principal::Principal;
use crate::interval::Interval;
use glam::DVec3;

/// The mass properties of a set of density 1.
#[derive(Debug, Clone)]
pub(crate) struct Mass {
    pub(crate) volume: Interval,
    /// The centroid, with the inertia about it; none where the volume may be 0.
    pub(crate) about: Option<AboutCentroid>,
}

/// What is measured about the centroid.
#[derive(Debug, Clone)]
pub(crate) struct AboutCentroid {
    pub(crate) centroid: [Interval; 3],
    pub(crate) inertia: Matrix,
    pub(crate) principal: Principal,
}

/// The places of xy, yz and zx among the moments.
const MIXED: [[usize; 3]; 3] = [[4, 7, 9], [7, 5, 8], [9, 8, 6]];

impl Mass {
    /// Returns the properties that these moments about `origin` have.
    pub(crate) fn new(of: &IntervalMoments, origin: DVec3) -> Self {
        let volume = of[0];
        if !(volume.lower > 0.0) {
            return Self { volume, about: None };
        }
        let offset = [0, 1, 2].map(|axis| of[1 + axis].over(volume));
        let centroid = [0, 1, 2].map(|axis| offset[axis] + Interval::exactly(origin[axis]));
        let second =
            [0, 1, 2].map(|i| [0, 1, 2].map(|j| of[MIXED[i][j]] - of[1 + i.min(j)] * offset[i.max(j)]));
        let square = |i: usize| second[i][i].not_negative();
        let inertia = [0, 1, 2].map(|i: usize| {
            let across = square((i + 1) % 3) + square((i + 2) % 3);
            [0, 1, 2].map(|j: usize| if i == j { across } else { -second[i][j] })
        });
        let is_known = inertia.iter().flatten().all(|entry| entry.width().is_finite());
        let about =
            is_known.then(|| AboutCentroid { centroid, inertia, principal: Principal::new(&inertia) });
        Self { volume, about }
    }
}
