// Stage `project`: the nearest foot of every sample on one group of B's
// patches. CPU twin: `src/iteration/project.rs`. One thread per sample.
// `project_all` projects on all patches; `project_tree.wgsl` may follow.

struct ProjectParams {
    // The dispatch's first thread.
    first_thread: u32,
    sample_count: u32,
    // The patches of `project_all`. Patches are counted within the group.
    first_patch: u32,
    patch_count: u32,
    // Number of patches in the groups before this one.
    patches_before: u32,
    iterations: u32,
    step_tolerance: f32,
    // Samples of a row, or 0 where samples do not lie in rows.
    column_count: u32,
}

@group(0) @binding(0) var<uniform> params: ProjectParams;
@group(0) @binding(1) var<storage, read> samples: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> projected: array<Projected>;
@group(0) @binding(3) var<storage, read> controls: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read> centers: array<vec4<f32>>;

// The nearer one of a known foot and the foot on one patch.
fn offer(best: Projected, patch_index: u32, point: vec3<f32>) -> Projected {
    let local = point - centers[patch_index].xyz;
    let foot = iterate(patch_index * PATCH_SIZE, local, params.iterations, params.step_tolerance);
    if foot.distance_squared < best.distance_squared {
        let packed = (params.patches_before + patch_index) | (foot.status << STATUS_SHIFT);
        return Projected(foot.distance_squared, packed, foot.parameters.x, foot.parameters.y);
    }
    return best;
}

// The sample of a thread. Neighbouring threads have samples of one tile,
// whose searches visit about the same nodes.
fn sample_of(id: vec3<u32>, groups: vec3<u32>) -> u32 {
    let index = params.first_thread + id.x + id.y * groups.x * WORKGROUP_SIZE;
    if params.column_count == 0u {
        return index;
    }
    let tiles_per_row = (params.column_count + TILE_COLUMNS - 1u) / TILE_COLUMNS;
    let tile = index / (TILE_COLUMNS * TILE_ROWS);
    let tile_row = tile / tiles_per_row;
    let column = (tile - tile_row * tiles_per_row) * TILE_COLUMNS + index % TILE_COLUMNS;
    let row = tile_row * TILE_ROWS + index / TILE_COLUMNS % TILE_ROWS;
    return select(params.sample_count, row * params.column_count + column, column < params.column_count);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn project_all(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let sample = sample_of(id, groups);
    if sample >= params.sample_count {
        return;
    }
    var best = projected[sample];
    let point = samples[sample].xyz;
    for (var k = 0u; k < params.patch_count; k++) {
        best = offer(best, params.first_patch + k, point);
    }
    projected[sample] = best;
}
