//! The command line of `nurbs-hausdorff`.

mod args;
mod completions;
mod convert;
mod diff;
mod distance;
mod failure;
mod files;
mod format;
mod info;
mod motion;
mod output;
mod progress;
mod report;
#[cfg(test)]
mod table;
mod usage;

/// Exit status of bad arguments, bad input or a failed machine.
const FAILED: u8 = 2;

fn main() -> std::process::ExitCode {
    use args::Command;
    let arguments = match usage::arguments() {
        Ok(arguments) => arguments,
        Err(status) => return status,
    };
    let done = match arguments.command {
        Command::Distance(arguments) => distance::run(&arguments),
        Command::Convert(arguments) => convert::run(&arguments).map(|()| 0),
        Command::Diff(arguments) => diff::run(&arguments),
        Command::Info(arguments) => info::run(&arguments).map(|()| 0),
        Command::Completions { shell } => completions::run(shell).map(|()| 0),
    };
    let status = done.unwrap_or_else(|failure| {
        eprintln!("error[{}]: {failure}", failure.code());
        FAILED
    });
    std::process::ExitCode::from(status)
}
