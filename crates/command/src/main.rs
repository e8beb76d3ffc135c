//! The command line of `nurbs-hausdorff`.

// The engine that threads share owns a device, whose type is nested deeply.
#![recursion_limit = "256"]

mod arguments;
mod batch;
mod commands;
mod failure;
mod input;
mod output;
mod pairs;
mod reports;

fn main() -> std::process::ExitCode {
    use arguments::Command;
    use commands::{
        align, check, clearance, closest_points, completions, convert, diff, distance, gaps, grid, info,
        overlap, score, statistics, summary,
    };
    let arguments = match arguments::usage::arguments() {
        Ok(arguments) => arguments,
        Err(status) => return status,
    };
    let done = match arguments.command {
        Command::Distance(arguments) => distance::run(&arguments),
        Command::Convert(arguments) => convert::run(&arguments),
        Command::Diff(arguments) => diff::run(&arguments),
        Command::Clearance(arguments) => clearance::run(&arguments),
        Command::Gaps(arguments) => gaps::run(&arguments),
        Command::Overlap(arguments) => overlap::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Statistics(arguments) => statistics::run(&arguments).map(|()| 0),
        Command::Score(arguments) => score::run(&arguments),
        Command::Summary(arguments) => summary::run(&arguments).map(|()| 0),
        Command::Align(arguments) => align::run(&arguments),
        Command::ClosestPoints(arguments) => closest_points::run(&arguments).map(|()| 0),
        Command::Grid(arguments) => grid::run(&arguments).map(|()| 0),
        Command::Batch(arguments) => batch::run(&arguments),
        Command::Info(arguments) => info::run(&arguments).map(|()| 0),
        Command::Completions { shell } => completions::run(shell).map(|()| 0),
    };
    let status = done.unwrap_or_else(|failure| {
        // Paths and words of a file cannot begin another line, which would look like one of ours.
        let message = nurbs_hausdorff::one_line(&failure.to_string());
        eprintln!("error[{}]: {message}", failure.code());
        output::json::print_error(failure.code(), &message)
    });
    std::process::ExitCode::from(status)
}
