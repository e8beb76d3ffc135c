//! What the targets share: how bytes become models and parameters, and what holds of a result.

pub mod bytes;
pub mod results;
pub mod sampling;
pub mod surfaces;
