// Stage `sample`: the moved points of one page of A's samples, as
// `src/iteration/sample.rs`. One thread a sample.

struct SampleParams {
    // Columns of the rotation, then the translation, both into B's frame.
    rotation_x: vec4<f32>,
    rotation_y: vec4<f32>,
    rotation_z: vec4<f32>,
    translation: vec4<f32>,
    first_row: u32,
    row_count: u32,
    columns: u32,
    padding: u32,
}

// One row of samples: fixed u on one row of patches.
struct Row {
    first_patch: u32,
    first_place: u32,
    s: f32,
    // Place of the row's first sample in the page.
    first_sample: u32,
}

// Where on a row of patches a sample lies.
struct Place {
    patch_column: u32,
    t: f32,
}

@group(0) @binding(0) var<uniform> params: SampleParams;
@group(0) @binding(1) var<storage, read> controls: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> centers: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> rows: array<Row>;
@group(0) @binding(4) var<storage, read> places: array<Place>;
@group(0) @binding(5) var<storage, read_write> samples: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read_write> best: array<Best>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn sample(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let index = id.x + id.y * groups.x * WORKGROUP_SIZE;
    if index >= params.row_count * params.columns {
        return;
    }
    let row = rows[params.first_row + index / params.columns];
    let column = index % params.columns;
    let place = places[row.first_place + column];
    let patch_index = row.first_patch + place.patch_column;
    let point = evaluate(patch_index * PATCH_SIZE, vec2<f32>(row.s, place.t)) + centers[patch_index].xyz;
    let moved = params.rotation_x.xyz * point.x + params.rotation_y.xyz * point.y
        + params.rotation_z.xyz * point.z + params.translation.xyz;
    let sample = row.first_sample + column;
    samples[sample] = vec4<f32>(moved, 0.0);
    best[sample] = Best(FARTHEST, ITERATION_LIMIT << STATUS_SHIFT, 0.0, 0.0);
}
