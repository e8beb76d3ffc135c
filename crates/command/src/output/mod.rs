//! Writes the result.

pub(crate) mod checked;
pub(crate) mod digits;
pub(crate) mod file;
pub(crate) mod grid;
pub(crate) mod headline;
pub(crate) mod json;
pub(crate) mod progress;
pub(crate) mod report;

use crate::failure::Failure;
use std::io::{ErrorKind, Write};

/// Writes text to standard output.
///
/// # Errors
/// [`Failure::Output`], but not if the reader has gone, as `head` does.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut output = std::io::stdout().lock();
    match output.write_all(text.as_bytes()).and_then(|()| output.flush()) {
        Err(error) if !is_unread(&error) => Err(Failure::Output(error)),
        _ => Ok(()),
    }
}

/// Returns whether output failed because its reader has gone: that of a pipe, or of a socket with text
/// that was not read.
pub(crate) fn is_unread(error: &std::io::Error) -> bool {
    matches!(error.kind(), ErrorKind::BrokenPipe | ErrorKind::ConnectionReset)
}
