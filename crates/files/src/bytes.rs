//! The bytes of a file and of those beside it, with bounded sizes.

use nurbs_hausdorff::{Error, Model, Result};
use nurbs_hausdorff_meshes::{Beside, MeshFile, MeshFormat};
use std::fs::File;
use std::io::Read;
use std::path::{Component, Path};

/// Returns the bytes of a file.
///
/// # Errors
/// [`Error::FileUnreadable`]; [`Error::FileTooLarge`] before more than 1 GiB of a mesh or a cloud, by the ending of its
/// name, or [`Model::MAX_JSON_BYTES`] of another file are read.
pub fn bytes(path: &Path) -> Result<Vec<u8>> {
    let file = File::open(path).map_err(|error| unreadable(path, &error))?;
    let length = file.metadata().map_err(|error| unreadable(path, &error))?.len();
    let most = max_bytes(path);
    if length > most {
        return Err(too_large(length, most));
    }
    bounded(file, path)
}

/// Returns all bytes of a reader, which is called by this path: a pipe or a device states no length, and a file may
/// grow.
///
/// # Errors
/// Those of [`bytes`].
pub fn bounded(reader: impl Read, path: &Path) -> Result<Vec<u8>> {
    let most = max_bytes(path);
    let mut bytes = Vec::new();
    reader.take(most + 1).read_to_end(&mut bytes).map_err(|error| unreadable(path, &error))?;
    match bytes.len() as u64 {
        length if length > most => Err(too_large(length, most)),
        _ => Ok(bytes),
    }
}

/// Returns the other files that belong to a model's file, as the files of its buffers belong to a glTF. Only files in
/// its folder or below are read. A path that leads elsewhere is left out: a file that somebody sent must not choose
/// which files of this machine are read.
///
/// # Errors
/// Those of [`bytes`]; [`Error::FileTooLarge`] for more than [`Model::MAX_JSON_BYTES`] all together.
pub fn bytes_beside(path: &Path, content: &[u8]) -> Result<Beside> {
    let mut files = Beside::new();
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

/// Returns the largest size of a file: that of meshes and clouds by the ending of its name, else that of CAD.
fn max_bytes(path: &Path) -> u64 {
    let is_mesh = MeshFormat::of_name(&path.to_string_lossy()).is_some();
    if is_mesh { MeshFile::MAX_BYTES } else { Model::MAX_JSON_BYTES }
}

fn unreadable(path: &Path, error: &std::io::Error) -> Error {
    Error::FileUnreadable { path: path.display().to_string(), found: error.to_string() }
}

fn too_large(found: u64, expected: u64) -> Error {
    Error::FileTooLarge { found, expected }
}
