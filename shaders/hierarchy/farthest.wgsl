// Stage `farthest`, on the last level: the cell of A with the largest lower
// bound, and the cell of B that gives its upper bound. CPU twin:
// `Traversal::farthest` of `src/hierarchy/traversal.rs`. One thread per cell in
// the first phase, per pair in the two others. The host generates the phases.

// Complements, as `bound` writes them.
struct Bound {
    near: u32,
    far: u32,
}

// All as complements, whose maximum is the least index or distance.
struct Farthest {
    a: atomic<u32>,
    far: atomic<u32>,
    b: atomic<u32>,
}

@group(0) @binding(0) var<uniform> params: StageParams;
@group(0) @binding(1) var<storage, read> bounds: array<Bound>;
@group(0) @binding(2) var<storage, read_write> totals: Totals;
@group(0) @binding(3) var<storage, read> pairs: array<vec2<u32>>;
@group(0) @binding(4) var<storage, read> boxes_a: array<Box>;
@group(0) @binding(5) var<storage, read> boxes_b: array<Box>;
@group(0) @binding(6) var<storage, read_write> found: Farthest;

@compute @workgroup_size(WORKGROUP_SIZE)
fn farthest(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let index = params.first + thread(id, groups);
    if index >= params.end {
        return;
    }
    if params.phase == PHASE_CELL {
        if bounds[index].far != 0u && ~bounds[index].near == atomicLoad(&totals.near) {
            atomicMax(&found.a, ~index);
        }
        return;
    }
    let pair = pairs[index];
    if pair.x != ~atomicLoad(&found.a) {
        return;
    }
    let bits = complement(far(boxes_a[pair.x], boxes_b[pair.y]));
    if params.phase == PHASE_DISTANCE {
        atomicMax(&found.far, bits);
    } else if bits == atomicLoad(&found.far) {
        atomicMax(&found.b, ~pair.y);
    }
}
