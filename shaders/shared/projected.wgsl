// What is known of a sample's projection, shared by `project` and `reduce`.

struct Best {
    distance_squared: f32,
    // Patch in the low bits, status in the two highest.
    patch_and_status: u32,
    s: f32,
    t: f32,
}

const STATUS_SHIFT: u32 = 30u;
const PATCH_MASK: u32 = 0x3fffffffu;
const CONVERGED: u32 = 0u;
const ITERATION_LIMIT: u32 = 1u;
const ON_EDGE: u32 = 2u;

// The squared distance of a sample not yet projected: near the largest float32.
const FARTHEST: f32 = 3.0e38;
