//! The failures that end the program, printed on standard error.

use nurbs_hausdorff::Error;
use std::fmt::{Display, Formatter};
use std::path::PathBuf;

/// An error and its origin.
#[derive(Debug)]
pub(crate) enum Failure {
    /// In the arguments or the machine.
    Plain(Error),
    /// In a model's file.
    Model {
        /// The path as given.
        path: PathBuf,
        /// The error in it.
        error: Error,
    },
    /// In a model's file, as the program that reads it states it.
    Reader {
        /// The path as given.
        path: PathBuf,
        /// The program's code.
        code: String,
        /// The reason.
        message: String,
    },
    /// Standard output could not be written.
    Output(std::io::Error),
    /// A file could not be written.
    File {
        /// The path as given.
        path: PathBuf,
        /// The reason.
        error: std::io::Error,
    },
    /// A file to be written is there already.
    Exists(PathBuf),
}

impl Failure {
    /// The library's code, or one that only the command line has.
    pub(crate) fn code(&self) -> &str {
        match self {
            Self::Plain(error) | Self::Model { error, .. } => error.code(),
            Self::Reader { code, .. } => code,
            Self::Output(_) | Self::File { .. } => "OUTPUT_FAILED",
            Self::Exists(_) => "OUTPUT_EXISTS",
        }
    }
}

impl Display for Failure {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        match self {
            // These errors contain the path.
            Self::Plain(error) | Self::Model { error: error @ Error::FileUnreadable { .. }, .. } => {
                write!(formatter, "{error}")
            }
            Self::Model { path, error } => write!(formatter, "{}: {error}", path.display()),
            Self::Reader { path, message, .. } => write!(formatter, "{}: {message}", path.display()),
            Self::Output(error) => write!(formatter, "standard output: {error}"),
            Self::File { path, error } => write!(formatter, "{}: {error}", path.display()),
            Self::Exists(path) => {
                write!(formatter, "{} is there already; --overwrite replaces it", path.display())
            }
        }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self::Plain(error)
    }
}
