// Stage `reduce`: the farthest sample of every block of BLOCK_SIZE samples,
// and how its projections ended. CPU twin: `src/iteration/reduce.rs`. One
// workgroup per block.

struct ReduceParams {
    sample_count: u32,
}

struct Block {
    farthest: Projected,
    sample: u32,
    // Numbers of samples by status.
    converged: u32,
    iteration_limit: u32,
    on_edge: u32,
}

@group(0) @binding(0) var<uniform> params: ReduceParams;
@group(0) @binding(1) var<storage, read> projected: array<Projected>;
@group(0) @binding(2) var<storage, read_write> blocks: array<Block>;

// The farthest sample of every thread.
var<workgroup> distances: array<f32, WORKGROUP_SIZE>;
var<workgroup> farthest: array<u32, WORKGROUP_SIZE>;
// Indexed by status.
var<workgroup> counts: array<atomic<u32>, 3>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn reduce(@builtin(local_invocation_index) local: u32, @builtin(workgroup_id) group: vec3<u32>) {
    let first = group.x * BLOCK_SIZE;
    let end = min(first + BLOCK_SIZE, params.sample_count);
    var sample = first;
    var largest = -1.0;
    for (var index = first + local; index < end; index += WORKGROUP_SIZE) {
        // Not `>`: a NaN counts as larger, and float64 then decides.
        if !(projected[index].distance_squared <= largest) {
            largest = projected[index].distance_squared;
            sample = index;
        }
        atomicAdd(&counts[min(projected[index].patch_and_status >> STATUS_SHIFT, ON_EDGE)], 1u);
    }
    distances[local] = largest;
    farthest[local] = sample;
    workgroupBarrier();
    for (var half = WORKGROUP_SIZE / 2u; half > 0u; half /= 2u) {
        if local < half && !(distances[local + half] <= distances[local]) {
            distances[local] = distances[local + half];
            farthest[local] = farthest[local + half];
        }
        workgroupBarrier();
    }
    if local == 0u {
        blocks[group.x] = Block(
            projected[farthest[0]],
            farthest[0],
            atomicLoad(&counts[CONVERGED]),
            atomicLoad(&counts[ITERATION_LIMIT]),
            atomicLoad(&counts[ON_EDGE]),
        );
    }
}
