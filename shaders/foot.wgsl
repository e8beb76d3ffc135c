// The foot of a target on one patch: where an iteration starts and ends. One
// of `newton.wgsl` and `tangent_plane.wgsl` follows this text.

struct Foot {
    at: vec2<f32>,
    distance_squared: f32,
    status: u32,
}

// A second derivative, or squared sine, of this size relative to the other
// direction's marks a degenerate edge.
const DEGENERATE_RATIO: f32 = 1e-6;

fn nearest_control(first: u32, local: vec3<f32>) -> vec2<f32> {
    var nearest = 0u;
    var least = FARTHEST;
    for (var index = 0u; index < PATCH_SIZE; index++) {
        let control = controls[first + index];
        let offset = control.xyz / control.w - local;
        let distance_squared = dot(offset, offset);
        if distance_squared < least {
            least = distance_squared;
            nearest = index;
        }
    }
    return vec2<f32>(f32(nearest / COLUMNS) / f32(P), f32(nearest % COLUMNS) / f32(Q));
}
