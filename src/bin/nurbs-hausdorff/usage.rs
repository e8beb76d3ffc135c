//! The arguments as given, or why they are none.

use crate::FAILED;
use crate::args::Arguments;
use clap::Parser;
use std::process::ExitCode;

/// The code of arguments that are not understood, as for options in JavaScript.
const CODE: &str = "OPTION_INVALID";

/// The program's arguments.
///
/// # Errors
/// The exit status, once help or what is wrong has been printed.
pub(crate) fn arguments() -> Result<Arguments, ExitCode> {
    Arguments::try_parse().map_err(|error| {
        if !error.use_stderr() {
            // A reader of the help that left early is no failure.
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
