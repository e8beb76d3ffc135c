//! A file that a command writes.

use crate::failure::Failure;
use crate::input::STANDARD_STREAM;
use nurbs_hausdorff::Error;
use std::fs::OpenOptions;
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::Path;

/// Returns whether the output is standard output. Refuses a file whose name does not end with a dot and these letters, in any
/// case.
///
/// # Errors
/// [`Error::OptionOutOfRange`], with what is expected.
pub(crate) fn is_stream(path: &Path, ending: &str, expected: &'static str) -> Result<bool, Error> {
    let is_stream = path.as_os_str() == STANDARD_STREAM;
    if is_stream || path.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending)) {
        return Ok(is_stream);
    }
    Err(Error::OptionOutOfRange { option: "output", found: format!("{path:?}"), expected })
}

/// Writes a file that is not there yet, or is to be replaced.
///
/// # Errors
/// [`Failure::Exists`]; [`Failure::File`].
pub(crate) fn write_file(
    path: &Path,
    overwrite: bool,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Failure> {
    let mut options = OpenOptions::new();
    options.write(true).truncate(true).create(overwrite).create_new(!overwrite);
    let written = options.open(path).and_then(|file| {
        let mut out = BufWriter::new(file);
        write(&mut out)?;
        out.flush()
    });
    written.map_err(|error| match error.kind() {
        ErrorKind::AlreadyExists => Failure::Exists(path.to_owned()),
        _ => Failure::File { path: path.to_owned(), error },
    })
}
