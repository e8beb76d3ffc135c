//! Curves as rational splines.

pub(in crate::brep::nurbs) mod conic;
pub(in crate::brep::nurbs) mod curve;
pub(in crate::brep::nurbs) mod curve_faults;
pub(in crate::brep::nurbs) mod nearest;
pub(in crate::brep::nurbs) mod part;
pub(in crate::brep::nurbs) mod spline;
