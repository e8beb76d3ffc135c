//! Tests of the work that finding a model's bodies takes.

use super::nesting::{Budget, MAX_PAIRS_OF_ALL, MIN_PAIRS, ShellBoxes};
use crate::engine::PreparedModel;
use crate::engine::prepared::shells::MAX_PAIRS;
use crate::model::{Model, RigidTransform};
use crate::param_box::ParamBox;
use crate::shapes::operations::{part, transformed};
use crate::shapes::sphere;
use glam::DVec3;

/// The distance of the halves of a ball, which a strip as wide joins.
const CRACK: f64 = 4e-5;

/// Concentric spheres, nearer to each other than the crack of a ball beside them is wide: strips of that width may
/// join any of them, so that no two are known to be apart.
fn spheres_within_a_crack(count: usize) -> PreparedModel {
    let mut surfaces = Vec::new();
    for place in 0..count {
        let whole = sphere(DVec3::ZERO, 1.0 - 1e-6 * place as f64).unwrap();
        surfaces.extend(whole.surfaces().iter().cloned());
    }
    let beside = sphere(DVec3::ZERO, 1.0).unwrap();
    for (along, height) in [([0.0, 0.5], -0.5 * CRACK), ([0.5, 1.0], 0.5 * CRACK)] {
        let half = part(&beside.surfaces()[0], ParamBox::new([0.0, 1.0], along)).unwrap();
        let moved = RigidTransform::translation(DVec3::new(5.0, 0.0, height)).unwrap();
        let half = transformed(&Model::new(None, vec![half]).unwrap(), &moved).unwrap();
        surfaces.extend(half.surfaces().iter().cloned());
    }
    PreparedModel::new(&Model::new(None, surfaces).unwrap()).unwrap()
}

/// Returns the numbers of comparisons of shells and of the pairs of cells that they bound.
fn work(model: &PreparedModel, mut budget: Budget) -> [usize; 2] {
    let shells = model.shell_parts();
    let boxes: Vec<ShellBoxes> = shells.iter().map(|shell| model.boxes_of(shell)).collect();
    let all = budget.left;
    let around = model.arounds(&shells, &boxes, &mut budget);
    assert!(around.iter().any(|around| !around.unknown.is_empty()));
    // Each pair of spheres counts in both directions, and one comparison decides both.
    [model.nested_boxes(&shells, &boxes).len() / 2, all - budget.left]
}

/// The work of all comparisons is bounded however many shells there are: each has a share of the budget, and ends
/// after it by no more than what is bounded at once.
#[test]
fn shells_that_are_not_told_apart_take_no_more_pairs_than_their_shares() {
    let [comparisons, alone] = work(&spheres_within_a_crack(2), Budget::default());
    assert!(comparisons == 1 && alone > 2 * MIN_PAIRS, "{alone}");
    let comparisons = 28;
    let [found, pairs] = work(&spheres_within_a_crack(8), Budget { left: comparisons * MIN_PAIRS });
    assert_eq!(found, comparisons);
    // As many comparisons without shares take 28 times those of one alone.
    assert!(pairs < comparisons * 7 * MIN_PAIRS / 4, "{pairs}");
}

#[test]
fn shares_are_of_what_is_left() {
    let mut budget = Budget::default();
    assert_eq!(budget.share(1), MAX_PAIRS);
    assert_eq!(budget.share(100), MAX_PAIRS_OF_ALL / 100);
    budget.spend(MAX_PAIRS_OF_ALL - 10);
    assert_eq!(budget.share(1), MIN_PAIRS);
    budget.spend(MAX_PAIRS_OF_ALL);
    assert_eq!(budget.share(7), MIN_PAIRS);
}
