//! Reads models.

mod format;

use crate::failure::Failure;
use nurbs_hausdorff::{Error, Model, ReadReport, Result};
use serde::Serialize;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The model in a file of interchange JSON or OpenCASCADE's BREP text, found by its content.
///
/// # Errors
/// [`Error::FileUnreadable`], [`Error::FileTooLarge`] before anything is read,
/// [`Error::FormatUnsupported`] with the way to convert, else as [`Model::from_json`] and
/// [`Model::from_brep`]; all with the path.
pub(crate) fn read(path: &Path) -> std::result::Result<Model, Failure> {
    read_with_report(path).map(|(model, _)| model)
}

/// As [`read`], with the report on what was read.
pub(crate) fn read_with_report(path: &Path) -> std::result::Result<(Model, CadReport), Failure> {
    let model = bytes(path).and_then(|bytes| parse(path, bytes));
    let (model, report) = model.map_err(|error| Failure::Model { path: path.to_owned(), error })?;
    for skipped in &report.read.skipped {
        let (path, face, why) = (path.display(), skipped.face, &skipped.why);
        eprintln!("warning: {path}: face {face} is left out: {why}");
    }
    Ok((model, report))
}

/// A report, with the kind of the file.
#[derive(Serialize)]
pub(crate) struct CadReport {
    pub(crate) kind: &'static str,
    #[serde(flatten)]
    pub(crate) read: ReadReport,
}

fn parse(path: &Path, bytes: Vec<u8>) -> Result<(Model, CadReport)> {
    if let Some(found) = format::unsupported(&bytes) {
        return Err(Error::FormatUnsupported { found, path: path.display().to_string() });
    }
    let text = String::from_utf8(bytes).map_err(|error| Error::JsonShape { found: error.to_string() })?;
    if format::is_brep(&text) {
        let (model, read) = Model::from_brep(&text)?;
        return Ok((model, CadReport { kind: "brep", read }));
    }
    let model = Model::from_json(&text)?;
    let read = ReadReport::of_exact(&model);
    Ok((model, CadReport { kind: "json", read }))
}

fn bytes(path: &Path) -> Result<Vec<u8>> {
    let unreadable = |error: std::io::Error| Error::FileUnreadable {
        path: path.display().to_string(),
        found: error.to_string(),
    };
    let too_large = |found| Error::FileTooLarge { found, expected: Model::MAX_JSON_BYTES };
    let file = File::open(path).map_err(unreadable)?;
    let length = file.metadata().map_err(unreadable)?.len();
    if length > Model::MAX_JSON_BYTES {
        return Err(too_large(length));
    }
    // A pipe or a device has no length, and a file may grow.
    let mut bytes = Vec::new();
    file.take(Model::MAX_JSON_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > Model::MAX_JSON_BYTES {
        return Err(too_large(bytes.len() as u64));
    }
    Ok(bytes)
}
