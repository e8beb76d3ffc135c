// Stage `split`: cells not decided write their parts into the next level, and
// what has no room there, or is for float64, into what is left over. One
// thread a cell; `level`, one thread in all, then makes the next level the
// one in work.

@group(0) @binding(0) var<uniform> params: LevelParams;
@group(0) @binding(1) var<storage, read> batch: Batch;
@group(0) @binding(2) var<storage, read> cells: array<Cell>;
@group(0) @binding(3) var<storage, read_write> next_cells: array<Cell>;
@group(0) @binding(4) var<storage, read_write> left_cells: array<Cell>;
@group(0) @binding(5) var<storage, read_write> tally: Tally;
@group(0) @binding(6) var<storage, read> pieces: array<Piece>;

fn place_next(cell: Cell) {
    let index = atomicAdd(&tally.next, 1u);
    if index < params.capacity {
        next_cells[index] = cell;
    } else {
        left_cells[atomicAdd(&tally.left, 1u)] = cell;
    }
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn split(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= batch.count {
        return;
    }
    let parent = cells[id.x];
    let distance = bitcast<u32>(parent.reach);
    if parent.reach < FARTHEST && distance > atomicMax(&tally.farthest, distance) {
        atomicStore(&tally.farthest_piece, parent.piece);
        atomicStore(&tally.farthest_s, bitcast<u32>(parent.center.x));
        atomicStore(&tally.farthest_t, bitcast<u32>(parent.center.y));
    }
    if parent.verdict == DROPPED {
        atomicMax(&tally.dropped, bitcast<u32>(parent.upper));
        return;
    }
    if parent.verdict == UNDECIDED {
        left_cells[atomicAdd(&tally.left, 1u)] = parent;
        return;
    }
    let in_s = (parent.verdict & SPLIT_S) != 0u;
    let in_t = (parent.verdict & SPLIT_T) != 0u;
    var child = parent;
    child.half *= vec2<f32>(select(1.0, 0.5, in_s), select(1.0, 0.5, in_t));
    child.level += 1u;
    // Its centre is no farther from the foot than the parent's and the way to it.
    let way = select(vec2<f32>(0.0), child.half, vec2<bool>(in_s, in_t));
    child.reach = (parent.reach + dot(way, pieces[parent.piece].first)) * ROOM;
    for (var side = 0u; side < 4u; side++) {
        let sign = vec2<f32>(select(1.0, -1.0, (side & 1u) == 0u), select(1.0, -1.0, (side & 2u) == 0u));
        if (!in_s && sign.x > 0.0) || (!in_t && sign.y > 0.0) {
            continue;
        }
        child.center = parent.center + sign * way;
        place_next(child);
    }
}
