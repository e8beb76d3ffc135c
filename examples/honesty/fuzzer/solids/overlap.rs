//! Volumes in common against points of a box, and against what must hold of any two solids.

use super::super::clearance::triangles_of;
use fastrand::Rng;
use glam::DVec3;
use nurbs_hausdorff::internals::engine::{Engine, PreparedModel};
use nurbs_hausdorff::{Interval, Model, OverlapOptions, OverlapResult, OverlapVolumes, RigidTransform};

/// The cells of the common box along each axis, of which two points are asked for.
const CELLS: u32 = 16;

/// The standard deviations by which a count may be off: once in 10⁹ counts.
const DEVIATIONS: f64 = 6.0;

/// The pieces after which a volume is left as it is known.
const MAX_CELLS: usize = 8000;

/// The shifts of a solid against itself, relative to its size: none, of rounding, small and large.
const SHIFTS: [f64; 5] = [0.0, 1e-14, 1e-6, 0.01, 0.3];

/// Returns in words what is wrong with the volumes that a solid has in common with itself, shifted, and with another
/// one that is laid about its centre.
pub(super) fn violations(rng: &mut Rng, [a, b]: [&Model; 2]) -> Vec<String> {
    let any = |rng: &mut Rng| DVec3::new(rng.f64() - 0.5, rng.f64() - 0.5, rng.f64() - 0.5);
    let size = a.bounding_box().diagonal();
    let shift = SHIFTS[rng.usize(0..SHIFTS.len())] * size * any(rng);
    let between = b.bounding_box().center() - a.bounding_box().center() + 0.3 * size * any(rng);
    let mut found = Vec::new();
    for (models, shift) in [([a, a], shift), ([a, b], between)] {
        let wrong = of_pair(rng, models, shift);
        found.extend(
            wrong.into_iter().map(|what| format!("the volume in common, shifted by {shift}: {what}")),
        );
    }
    found
}

fn of_pair(rng: &mut Rng, models: [&Model; 2], shift: DVec3) -> Vec<String> {
    let [Ok(a), Ok(b)] = models.map(PreparedModel::new) else { return Vec::new() };
    let Ok(transform) = RigidTransform::translation(shift) else { return Vec::new() };
    let measured = |from: &PreparedModel, to: &PreparedModel, transform| {
        let options = OverlapOptions { max_cells: Some(MAX_CELLS), transform, ..OverlapOptions::default() };
        Engine::cpu().overlap(from, to, &options).wait()
    };
    let (found, reverse) = match (measured(&a, &b, transform), measured(&b, &a, transform.inverse())) {
        (Ok(found), Ok(reverse)) => (found, reverse),
        (Err(error), _) | (_, Err(error)) => return vec![format!("it is refused by {}", error.code())],
    };
    let (Some(volumes), Some(back)) = (found.volumes, reverse.volumes) else { return Vec::new() };
    let mut wrong = impossible(&found, &volumes, [&a, &b]);
    let meet = |one: Interval, other: Interval| one.lower <= other.upper && other.lower <= one.upper;
    if !meet(volumes.intersection, back.intersection) {
        wrong.push(format!("{:?}, and {:?} the other way round", volumes.intersection, back.intersection));
    }
    let is_same = std::ptr::eq(models[0], models[1]) && shift == DVec3::ZERO;
    if is_same && !found.ratio.is_some_and(|ratio| ratio.contains(1.0)) {
        wrong.push(format!("the ratio of a solid to itself is {:?}", found.ratio));
    }
    wrong.extend(by_points(rng, models, shift, volumes.intersection));
    wrong
}

/// Returns what no two solids have: sets that are larger than their unions, or volumes that do not add up.
fn impossible(found: &OverlapResult, volumes: &OverlapVolumes, models: [&PreparedModel; 2]) -> Vec<String> {
    let OverlapVolumes { intersection, union, only_a, only_b, .. } = *volumes;
    let mut wrong = Vec::new();
    let [a, b] = models.map(|model| model.facts().volume);
    let sums = [
        (a, intersection + only_a),
        (b, intersection + only_b),
        (Some(union), intersection + only_a + only_b),
    ];
    for (whole, sum) in sums {
        if let Some(whole) = whole.filter(|whole| whole.upper < sum.lower || sum.upper < whole.lower) {
            wrong.push(format!("{whole:?} has parts of {sum:?}"));
        }
    }
    if found.ratio.is_none_or(|ratio| !(ratio.lower <= ratio.upper && ratio.upper <= 1.0)) {
        wrong.push(format!("the ratio is {:?}", found.ratio));
    }
    wrong
}

/// Compares with the number of points that are inside both, by rays through triangles: two at random in each cell of a
/// grid over the common box.
fn by_points(rng: &mut Rng, models: [&Model; 2], shift: DVec3, stated: Interval) -> Option<String> {
    let boxes = models.map(Model::bounding_box);
    let low = (boxes[0].min + shift).max(boxes[1].min);
    let extent = ((boxes[0].max + shift).min(boxes[1].max) - low).max(DVec3::ZERO);
    let triangles = models.map(triangles_of);
    let centers = boxes.map(|aabb| aabb.center());
    let is_common = |point: DVec3| match triangles[0].contain(point - shift - centers[0]) {
        Some(false) => Some(false),
        of_a => match triangles[1].contain(point - centers[1]) {
            Some(false) => Some(false),
            of_b => of_a.zip(of_b).map(|_| true),
        },
    };
    let (mut inside, mut open, mut mixed) = (0.0, 0.0, 0.0);
    for cell in 0..CELLS.pow(3) {
        let corner = [cell % CELLS, cell / CELLS % CELLS, cell / CELLS / CELLS].map(f64::from);
        let [one, other] = [(); 2].map(|()| {
            let at = DVec3::from_array(corner) + DVec3::new(rng.f64(), rng.f64(), rng.f64());
            is_common(low + extent * at / f64::from(CELLS))
        });
        for point in [one, other] {
            inside += 0.5 * f64::from(point == Some(true));
            open += 0.5 * f64::from(point.is_none());
        }
        mixed += f64::from(one != other);
    }
    // A cell's two points differ with twice the variance of one, and the mean of both has half of it.
    let slack = DEVIATIONS * (1.0 + 0.5 * f64::sqrt(mixed));
    let cell = extent.element_product() / f64::from(CELLS.pow(3));
    let [least, most] = [inside - slack, inside + open + slack].map(|number| number * cell);
    (stated.upper < least || stated.lower > most)
        .then(|| format!("{stated:?}, by points between {least} and {most}"))
}
