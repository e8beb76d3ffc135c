// Boxes and bounds of the distances between their contents, shared by the
// stages of method `hierarchy`. CPU twin: `src/hierarchy/box_distance.rs`.

struct Box {
    low: vec4<f32>,
    high: vec4<f32>,
}

// A node's children, which are consecutive on the next level.
struct Children {
    first: u32,
    count: u32,
}

struct StageParams {
    // The nodes or pairs of this dispatch.
    first: u32,
    end: u32,
    // The number of pairs that the list of the next level holds.
    capacity: u32,
    // The phase of stage `farthest`.
    phase: u32,
}

// Largest bounds of squared distances, as bits, which order as non-negative
// floats do, and the number of pairs of the next level.
struct Totals {
    near: atomic<u32>,
    far: atomic<u32>,
    pairs: atomic<u32>,
}

// Relative margins for the rounding of a squared distance: at most eight
// roundings of 2^-23.
const ROUNDED_DOWN: f32 = 1.0 - 2e-6;
const ROUNDED_UP: f32 = 1.0 + 2e-6;

// A lower bound on the squared distance between points of two boxes.
fn near(a: Box, b: Box) -> f32 {
    let gap = max(max(a.low.xyz - b.high.xyz, b.low.xyz - a.high.xyz), vec3<f32>(0.0));
    return dot(gap, gap) * ROUNDED_DOWN;
}

// An upper bound on the squared distance between points of two boxes.
fn far(a: Box, b: Box) -> f32 {
    let span = max(abs(a.low.xyz - b.high.xyz), abs(b.low.xyz - a.high.xyz));
    return dot(span, span) * ROUNDED_UP;
}

// The bits' complement: its largest value is that of the smallest float, and 0,
// which new buffers contain, is larger than any float's.
fn complement(value: f32) -> u32 {
    return ~bitcast<u32>(value);
}

fn thread(id: vec3<u32>, groups: vec3<u32>) -> u32 {
    return id.x + id.y * groups.x * WORKGROUP_SIZE;
}
