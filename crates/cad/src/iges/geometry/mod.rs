//! Placements, curves and surfaces of the file.

mod conics;
mod curves;
mod elementary;
mod joined;
mod placement;
mod power_basis;
mod splines;
mod surfaces;

pub(super) use curves::{Leaf, leaves};
pub(super) use joined::{over, spline};
pub(super) use placement::{matrix, placed};
pub(super) use surfaces::{Carrier, carrier};

/// The deepest nesting of matrices, curves and surfaces that are made of others. Files have at
/// most a few levels; the limit keeps a damaged one from exhausting the stack.
const MAX_NESTING: usize = 16;

/// The scale of lengths in space; parameters have none.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scale(pub(super) f64);
