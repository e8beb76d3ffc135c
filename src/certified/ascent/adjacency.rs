//! Adjacency of patches over shared edges, found from their geometry.

use super::super::Operand;
use crate::closest::{nearest_control, newton};

/// Distance up to which patches count as joined, relative to the diagonal of
/// A's box. Only the choice where to continue depends on it.
const JOIN_TOLERANCE: f64 = 1e-9;

/// Bound on the Newton steps from a start, for a point of the patch.
const MAX_ITERATIONS: u32 = 16;

/// Returns the other patches that contain a patch's point at these parameters,
/// if it is on an edge, with its parameters there. O(log patches).
pub(super) fn adjacent_patches(
    operand: &Operand<'_>,
    index: u32,
    parameters: [f64; 2],
) -> Vec<(u32, [f64; 2])> {
    let mut adjacent = Vec::new();
    let tree = &operand.target.tree;
    let is_inside = parameters.iter().all(|&parameter| parameter > 0.0 && parameter < 1.0);
    let Some(root) = tree.nodes().first().filter(|_| !is_inside) else { return adjacent };
    let tolerance_squared = (JOIN_TOLERANCE * root.aabb.diagonal()).powi(2);
    let point = operand.patch(index).point(parameters);
    for leaf in tree.leaves_within(point, tolerance_squared) {
        let other = tree.primitive(&leaf);
        if other == index {
            continue;
        }
        let patch = operand.patch(other);
        let foot = newton(&patch, point, nearest_control(&patch, point), MAX_ITERATIONS);
        if foot.distance_squared <= tolerance_squared {
            adjacent.push((other, foot.parameters));
        }
    }
    adjacent
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::bezier::extract;
    use crate::closest::Target;
    use crate::shapes::shape;

    /// On a closed surface every point of an edge belongs to another patch too,
    /// and no inner point does.
    #[test]
    fn every_edge_of_a_torus_has_an_adjacent_patch() {
        let Ok(model) = shape("torus") else { unreachable!() };
        let target = Target::new(extract(&model).patches);
        let operand = Operand::new(&target, &[]);
        for index in 0..target.patches.len() as u32 {
            assert!(adjacent_patches(&operand, index, [0.5, 0.3]).is_empty());
            for parameters in [[0.0, 0.3], [1.0, 0.7], [0.2, 0.0], [0.9, 1.0], [1.0, 1.0]] {
                let joined = adjacent_patches(&operand, index, parameters);
                let point = operand.patch(index).point(parameters);
                assert!(!joined.is_empty(), "{index} {parameters:?}");
                for (other, parameters) in joined {
                    assert!(other != index);
                    assert!(operand.patch(other).point(parameters).distance(point) < 1e-8);
                }
            }
        }
    }
}
