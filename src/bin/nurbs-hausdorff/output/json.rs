//! The JSON that the commands print: their result, and its origin.

use super::print;
use crate::failure::Failure;
use crate::input::{Input, Source};
use nurbs_hausdorff::{Error, Skipped};
use serde::Serialize;

/// The version of the names and meanings in the JSON. It rises when one is removed or
/// changes, not when one is added.
const SCHEMA_VERSION: u32 = 1;

/// A result of the files of A and B.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct OfFiles<'a, R> {
    schema_version: u32,
    version: &'static str,
    files: Both<&'a Source>,
    #[serde(flatten)]
    result: &'a R,
    /// The faces left out.
    skipped: Both<&'a [Skipped]>,
}

/// One of A and one of B.
#[derive(Serialize)]
struct Both<T> {
    a: T,
    b: T,
}

impl<'a, R> OfFiles<'a, R> {
    pub(crate) fn new(result: &'a R, a: &'a Input, b: &'a Input) -> Self {
        Self {
            schema_version: SCHEMA_VERSION,
            version: env!("CARGO_PKG_VERSION"),
            files: Both { a: &a.source, b: &b.source },
            result,
            skipped: Both { a: &a.report.read.skipped, b: &b.report.read.skipped },
        }
    }
}

/// A result of one file.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct OfFile<'a, R> {
    schema_version: u32,
    version: &'static str,
    file: &'a Source,
    #[serde(flatten)]
    result: &'a R,
}

impl<'a, R> OfFile<'a, R> {
    pub(crate) fn new(result: &'a R, source: &'a Source) -> Self {
        let version = env!("CARGO_PKG_VERSION");
        Self { schema_version: SCHEMA_VERSION, version, file: source, result }
    }
}

/// Writes one JSON object on one line.
///
/// # Errors
/// As [`print`].
pub(crate) fn print_json(value: &impl Serialize) -> Result<(), Failure> {
    print(&line(value)?)
}

/// One JSON object on one line.
///
/// # Errors
/// [`Error::JsonShape`] for what JSON cannot hold.
pub(crate) fn line(value: &impl Serialize) -> Result<String, Failure> {
    let json = serde_json::to_string(value).map_err(|error| Error::JsonShape { found: error.to_string() })?;
    Ok(format!("{json}\n"))
}
