//! Proves a result anew, slowly, in interval arithmetic and with none of the search's code.
//!
//! `nurbs-hausdorff distance A.json B.json --json > RESULT.json`
//! `cargo run --release --example verify -- A.json B.json RESULT.json`
//!
//! `nurbs-hausdorff clearance A.json B.json --json > RESULT.json`
//! `cargo run --release --example verify -- --clearance A.json B.json RESULT.json`
//!
//! `cargo run --release --example verify -- --cuts PART.brep OTHER.json`
//!
//! The second form proves the interval around the least distance, of models without trimmed faces.
//! The third form proves of every trimmed face that the pieces it is cut into are that face, to its
//! stated deviation and the slack, relative to the face's diagonal: they cover it, lie in it, and are
//! points of its surface. It prints a line of CSV for each model, of any format that is read.
//!
//! In the first two forms a model may be a mesh or a cloud of points, by the ending of its name: each
//! triangle and each point is proved as a surface, so that thousands of them take minutes.
//!
//! Prints `proved`, `undecided`, which is not proved in the time given, or `refuted`; exit status 0, 3 or 1, and 2 for
//! bad input. Models are moved by `--rotate` and `--translate` as by the command.

mod cuts;
mod facets;
#[path = "../../crates/command/src/arguments/models/motion.rs"]
mod motion;
#[allow(dead_code, reason = "the fuzzer compares with parts of models")]
mod proof;

use clap::Parser;
use motion::{Rotation, Translation};
use nurbs_hausdorff_cad::from_file;
use proof::{Claim, Deadline, LeastClaim, Model, Motion, Report, Settings, Verdict, Witness};
use serde::Deserialize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

/// Proves or refutes the interval of a result.
#[derive(Parser)]
struct Arguments {
    /// The model measured from.
    #[arg(required_unless_present = "cuts")]
    a: Option<PathBuf>,
    /// The model measured to.
    #[arg(required_unless_present = "cuts")]
    b: Option<PathBuf>,
    /// The result, as `nurbs-hausdorff distance A B --json` prints it.
    #[arg(required_unless_present = "cuts")]
    result: Option<PathBuf>,
    /// The result is a clearance, as `nurbs-hausdorff clearance A B --json` prints it.
    #[arg(long, conflicts_with = "cuts")]
    clearance: bool,
    /// Models whose faces' cuts are proved.
    #[arg(long, num_args = 1.., conflicts_with_all = ["a", "b", "result"])]
    cuts: Vec<PathBuf>,
    /// Seconds after which a proof is given up: of the CPU for a face's cut.
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
    b: StatedPoint,
}

#[derive(Deserialize)]
struct StatedPoint {
    face: usize,
    u: f64,
    v: f64,
    /// The triangle of a mesh, with the weights of its corners.
    triangle: Option<usize>,
    barycentric: Option<[f64; 3]>,
    /// The point of a cloud.
    index: Option<usize>,
}

impl StatedPoint {
    fn witness(&self) -> Witness {
        match (self.triangle, self.barycentric, self.index) {
            (Some(triangle), Some(weights), _) => facets::witness(triangle, weights),
            (_, _, Some(surface)) => Witness { surface, u: 0.0, v: 0.0 },
            _ => Witness { surface: self.face, u: self.u, v: self.v },
        }
    }
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    if !arguments.cuts.is_empty() {
        return prove_cuts(&arguments);
    }
    match run(&arguments) {
        Ok(report) => {
            for note in &report.notes {
                println!("{note}");
            }
            println!("lower: {}; upper: {}; {} cells", word(report.lower), word(report.upper), report.cells);
            println!("{}", word(report.verdict()));
            status(report.verdict())
        }
        Err(reason) => {
            eprintln!("{reason}");
            ExitCode::from(2)
        }
    }
}

fn status(verdict: Verdict) -> ExitCode {
    ExitCode::from(match verdict {
        Verdict::Proved => 0,
        Verdict::Refuted => 1,
        Verdict::NotProved => 3,
    })
}

/// What became of a model's trimmed faces.
#[derive(Default)]
struct Counts {
    /// By verdict.
    found: [usize; 3],
    uncut: usize,
    seconds: f64,
    slowest: f64,
}

