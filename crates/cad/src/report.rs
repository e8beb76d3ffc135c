//! Faults and remarks of faces whose numbers are not known yet.

use super::nurbs::Unconvertible;

/// A remark on a face whose number is not known yet.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Remark {
    pub(super) code: &'static str,
    pub(super) why: String,
}

impl Remark {
    pub(super) fn new(code: &'static str, why: impl Into<String>) -> Self {
        Self { code, why: why.into() }
    }
}

/// The reason for which a face cannot be read.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FaceFault {
    pub(super) code: &'static str,
    pub(super) why: String,
}

impl FaceFault {
    pub(super) fn new(code: &'static str, why: impl Into<String>) -> Self {
        Self { code, why: why.into() }
    }
}

impl From<Unconvertible> for FaceFault {
    fn from(reason: Unconvertible) -> Self {
        Self::new(reason.code(), reason.why())
    }
}
