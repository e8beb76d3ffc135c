// What the stages of method `certified` share: cells of A in the parameters
// (σ, τ) of A's pieces, [-1, 1]^2 each.

struct Cell {
    center: vec2<f32>,
    half: vec2<f32>,
    // The piece of A.
    piece: u32,
    // A foot near the centre's: B's piece and the (s, t) in [0, 1]^2 on it.
    foot: u32,
    foot_at: vec2<f32>,
    // At least the distance of all its points to B.
    upper: f32,
    // At least the centre's distance to that foot.
    reach: f32,
    level: u32,
    // What is to be done with it: bits of SPLIT_S and SPLIT_T, or one of these.
    verdict: u32,
}

const DROPPED: u32 = 0u;
const SPLIT_S: u32 = 1u;
const SPLIT_T: u32 = 2u;
// For float64 to decide.
const UNDECIDED: u32 = 4u;

// The cells of a level, with the workgroups of a dispatch over them.
struct Batch {
    workgroups: vec3<u32>,
    count: u32,
}

struct LevelParams {
    // A bound of at most this ends a cell.
    prune_threshold: f32,
    // The unit of the pieces' centres.
    grid: f32,
    // Error of a difference of two centres.
    slack: f32,
    // Cells that a level has room for.
    capacity: u32,
    // The pieces that this dispatch is about: those of one pair of degrees.
    first_piece: u32,
    piece_count: u32,
}

// Rounding relative to a bound that grows on the way: twice 32 roundings of 2^-23.
const ROOM: f32 = 1.0 + 8e-6;
