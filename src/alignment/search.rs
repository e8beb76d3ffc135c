//! The search for poses: many starts are fitted with the feet of a grid, and the best of them with exact feet.

use super::field::{Field, FootField};
use super::foot_grid::FootGrid;
use super::mean::{LocalFit, Loss};
use super::moments::Principal;
use super::poses::{Candidate, distinct, spiral};
use super::samples::Samples;
use crate::bvh::Aabb;
use crate::model::RigidTransform;
use crate::threads::parallel::map;
use glam::{DQuat, DVec3};

/// The number of rotations that are tried: within 30° of any there is one, the basin of most parts.
const ROTATIONS: usize = 600;

/// The number of rotations where A's centre is tried beside B's as well, for parts of a model.
const ROTATIONS_BESIDE: usize = 240;

/// Samples and steps with which a start is tried by the grid; twice as many samples where some are left out, as which
/// ones is to be learnt from them.
const GRID_SAMPLES: usize = 128;
const GRID_SAMPLES_AND_OUTLIERS: usize = 256;
const GRID_STEPS: usize = 12;

/// Samples, steps and number of the poses that are fitted by exact feet: a cube has 24 equal ones.
const EXACT_SAMPLES: usize = 200;
const EXACT_STEPS: usize = 12;
const MOST_EXACT: usize = 48;

/// The samples, the steps and the number of poses of the last round, whose residuals are compared.
const FINE_SAMPLES: usize = 2000;
const FINE_STEPS: usize = 4;
const MOST_FINE: usize = 24;

/// A pose by the grid whose residual exceeds this multiple of the least one is not fitted further.
const WORSE: f64 = 4.0;

/// What the grid adds to a residual, as a part of the gyration: its spacing seen from a curved part.
const GRID_ERROR: f64 = 0.03;

/// The steps of the shift of A's centre from B's, in standard deviations of B along its axes: half
/// of a part is shifted by about one.
const BESIDE: f64 = 1.0;

/// The residual, as a part of the gyration, above which a part of a model is looked for: the
/// centres then do not correspond.
const POOR: f64 = 0.01;

/// The number of starts between two checkpoints.
const STARTS_AT_ONCE: usize = 32;

/// The number of poses that stand for random ones, their samples, and the shift in gyrations.
const RANDOM_POSES: usize = 48;
const RANDOM_SAMPLES: usize = 64;
const RANDOM_SHIFT: f64 = 0.5;

/// A search over starts. Deterministic.
pub(crate) struct Search<'a> {
    field: FootField<'a>,
    loss: Loss,
    /// The number of all samples.
    count: usize,
    grid: FootGrid,
    /// The samples that stand for A's centre and size: those that are not far off.
    kept: Samples,
    coarse: Samples,
    exact: Samples,
    fine: Samples,
    starts: Vec<RigidTransform>,
    /// Starts for parts of a model, which follow where the first find nothing.
    beside: Vec<RigidTransform>,
    next: usize,
    found: Vec<Candidate>,
}

impl<'a> Search<'a> {
    /// Prepares the starts: `given`, principal axes on those of B, whose samples are `other`, and
    /// rotations spread over all. `None` for a field without points.
    pub(crate) fn new(
        field: FootField<'a>,
        of_b: Aabb,
        (samples, other): (&Samples, &Samples),
        given: &[RigidTransform],
        loss: Loss,
    ) -> Option<Self> {
        let grid = FootGrid::new(&field, of_b)?;
        let kept = samples.without_farthest(loss.outliers);
        let (a, b) = (Principal::of(&kept), Principal::of(other));
        let rotations: Vec<DQuat> =
            a.onto(&b).into_iter().chain((0..ROTATIONS).map(|index| spiral(index, ROTATIONS))).collect();
        let laid = |rotation: DQuat, on: DVec3| RigidTransform::about(rotation, kept.center, on);
        let starts = given.iter().copied();
        let starts = starts.chain(rotations.iter().map(|&rotation| laid(rotation, other.center)));
        let places = (0..6).map(|k| {
            let axis = k / 2;
            let step = BESIDE * b.spreads[axis].max(0.0).sqrt() * if k % 2 == 0 { 1.0 } else { -1.0 };
            other.center + step * (b.axes * DVec3::AXES[axis])
        });
        let few = |place: DVec3| {
            (0..ROTATIONS_BESIDE).map(move |index| laid(spiral(index, ROTATIONS_BESIDE), place))
        };
        let (starts, beside) = (starts.collect(), places.flat_map(few).collect());
        let coarse = if loss.outliers > 0.0 { GRID_SAMPLES_AND_OUTLIERS } else { GRID_SAMPLES };
        Some(Self {
            field,
            loss,
            count: samples.points.len(),
            grid,
            kept,
            coarse: samples.thinned(coarse),
            exact: samples.thinned(EXACT_SAMPLES),
            fine: samples.thinned(FINE_SAMPLES),
            starts,
            beside,
            next: 0,
            found: Vec::new(),
        })
    }

