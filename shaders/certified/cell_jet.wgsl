// Stage `cell`: A's derivatives at every cell's centre, scaled by the cell,
// and the centre as a sample for `project`. One thread a cell.

@group(0) @binding(0) var<uniform> params: LevelParams;
@group(0) @binding(1) var<storage, read> batch: Batch;
@group(0) @binding(2) var<storage, read> cells: array<Cell>;
@group(0) @binding(3) var<storage, read> coefficients: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read> pieces: array<Piece>;
@group(0) @binding(5) var<storage, read_write> jets: array<Jet>;
@group(0) @binding(6) var<storage, read_write> samples: array<vec4<f32>>;
@group(0) @binding(7) var<storage, read_write> best: array<Best>;

// The parent's foot stands until one is found that is nearer than this.
const SEED_ROOM: f32 = 1.0 + 1e-5;

@compute @workgroup_size(WORKGROUP_SIZE)
fn cell(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= batch.count {
        return;
    }
    let own = cells[id.x];
    // Wraps around for pieces of degrees before these.
    let place = own.piece - params.first_piece;
    if place >= params.piece_count {
        return;
    }
    let jet = piece_jet(place * PIECE_SIZE, own.center);
    let half = own.half;
    jets[id.x] = Jet(
        jet.point,
        half.x * jet.s,
        half.y * jet.t,
        half.x * half.x * jet.ss,
        half.x * half.y * jet.st,
        half.y * half.y * jet.tt,
    );
    samples[id.x] = vec4<f32>(params.grid * vec3<f32>(pieces[own.piece].center) + jet.point, 0.0);
    let seed = min(own.reach * own.reach * SEED_ROOM, FARTHEST);
    best[id.x] = Best(seed, own.foot | (ITERATION_LIMIT << STATUS_SHIFT), own.foot_at.x, own.foot_at.y);
}
