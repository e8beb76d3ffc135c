//! Parses the arguments and prints their errors.

use crate::FAILED;
use crate::arguments::Arguments;
use clap::Parser;
use std::process::ExitCode;

/// The code of arguments that cannot be parsed, as for options in JavaScript.
const CODE: &str = "OPTION_INVALID";

/// The program's arguments.
///
/// # Errors
/// The exit status, after the help or the error has been printed.
pub(crate) fn arguments() -> Result<Arguments, ExitCode> {
    Arguments::try_parse().map_err(|error| {
        if !error.use_stderr() {
            // It is no failure if the reader of the help has gone.
            let _ = error.print();
            return ExitCode::SUCCESS;
        }
        let text = error.render().to_string();
        match text.strip_prefix("error: ") {
            Some(text) => eprint!("error[{CODE}]: {text}"),
            None => eprint!("{text}"),
        }
        ExitCode::from(FAILED)
    })
}
