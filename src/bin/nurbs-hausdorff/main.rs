//! The command line of `nurbs-hausdorff`.

#[cfg(not(target_arch = "wasm32"))]
mod args;
#[cfg(not(target_arch = "wasm32"))]
mod distance;
#[cfg(not(target_arch = "wasm32"))]
mod files;
#[cfg(not(target_arch = "wasm32"))]
mod info;
#[cfg(not(target_arch = "wasm32"))]
mod progress;
#[cfg(not(target_arch = "wasm32"))]
mod report;

/// Exit status of bad input or a failed machine; clap's own for bad arguments.
#[cfg(not(target_arch = "wasm32"))]
const FAILED: u8 = 2;

#[cfg(not(target_arch = "wasm32"))]
fn main() -> std::process::ExitCode {
    use args::{Arguments, Command};
    use clap::{CommandFactory, Parser};
    let done = match Arguments::parse().command {
        Command::Distance(arguments) => distance::run(&arguments),
        Command::Info(arguments) => info::run(&arguments).map(|()| 0),
        Command::Completions { shell } => {
            let mut command = Arguments::command();
            clap_complete::generate(shell, &mut command, "nurbs-hausdorff", &mut std::io::stdout());
            Ok(0)
        }
    };
    let status = done.unwrap_or_else(|error| {
        eprintln!("error[{}]: {error}", error.code());
        FAILED
    });
    std::process::ExitCode::from(status)
}

/// The command line is native only.
#[cfg(target_arch = "wasm32")]
fn main() {}
