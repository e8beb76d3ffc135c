//! The reader of IGES files (version 5.3, fixed-length lines).
//!
//! The stages: [`file`] splits the text into its sections, and parses the parameters of an entity
//! when they are needed; [`geometry`] reads curves, surfaces and placements; [`shapes`] makes
//! edges, faces and bodies of them, placed as subfigures state.

mod file;
mod geometry;
mod shapes;

use super::topology::Topology;
use nurbs_hausdorff::{Error, Result};

/// Parses a file. O(length).
///
/// Faces that cannot be read stand in the topology with the reason; so do bodies of kinds that
/// are not read, and surfaces that no entity refers to though they depend on one.
///
/// # Errors
/// [`Error::IgesSyntax`] with the first line that the format does not allow, also for a file that
/// ends early; [`Error::IgesUnreadable`].
pub(super) fn parse(bytes: &[u8]) -> Result<Topology> {
    let file = file::File::parse(bytes)?;
    shapes::read(&file).map_err(|fault| Error::IgesUnreadable { found: fault.why })
}
