//! The JSON that the commands print: their result, and its origin.

use super::print;
use crate::failure::Failure;
use crate::input::{Input, Source};
use nurbs_hausdorff::{Error, Skipped};
use serde::Serialize;
use serde_json::value::{RawValue, to_raw_value};

/// The version of the names and meanings in the JSON. It rises when one is removed or
/// changes, not when one is added.
const SCHEMA_VERSION: u32 = 1;

/// The versions, with which every object begins.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Head {
    schema_version: u32,
    version: &'static str,
}

impl Head {
    pub(crate) fn new() -> Self {
        Self { schema_version: SCHEMA_VERSION, version: env!("CARGO_PKG_VERSION") }
    }
}

/// A result of the files of A and B.
#[derive(Serialize)]
pub(crate) struct OfFiles<'a, R> {
    #[serde(flatten)]
    head: Head,
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
            head: Head::new(),
            files: Both { a: &a.source, b: &b.source },
            result,
            skipped: Both { a: &a.report.read.skipped, b: &b.report.read.skipped },
        }
    }
}

/// A result of one file.
#[derive(Serialize)]
pub(crate) struct OfFile<'a, R> {
    #[serde(flatten)]
    head: Head,
    file: &'a Source,
    #[serde(flatten)]
    result: &'a R,
}

impl<'a, R> OfFile<'a, R> {
    pub(crate) fn new(result: &'a R, source: &'a Source) -> Self {
        Self { head: Head::new(), file: source, result }
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
    Ok(format!("{}\n", raw(value)?))
}

/// One JSON object, written once.
///
/// # Errors
/// As [`line`].
pub(crate) fn raw(value: &impl Serialize) -> Result<Box<RawValue>, Failure> {
    let found = |error: serde_json::Error| Error::JsonShape { found: error.to_string() };
    Ok(to_raw_value(value).map_err(found)?)
}
