//! Facts of bodies as intervals that contain them: volume, centroid, inertia, extents.
//!
//! The integrals over a body are those of polynomials times x·n over its boundary. Over a patch they are
//! means of rational functions without roots, which Gauss's rules integrate exactly where weights are equal, and
//! else to an error that an ellipse proves in which the weight does not vanish. Lemmas and proofs are in
//! docs/facts.md. Nothing here knows of files, shells or options.

mod body;
mod extent;
mod mass;
mod moments;
mod nodes;
mod patch;
mod principal;
mod triangle;

use crate::interval::Interval;
pub use body::{Facts, Orientation, VolumeUnknown};
pub(crate) use extent::{largest, largest_of_points};
pub(crate) use mass::{AboutCentroid, Mass};
pub(crate) use moments::{IntervalMoments, Moments, shifted};
pub(crate) use patch::of_patch;
pub(crate) use principal::Principal;
pub(crate) use triangle::{area_of_triangle, of_triangle};

/// A symmetric matrix of intervals.
pub(crate) type Matrix = [[Interval; 3]; 3];
