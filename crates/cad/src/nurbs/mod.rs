//! Curves and surfaces of the file: evaluation, and conversion to NURBS.

mod basis;
mod conversion;
mod curves;
mod frame;
mod image;
mod net;
mod parameter_map;
mod surface;

use curves::{conic, curve, curve_faults, nearest, part, spline};

pub(crate) use basis::Basis;
pub(crate) use conic::Conic;
pub(crate) use conversion::Unconvertible;
pub(crate) use curve::{Curve, SplineCurve};
pub(crate) use frame::Frame;
pub(crate) use nearest::nearest_parameter;
pub(crate) use net::SurfaceNet;
pub(crate) use parameter_map::ParameterMap;
pub(crate) use part::CurvePart;
pub(crate) use spline::{Spline, project};
pub(crate) use surface::{SplineSurface, Surface};
