//! Reads models.

mod format;

use crate::failure::Failure;
use nurbs_hausdorff::{Error, Model, PreparedModel, ReadReport, Result, Skipped};
use serde::Serialize;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Reads the model in a file of interchange JSON, STEP, IGES or OpenCASCADE's BREP text, found by its
/// content, and prints the faces left out and the notes on others.
///
/// # Errors
/// [`Error::FileUnreadable`], [`Error::FileTooLarge`] before anything is read,
/// [`Error::FormatUnsupported`] with the way to convert, else as [`Model::from_json`],
/// [`Model::from_step`], [`Model::from_iges`], [`Model::from_brep`] and [`PreparedModel`]; all with the path.
pub(crate) fn read(path: &Path) -> std::result::Result<Input, Failure> {
    let input = bytes(path).and_then(|bytes| parse(path, bytes));
    let input = input.map_err(|error| Failure::Model { path: path.to_owned(), error })?;
    for skipped in &input.report.read.skipped {
        let (path, face, why) = (path.display(), skipped.face, &skipped.why);
        let entity = skipped.entity.map(|entity| format!(" (#{entity})")).unwrap_or_default();
        eprintln!("warning: {path}: face {face}{entity} is left out: {why}");
    }
    for note in &input.report.read.notes {
        eprintln!("note: {}: face {}: {}", path.display(), note.face, note.why);
    }
    Ok(input)
}

/// A model that was read.
pub(crate) struct Input {
    /// The model, without the faces left out.
    pub(crate) model: Model,
    pub(crate) prepared: PreparedModel,
    pub(crate) report: CadReport,
}

/// A result with the faces that were left out of the files' models, if any.
#[derive(Serialize)]
pub(crate) struct OfFiles<'a, R> {
    #[serde(flatten)]
    result: &'a R,
    #[serde(skip_serializing_if = "Option::is_none")]
    skipped: Option<LeftOut<'a>>,
}

/// The faces left out of A and of B.
#[derive(Serialize)]
struct LeftOut<'a> {
    a: &'a [Skipped],
    b: &'a [Skipped],
}

impl<'a, R> OfFiles<'a, R> {
    pub(crate) fn new(result: &'a R, a: &'a Input, b: &'a Input) -> Self {
        let [a, b] = [a, b].map(|input| input.report.read.skipped.as_slice());
        let skipped = (!a.is_empty() || !b.is_empty()).then_some(LeftOut { a, b });
        Self { result, skipped }
    }
}

/// Returns whether a verdict holds for the files: no faces were left out of their models, or that is
/// allowed. Says on standard error why it does not.
pub(crate) fn is_judged(a: &Input, b: &Input, allow_skipped: bool) -> bool {
    let skipped: usize = [a, b].map(|input| input.report.read.skipped.len()).iter().sum();
    let is_judged = allow_skipped || skipped == 0;
    if !is_judged {
        eprintln!("undecided: {skipped} faces were left out; --allow-skipped judges the others");
    }
    is_judged
}

/// The reader of all files, by the name that the command of the npm package gives it.
const READER: &str = "built-in";

/// A report, with the kind of the file and its reader.
#[derive(Serialize)]
pub(crate) struct CadReport {
    pub(crate) kind: &'static str,
    reader: &'static str,
    #[serde(flatten)]
    pub(crate) read: ReadReport,
}

fn parse(path: &Path, bytes: Vec<u8>) -> Result<Input> {
    if let Some(found) = format::unsupported(&bytes) {
        return Err(Error::FormatUnsupported { found, path: path.display().to_string() });
    }
    if format::is_binary_brep(&bytes) {
        return Err(Error::BrepSyntax {
            line: 1,
            found: "an OpenCASCADE BREP file in binary".to_owned(),
            expected: "BREP text, as BRepTools::Write writes it".to_owned(),
        });
    }
    if format::is_step(&bytes) {
        let (model, read) = Model::from_step(&bytes)?;
        return of_cad(model, read, "step");
    }
    if format::is_iges(&bytes) {
        let (model, read) = Model::from_iges(&bytes)?;
        return of_cad(model, read, "iges");
    }
    let text = String::from_utf8(bytes).map_err(|error| Error::JsonShape { found: error.to_string() })?;
    if format::is_brep(&text) {
        let (model, read) = Model::from_brep(&text)?;
        return of_cad(model, read, "brep");
    }
    let model = Model::from_json(&text)?;
    let prepared = PreparedModel::new(&model)?;
    let report = CadReport { kind: "json", reader: READER, read: ReadReport::of_exact(&model) };
    Ok(Input { model, prepared, report })
}

/// Prepares a model of a CAD file without the faces that cannot be cut into patches.
fn of_cad(model: Model, mut read: ReadReport, kind: &'static str) -> Result<Input> {
    let (model, prepared) = PreparedModel::of_read(model, &mut read)?;
    Ok(Input { model, prepared, report: CadReport { kind, reader: READER, read } })
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
