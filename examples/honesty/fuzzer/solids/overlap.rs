//! Volumes in common against points of a box, and against what must hold of any two solids.

use fastrand::Rng;
use glam::{DQuat, DVec3};
use nurbs_hausdorff::internals::engine::{Engine, PreparedModel};
use nurbs_hausdorff::{
    Aabb, Interval, Model, OverlapOptions, OverlapResult, OverlapVolumes, RigidTransform, Side,
};

/// The cells of the common box along each axis, of which two points are asked for.
const CELLS: u32 = 16;

/// The standard deviations by which a count may be off: once in 10⁹ counts.
const DEVIATIONS: f64 = 6.0;

/// The pieces after which a volume is left as it is known: to about a hundredth where boundaries cross.
const MAX_CELLS: usize = 40_000;

/// The shifts of a solid against itself, relative to its size: none, and one of rounding.
const SHIFTS: [f64; 2] = [0.0, 1e-14];

/// Returns in words what is wrong with the volumes that a solid has in common with itself in its place, with itself
/// turned and shifted, and with another one that is laid about its centre.
pub(super) fn violations(rng: &mut Rng, [a, b]: [&Model; 2]) -> Vec<String> {
    let any = |rng: &mut Rng| DVec3::new(rng.f64() - 0.5, rng.f64() - 0.5, rng.f64() - 0.5);
    let (size, center) = (a.bounding_box().diagonal(), a.bounding_box().center());
    let shift = SHIFTS[rng.usize(0..SHIFTS.len())] * size * any(rng);
    let turn = DQuat::from_scaled_axis(3.0 * any(rng));
    let turned = center - turn * center + 0.4 * size * any(rng);
    let between = b.bounding_box().center() - center + 0.4 * size * any(rng);
    let mut found = Vec::new();
    for (models, turn, shift) in
        [([a, a], DQuat::IDENTITY, shift), ([a, a], turn, turned), ([a, b], DQuat::IDENTITY, between)]
    {
        let Ok(transform) = RigidTransform::new(turn, shift) else { continue };
        let wrong = of_pair(rng, models, transform);
        found.extend(wrong.into_iter().map(|what| format!("the volume in common by {transform:?}: {what}")));
    }
    found
}

fn of_pair(rng: &mut Rng, models: [&Model; 2], transform: RigidTransform) -> Vec<String> {
    let [Ok(a), Ok(b)] = models.map(PreparedModel::new) else { return Vec::new() };
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
    let is_same = std::ptr::eq(models[0], models[1]) && transform == RigidTransform::IDENTITY;
    if is_same && !found.ratio.is_some_and(|ratio| ratio.contains(1.0)) {
        wrong.push(format!("the ratio of a solid to itself is {:?}", found.ratio));
    }
    let boxes = models.map(Model::bounding_box);
    wrong.extend(by_points(rng, [&a, &b], boxes, &transform, volumes.intersection));
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

/// Compares with the number of points that are inside both by their certain sides, which `sides` checks: two at random
/// in each cell of a grid over a box of all common points. Rays through triangles would leave too many points open.
fn by_points(
    rng: &mut Rng,
    models: [&PreparedModel; 2],
    boxes: [Aabb; 2],
    transform: &RigidTransform,
    stated: Interval,
) -> Option<String> {
    let (turn, shift) = (transform.rotation(), transform.offset());
    let (middle, reach) = (turn * boxes[0].center() + shift, 0.5 * boxes[0].diagonal());
    let low = (middle - reach).max(boxes[1].min);
    let extent = ((middle + reach).min(boxes[1].max) - low).max(DVec3::ZERO);
    let is_inside = |index: usize, point: DVec3| match models[index].side(point.to_array()) {
        Side::Inside => Some(true),
        Side::Outside => Some(false),
        _ => None,
    };
    let is_common = |point: DVec3| match is_inside(0, turn.inverse() * (point - shift)) {
        Some(false) => Some(false),
        of_a => match is_inside(1, point) {
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
