// Stage `bound`: bounds of the distance to B from every child of a pair's node
// of A, over the children of its node of B. CPU twin: `Traversal::bound` of
// `src/hierarchy/traversal.rs`. One thread per pair.

// Complements of the least bounds of all pairs with this box of A.
struct Bound {
    near: atomic<u32>,
    far: atomic<u32>,
}

@group(0) @binding(0) var<uniform> params: StageParams;
@group(0) @binding(1) var<storage, read> pairs: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> nodes_a: array<Children>;
@group(0) @binding(3) var<storage, read> nodes_b: array<Children>;
@group(0) @binding(4) var<storage, read> boxes_a: array<Box>;
@group(0) @binding(5) var<storage, read> boxes_b: array<Box>;
@group(0) @binding(6) var<storage, read_write> bounds: array<Bound>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn bound(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let index = params.first + thread(id, groups);
    if index >= params.end {
        return;
    }
    let children_a = nodes_a[pairs[index].x];
    let children_b = nodes_b[pairs[index].y];
    for (var i = children_a.first; i < children_a.first + children_a.count; i++) {
        let a = boxes_a[i];
        var min_near = UNKNOWN_DISTANCE;
        var min_far = UNKNOWN_DISTANCE;
        for (var j = children_b.first; j < children_b.first + children_b.count; j++) {
            min_near = min(min_near, near(a, boxes_b[j]));
            min_far = min(min_far, far(a, boxes_b[j]));
        }
        atomicMax(&bounds[i].near, complement(min_near));
        atomicMax(&bounds[i].far, complement(min_far));
    }
}
