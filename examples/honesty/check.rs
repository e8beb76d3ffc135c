//! One pair measured and checked.

use super::brute::{cloud, distance};
use super::evaluator::point;
use super::pairs::pair;
use glam::DVec3;
use nurbs_hausdorff::distance::{
    Backend, DistanceResult, Engine, Options, PreparedModel, Silent, SurfacePoint,
};
use nurbs_hausdorff::{Model, RigidTransform};

/// Cells a direction, so that a pair takes milliseconds.
const MOST_CELLS: usize = 4000;

/// Grid points along each direction of a surface: for a first look, and to make sure.
const GRID: usize = 17;
const DENSE: usize = 65;

/// Polished starts for a first look, and to make sure.
const STARTS: usize = 4;
const DENSE_STARTS: usize = 40;

/// The evaluator's own rounding relative to the largest coordinate.
const ROUNDING: f64 = 1e-13;

/// What checking a pair gave.
pub(crate) struct Outcome {
    pub(crate) converged: bool,
    pub(crate) cells: usize,
    pub(crate) violations: Vec<String>,
}

pub(crate) fn check(seed: u64) -> Outcome {
    let pair = pair(seed);
    let engine = pollster::block_on(Engine::new(Backend::Cpu)).unwrap();
    let options = Options {
        tolerance: pair.tolerance,
        max_cells: Some(MOST_CELLS),
        transform: pair.transform,
        symmetric: pair.symmetric,
        ..Options::default()
    };
    let (a, b) = (PreparedModel::new(&pair.a), PreparedModel::new(&pair.b));
    let result = pollster::block_on(engine.distance(&a, &b, &options, &mut Silent)).unwrap();
    let mut violations = Vec::new();
    let mut note = |what: String| violations.push(format!("seed {seed} ({}): {what}", pair.kind));
    let forward = result.forward.as_deref().unwrap_or(&result);
    let identity = RigidTransform::IDENTITY;
    check_direction(&pair.a, &pair.transform, &pair.b, &identity, forward, false, &mut note);
    if let Some(reverse) = &result.reverse {
        check_direction(&pair.b, &identity, &pair.a, &pair.transform, reverse, true, &mut note);
    }
    let details = result.certified.unwrap();
    Outcome { converged: result.converged, cells: details.cells, violations }
}

/// From one model to the other, each in its place; `reversed` if `from` is B.
fn check_direction(
    from: &Model,
    from_pose: &RigidTransform,
    to: &Model,
    to_pose: &RigidTransform,
    result: &DistanceResult,
    reversed: bool,
    note: &mut impl FnMut(String),
) {
    let DistanceResult { lower, upper, computed, witness, .. } = result;
    let boxes = [from.bounding_box(), to.bounding_box()];
    let largest =
        boxes.iter().map(|aabb| aabb.min.abs().max(aabb.max.abs()).max_element()).fold(0.0, f64::max);
    let rounding = ROUNDING * (largest + from_pose.offset().length() + to_pose.offset().length());
    if !(*lower <= *computed && *computed <= *upper) {
        note(format!("lower {lower}, computed {computed}, upper {upper}"));
    }
    let (start, end) = if reversed { (&witness.b, &witness.a) } else { (&witness.a, &witness.b) };
    for (model, pose, told) in [(from, from_pose, start), (to, to_pose, end)] {
        let off = placed(model, pose, told).distance(DVec3::from_array(told.point));
        if off > rounding {
            note(format!("a witness is {off} off its parameters"));
        }
    }
    let between = DVec3::from_array(start.point).distance(DVec3::from_array(end.point));
    if (between - computed).abs() > rounding {
        note(format!("the witnesses are {between} apart, computed {computed}"));
    }
    // Into the frame of the model measured to, where its grid is made.
    let into = |point: DVec3| to_pose.apply_inverse(point);
    let coarse = cloud(to, GRID);
    let witness_distance = distance(to, &coarse, GRID, into(DVec3::from_array(start.point)), DENSE_STARTS);
    if witness_distance < lower - rounding {
        note(format!("lower {lower}, but B is {witness_distance} from the witness"));
    }
    for sample in cloud(from, GRID) {
        let target = into(from_pose.apply(sample.point));
        let near = |point: DVec3| point.distance(target) <= *upper;
        if coarse.iter().any(|placed| near(placed.point)) {
            continue;
        }
        if distance(to, &coarse, GRID, target, STARTS) <= upper + rounding {
            continue;
        }
        let dense = distance(to, &cloud(to, DENSE), DENSE, target, DENSE_STARTS);
        if dense > upper + rounding {
            note(format!("upper {upper}, but a point of A is {dense} from B"));
            return;
        }
    }
}

fn placed(model: &Model, pose: &RigidTransform, told: &SurfacePoint) -> DVec3 {
    pose.apply(DVec3::from_array(point(&model.surfaces()[told.surface], told.u, told.v)))
}
