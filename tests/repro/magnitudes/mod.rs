//! Numbers that are far from 1, and models far from the origin or of no size.

mod far;
mod overflow;
mod plane_1e7;
mod points;
mod underflow;

pub(crate) use far::far;
pub(crate) use overflow::overflow;
pub(crate) use plane_1e7::plane_1e7;
pub(crate) use points::points;
pub(crate) use underflow::underflow;
