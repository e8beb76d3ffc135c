//! The readers of scans in binary: LAS, LAZ and E57.

pub(super) mod e57;
pub(super) mod las;
