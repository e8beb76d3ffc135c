//! Rhino's 3DM, which another program turns into interchange JSON: its reader, rhino3dm, is JavaScript's.

use crate::failure::Failure;
use nurbs_hausdorff::{Model, ReadReport};
use serde::Deserialize;
use std::ffi::OsString;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

/// The variable of the environment that holds the program and its arguments, an array of JSON. The
/// command of the npm package sets it.
///
/// The program takes the name of the file as one more argument and its bytes from standard input. It
/// writes an [`Answer`] as JSON.
const PROGRAM: &str = "NURBS_HAUSDORFF_3DM";

/// The first bytes of a 3DM file.
const SIGNATURE: &[u8] = b"3D Geometry File Format";

/// The kind and the reader, as the npm package calls them.
pub(super) const KIND: &str = "3dm";
pub(super) const READER: &str = "rhino3dm";

/// The code of a program that gives no answer.
const FAILED: &str = "CAD_UNREADABLE";

/// What the program writes.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
enum Answer {
    /// Interchange JSON, and the account of what was read.
    Model { json: String, report: ReadReport },
    /// Why the file has none.
    Error { code: String, message: String },
}

/// Returns the program that reads these bytes, if they are a 3DM file and there is one.
pub(super) fn reader(bytes: &[u8]) -> Option<OsString> {
    bytes.starts_with(SIGNATURE).then(|| std::env::var_os(PROGRAM)).flatten()
}

/// Reads a 3DM file by the program.
///
/// # Errors
/// Those that the program states; [`FAILED`] if it fails; those of [`Model::from_json`].
pub(super) fn read(program: &OsString, path: &Path, bytes: &[u8]) -> Result<(Model, ReadReport), Failure> {
    let failed = |found: String| Failure::Reader {
        path: path.to_owned(),
        code: FAILED.to_owned(),
        message: format!("the reader of 3DM files failed: {found}"),
    };
    let words: Vec<String> = serde_json::from_slice(program.as_encoded_bytes())
        .map_err(|error| failed(format!("{PROGRAM} is no array of words: {error}")))?;
    let output = run(&words, path, bytes).map_err(|error| failed(error.to_string()))?;
    match serde_json::from_slice(&output) {
        Ok(Answer::Model { json, report }) => {
            let model = Model::from_json(&json);
            Ok((model.map_err(|error| Failure::Model { path: path.to_owned(), error })?, report))
        }
        Ok(Answer::Error { code, message }) => Err(Failure::Reader { path: path.to_owned(), code, message }),
        Err(error) => Err(failed(error.to_string())),
    }
}

/// Returns what the program writes; its messages go to standard error.
fn run(words: &[String], path: &Path, bytes: &[u8]) -> std::io::Result<Vec<u8>> {
    let (program, arguments) = words.split_first().ok_or(std::io::ErrorKind::NotFound)?;
    let mut command = Command::new(program);
    let mut child = command.args(arguments).arg(path).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn()?;
    if let Some(mut input) = child.stdin.take() {
        // A program that ends before it has read everything says why in its answer.
        let _ = input.write_all(bytes);
    }
    Ok(child.wait_with_output()?.stdout)
}
