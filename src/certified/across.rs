//! The patches of A that go on where one ends.

use super::Operand;
use crate::closest::{nearest_control, newton};

/// Distance between patches that count as joined, relative to the box around
/// A: a guess where to go on is all that hangs on it.
const JOINED: f64 = 1e-9;

/// Newton steps from a start, for a point of the patch.
const ITERATIONS: u32 = 16;

/// Other patches that have a patch's point at these parameters, if it is on an
/// edge, with its parameters there. O(log patches).
pub(super) fn across(side: &Operand<'_>, index: u32, parameters: [f64; 2]) -> Vec<(u32, [f64; 2])> {
    let mut joined = Vec::new();
    let tree = &side.target.tree;
    let is_inside = parameters.iter().all(|&parameter| parameter > 0.0 && parameter < 1.0);
    let Some(root) = tree.nodes().first().filter(|_| !is_inside) else { return joined };
    let most = JOINED * JOINED * root.aabb.diagonal() * root.aabb.diagonal();
    let point = side.patch(index).point(parameters);
    for leaf in tree.leaves_within(point, most) {
        let other = tree.primitive(&leaf);
        if other == index {
            continue;
        }
        let patch = side.patch(other);
        let foot = newton(&patch, point, nearest_control(&patch, point), ITERATIONS);
        if foot.distance_squared <= most {
            joined.push((other, foot.parameters));
        }
    }
    joined
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::bezier::extract;
    use crate::closest::Target;
    use crate::shapes::shape;

    /// On a closed surface every edge's point is one of another patch too, and
    /// none inside is.
    #[test]
    fn a_torus_goes_on_across_every_edge() {
        let Ok(model) = shape("torus") else { unreachable!() };
        let target = Target::new(extract(&model).patches);
        let side = Operand::new(&target, &[]);
        for index in 0..target.patches.len() as u32 {
            assert!(across(&side, index, [0.5, 0.3]).is_empty());
            for parameters in [[0.0, 0.3], [1.0, 0.7], [0.2, 0.0], [0.9, 1.0], [1.0, 1.0]] {
                let joined = across(&side, index, parameters);
                let point = side.patch(index).point(parameters);
                assert!(!joined.is_empty(), "{index} {parameters:?}");
                for (other, parameters) in joined {
                    assert!(other != index);
                    assert!(side.patch(other).point(parameters).distance(point) < 1e-8);
                }
            }
        }
    }
}
