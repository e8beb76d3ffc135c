// Stage `cell_jet`: A's jet at every cell's centre, with derivatives scaled to
// the cell, and the centre as a sample for stage `project`. CPU twin: the jets
// in `src/certified/cell_context.rs`. One thread per cell.

@group(0) @binding(0) var<uniform> params: LevelParams;
@group(0) @binding(1) var<storage, read> batch: Batch;
@group(0) @binding(2) var<storage, read> cells: array<CellState>;
@group(0) @binding(3) var<storage, read> coefficients: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read> subpatches: array<Subpatch>;
@group(0) @binding(5) var<storage, read_write> jets: array<Jet>;
@group(0) @binding(6) var<storage, read_write> samples: array<vec4<f32>>;
@group(0) @binding(7) var<storage, read_write> projected: array<Projected>;

// Relative margin of the inherited foot's squared distance, so that a
// projection onto the same foot replaces it.
const INHERITED_MARGIN: f32 = 1.0 + 1e-5;

@compute @workgroup_size(WORKGROUP_SIZE)
fn cell_jet(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= batch.count {
        return;
    }
    let cell = cells[id.x];
    // Wraps around for subpatches before the first.
    let index = cell.subpatch - params.first_subpatch;
    if index >= params.subpatch_count {
        return;
    }
    let jet = subpatch_jet(index * SUBPATCH_SIZE, cell.center);
    let half = cell.half;
    jets[id.x] = Jet(
        jet.point,
        half.x * jet.s,
        half.y * jet.t,
        half.x * half.x * jet.ss,
        half.x * half.y * jet.st,
        half.y * half.y * jet.tt,
    );
    let center = vec3<f32>(subpatches[cell.subpatch].center);
    samples[id.x] = vec4<f32>(params.center_unit * center + jet.point, 0.0);
    let inherited = min(cell.foot_distance * cell.foot_distance * INHERITED_MARGIN, UNKNOWN_DISTANCE);
    projected[id.x] = Projected(
        inherited,
        cell.foot_subpatch | (ITERATION_LIMIT << STATUS_SHIFT),
        cell.foot_parameters.x,
        cell.foot_parameters.y,
    );
}
