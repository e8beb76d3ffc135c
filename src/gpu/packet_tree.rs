//! The tree that the threads of a subgroup go through together.

use super::layouts::Node;
use super::upload_target::leaf_place;
use crate::bvh::Bvh;

/// No box: farther from everything than any distance.
const EMPTY: Node = Node { box_min: [f32::MAX; 3], place: 0, box_max: [f32::MIN; 3], second: 0 };

/// The children of all nodes, `lanes` a node and the root's first, from a tree
/// of single boxes: of a binary tree's nodes, the largest are opened until
/// there are as many as `lanes`. `pack` is given a node and its place, as
/// `project_packet.wgsl` reads it. O(n lanes^2).
pub(super) fn packet_nodes(
    tree: &Bvh,
    lanes: usize,
    pack: &dyn Fn(&crate::bvh::Node, u32) -> Node,
) -> Vec<Node> {
    let nodes = tree.nodes();
    let of = |index: u32| &nodes[index as usize];
    let mut packed = Vec::new();
    // Roots of the nodes, in order.
    let mut roots: Vec<u32> = if nodes.is_empty() { Vec::new() } else { vec![0] };
    let mut next = 0;
    while next < roots.len() {
        let mut children = vec![roots[next]];
        next += 1;
        while children.len() < lanes {
            let size = |index: u32| of(index).aabb.diagonal();
            let inner = (0..children.len()).filter(|&place| !of(children[place]).is_leaf());
            let largest = inner.max_by(|&a, &b| size(children[a]).total_cmp(&size(children[b])));
            let Some(place) = largest else { break };
            let opened = children[place];
            children[place] = opened + 1;
            children.push(of(opened).right_child);
        }
        for &child in &children {
            let place = if of(child).is_leaf() {
                leaf_place(of(child))
            } else {
                roots.push(child);
                2 * (roots.len() as u32 - 1)
            };
            packed.push(pack(of(child), place));
        }
        packed.resize(next * lanes, EMPTY);
    }
    packed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bvh::Aabb;
    use glam::DVec3;

    /// Bounds of a node of the kernel's tree, and the patches below.
    fn below(nodes: &[Node], lanes: usize, node: usize, seen: &mut Vec<u32>) -> [[f32; 3]; 2] {
        let mut whole = [[f32::MAX; 3], [f32::MIN; 3]];
        for child in &nodes[node * lanes..(node + 1) * lanes] {
            if child == &EMPTY {
                continue;
            }
            if child.place % 2 == 1 {
                seen.push(child.place / 2);
            } else {
                let [low, high] = below(nodes, lanes, child.place as usize / 2, seen);
                assert_eq!((low, high), (child.box_min, child.box_max));
            }
            let [low, high] = &mut whole;
            low.iter_mut().zip(child.box_min).for_each(|(low, x)| *low = low.min(x));
            high.iter_mut().zip(child.box_max).for_each(|(high, x)| *high = high.max(x));
        }
        whole
    }

    #[test]
    fn every_patch_is_below_the_root_once_in_boxes_around_those_below() {
        let mut random = fastrand::Rng::with_seed(1);
        let pack = |of: &crate::bvh::Node, place| Node {
            box_min: of.aabb.min.to_array().map(|x| x as f32),
            place,
            box_max: of.aabb.max.to_array().map(|x| x as f32),
            second: 0,
        };
        for (count, lanes) in [(1, 8), (2, 4), (8, 8), (9, 8), (100, 4), (1000, 8), (333, 16)] {
            let mut point = || DVec3::new(random.f64(), random.f64(), random.f64());
            let boxes: Vec<Aabb> = (0..count).map(|_| Aabb::EMPTY.with(point()).with(point())).collect();
            let nodes = packet_nodes(&Bvh::new(&boxes), lanes, &pack);
            let mut seen = Vec::new();
            below(&nodes, lanes, 0, &mut seen);
            seen.sort_unstable();
            assert!(seen.iter().copied().eq(0..count), "{count} {lanes}");
            assert!(nodes.len() / lanes <= (count as usize).max(1));
        }
    }
}
