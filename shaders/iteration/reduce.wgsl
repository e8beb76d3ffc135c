// Stage `reduce`: the largest of the least distances of every block of
// samples and where it is, as `src/iteration/reduce.rs`, and how many
// projections ended in which way. One workgroup a block.

struct ReduceParams {
    sample_count: u32,
    block_size: u32,
}

struct Block {
    best: Best,
    sample: u32,
    converged: u32,
    iteration_limit: u32,
    on_edge: u32,
}

@group(0) @binding(0) var<uniform> params: ReduceParams;
@group(0) @binding(1) var<storage, read> best: array<Best>;
@group(0) @binding(2) var<storage, read_write> blocks: array<Block>;

var<workgroup> distances: array<f32, WORKGROUP_SIZE>;
var<workgroup> places: array<u32, WORKGROUP_SIZE>;
var<workgroup> counts: array<atomic<u32>, 3>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn reduce(@builtin(local_invocation_index) local: u32, @builtin(workgroup_id) group: vec3<u32>) {
    let first = group.x * params.block_size;
    let end = min(first + params.block_size, params.sample_count);
    var place = first;
    var largest = -1.0;
    for (var index = first + local; index < end; index += WORKGROUP_SIZE) {
        // Not `>`: a distance that is no number is taken too, for float64 to decide.
        if !(best[index].distance_squared <= largest) {
            largest = best[index].distance_squared;
            place = index;
        }
        atomicAdd(&counts[min(best[index].patch_and_status >> STATUS_SHIFT, ON_EDGE)], 1u);
    }
    distances[local] = largest;
    places[local] = place;
    workgroupBarrier();
    for (var half = WORKGROUP_SIZE / 2u; half > 0u; half /= 2u) {
        if local < half && !(distances[local + half] <= distances[local]) {
            distances[local] = distances[local + half];
            places[local] = places[local + half];
        }
        workgroupBarrier();
    }
    if local == 0u {
        blocks[group.x] = Block(
            best[places[0]],
            places[0],
            atomicLoad(&counts[CONVERGED]),
            atomicLoad(&counts[ITERATION_LIMIT]),
            atomicLoad(&counts[ON_EDGE]),
        );
    }
}
