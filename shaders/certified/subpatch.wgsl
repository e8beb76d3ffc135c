// A piece of a Bézier patch: (σ, τ) in [-1, 1]^2, of a kernel's size.

struct Piece {
    // In units of the grid.
    center: vec3<i32>,
    // Error of a point, of the first and of the second derivatives in float32.
    value_error: f32,
    first_error: vec2<f32>,
    // Bounds of the derivatives by (σ, τ): of a piece of A over the piece, of
    // one of B over the patch that it was cut from.
    first: vec2<f32>,
    second_error: vec3<f32>,
    radius: f32,
    second: vec3<f32>,
    padding: f32,
    third: vec4<f32>,
    // The corners of that patch.
    low: vec2<f32>,
    high: vec2<f32>,
}
