// Stage `boxes`: a box around every part of a cell. CPU twin:
// `src/hierarchy/boxes.rs`. One thread per part. The host generates WHOLE_MODEL.

struct BoxesParams {
    // The parts of this dispatch.
    first: u32,
    end: u32,
    // The factor from the model's scale to the common one, a power of two.
    rescale: f32,
    // Upper bound on the rounding error of a moved point, in float64 and float32.
    margin: f32,
    // Columns of the rotation, then the translation, both into the common frame.
    rotation_x: vec4<f32>,
    rotation_y: vec4<f32>,
    rotation_z: vec4<f32>,
    translation: vec4<f32>,
}

struct Part {
    s: vec2<f32>,
    t: vec2<f32>,
    patch_index: u32,
    // Its index on the level of the parts.
    node: u32,
    // Upper bound on the distance of its points from the box of its exact
    // corners, plus the error of the corners. From WHOLE_MODEL on, its box is
    // that of the whole model about its origin, and the corners are not evaluated.
    growth: f32,
    padding: u32,
}

@group(0) @binding(0) var<uniform> params: BoxesParams;
@group(0) @binding(1) var<storage, read> controls: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> centers: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> parts: array<Part>;
@group(0) @binding(4) var<storage, read_write> parts_boxes: array<Box>;

// The moved corner of a part.
fn corner(part: Part, parameters: vec2<f32>) -> vec3<f32> {
    // A patch's centre can be outside the model's box, if its net is much larger than it is.
    var point = vec3<f32>(0.0);
    if part.growth < WHOLE_MODEL {
        point = centers[part.patch_index].xyz + evaluate(part.patch_index * PATCH_SIZE, parameters);
    }
    return params.rotation_x.xyz * point.x + params.rotation_y.xyz * point.y
        + params.rotation_z.xyz * point.z + params.translation.xyz;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn boxes(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let index = params.first + thread(id, groups);
    if index >= params.end {
        return;
    }
    let part = parts[index];
    let a = corner(part, vec2<f32>(part.s.x, part.t.x));
    let b = corner(part, vec2<f32>(part.s.x, part.t.y));
    let c = corner(part, vec2<f32>(part.s.y, part.t.x));
    let d = corner(part, vec2<f32>(part.s.y, part.t.y));
    let growth = vec3<f32>(part.growth * params.rescale + params.margin);
    let low = min(min(a, b), min(c, d)) - growth;
    let high = max(max(a, b), max(c, d)) + growth;
    parts_boxes[part.node] = Box(vec4<f32>(low, 0.0), vec4<f32>(high, 0.0));
}
