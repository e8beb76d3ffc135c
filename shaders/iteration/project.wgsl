// Stage `project`: the nearest foot of every sample on one group of B's
// patches, as `src/iteration/project.rs`. One thread a sample.

struct ProjectParams {
    // The chunk's first thread; of its threads, those with a sample below the count work.
    first_thread: u32,
    sample_count: u32,
    // The patches tried without a tree; the nodes' patches count from 0.
    first_patch: u32,
    patch_count: u32,
    // Number of patches in the groups before this one.
    patches_before: u32,
    iterations: u32,
    step_tolerance: f32,
    // Samples of a row, or 0 where they do not lie in rows.
    columns: u32,
}

// A box this much nearer than the best is still visited, so that rounding
// rules out no patch that could win.
const BOX_ROUNDING: f32 = 1.0 - 1e-6;

@group(0) @binding(0) var<uniform> params: ProjectParams;
@group(0) @binding(1) var<storage, read> samples: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> best: array<Best>;
@group(0) @binding(3) var<storage, read> controls: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read> centers: array<vec4<f32>>;

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

// Threads next to each other have samples close together, whose searches go
// the same way: eight have four columns of two rows, in the order of `Plan::new`.
fn sample_of(id: vec3<u32>, groups: vec3<u32>) -> u32 {
    let index = params.first_thread + id.x + id.y * groups.x * WORKGROUP_SIZE;
    if params.columns == 0u {
        return index;
    }
    let across = (params.columns + 3u) / 4u;
    let tile = index / 8u;
    let down = tile / across;
    let column = (tile - down * across) * 4u + index % 4u;
    let row = down * 2u + index / 4u % 2u;
    return select(params.sample_count, row * params.columns + column, column < params.columns);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn project_all(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let sample = sample_of(id, groups);
    if sample >= params.sample_count {
        return;
    }
    // The host keeps the number of patches within the turns of all threads.
    var search = Search(best[sample], 0u);
    let point = samples[sample].xyz;
    for (var k = 0u; k < params.patch_count; k++) {
        search = offer(search, params.first_patch + k, point);
    }
    best[sample] = search.known;
}
