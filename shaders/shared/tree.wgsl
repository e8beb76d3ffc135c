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

// A descent to the leaves whose boxes are nearer than a limit that never rises.
struct Descent {
    // Nodes that wait, with lower bounds on their squared distances.
    codes: array<u32, STACK_SIZE>,
    distances: array<f32, STACK_SIZE>,
    height: u32,
    // The node from which the descent goes on, NO_NODE for one that waits.
    code: u32,
    // The least of these bounds of nodes that were passed over before they waited.
    passed: f32,
}

fn start_descent(descent: ptr<function, Descent>) {
    (*descent).height = 0u;
    (*descent).code = nodes[0].code;
    (*descent).passed = UNKNOWN_DISTANCE;
}

// Returns the patch of the next leaf, the nearer child first; NO_NODE after the last.
fn next_leaf(descent: ptr<function, Descent>, point: vec3<f32>, limit: f32) -> u32 {
    var code = (*descent).code;
    var height = (*descent).height;
    while (code & 1u) == 0u || (code == NO_NODE && height > 0u) {
        while code == NO_NODE && height > 0u {
            height--;
            if (*descent).distances[height] < limit {
                code = (*descent).codes[height];
            }
        }
        if (code & 1u) == 0u {
            let left = (code >> 1u) + 1u;
            let right = nodes[left - 1u].right_child;
            let left_distance = box_distance_squared(left, point);
            let right_distance = box_distance_squared(right, point);
            let right_is_nearer = right_distance < left_distance;
            let near = min(left_distance, right_distance);
            let far = max(left_distance, right_distance);
            let left_code = nodes[left].code;
            let right_code = nodes[right].code;
            code = NO_NODE;
            if near < limit {
                code = select(left_code, right_code, right_is_nearer);
            } else {
                (*descent).passed = min((*descent).passed, near);
            }
            if far < limit {
                (*descent).codes[height] = select(right_code, left_code, right_is_nearer);
                (*descent).distances[height] = far;
                height++;
            } else {
                (*descent).passed = min((*descent).passed, far);
            }
        }
    }
    (*descent).height = height;
    (*descent).code = NO_NODE;
    return select(code >> 1u, NO_NODE, code == NO_NODE);
}
