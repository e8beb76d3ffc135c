// Boxes, and how near and how far the contents of two can be, as
// `src/hierarchy/distances.rs`. Shared by the stages of method `hierarchy`.

struct Box {
    low: vec4<f32>,
    high: vec4<f32>,
}

// A node's children, neighbours on the level below.
struct Children {
    first: u32,
    count: u32,
}

struct StepParams {
    // The nodes or pairs that this dispatch works on.
    first: u32,
    end: u32,
    // Pairs that the next level's list holds.
    capacity: u32,
    // Which of a stage's steps this is.
    phase: u32,
}

// Bounds of squared distances as the bits of floats, which order as the floats
// do. Those that a minimum is taken of are stored as complements, so that 0,
// which new buffers hold, is the bound that nothing exceeds.
struct Totals {
    near: atomic<u32>,
    far: atomic<u32>,
    pairs: atomic<u32>,
}

// Room for the roundings of a squared distance: at most eight of 2^-23.
const ROUNDED_DOWN: f32 = 1.0 - 2e-6;
const ROUNDED_UP: f32 = 1.0 + 2e-6;

const FARTHEST: f32 = 3.0e38;

fn near(a: Box, b: Box) -> f32 {
    let gap = max(max(a.low.xyz - b.high.xyz, b.low.xyz - a.high.xyz), vec3<f32>(0.0));
    return dot(gap, gap) * ROUNDED_DOWN;
}

fn far(a: Box, b: Box) -> f32 {
    let span = max(abs(a.low.xyz - b.high.xyz), abs(b.low.xyz - a.high.xyz));
    return dot(span, span) * ROUNDED_UP;
}

fn complement(value: f32) -> u32 {
    return ~bitcast<u32>(value);
}

fn thread(id: vec3<u32>, groups: vec3<u32>) -> u32 {
    return id.x + id.y * groups.x * WORKGROUP_SIZE;
}
