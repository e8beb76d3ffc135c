//! Support points: where a model extends farthest in a direction.

use super::super::Operand;
use crate::bvh::Aabb;
use glam::{DVec3, Vec4Swizzles};

/// The patch of a model whose control points extend farthest along a
/// direction, and the parameters (i/p, j/q) of the control point that does;
/// `None` for a model without patches. O(log patches) in general position.
///
/// Of a model and its copy moved by t, no point of the copy is farther from the
/// model than |t|, and the support point along t is that far, as the model
/// lies on one side of a plane through it.
pub(super) fn support_point(operand: &Operand<'_>, direction: DVec3) -> Option<(u32, [f64; 2])> {
    let tree = &operand.target.tree;
    let mut best = (f64::NEG_INFINITY, None);
    let mut stack = vec![0];
    while let Some(index) = stack.pop() {
        let node = tree.nodes().get(index)?;
        if support_value(&node.aabb, direction) <= best.0 {
            continue;
        }
        if !node.is_leaf() {
            let [left, right] = [index + 1, node.right_child as usize];
            let [of_left, of_right] =
                [left, right].map(|child| support_value(&tree.nodes()[child].aabb, direction));
            stack.extend_from_slice(&if of_left > of_right { [right, left] } else { [left, right] });
            continue;
        }
        let patch = operand.patch(tree.primitive(node));
        let [p, q] = patch.degree;
        for (index, control) in patch.controls.iter().enumerate() {
            let value = (patch.center + control.xyz() / control.w).dot(direction);
            if value > best.0 {
                let (i, j) = (index / (q + 1), index % (q + 1));
                let parameters = [i as f64 / p as f64, j as f64 / q as f64];
                best = (value, Some((tree.primitive(node), parameters)));
            }
        }
    }
    best.1
}

/// The support function of a box.
fn support_value(aabb: &Aabb, direction: DVec3) -> f64 {
    (aabb.min * direction).max(aabb.max * direction).element_sum()
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::bezier::extract;
    use crate::closest::Target;
    use crate::shapes::shape;

    /// No control point lies farther along the direction than the one found.
    #[test]
    fn no_control_point_lies_beyond_the_support_point() {
        let random = &mut fastrand::Rng::with_seed(21);
        for name in ["bottle", "torus", "wavy-sheet", "naca-wing"] {
            let Ok(model) = shape(name) else { unreachable!() };
            let target = Target::new(extract(&model).patches);
            let operand = Operand::new(&target, &[]);
            for _ in 0..20 {
                let direction = DVec3::from_array([0; 3].map(|_| 2.0 * random.f64() - 1.0));
                let Some((index, [s, t])) = support_point(&operand, direction) else { unreachable!() };
                let patch = operand.patch(index);
                let [p, q] = patch.degree;
                let place = (s * p as f64).round() as usize * (q + 1) + (t * q as f64).round() as usize;
                let along = |patch: &crate::bezier::Patch<'_>, place: usize| {
                    (patch.center + patch.controls[place].xyz() / patch.controls[place].w).dot(direction)
                };
                let found = along(&patch, place);
                for patch in target.patches.iter() {
                    assert!((0..patch.controls.len()).all(|place| along(&patch, place) <= found), "{name}");
                }
            }
        }
    }
}
