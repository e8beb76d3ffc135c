//! The readers of points: text, PCD and PTX.

pub(super) mod pcd;
pub(super) mod ptx;
pub(super) mod text;
