//! The bytes of a model, from a file or from standard input.

use nurbs_hausdorff::Result;
use nurbs_hausdorff_meshes::Beside;
use serde::Serialize;
use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use std::path::Path;

/// The path that stands for standard input, and for standard output.
pub(crate) const STANDARD_STREAM: &str = "-";

/// A model's file, by which a result can be traced to it.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Source {
    /// The path as given.
    path: String,
    /// SHA-256 of the file's bytes and those of the files beside it that it consists of, in hexadecimal digits.
    sha256: String,
}

impl Source {
    pub(super) fn new(path: &Path, bytes: &[u8], beside: &Beside) -> Self {
        let mut hash = Sha256::new_with_prefix(bytes);
        beside.values().for_each(|bytes| hash.update(bytes));
        Self { path: path.display().to_string(), sha256: hexadecimal(&hash.finalize()) }
    }

    pub(crate) fn path(&self) -> &str {
        &self.path
    }

    pub(crate) fn sha256(&self) -> &str {
        &self.sha256
    }
}

/// Returns two digits for each byte.
pub(crate) fn hexadecimal(bytes: &[u8]) -> String {
    let mut digits = String::new();
    for byte in bytes {
        // Writing to a string does not fail.
        let _ = write!(digits, "{byte:02x}");
    }
    digits
}

/// Returns the bytes of a file, or of standard input for [`STANDARD_STREAM`].
///
/// # Errors
/// Those of [`nurbs_hausdorff_files::bytes`].
pub(super) fn bytes(path: &Path) -> Result<Vec<u8>> {
    if is_standard_input(path) {
        return nurbs_hausdorff_files::bounded(std::io::stdin().lock(), path);
    }
    nurbs_hausdorff_files::bytes(path)
}

/// Returns the other files that belong to a model's file. A model from standard input has none.
///
/// # Errors
/// Those of [`nurbs_hausdorff_files::bytes_beside`].
pub(super) fn beside(path: &Path, content: &[u8]) -> Result<Beside> {
    if is_standard_input(path) {
        return Ok(Beside::new());
    }
    nurbs_hausdorff_files::bytes_beside(path, content)
}

fn is_standard_input(path: &Path) -> bool {
    path.as_os_str() == STANDARD_STREAM
}
