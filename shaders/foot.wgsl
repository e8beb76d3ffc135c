// The foot of a target on one patch: where an iteration starts and ends. One
// of `newton.wgsl` and `tangent_plane.wgsl` follows this text.

struct Foot {
    at: vec2<f32>,
    distance_squared: f32,
    status: u32,
    // Points evaluated on the way.
    evaluations: u32,
}

// A second derivative, or squared sine, of this size relative to the other
// direction's marks a degenerate edge.
const DEGENERATE_RATIO: f32 = 1e-6;

fn nearest_control(first: u32, local: vec3<f32>) -> vec2<f32> {
    var nearest = vec2<f32>(0.0);
    var least = FARTHEST;
    for (var i = 0u; i < ROWS; i++) {
        let in_row = nearest_in_row(first + i * COLUMNS, local);
        if in_row.x < least {
            least = in_row.x;
            nearest = vec2<f32>(f32(i), in_row.y);
        }
    }
    return nearest / vec2<f32>(f32(P), f32(Q));
}
