// The nearest foot found of a sample. CPU twin: `Projected` of
// `src/iteration/mod.rs`. The host generates the constants.

struct Projected {
    // UNKNOWN_DISTANCE before the first projection.
    distance_squared: f32,
    // The patch in the bits of PATCH_MASK, the status from STATUS_SHIFT on.
    patch_and_status: u32,
    s: f32,
    t: f32,
}
