//! Proves a result anew, slowly, in interval arithmetic and with none of the search's code.
//!
//! `nurbs-hausdorff distance A.json B.json --json > RESULT.json`
//! `cargo run --release --example verify -- A.json B.json RESULT.json`
//!
//! Prints `proved`, `not proved in the time given` or `refuted`; exit status 0, 3 or 1, and 2 for
//! bad input. Models are moved by `--rotate` and `--translate` as by the command.

#[path = "../../src/bin/nurbs-hausdorff/arguments/motion.rs"]
mod motion;
#[allow(dead_code, reason = "the fuzzer compares with parts of models")]
mod proof;

use clap::Parser;
use motion::{Rotation, Translation};
use proof::{Claim, Model, Motion, Report, Settings, Verdict, Witness};
use serde::Deserialize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

/// Proves or refutes the interval of a result.
#[derive(Parser)]
struct Arguments {
    /// The model measured from.
    a: PathBuf,
    /// The model measured to.
    b: PathBuf,
    /// The result, as `nurbs-hausdorff distance A B --json` prints it.
    result: PathBuf,
    /// Seconds after which the proof is given up.
    #[arg(long, default_value_t = 60.0)]
    seconds: f64,
    /// What is added to both sides of the interval, relative to the larger diagonal, or to the upper
    /// end where both models are points.
    #[arg(long, default_value_t = 1e-3)]
    slack: f64,
    /// The translation of A that the result was computed with.
    #[arg(long, value_name = "X,Y,Z", default_value = "0,0,0", allow_hyphen_values = true)]
    translate: Translation,
    /// The rotation of A that the result was computed with.
    #[arg(long, value_name = "X,Y,Z,DEGREES", default_value = "0,0,1,0", allow_hyphen_values = true)]
    rotate: Rotation,
}

/// What is read of a result.
#[derive(Deserialize)]
struct Stated {
    lower: f64,
    upper: f64,
    witness: StatedWitness,
    forward: Option<serde_json::Value>,
}

#[derive(Deserialize)]
struct StatedWitness {
    a: StatedPoint,
}

#[derive(Deserialize)]
struct StatedPoint {
    surface: usize,
    u: f64,
    v: f64,
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(report) => {
            for note in &report.notes {
                println!("{note}");
            }
            println!("lower: {}; upper: {}; {} cells", word(report.lower), word(report.upper), report.cells);
            println!("{}", word(report.verdict()));
            ExitCode::from(match report.verdict() {
                Verdict::Proved => 0,
                Verdict::Refuted => 1,
                Verdict::NotProved => 3,
            })
        }
        Err(reason) => {
            eprintln!("{reason}");
            ExitCode::from(2)
        }
    }
}

fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Proved => "proved",
        Verdict::NotProved => "not proved in the time given",
        Verdict::Refuted => "refuted",
    }
}

fn run(arguments: &Arguments) -> Result<Report, String> {
    let model = |path: &Path| {
        let text = read(path)?;
        Model::from_json(&text).map_err(|reason| format!("{}: {reason}", path.display()))
    };
    let (a, b) = (model(&arguments.a)?, model(&arguments.b)?);
    let text = read(&arguments.result)?;
    let stated: Stated =
        serde_json::from_str(&text).map_err(|error| format!("{}: {error}", arguments.result.display()))?;
    if stated.forward.is_some() {
        return Err("a symmetric result: verify the results of both directions instead".to_owned());
    }
    let StatedPoint { surface, u, v } = stated.witness.a;
    let claim = Claim { lower: stated.lower, upper: stated.upper, witness: Witness { surface, u, v } };
    let motion =
        Motion { rotation: arguments.rotate.0.to_array(), translation: arguments.translate.0.to_array() };
    let time = Duration::try_from_secs_f64(arguments.seconds).map_err(|error| error.to_string())?;
    if !(arguments.slack >= 0.0 && arguments.slack.is_finite()) {
        return Err(format!("slack is {}, expected a number that is not negative", arguments.slack));
    }
    let settings = Settings { time, slack: arguments.slack };
    Ok(proof::check(&a, &motion, &b, &claim, &settings))
}

fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}