    /// Tries some starts; returns whether all are done. Those beside B's centre follow only where the
    /// best of the others is poor.
    pub(crate) fn advance(&mut self) -> bool {
        if self.next == self.starts.len() && !self.beside.is_empty() && self.is_poor() {
            self.starts.append(&mut self.beside);
        }
        let end = (self.next + STARTS_AT_ONCE).min(self.starts.len());
        let starts = &self.starts[self.next..end];
        let tried = map(starts.len(), |index| self.try_start(starts[index]));
        self.found.extend(tried.into_iter().flatten());
        self.next = end;
        self.next == self.starts.len() && (self.beside.is_empty() || !self.is_poor())
    }

    fn is_poor(&self) -> bool {
        let least = self.found.iter().map(|one| one.rms).fold(f64::INFINITY, f64::min);
        !(least <= POOR * self.kept.gyration)
    }

    fn try_start(&self, motion: RigidTransform) -> Option<Candidate> {
        self.fitted(&self.grid, &self.coarse, GRID_STEPS, motion)
    }

    /// Returns the pose after some steps with some of the samples.
    fn fitted(
        &self,
        field: impl Field,
        samples: &Samples,
        steps: usize,
        motion: RigidTransform,
    ) -> Option<Candidate> {
        let loss = self.loss.of_some(samples.points.len(), self.count);
        let mut fit = LocalFit::new(field, samples, loss, 0.0, motion)?;
        fit.run(steps);
        Some(Candidate { motion: fit.motion, rms: fit.rms() })
    }

    /// Returns the number of starts tried.
    pub(crate) fn tried(&self) -> usize {
        self.next
    }

    /// Returns the part of the starts that are done, of those that are known.
    pub(crate) fn done(&self) -> f64 {
        self.next as f64 / (self.starts.len() + self.beside.len()) as f64
    }

    /// Fits the best poses by exact feet, first with few samples, then with more; returns them in
    /// the order of their residuals.
    pub(crate) fn best(&mut self) -> Vec<Candidate> {
        let found = distinct(std::mem::take(&mut self.found), &self.kept, MOST_EXACT);
        let floor = GRID_ERROR * self.kept.gyration;
        let exact = self.refined(within(found, WORSE, floor), &self.exact, EXACT_STEPS);
        let exact = distinct(exact, &self.kept, MOST_FINE);
        let floor = 1e-3 * self.kept.gyration;
        let fine = self.refined(within(exact, WORSE, floor), &self.fine, FINE_STEPS);
        distinct(fine, &self.kept, MOST_FINE)
    }

    fn refined(&self, candidates: Vec<Candidate>, samples: &Samples, steps: usize) -> Vec<Candidate> {
        let refine = |index: usize| self.fitted(self.field, samples, steps, candidates[index].motion);
        map(candidates.len(), refine).into_iter().flatten().collect()
    }
}

/// Returns the poses in which the principal axes of samples lie on those of others, with both centres: four, or more
/// where spreads are nearly equal.
pub(crate) fn principal_poses(samples: &Samples, other: &Samples) -> Vec<RigidTransform> {
    let rotations = Principal::of(samples).onto(&Principal::of(other));
    rotations
        .into_iter()
        .map(|rotation| RigidTransform::about(rotation, samples.center, other.center))
        .collect()
}

/// Returns the candidates whose residual is at most `factor` times the least one and `floor`.
fn within(candidates: Vec<Candidate>, factor: f64, floor: f64) -> Vec<Candidate> {
    let least = candidates.iter().map(|one| one.rms).fold(f64::INFINITY, f64::min);
    candidates.into_iter().filter(|one| one.rms <= factor * least + floor).collect()
}

/// Returns the residual that a pose has which nothing determines: the median, over poses in rotations
/// spread over all and with A's centre half its gyration beside B's, of the root mean square of the
/// distances that are not left out. `None` for a field without points.
pub(crate) fn random_residual(
    field: impl Field + Copy,
    (samples, other): (&Samples, &Samples),
    loss: Loss,
) -> Option<f64> {
    let few = samples.thinned(RANDOM_SAMPLES);
    let kept = samples.without_farthest(loss.outliers);
    let loss = loss.of_some(few.points.len(), samples.points.len());
    let of = |index: usize| {
        let rotation = spiral(index, RANDOM_POSES);
        let shift = RANDOM_SHIFT * kept.gyration * (rotation * DVec3::Z);
        let motion = RigidTransform::about(rotation, kept.center, other.center + shift);
        Some(LocalFit::new(field, &few, loss, 0.0, motion)?.rms())
    };
    let mut all = map(RANDOM_POSES, of).into_iter().collect::<Option<Vec<f64>>>()?;
    all.sort_by(f64::total_cmp);
    all.get(RANDOM_POSES / 2).copied()
}
