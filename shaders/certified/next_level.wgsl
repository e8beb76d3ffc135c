// Stage `next_level`: makes the cells written for the next level the current
// ones. CPU twin: none; the CPU has a queue without levels. One thread.

@group(0) @binding(0) var<uniform> params: LevelParams;
@group(0) @binding(1) var<storage, read_write> batch: Batch;
@group(0) @binding(2) var<storage, read_write> tally: Tally;

@compute @workgroup_size(1)
fn next_level() {
    atomicAdd(&tally.cells, batch.count);
    atomicAdd(&tally.levels, min(batch.count, 1u));
    let count = min(atomicExchange(&tally.next_cells, 0u), params.capacity);
    atomicStore(&tally.waiting_cells, count);
    batch = Batch(vec3<u32>((count + WORKGROUP_SIZE - 1u) / WORKGROUP_SIZE, 1u, 1u), count);
}
