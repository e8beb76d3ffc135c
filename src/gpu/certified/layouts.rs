//! The structs and constants shared with `shaders/certified`, field by field.

use crate::certified::MAX_ASPECT;
use crate::gpu::kernel::Constant;
use bytemuck::{Pod, Zeroable};

/// Levels of one submission.
pub(crate) const LEVELS: usize = 4;

/// `LevelParams` of `cells.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct LevelParams {
    pub(crate) prune_threshold: f32,
    pub(crate) center_unit: f32,
    pub(crate) center_error: f32,
    pub(crate) capacity: u32,
    pub(crate) first_subpatch: u32,
    pub(crate) subpatch_count: u32,
}

/// `CellState` of `cells.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct CellState {
    pub(crate) center: [f32; 2],
    pub(crate) half: [f32; 2],
    pub(crate) subpatch: u32,
    pub(crate) foot_subpatch: u32,
    pub(crate) foot_parameters: [f32; 2],
    pub(crate) upper: f32,
    pub(crate) foot_distance: f32,
    pub(crate) level: u32,
    pub(crate) verdict: u32,
}

/// `Batch` of `cells.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Batch {
    pub(crate) workgroups: [u32; 3],
    pub(crate) count: u32,
}

/// `Subpatch` of `subpatch.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Subpatch {
    pub(crate) center: [i32; 3],
    pub(crate) value_error: f32,
    pub(crate) first_error: [f32; 2],
    pub(crate) first: [f32; 2],
    pub(crate) second_error: [f32; 3],
    pub(crate) radius: f32,
    pub(crate) second: [f32; 3],
    pub(crate) padding: f32,
    pub(crate) third: [f32; 4],
    pub(crate) low: [f32; 2],
    pub(crate) high: [f32; 2],
}

/// `Tally` of `tally.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Tally {
    pub(crate) next_cells: u32,
    pub(crate) waiting_cells: u32,
    pub(crate) leftover_cells: u32,
    pub(crate) pruned_upper: u32,
    pub(crate) farthest: u32,
    pub(crate) farthest_subpatch: u32,
    pub(crate) farthest_s: u32,
    pub(crate) farthest_t: u32,
    pub(crate) cells: u32,
    pub(crate) levels: u32,
}

/// Bytes of `Jet` of `jet.wgsl` in a buffer.
pub(crate) const JET_BYTES: u64 = 96;

/// The values of [`CellState::verdict`]: pruned by its upper bound, to be
/// split along σ or τ, or to be bounded in float64.
const PRUNED: u32 = 0;
const SPLIT_S: u32 = 1;
const SPLIT_T: u32 = 2;
pub(crate) const FLOAT64_ONLY: u32 = 4;

/// The constants of `cells.wgsl`.
pub(crate) const CELLS_CONSTANTS: &[Constant] = &[
    Constant::u32("PRUNED", PRUNED),
    Constant::u32("SPLIT_S", SPLIT_S),
    Constant::u32("SPLIT_T", SPLIT_T),
    Constant::u32("FLOAT64_ONLY", FLOAT64_ONLY),
];

/// Upper bound on the relative error of a difference of two points, whose
/// roundings are each relative to the points' sizes.
pub(crate) const DIFFERENCE_ROUNDINGS: f32 = 4.0 * f32::EPSILON;

/// Upper bound on the relative error of a length: three products, two sums, a
/// root of up to 5 units, and the operations that add it to the bound.
pub(crate) const LENGTH_ROUNDINGS: f32 = 16.0 * f32::EPSILON;

/// The constants of `taylor.wgsl`.
pub(crate) const TAYLOR_CONSTANTS: &[Constant] = &[
    Constant::f32("MAX_ASPECT", MAX_ASPECT as f32),
    Constant::f32("UNIT_ROUNDOFF", f32::EPSILON),
    Constant::f32("DIFFERENCE_ROUNDINGS", DIFFERENCE_ROUNDINGS),
    Constant::f32("LENGTH_ROUNDINGS", LENGTH_ROUNDINGS),
];
