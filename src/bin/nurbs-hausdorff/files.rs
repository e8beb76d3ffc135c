//! Reads models.

use crate::failure::Failure;
use nurbs_hausdorff::{Error, Model, Result};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The model in a file.
///
/// # Errors
/// [`Error::FileUnreadable`], [`Error::FileTooLarge`] before anything is read,
/// else as [`Model::from_json`]; all with the path.
pub(crate) fn read(path: &Path) -> std::result::Result<Model, Failure> {
    let model = text(path).and_then(|text| Model::from_json(&text));
    model.map_err(|error| Failure::Model { path: path.to_owned(), error })
}

fn text(path: &Path) -> Result<String> {
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
    String::from_utf8(bytes).map_err(|error| Error::JsonShape { found: error.to_string() })
}
