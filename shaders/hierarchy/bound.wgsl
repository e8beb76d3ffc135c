// Stage `bound`: every box of A below a pair's, bounded by the boxes of B
// below it, as `Traversal::bound` of `src/hierarchy/traversal.rs`. One thread
// a pair.

struct Bound {
    near: atomic<u32>,
    far: atomic<u32>,
}

@group(0) @binding(0) var<uniform> params: StepParams;
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
    let of_a = nodes_a[pairs[index].x];
    let of_b = nodes_b[pairs[index].y];
    for (var i = of_a.first; i < of_a.first + of_a.count; i++) {
        let a = boxes_a[i];
        var nearest = FARTHEST;
        var least_far = FARTHEST;
        for (var j = of_b.first; j < of_b.first + of_b.count; j++) {
            nearest = min(nearest, near(a, boxes_b[j]));
            least_far = min(least_far, far(a, boxes_b[j]));
        }
        atomicMax(&bounds[i].near, complement(nearest));
        atomicMax(&bounds[i].far, complement(least_far));
    }
}
