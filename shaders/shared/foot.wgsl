// The result of an iteration on one patch. CPU twin: `Foot` of
// `src/closest/mod.rs`. One of `newton.wgsl` and `tangent_plane.wgsl` follows
// this text and defines `iterate`.

struct Foot {
    parameters: vec2<f32>,
    distance_squared: f32,
    status: u32,
}

// A second derivative of this size relative to the other direction's, or a
// squared sine between the tangents, marks a degenerate edge.
const DEGENERATE_RATIO: f32 = 1e-6;
