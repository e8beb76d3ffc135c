//! The reader of STEP files (ISO 10303-21 with the geometry and topology of ISO 10303-42).
//!
//! The stages: [`exchange`] finds and parses instances; [`units`] and [`geometry`] read what
//! they describe; [`shapes`] makes vertices, edges, faces and bodies of them; [`assembly`]
//! places the representations of products as their [`relations`] and [`usages`] state. [`styles`] gives them
//! colours. What is [`left_over`] is named, and of a file without faces its [`contents`] are.

mod assembly;
mod contents;
mod exchange;
mod geometry;
mod left_over;
mod relations;
mod shapes;
mod styles;
mod units;
mod usages;

use super::topology::Topology;
use exchange::Exchange;
use nurbs_hausdorff::{Error, Result};

/// Parses a file. O(length).
///
/// Faces that cannot be read stand in the topology with the reason; so do bodies of kinds that
/// are not read, and shells that no representation contains.
///
/// # Errors
/// [`Error::StepSyntax`] with the line of the first token that the format does not allow, also
/// for a file that ends early.
pub(super) fn parse(bytes: &[u8]) -> Result<Topology> {
    let file = Exchange::parse(bytes)?;
    assembly::read(&file).map_err(|fault| Error::StepUnreadable { found: fault.why })
}

/// Returns what a file without faces has instead, in words. O(length).
pub(super) fn contents_of(bytes: &[u8]) -> Result<String> {
    Ok(contents::contents(&Exchange::parse(bytes)?))
}