/// Proves the cuts of all trimmed faces: prints a line of CSV for each model, and those that are not
/// proved on standard error.
fn prove_cuts(arguments: &Arguments) -> ExitCode {
    let mut worst = Verdict::Proved;
    println!("model,proved,undecided,refuted,not cut,CPU seconds,slowest");
    for path in &arguments.cuts {
        let model = match library_model(path) {
            Ok(model) => model,
            Err(reason) => {
                eprintln!("{}: not read: {reason}", path.display());
                continue;
            }
        };
        let mut counts = Counts::default();
        for (index, face) in model.faces().enumerate() {
            let Some(cut) = cuts::cut(index, &face, MAX_DEVIATION * model.bounding_box().diagonal()) else {
                continue;
            };
            let Ok(cut) = cut else {
                counts.uncut += 1;
                continue;
            };
            let deadline = Deadline::after(arguments.seconds);
            let finding = proof::cut::check(&cut, arguments.slack, &deadline);
            counts.found[finding.verdict as usize] += 1;
            counts.seconds += deadline.spent();
            counts.slowest = counts.slowest.max(deadline.spent());
            if finding.verdict != Verdict::Proved {
                let note = finding.note.unwrap_or_default();
                eprintln!("{}: face {index}: {} {note}", path.display(), word(finding.verdict));
            }
            if finding.verdict == Verdict::Refuted || worst == Verdict::Proved {
                worst = finding.verdict;
            }
        }
        let Counts { found: [proved, open, refuted], uncut, seconds, slowest } = counts;
        let name = path.file_name().unwrap_or_default().display();
        println!("{name},{proved},{open},{refuted},{uncut},{seconds:.2},{slowest:.2}");
    }
    status(worst)
}

/// The deviation that faces are cut with, relative to the model's diagonal.
const MAX_DEVIATION: f64 = 1e-9;

/// Reads a model with the library, whose cuts are to be proved.
fn library_model(path: &Path) -> Result<nurbs_hausdorff::Model, String> {
    let bytes = std::fs::read(path).map_err(|error| error.to_string())?;
    let read = from_file(bytes, &path.to_string_lossy());
    read.map(|(model, _, _)| model).map_err(|error| error.to_string())
}

fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Proved => "proved",
        Verdict::NotProved => "undecided",
        Verdict::Refuted => "refuted",
    }
}

fn run(arguments: &Arguments) -> Result<Report, String> {
    let (Some(a), Some(b), Some(result)) = (&arguments.a, &arguments.b, &arguments.result) else {
        return Err("no models and result".to_owned());
    };
    let model = |path: &Path| {
        let model = match facets::read(path) {
            Some(model) => model,
            None => Model::from_json(&read(path)?),
        };
        model.map_err(|reason| format!("{}: {reason}", path.display()))
    };
    let (a, b) = (model(a)?, model(b)?);
    if [&a, &b].iter().any(|model| model.is_trimmed()) {
        return Err("a model has trimmed faces, of which only the surfaces are read".to_owned());
    }
    let text = read(result)?;
    let stated: Stated =
        serde_json::from_str(&text).map_err(|error| format!("{}: {error}", result.display()))?;
    if stated.forward.is_some() {
        return Err("a symmetric result: verify the results of both directions instead".to_owned());
    }
    let motion =
        Motion { rotation: arguments.rotate.0.to_array(), translation: arguments.translate.0.to_array() };
    let time = Duration::try_from_secs_f64(arguments.seconds).map_err(|error| error.to_string())?;
    if !(arguments.slack >= 0.0 && arguments.slack.is_finite()) {
        return Err(format!("slack is {}, expected a number that is not negative", arguments.slack));
    }
    let settings = Settings { time, slack: arguments.slack };
    let Stated { lower, upper, witness, .. } = stated;
    let points = [&witness.a, &witness.b].map(StatedPoint::witness);
    if arguments.clearance {
        let claim = LeastClaim { lower, upper, witness: points };
        return Ok(proof::check_least(&a, &motion, &b, &claim, &settings));
    }
    let claim = Claim { lower, upper, witness: points[0] };
    Ok(proof::check(&a, &motion, &b, &claim, &settings))
}

fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}
