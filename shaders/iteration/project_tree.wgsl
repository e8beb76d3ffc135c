// Stage `project` with a tree, every thread on its own.

struct Node {
    box_min: vec3<f32>,
    // Of a leaf, twice its patch and one, else twice its own index.
    place: u32,
    box_max: vec3<f32>,
    // Index of the second child; the first follows its parent.
    second: u32,
}

// No place.
const NOWHERE: u32 = 0xffffffffu;

// Deeper than any tree over the patches that fit a binding.
const STACK_SIZE: u32 = 32u;

// Turns of all loops that one thread may take: llvmpipe ends every loop after
// 65,535, counted over the up to 16 threads that it runs together.
const MAX_TURNS: u32 = 4000u;

@group(0) @binding(5) var<storage, read> nodes: array<Node>;

fn box_distance_squared(node: u32, point: vec3<f32>) -> f32 {
    let outside = max(max(nodes[node].box_min - point, point - nodes[node].box_max), vec3<f32>(0.0));
    return dot(outside, outside) * BOX_ROUNDING;
}

// Every thread looks for its next patch, then all project at once: the
// projections are what takes long.
@compute @workgroup_size(WORKGROUP_SIZE)
fn project_tree(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let sample = sample_of(id, groups);
    let exists = sample < params.sample_count;
    let point = samples[sample].xyz;
    var search = Search(best[sample], 0u);
    var waiting: array<u32, STACK_SIZE>;
    var distances: array<f32, STACK_SIZE>;
    var height = 0u;
    var place = select(NOWHERE, nodes[0].place, exists);
    loop {
        // Down to the nearest leaf; even places are those of inner nodes.
        while (place & 1u) == 0u || (place == NOWHERE && height > 0u) {
            search.turns++;
            if search.turns > MAX_TURNS {
                // Not tried on everything: the distance may be too large, never too small.
                search.known.patch_and_status = (search.known.patch_and_status & PATCH_MASK)
                    | (ITERATION_LIMIT << STATUS_SHIFT);
                place = NOWHERE;
                height = 0u;
                break;
            }
            while place == NOWHERE && height > 0u {
                search.turns++;
                height--;
                if distances[height] < search.known.distance_squared {
                    place = waiting[height];
                }
            }
            if (place & 1u) == 0u {
                let first = (place >> 1u) + 1u;
                let second = nodes[first - 1u].second;
                let one = box_distance_squared(first, point);
                let two = box_distance_squared(second, point);
                let swap = two < one;
                let far = max(one, two);
                let places = vec2<u32>(nodes[first].place, nodes[second].place);
                place = select(NOWHERE, select(places.x, places.y, swap), min(one, two) < search.known.distance_squared);
                if far < search.known.distance_squared {
                    waiting[height] = select(places.y, places.x, swap);
                    distances[height] = far;
                    height++;
                }
            }
        }
        if place == NOWHERE {
            break;
        }
        search = offer(search, place >> 1u, point);
        place = NOWHERE;
    }
    if exists {
        best[sample] = search.known;
    }
}
