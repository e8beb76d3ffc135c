//! What ends the program early, as told on standard error.

use nurbs_hausdorff::Error;
use std::fmt::{Display, Formatter};
use std::path::PathBuf;

/// An error, and whose it is.
#[derive(Debug)]
pub(crate) enum Failure {
    /// Of the arguments, or of the machine.
    Plain(Error),
    /// Of a model's file.
    Model {
        /// As given.
        path: PathBuf,
        /// What is wrong with it.
        error: Error,
    },
    /// Standard output could not be written.
    Output(std::io::Error),
}

impl Failure {
    /// The library's code, or the one code of the command line's own.
    pub(crate) fn code(&self) -> &'static str {
        match self {
            Self::Plain(error) | Self::Model { error, .. } => error.code(),
            Self::Output(_) => "OUTPUT_FAILED",
        }
    }
}

impl Display for Failure {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        match self {
            // These name the path themselves.
            Self::Plain(error) | Self::Model { error: error @ Error::FileUnreadable { .. }, .. } => {
                write!(formatter, "{error}")
            }
            Self::Model { path, error } => write!(formatter, "{}: {error}", path.display()),
            Self::Output(error) => write!(formatter, "standard output: {error}"),
        }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self::Plain(error)
    }
}
