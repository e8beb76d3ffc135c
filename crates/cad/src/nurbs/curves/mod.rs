//! Curves as rational splines.

pub(in crate::nurbs) mod conic;
pub(in crate::nurbs) mod curve;
pub(in crate::nurbs) mod curve_faults;
pub(in crate::nurbs) mod nearest;
pub(in crate::nurbs) mod part;
pub(in crate::nurbs) mod spline;
