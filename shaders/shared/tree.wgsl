// The bounding volume hierarchy over a group's patches. CPU twin:
// `src/bvh/tree.rs`. It is bound after the patches' centres.

struct Node {
    box_min: vec3<f32>,
    // Twice the patch plus one for a leaf, twice its own index for an inner node.
    code: u32,
    box_max: vec3<f32>,
    // The left child is the node after its parent.
    right_child: u32,
}

// The code of no node; odd, like those of leaves.
const NO_NODE: u32 = 0xffffffffu;

// Deeper than any BVH over the patches of one binding.
const STACK_SIZE: u32 = 32u;

// Boxes are tested by slightly less than their squared distance, so that
// rounding excludes no patch with the nearest point.
const BOX_ROUNDING: f32 = 1.0 - 1e-6;

@group(0) @binding(5) var<storage, read> nodes: array<Node>;

// A lower bound on the squared distance from `point` to what the node contains.
fn box_distance_squared(node: u32, point: vec3<f32>) -> f32 {
    let outside = max(max(nodes[node].box_min - point, point - nodes[node].box_max), vec3<f32>(0.0));
    return dot(outside, outside) * BOX_ROUNDING;
}
