// Stage `extremes`: the bounds of the directed distance, which are the largest
// of the level's boxes of A. CPU twin: `extremes` of
// `src/hierarchy/traversal.rs`. One thread per box.

// Complements, as `bound` writes them.
struct Bound {
    near: u32,
    far: u32,
}

@group(0) @binding(0) var<uniform> params: StageParams;
@group(0) @binding(1) var<storage, read> bounds: array<Bound>;
@group(0) @binding(2) var<storage, read_write> totals: Totals;

@compute @workgroup_size(WORKGROUP_SIZE)
fn extremes(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let index = params.first + thread(id, groups);
    // A box without a bound was culled on an earlier level.
    if index >= params.end || bounds[index].far == 0u {
        return;
    }
    atomicMax(&totals.near, ~bounds[index].near);
    atomicMax(&totals.far, ~bounds[index].far);
}
