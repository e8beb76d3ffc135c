// Stage `cull`: the pairs of the next level that may contain the distance. CPU
// twin: `Traversal::cull` of `src/hierarchy/traversal.rs`. All pairs are
// counted; those beyond the capacity are not stored. One thread per pair.

// Complements, as `bound` writes them.
struct Bound {
    near: u32,
    far: u32,
}

@group(0) @binding(0) var<uniform> params: StageParams;
@group(0) @binding(1) var<storage, read> pairs: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> nodes_a: array<Children>;
@group(0) @binding(3) var<storage, read> nodes_b: array<Children>;
@group(0) @binding(4) var<storage, read> boxes_a: array<Box>;
@group(0) @binding(5) var<storage, read> boxes_b: array<Box>;
@group(0) @binding(6) var<storage, read> bounds: array<Bound>;
@group(0) @binding(7) var<storage, read_write> totals: Totals;
@group(0) @binding(8) var<storage, read_write> next_pairs: array<vec2<u32>>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn cull(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let index = params.first + thread(id, groups);
    if index >= params.end {
        return;
    }
    let children_a = nodes_a[pairs[index].x];
    let children_b = nodes_b[pairs[index].y];
    let lower = atomicLoad(&totals.near);
    for (var i = children_a.first; i < children_a.first + children_a.count; i++) {
        let upper = ~bounds[i].far;
        if upper < lower {
            continue;
        }
        let a = boxes_a[i];
        for (var j = children_b.first; j < children_b.first + children_b.count; j++) {
            if bitcast<u32>(near(a, boxes_b[j])) <= upper {
                let next = atomicAdd(&totals.pairs, 1u);
                if next < params.capacity {
                    next_pairs[next] = vec2<u32>(i, j);
                }
            }
        }
    }
}
