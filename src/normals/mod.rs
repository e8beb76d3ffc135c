//! Tangent planes of parts of a model compared with those of another model nearby (docs/score.md, lemmas N1 to N7).
//!
//! A point p of A has a *like counterpart* in B if a point q of B is within a distance of p and the tangent planes at
//! both form at most a permitted angle, the least of their lines' angles, 0 to 90 degrees: sheets have no side.

mod beside;
mod comparison;
mod cone;
mod cover;
mod quad;
mod reach;
mod shape;
mod target;

pub(crate) use beside::{ByFormula, OrientedPoint};
pub(crate) use comparison::{Likeness, Likenesses};
pub(crate) use cone::NormalCone;
pub(crate) use reach::{DISTANCE_ROUNDINGS, Looked, Reach};
pub(crate) use shape::{Hull, Region, Shape};
pub(crate) use target::NormalTarget;
