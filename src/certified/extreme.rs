//! Where A goes farthest in one direction.

use super::Operand;
use crate::bvh::Aabb;
use glam::{DVec3, Vec4Swizzles};

/// The patch of a model whose controls go farthest along a direction, and the
/// parameters (i/p, j/q) of the control that does; `None` for a model without
/// patches. O(log patches) in general position.
///
/// Of a model and its copy moved by t, no point of the copy is farther from the
/// model than |t|, and the one farthest along t is that far, as the model
/// lies on one side of a plane through it.
pub(super) fn extreme(side: &Operand<'_>, direction: DVec3) -> Option<(u32, [f64; 2])> {
    let tree = &side.target.tree;
    let mut best = (f64::NEG_INFINITY, None);
    let mut waiting = vec![0];
    while let Some(place) = waiting.pop() {
        let node = tree.nodes().get(place)?;
        if reach(&node.aabb, direction) <= best.0 {
            continue;
        }
        if !node.is_leaf() {
            let [first, second] = [place + 1, node.right_child as usize];
            let [of_first, of_second] =
                [first, second].map(|child| reach(&tree.nodes()[child].aabb, direction));
            waiting.extend_from_slice(&if of_first > of_second { [second, first] } else { [first, second] });
            continue;
        }
        let patch = side.patch(tree.primitive(node));
        let [p, q] = patch.degree;
        for (place, control) in patch.controls.iter().enumerate() {
            let along = (patch.center + control.xyz() / control.w).dot(direction);
            if along > best.0 {
                let (i, j) = (place / (q + 1), place % (q + 1));
                let parameters = [i as f64 / p as f64, j as f64 / q as f64];
                best = (along, Some((tree.primitive(node), parameters)));
            }
        }
    }
    best.1
}

/// How far a box goes along a direction.
fn reach(aabb: &Aabb, direction: DVec3) -> f64 {
    (aabb.min * direction).max(aabb.max * direction).element_sum()
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::bezier::extract;
    use crate::closest::Target;
    use crate::shapes::shape;

    /// No control goes farther than the one told.
    #[test]
    fn no_control_goes_farther_than_the_extreme() {
        let random = &mut fastrand::Rng::with_seed(21);
        for name in ["bottle", "torus", "wavy-sheet", "naca-wing"] {
            let Ok(model) = shape(name) else { unreachable!() };
            let target = Target::new(extract(&model).patches);
            let side = Operand::new(&target, &[]);
            for _ in 0..20 {
                let direction = DVec3::from_array([0; 3].map(|_| 2.0 * random.f64() - 1.0));
                let Some((index, [s, t])) = extreme(&side, direction) else { unreachable!() };
                let patch = side.patch(index);
                let [p, q] = patch.degree;
                let place = (s * p as f64).round() as usize * (q + 1) + (t * q as f64).round() as usize;
                let along = |patch: &crate::bezier::Patch<'_>, place: usize| {
                    (patch.center + patch.controls[place].xyz() / patch.controls[place].w).dot(direction)
                };
                let told = along(&patch, place);
                for patch in target.patches.iter() {
                    assert!((0..patch.controls.len()).all(|place| along(&patch, place) <= told), "{name}");
                }
            }
        }
    }
}
