//! The least distance of two models by brute force: samples, and descents from the nearest ones.

use super::super::sheet::Sheet;
use super::subjects::Subject;
use glam::{DMat4, DVec2, DVec3, DVec4};
use nurbs_hausdorff::RigidTransform;

/// The number of pairs of samples, of different points of A, from which descents start.
const STARTS: usize = 12;

/// The largest number of steps of a descent, its initial damping, and the one at which it ends.
const MAX_STEPS: usize = 40;
const DAMPING: f64 = 1e-3;
const MAX_DAMPING: f64 = 1e12;

/// A sample of a model.
#[derive(Clone, Copy)]
pub(super) struct Sample {
    pub(super) sheet: usize,
    pub(super) parameters: DVec2,
    pub(super) point: DVec3,
}

/// Samples in a tree that is split at medians.
pub(super) struct Cloud {
    samples: Vec<Sample>,
}

impl Cloud {
    pub(super) fn new(mut samples: Vec<Sample>) -> Self {
        split(&mut samples, 0);
        Self { samples }
    }

    pub(super) fn samples(&self) -> &[Sample] {
        &self.samples
    }

    /// Returns the nearest sample, with its squared distance.
    pub(super) fn nearest(&self, point: DVec3) -> (Sample, f64) {
        let mut best = (self.samples[0], f64::INFINITY);
        search(&self.samples, 0, point, &mut best);
        best
    }
}

/// Sorts samples so that the middle one separates the others along an axis, and so on.
fn split(samples: &mut [Sample], axis: usize) {
    if samples.len() < 2 {
        return;
    }
    let middle = samples.len() / 2;
    samples.select_nth_unstable_by(middle, |a, b| a.point[axis].total_cmp(&b.point[axis]));
    let (low, high) = samples.split_at_mut(middle);
    split(low, (axis + 1) % 3);
    split(&mut high[1..], (axis + 1) % 3);
}

fn search(samples: &[Sample], axis: usize, point: DVec3, best: &mut (Sample, f64)) {
    if samples.is_empty() {
        return;
    }
    let middle = samples.len() / 2;
    let squared = samples[middle].point.distance_squared(point);
    if squared < best.1 {
        *best = (samples[middle], squared);
    }
    let offset = point[axis] - samples[middle].point[axis];
    let (low, high) = (&samples[..middle], &samples[middle + 1..]);
    let [near, far] = if offset < 0.0 { [low, high] } else { [high, low] };
    search(near, (axis + 1) % 3, point, best);
    if offset * offset < best.1 {
        search(far, (axis + 1) % 3, point, best);
    }
}

/// Returns the least distance found of a point of A, moved, from a point of B.
pub(super) fn nearest([a, b]: [&Subject; 2], transform: &RigidTransform) -> f64 {
    // The clouds are relative to origins near the models.
    let shift = transform.apply(a.origin) - b.origin;
    let into = |point: DVec3| transform.rotate(point) + shift;
    let mut pairs: Vec<(Sample, Sample, f64)> = a
        .cloud
        .samples()
        .iter()
        .map(|&sample| {
            let (other, squared) = b.cloud.nearest(into(sample.point));
            (sample, other, squared)
        })
        .collect();
    let count = STARTS.min(pairs.len());
    pairs.select_nth_unstable_by(count - 1, |a, b| a.2.total_cmp(&b.2));
    let descend = |&(one, other, squared): &(Sample, Sample, f64)| {
        descend(
            [&a.sheets[one.sheet], &b.sheets[other.sheet]],
            [one.parameters, other.parameters],
            transform,
            shift,
        )
        .min(squared.sqrt())
    };
    pairs[..count].iter().map(descend).fold(f64::INFINITY, f64::min)
}

/// Returns the distance at which a descent by the method of Levenberg and Marquardt ends, over the
/// four parameters within both domains.
fn descend(sheets: [&Sheet; 2], start: [DVec2; 2], transform: &RigidTransform, shift: DVec3) -> f64 {
    let mut at = start;
    let mut damping = DAMPING;
    let system = |at: [DVec2; 2]| {
        let [a, b] = [0, 1].map(|side| sheets[side].tangents(at[side]));
        let rotate = |vector| transform.rotate(vector);
        let residual = rotate(a.point) + shift - b.point;
        (residual, [rotate(a.u), rotate(a.v), -b.u, -b.v])
    };
    let (mut residual, mut first) = system(at);
    for _ in 0..MAX_STEPS {
        if damping > MAX_DAMPING {
            break;
        }
        let product = |i: usize, j: usize| first[i].dot(first[j]);
        let mut matrix: [[f64; 4]; 4] = std::array::from_fn(|i| {
            std::array::from_fn(|j| product(i, j) * if i == j { 1.0 + damping } else { 1.0 })
        });
        let mut right: [f64; 4] = std::array::from_fn(|i| -first[i].dot(residual));
        for k in 0..4 {
            // A parameter at an end stays there while it is pushed outwards.
            let (side, axis) = (k / 2, k % 2);
            let pushed = {
                let mut moved = at[side];
                moved[axis] += right[k].signum() * sheets[side].extent()[axis];
                sheets[side].clamp(moved)[axis] == at[side][axis]
            };
            if pushed || matrix[k][k] == 0.0 {
                matrix[k] = [0.0; 4];
                for row in &mut matrix {
                    row[k] = 0.0;
                }
                (matrix[k][k], right[k]) = (1.0, 0.0);
            }
        }
        let step = DMat4::from_cols_array_2d(&matrix).inverse() * DVec4::from_array(right);
        let next = [
            sheets[0].clamp(at[0] + DVec2::new(step.x, step.y)),
            sheets[1].clamp(at[1] + DVec2::new(step.z, step.w)),
        ];
        let (next_residual, next_first) = system(next);
        if step.is_finite() && next_residual.length_squared() < residual.length_squared() {
            (at, residual, first) = (next, next_residual, next_first);
            damping *= 0.1;
        } else {
            damping *= 10.0;
        }
    }
    residual.length()
}
