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
