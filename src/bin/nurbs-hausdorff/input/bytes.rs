//! The bytes of a model, from a file or from standard input.

use nurbs_hausdorff::{Beside, Error, MeshFile, MeshFormat, Model, Result};
use serde::Serialize;
use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use std::fs::File;
use std::io::Read;
use std::path::{Component, Path};

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
/// [`Error::FileUnreadable`]; [`Error::FileTooLarge`] before more than [`max_bytes`] are read.
pub(super) fn bytes(path: &Path) -> Result<Vec<u8>> {
    let unreadable = |error: std::io::Error| Error::FileUnreadable {
        path: path.display().to_string(),
        found: error.to_string(),
    };
    let most = max_bytes(path);
    if path.as_os_str() == STANDARD_STREAM {
        return bounded(std::io::stdin().lock(), most, unreadable);
    }
    let file = File::open(path).map_err(unreadable)?;
    let length = file.metadata().map_err(unreadable)?.len();
    if length > most {
        return Err(too_large(length, most));
    }
    bounded(file, most, unreadable)
}

/// Returns the largest size of a file: that of meshes and clouds by the ending of its name, else that of CAD.
fn max_bytes(path: &Path) -> u64 {
    let is_mesh = MeshFormat::of_name(&path.to_string_lossy()).is_some();
    if is_mesh { MeshFile::MAX_BYTES } else { Model::MAX_JSON_BYTES }
}

/// Returns the other files that belong to a model's file, as the files of its buffers belong to a glTF. Only files in
/// its folder or below are read. A path that leads elsewhere is left out: a file that somebody sent must not choose
/// which files of this machine are read. A model from standard input has no other files.
///
/// # Errors
/// Those of [`bytes`]; [`Error::FileTooLarge`] for more than that all together.
pub(super) fn beside(path: &Path, content: &[u8]) -> Result<Beside> {
    let mut files = Beside::new();
    if path.as_os_str() == STANDARD_STREAM {
        return Ok(files);
    }
    let Ok(Some(format)) = MeshFormat::of_file(content, &path.to_string_lossy()) else { return Ok(files) };
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut length = 0;
    for name in MeshFile::names_beside(content, format) {
        let is_below = Path::new(&name).components().all(|part| matches!(part, Component::Normal(_)));
        if !is_below || files.contains_key(&name) {
            continue;
        }
        let found = bytes(&folder.join(&name))?;
        length += found.len() as u64;
        if length > Model::MAX_JSON_BYTES {
            return Err(too_large(length, Model::MAX_JSON_BYTES));
        }
        files.insert(name, found);
    }
    Ok(files)
}

/// Reads to the end: a pipe or a device states no length, and a file may grow.
fn bounded(reader: impl Read, most: u64, unreadable: impl Fn(std::io::Error) -> Error) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    reader.take(most + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    match bytes.len() as u64 {
        length if length > most => Err(too_large(length, most)),
        _ => Ok(bytes),
    }
}

fn too_large(found: u64, expected: u64) -> Error {
    Error::FileTooLarge { found, expected }
}
