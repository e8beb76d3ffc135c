// The cells of A, shared by the stages of method `certified`. CPU twin: `SearchNode`
// of `src/certified/search/node.rs`. The host generates PRUNED, SPLIT_S,
// SPLIT_T, FLOAT64_ONLY.

// A rectangle of a subpatch of A, in its parameters (σ, τ) in [-1, 1]^2.
struct CellState {
    center: vec2<f32>,
    half: vec2<f32>,
    // The subpatch of A.
    subpatch: u32,
    // The foot of the centre: a subpatch of B and (s, t) in [0, 1]^2 on it.
    foot_subpatch: u32,
    foot_parameters: vec2<f32>,
    // An upper bound on the distance from any point of the cell to B.
    upper: f32,
    // An upper bound on the distance from the centre to the foot.
    foot_distance: f32,
    level: u32,
    // PRUNED, FLOAT64_ONLY, or bits of SPLIT_S and SPLIT_T.
    verdict: u32,
}

// The number of cells of a level, and of workgroups for them.
struct Batch {
    workgroups: vec3<u32>,
    count: u32,
}

struct LevelParams {
    // Cells with an upper bound of at most this are pruned.
    prune_threshold: f32,
    // The unit of the subpatches' centres.
    center_unit: f32,
    // An upper bound on the error of the difference of two centres.
    center_error: f32,
    // The number of cells that a level's buffer holds.
    capacity: u32,
    // The subpatches of this dispatch, which have one pair of degrees.
    first_subpatch: u32,
    subpatch_count: u32,
}

// Relative margin for the rounding of a bound that is summed up: twice 32
// roundings of 2^-23.
const ROUNDED_UP: f32 = 1.0 + 8e-6;
