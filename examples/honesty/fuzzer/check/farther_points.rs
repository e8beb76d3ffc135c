//! The search by brute force for points that contradict an interval.

use super::super::brute::{Placed, Target};
use super::super::sheet::{Sheet, sheets};
use super::super::surfaces::magnitude;
use super::super::trims::Rim;
use super::direction::Direction;
use fastrand::Rng;
use glam::{DVec2, DVec3};
use nurbs_hausdorff::internals::engine::DistanceResult;
use std::f64::consts::TAU;

/// The number of samples along each axis of a surface of A, one at random in each
/// cell of a grid, as the library's own samples are at dyadic fractions.
const SAMPLES: usize = 11;

/// The number of samples from which local searches for farther points start, and the
/// rounds of each.
const CLIMBS: usize = 6;
const CLIMB_ROUNDS: usize = 24;

/// The exponents of 10 between which samples near loops are away from them, relative to the domain.
const NEAR_LOOPS: [f64; 2] = [-10.0, -1.0];

impl Direction<'_> {
    /// Checks by brute force that no point of A found is farther than `upper`, and no
    /// point of B found is nearer to the witness than `lower`.
    pub(super) fn check_distances(&self, rng: &mut Rng, violations: &mut Vec<String>) {
        let DistanceResult { lower, upper, .. } = self.result;
        let [from_origin, to_origin] = [self.from, self.to].map(|model| model.bounding_box().center());
        let to_sheets = sheets(self.to, to_origin);
        let from_sheets = sheets(self.from, from_origin);
        let target = Target::new(&to_sheets);
        // The transform from the frame of one model's sheets into that of the other's.
        let shift = self.poses[1].apply_inverse(self.poses[0].apply(from_origin)) - to_origin;
        let turn = self.poses[1].rotation().inverse() * self.poses[0].rotation();
        let into = |point: DVec3| turn * point + shift;
        let witness = self.witness[0];
        let start = self.poses[1].apply_inverse(DVec3::from_array(witness.point)) - to_origin;
        let least = target.least(start);
        if least.distance + target.rim_error(&least) < lower - self.rounding {
            violations.push(format!("lower {lower}, but B is {} from the witness", least.distance));
        }
        let mut samples = Vec::new();
        // The witness on a trimmed face is checked to be near it, and need not be a point of it.
        if from_sheets[witness.face].region.is_none() {
            let parameters = DVec2::new(witness.u, witness.v);
            samples.push((Sample { sheet: witness.face, parameters, is_rim: false }, start));
        }
        for (index, sheet) in from_sheets.iter().enumerate() {
            for (parameters, is_rim) in sample_parameters(sheet, rng) {
                let point = into(sheet.point(parameters));
                samples.push((Sample { sheet: index, parameters, is_rim }, point));
            }
        }
        let mut found: Vec<(Sample, Placed)> =
            samples.iter().map(|&(sample, point)| (sample, target.near(point, None))).collect();
        let first = usize::from(from_sheets[witness.face].region.is_none());
        found[first..].sort_unstable_by(|a, b| b.1.distance.total_cmp(&a.1.distance));
        let beyond = upper + self.rounding;
        let is_beyond = |point: DVec3, at: Sample| {
            !target.is_within(point, beyond, (at.sheet, at.parameters))
                && self.is_proved_beyond(at, beyond, &to_sheets)
        };
        for &(sample, near) in &found {
            let point = into(from_sheets[sample.sheet].point(sample.parameters));
            if near.distance > beyond && is_beyond(point, sample) {
                let distance = target.least(point).distance;
                violations.push(format!("upper {upper}, but a point of A is {distance} from B"));
                return;
            }
        }
        for &(sample, near) in found.iter().filter(|(sample, _)| !sample.is_rim).take(CLIMBS) {
            let sheet = &from_sheets[sample.sheet];
            if let Some(point) =
                climb((sample.sheet, sheet), sample.parameters, near, &target, &into, beyond, &is_beyond)
            {
                let distance = target.least(point).distance;
                violations.push(format!("upper {upper}, but a point of A is {distance} from B"));
                return;
            }
        }
    }
}

/// A point of A by its face and parameters, and whether it was taken from a loop.
#[derive(Clone, Copy)]
pub(super) struct Sample {
    pub(super) sheet: usize,
    pub(super) parameters: DVec2,
    pub(super) is_rim: bool,
}

/// Returns random points of a face, with whether they are on a loop: one in each cell of a grid of
/// the domain and on each of its edges, and the corners, those that the face contains; and points
/// on and near its loops.
fn sample_parameters(sheet: &Sheet, rng: &mut Rng) -> Vec<(DVec2, bool)> {
    let mut samples = Vec::new();
    for index in 0..SAMPLES * SAMPLES {
        let [i, j] =
            [index / SAMPLES, index % SAMPLES].map(|cell| (cell as f64 + rng.f64()) / SAMPLES as f64);
        samples.push(sheet.at([i, j]));
    }
    for cell in 0..SAMPLES {
        let along = (cell as f64 + rng.f64()) / SAMPLES as f64;
        for end in [0.0, 1.0] {
            samples.extend([sheet.at([along, end]), sheet.at([end, along])]);
        }
    }
    for corner in [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]] {
        samples.push(sheet.at(corner));
    }
    let Some(region) = &sheet.region else {
        return samples.into_iter().map(|parameters| (parameters, false)).collect();
    };
    let mut rims = Vec::new();
    for curve in 0..region.curves() {
        for t in [0.0, rng.f64(), rng.f64(), rng.f64()] {
            let at = region.at(Rim { curve, t });
            rims.push((at, true));
            let offset = DVec2::from_angle(TAU * rng.f64()) * magnitude(rng, NEAR_LOOPS[0], NEAR_LOOPS[1]);
            samples.push(sheet.clamp(at + offset * sheet.extent()));
        }
    }
    let inside = samples.into_iter().filter(|&parameters| region.contains(parameters));
    inside.map(|parameters| (parameters, false)).chain(rims).collect()
}

/// Searches around a sample for farther points; returns one beyond the bound, if it
/// finds one.
fn climb(
    (index, sheet): (usize, &Sheet),
    start: DVec2,
    foot: Placed,
    target: &Target<'_>,
    into: &impl Fn(DVec3) -> DVec3,
    beyond: f64,
    is_beyond: &impl Fn(DVec3, Sample) -> bool,
) -> Option<DVec3> {
    let (mut at, mut best) = (start, foot);
    let mut step = sheet.extent() / SAMPLES as f64;
    for _ in 0..CLIMB_ROUNDS {
        let center = at;
        for i in -1..=1 {
            for j in -1..=1 {
                let parameters = sheet.clamp(center + step * DVec2::new(f64::from(i), f64::from(j)));
                if !sheet.contains(parameters) {
                    continue;
                }
                let point = into(sheet.point(parameters));
                let near = target.near(point, Some(best));
                if near.distance <= best.distance {
                    continue;
                }
                if near.distance > beyond {
                    if is_beyond(point, Sample { sheet: index, parameters, is_rim: false }) {
                        return Some(point);
                    }
                    continue;
                }
                (at, best) = (parameters, near);
            }
        }
        if at == center {
            step *= 0.5;
        }
    }
    None
}
