// Stage `project`: the nearest foot of every sample on one group of B's
// patches, as `src/iteration/project.rs`. One thread a sample.

struct ProjectParams {
    first_sample: u32,
    sample_count: u32,
    // The patches tried without a tree; the nodes' patches count from 0.
    first_patch: u32,
    patch_count: u32,
    // Number of patches in the groups before this one.
    patches_before: u32,
    iterations: u32,
    step_tolerance: f32,
    padding: u32,
}

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

// A box this much nearer than the best is still visited, so that rounding
// rules out no patch that could win.
const BOX_ROUNDING: f32 = 1.0 - 1e-6;

// Turns of all loops that one thread may take: llvmpipe ends every loop after
// 65,535, counted over the up to 16 threads that it runs together.
const MOST_TURNS: u32 = 4000u;

@group(0) @binding(0) var<uniform> params: ProjectParams;
@group(0) @binding(1) var<storage, read> samples: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> best: array<Best>;
@group(0) @binding(3) var<storage, read> controls: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read> centers: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read> nodes: array<Node>;

// Turns of an evaluation, whose rows may be looped over; loading the patch and
// finding its nearest control take no more.
const TURNS_OF_EVALUATION: u32 = P + 2u;

struct Search {
    known: Best,
    turns: u32,
}

fn offer(before: Search, patch_index: u32, point: vec3<f32>) -> Search {
    let local = point - centers[patch_index].xyz;
    let found = foot(patch_index * PATCH_SIZE, local, params.iterations, params.step_tolerance);
    var after = before;
    after.turns += (found.evaluations + 1u) * TURNS_OF_EVALUATION;
    if found.distance_squared < before.known.distance_squared {
        let packed = (params.patches_before + patch_index) | (found.status << STATUS_SHIFT);
        after.known = Best(found.distance_squared, packed, found.at.x, found.at.y);
    }
    return after;
}

fn box_distance_squared(node: u32, point: vec3<f32>) -> f32 {
    let outside = max(max(nodes[node].box_min - point, point - nodes[node].box_max), vec3<f32>(0.0));
    return dot(outside, outside) * BOX_ROUNDING;
}

fn thread(id: vec3<u32>, groups: vec3<u32>) -> u32 {
    return id.x + id.y * groups.x * WORKGROUP_SIZE;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn project_all(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let index = thread(id, groups);
    let exists = index < params.sample_count;
    let sample = params.first_sample + index;
    join();
    // The host keeps the number of patches within the turns of all threads.
    var search = Search(best[sample], 0u);
    let point = samples[sample].xyz;
    for (var k = 0u; k < params.patch_count; k++) {
        take((params.first_patch + k) * PATCH_SIZE, exists);
        if exists {
            search = offer(search, params.first_patch + k, point);
        }
    }
    if exists {
        best[sample] = search.known;
    }
}

// Every thread looks for its next patch, then all project at once: the
// projections are what takes long.
@compute @workgroup_size(WORKGROUP_SIZE)
fn project_tree(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let index = thread(id, groups);
    let exists = index < params.sample_count;
    let sample = params.first_sample + index;
    join();
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
            if search.turns > MOST_TURNS {
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
        let found = place != NOWHERE;
        if !any_of(found) {
            break;
        }
        let next = place >> 1u;
        take(next * PATCH_SIZE, found);
        if found {
            search = offer(search, next, point);
            place = NOWHERE;
        }
    }
    if exists {
        best[sample] = search.known;
    }
}
