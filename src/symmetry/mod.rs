//! Surfaces that a turn about an axis leaves as they are.

mod line;
mod revolution;
mod sphere;
mod winding;

pub(crate) use revolution::{Revolution, revolutions};
pub(crate) use sphere::Sphere;
