//! Motions by hand: by pairs of points, and by datums in their order.

mod datums;
mod points;

pub(crate) use datums::by_datums;
pub use datums::{Datum, DatumFit, Feature};
pub use points::PointPair;
