//! Parses the arguments and prints their errors.

use crate::arguments::Arguments;
use crate::output::json::print_error;
use clap::{CommandFactory, FromArgMatches};
use std::process::ExitCode;

/// The code of arguments that cannot be parsed, as for options in JavaScript.
const CODE: &str = "OPTION_INVALID";

/// The program's arguments.
///
/// # Errors
/// The exit status, after the help or the error has been printed.
pub(crate) fn arguments() -> Result<Arguments, ExitCode> {
    // Numbers below 0 are values, whose range is checked with that of others.
    let command = Arguments::command().mut_subcommands(|one| one.allow_negative_numbers(true));
    let parsed = command.try_get_matches().and_then(|matches| Arguments::from_arg_matches(&matches));
    parsed.map_err(|error| {
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
        // What the error itself says stands before the usage.
        let message = text.strip_prefix("error: ").unwrap_or(&text).split("\n\n").next().unwrap_or_default();
        ExitCode::from(print_error(CODE, message))
    })
}
