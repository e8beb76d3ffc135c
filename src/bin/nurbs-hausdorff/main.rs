//! The command line of `nurbs-hausdorff`.

#[cfg(not(target_arch = "wasm32"))]
mod args;
#[cfg(not(target_arch = "wasm32"))]
mod completions;
#[cfg(not(target_arch = "wasm32"))]
mod distance;
#[cfg(not(target_arch = "wasm32"))]
mod failure;
#[cfg(not(target_arch = "wasm32"))]
mod files;
#[cfg(not(target_arch = "wasm32"))]
mod info;
#[cfg(not(target_arch = "wasm32"))]
mod motion;
#[cfg(not(target_arch = "wasm32"))]
mod output;
#[cfg(not(target_arch = "wasm32"))]
mod progress;
#[cfg(not(target_arch = "wasm32"))]
mod report;
#[cfg(not(target_arch = "wasm32"))]
mod usage;

/// Exit status of bad arguments, bad input or a failed machine.
#[cfg(not(target_arch = "wasm32"))]
const FAILED: u8 = 2;

#[cfg(not(target_arch = "wasm32"))]
fn main() -> std::process::ExitCode {
    use args::Command;
    let arguments = match usage::arguments() {
        Ok(arguments) => arguments,
        Err(status) => return status,
    };
    let done = match arguments.command {
        Command::Distance(arguments) => distance::run(&arguments),
        Command::Info(arguments) => info::run(&arguments).map(|()| 0),
        Command::Completions { shell } => completions::run(shell).map(|()| 0),
    };
    let status = done.unwrap_or_else(|failure| {
        eprintln!("error[{}]: {failure}", failure.code());
        FAILED
    });
    std::process::ExitCode::from(status)
}

/// The command line is native only.
#[cfg(target_arch = "wasm32")]
fn main() {}
