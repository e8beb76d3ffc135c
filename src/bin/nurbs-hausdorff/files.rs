//! Reading models.

use nurbs_hausdorff::model::MAX_JSON_BYTES;
use nurbs_hausdorff::{Error, Model, Result};
use std::path::Path;

/// The model in a file.
///
/// # Errors
/// [`Error::FileUnreadable`], [`Error::FileTooLarge`] before anything is read,
/// else as [`Model::from_json`].
pub(crate) fn read(path: &Path) -> Result<Model> {
    let unreadable = |error: std::io::Error| Error::FileUnreadable {
        path: path.display().to_string(),
        found: error.to_string(),
    };
    let found = std::fs::metadata(path).map_err(unreadable)?.len();
    if found > MAX_JSON_BYTES {
        return Err(Error::FileTooLarge { found, expected: MAX_JSON_BYTES });
    }
    let bytes = std::fs::read(path).map_err(unreadable)?;
    let text = String::from_utf8(bytes)
        .map_err(|error| Error::JsonShape { found: format!("{}: {error}", path.display()) })?;
    Model::from_json(&text)
}
