// Stage `split`: writes the children of cells that are to be split into the
// next level, and cells for float64, or for which the next level has no space,
// into the leftover cells. CPU twin: `Cell::split` of
// `src/certified/cell.rs`. One thread per cell.

@group(0) @binding(0) var<uniform> params: LevelParams;
@group(0) @binding(1) var<storage, read> batch: Batch;
@group(0) @binding(2) var<storage, read> cells: array<CellState>;
@group(0) @binding(3) var<storage, read_write> next_cells: array<CellState>;
@group(0) @binding(4) var<storage, read_write> leftover_cells: array<CellState>;
@group(0) @binding(5) var<storage, read_write> tally: Tally;
@group(0) @binding(6) var<storage, read> subpatches: array<Subpatch>;

fn write_leftover(cell: CellState) {
    leftover_cells[atomicAdd(&tally.leftover_cells, 1u)] = cell;
}

fn write_next(cell: CellState) {
    let index = atomicAdd(&tally.next_cells, 1u);
    if index < params.capacity {
        next_cells[index] = cell;
    } else {
        write_leftover(cell);
    }
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn split(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= batch.count {
        return;
    }
    let parent = cells[id.x];
    let distance = bitcast<u32>(parent.foot_distance);
    if parent.foot_distance < UNKNOWN_DISTANCE && distance > atomicMax(&tally.farthest, distance) {
        atomicStore(&tally.farthest_subpatch, parent.subpatch);
        atomicStore(&tally.farthest_s, bitcast<u32>(parent.center.x));
        atomicStore(&tally.farthest_t, bitcast<u32>(parent.center.y));
    }
    if parent.verdict == PRUNED {
        atomicMax(&tally.pruned_upper, bitcast<u32>(parent.upper));
        return;
    }
    if parent.verdict == FLOAT64_ONLY {
        write_leftover(parent);
        return;
    }
    let split_s = (parent.verdict & SPLIT_S) != 0u;
    let split_t = (parent.verdict & SPLIT_T) != 0u;
    var child = parent;
    child.half *= vec2<f32>(select(1.0, 0.5, split_s), select(1.0, 0.5, split_t));
    child.level += 1u;
    let offset = select(vec2<f32>(0.0), child.half, vec2<bool>(split_s, split_t));
    // By the triangle inequality, through the parent's centre.
    child.foot_distance = (parent.foot_distance + dot(offset, subpatches[parent.subpatch].first)) * ROUNDED_UP;
    for (var corner = 0u; corner < 4u; corner++) {
        let sign = vec2<f32>(select(1.0, -1.0, (corner & 1u) == 0u), select(1.0, -1.0, (corner & 2u) == 0u));
        if (!split_s && sign.x > 0.0) || (!split_t && sign.y > 0.0) {
            continue;
        }
        child.center = parent.center + sign * offset;
        write_next(child);
    }
}
