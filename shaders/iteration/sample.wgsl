// Stage `sample`: the moved points of A's samples of one page. CPU twin:
// `src/iteration/sample.rs`. One thread per sample.

struct SampleParams {
    // Columns of the rotation, then the translation, from A's frame and scale to B's.
    rotation_x: vec4<f32>,
    rotation_y: vec4<f32>,
    rotation_z: vec4<f32>,
    translation: vec4<f32>,
    row_count: u32,
    column_count: u32,
    padding: vec2<u32>,
}

// A row of samples: constant u, on one row of patches.
struct SampleRow {
    first_patch: u32,
    // Index of the row's first column in `columns`.
    first_column: u32,
    s: f32,
    // Index of the row's first sample in the page.
    first_sample: u32,
}

// The parameters of a column of samples on a row of patches.
struct SampleColumn {
    patch_column: u32,
    t: f32,
}

@group(0) @binding(0) var<uniform> params: SampleParams;
@group(0) @binding(1) var<storage, read> controls: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> centers: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> rows: array<SampleRow>;
@group(0) @binding(4) var<storage, read> columns: array<SampleColumn>;
@group(0) @binding(5) var<storage, read_write> samples: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read_write> projected: array<Projected>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn sample(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let index = id.x + id.y * groups.x * WORKGROUP_SIZE;
    if index >= params.row_count * params.column_count {
        return;
    }
    let row = rows[index / params.column_count];
    let column_index = index % params.column_count;
    let column = columns[row.first_column + column_index];
    let patch_index = row.first_patch + column.patch_column;
    let point = evaluate(patch_index * PATCH_SIZE, vec2<f32>(row.s, column.t)) + centers[patch_index].xyz;
    let moved = params.rotation_x.xyz * point.x + params.rotation_y.xyz * point.y
        + params.rotation_z.xyz * point.z + params.translation.xyz;
    let sample = row.first_sample + column_index;
    samples[sample] = vec4<f32>(moved, 0.0);
    projected[sample] = Projected(UNKNOWN_DISTANCE, ITERATION_LIMIT << STATUS_SHIFT, 0.0, 0.0);
}
