//! The JSON that the commands print: their result, and its origin.

use super::print;
use crate::failure::Failure;
use crate::input::{Input, Source};
use crate::reports::Verdict;
use nurbs_hausdorff::{Error, Skipped};
use serde::Serialize;
use serde_json::value::{RawValue, to_raw_value};
use std::ffi::OsString;

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

/// The question that a result answers, and the verdict.
#[derive(Debug, Clone, Copy, Serialize)]
pub(crate) struct Asked {
    pub(crate) command: &'static str,
    /// `None` where nothing was judged.
    pub(crate) verdict: Option<Verdict>,
    /// The limit as given, unless the result states it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) limit: Option<f64>,
    /// Whether both directions were measured, of commands that can measure one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) symmetric: Option<bool>,
}

/// A result of the files of A and B.
#[derive(Serialize)]
pub(crate) struct OfFiles<'a, R> {
    #[serde(flatten)]
    head: Head,
    #[serde(flatten)]
    asked: Asked,
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
    pub(crate) fn new(asked: Asked, result: &'a R, a: &'a Input, b: &'a Input) -> Self {
        Self {
            head: Head::new(),
            asked,
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
    command: &'static str,
    file: &'a Source,
    #[serde(flatten)]
    result: &'a R,
}

impl<'a, R> OfFile<'a, R> {
    pub(crate) fn new(command: &'static str, result: &'a R, source: &'a Source) -> Self {
        Self { head: Head::new(), command, file: source, result }
    }
}

/// A result of several files.
#[derive(Serialize)]
pub(crate) struct OfAllFiles<'a, R> {
    #[serde(flatten)]
    head: Head,
    command: &'static str,
    verdict: Verdict,
    files: Vec<&'a Source>,
    #[serde(flatten)]
    result: &'a R,
    /// The faces left out of each file.
    skipped: Vec<&'a [Skipped]>,
}

impl<'a, R> OfAllFiles<'a, R> {
    pub(crate) fn new(command: &'static str, verdict: Verdict, result: &'a R, inputs: &[&'a Input]) -> Self {
        Self {
            head: Head::new(),
            command,
            verdict,
            files: inputs.iter().map(|input| &input.source).collect(),
            result,
            skipped: inputs.iter().map(|input| input.report.read.skipped.as_slice()).collect(),
        }
    }
}

/// The reason for which there is no result.
#[derive(Debug, Serialize)]
pub(crate) struct Reason<'a> {
    pub(crate) code: &'a str,
    pub(crate) message: &'a str,
}

/// What is printed in place of a result.
#[derive(Serialize)]
struct NoResult<'a> {
    #[serde(flatten)]
    head: Head,
    verdict: Verdict,
    error: Reason<'a>,
}

/// Prints an error as JSON if the arguments ask for JSON, and returns its exit status.
pub(crate) fn print_error(code: &str, message: &str) -> u8 {
    if asks_for_json() {
        let error = Reason { code, message };
        // It stands on standard error, too: nothing more can be done if this output fails.
        let _ = print_json(&NoResult { head: Head::new(), verdict: Verdict::Error, error });
    }
    Verdict::Error.status()
}

/// Returns whether the arguments ask for JSON, also where they cannot be parsed.
fn asks_for_json() -> bool {
    let words: Vec<OsString> = std::env::args_os().collect();
    let of_format = words.windows(2).any(|pair| pair[0] == "--format" && pair[1] == "json");
    of_format || words.iter().any(|word| word == "--json" || word == "--format=json")
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
