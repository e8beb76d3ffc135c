// A subpatch of a Bézier patch, small enough for float32. CPU twin:
// `Subpatches` of `src/gpu/certified/subpatches.rs`.

// Derivatives are by (σ, τ) in [-1, 1]^2. Their bounds hold over the subpatch
// for A, over `low` to `high` for B.
struct Subpatch {
    // In units of `LevelParams.center_unit`.
    center: vec3<i32>,
    // Upper bounds on the float32 error of a point, of the first and of the
    // second derivatives.
    value_error: f32,
    first_error: vec2<f32>,
    // Upper bounds on the length of the first derivatives.
    first: vec2<f32>,
    second_error: vec3<f32>,
    // An upper bound on the distance of a point from the centre.
    radius: f32,
    // Upper bounds on the length of the second derivatives σσ, στ, ττ.
    second: vec3<f32>,
    padding: f32,
    // Upper bounds on the length of the third derivatives σσσ, σστ, σττ, τττ.
    third: vec4<f32>,
    // The parameters at which the subpatch, extended, is a part of B.
    low: vec2<f32>,
    high: vec2<f32>,
}
