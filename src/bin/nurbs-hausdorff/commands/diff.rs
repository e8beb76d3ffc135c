//! The command `diff`.

use crate::arguments::DiffArguments;
use crate::failure::Failure;
use crate::input::{Input, is_judged};
use crate::output::json::{OfFiles, raw};
use crate::output::progress::Bar;
use crate::output::report::GAPS_DECIDE;
use crate::pairs::{self, Comparison};
use crate::reports::{Answer, Verdict};
use nurbs_hausdorff::pictures::{PictureOptions, Place, Shown};
use nurbs_hausdorff::{DiffOptions, DiffResult, Engine, FaceDifference, FaceState};
use std::fmt::Write;

/// The largest number of faces of one model and state that the table lists; JSON has all.
const MAX_LISTED: usize = 100;

/// Compares the models face by face, prints the differences and returns the exit status.
pub(crate) fn run(arguments: &DiffArguments) -> Result<u8, Failure> {
    let options = arguments.options()?;
    options.validate()?;
    let comparison = Diff { arguments, options, engine: Engine::cpu() };
    pairs::run(&arguments.pair, &arguments.reporting, &comparison)
}

struct Diff<'a> {
    arguments: &'a DiffArguments,
    options: DiffOptions,
    engine: Engine,
}

impl Comparison for Diff<'_> {
    const NAME: &'static str = "diff";

    fn options(&self) -> String {
        let DiffArguments { allow_skipped, strict_gaps, .. } = self.arguments;
        format!("{:?} {allow_skipped} {strict_gaps}", self.options)
    }

    fn compare(&self, a: &Input, b: &Input) -> Result<(Answer, PictureOptions), Failure> {
        let mut bar = Bar::new();
        let diff = self.engine.diff(&a.prepared, &b.prepared, &self.options);
        let mut result = diff.monitored(&mut bar).wait()?;
        drop(bar);
        let is_timed = self.options.max_seconds.is_some() && result.state == FaceState::Undecided;
        if !is_judged(a, b, self.arguments.allow_skipped) {
            (result.state, result.with_gaps) = (FaceState::Undecided, FaceState::Undecided);
        }
        let state = if self.arguments.strict_gaps { result.with_gaps } else { result.state };
        let answer = Answer {
            verdict: match state {
                FaceState::Unchanged => Verdict::Passed,
                FaceState::Changed => Verdict::Failed,
                _ => Verdict::Undecided,
            },
            limit: Some(result.limit),
            word: word(state).to_owned(),
            summary: summary(&result),
            findings: findings(&result),
            text: text(&result),
            seconds: result.seconds.prepare + result.seconds.solve,
            repeatable: !is_timed,
            json: raw(&OfFiles::new(&result, a, b))?,
            figures: String::new(),
        };
        Ok((answer, self.shown(&result)))
    }
}

impl Diff<'_> {
    /// Both models, with the farthest points of their faces.
    fn shown(&self, result: &DiffResult) -> PictureOptions {
        let side = |faces: &[FaceDifference], is_a: bool| {
            let farthest = faces.iter().max_by(|one, other| one.lower.total_cmp(&other.lower));
            Shown {
                uppers: faces.iter().map(|face| face.upper).collect(),
                farthest: farthest.map(|face| {
                    let [a, b] = [&face.witness.a, &face.witness.b].map(|at| at.point);
                    let [point, foot] = if is_a { [a, b] } else { [b, a] };
                    Place { face: face.face, point, foot }
                }),
            }
        };
        PictureOptions {
            allowed: Some(result.limit),
            a: Some(side(&result.faces_of_a, true)),
            b: Some(side(&result.faces_of_b, false)),
            scale_units: self.options.scale_units,
            transform: self.options.transform,
        }
    }
}

fn word(state: FaceState) -> &'static str {
    match state {
        FaceState::Unchanged => "unchanged",
        FaceState::Changed => "changed",
        _ => "undecided",
    }
}

/// Ends a line with a verdict that does not hold for every reading of the files.
fn doubt(result: &DiffResult) -> &'static str {
    if result.with_gaps == result.state { "" } else { GAPS_DECIDE }
}

/// The numbers of faces in each state.
fn counts(faces: &[FaceDifference]) -> String {
    let count = |state| faces.iter().filter(|face| face.state == state).count();
    let [unchanged, changed, undecided] =
        [FaceState::Unchanged, FaceState::Changed, FaceState::Undecided].map(count);
    format!("{unchanged} unchanged, {changed} changed, {undecided} undecided")
}

fn summary(result: &DiffResult) -> String {
    let [a, b] = [&result.faces_of_a, &result.faces_of_b].map(|faces| counts(faces));
    format!("faces of A: {a}; of B: {b}; limit {:?}{}", result.limit, doubt(result))
}

/// A line for each face that is not unchanged, those that changed first.
fn findings(result: &DiffResult) -> Vec<String> {
    let mut findings = Vec::new();
    for state in [FaceState::Changed, FaceState::Undecided] {
        for (index, name) in ["A", "B"].into_iter().enumerate() {
            let faces = &result.faces_in(state)[index];
            for face in faces.iter().take(MAX_LISTED) {
                let point = if index == 0 { &face.witness.a } else { &face.witness.b };
                let [x, y, z] = point.point;
                let face_name = point.face_name.as_ref().map_or(String::new(), |name| format!(" ({name})"));
                findings.push(format!(
                    "{name} face {}{face_name} {}: [{:?}, {:?}] at {x:?} {y:?} {z:?}",
                    face.face,
                    word(state),
                    face.lower,
                    face.upper
                ));
            }
            if faces.len() > MAX_LISTED {
                findings.push(format!(
                    "and {} more faces of {name} {}",
                    faces.len() - MAX_LISTED,
                    word(state)
                ));
            }
        }
    }
    findings
}

fn text(result: &DiffResult) -> String {
    let mut out =
        format!("models     {} at a limit of {:?}{}\n", word(result.state), result.limit, doubt(result));
    for (name, faces) in [("A", &result.faces_of_a), ("B", &result.faces_of_b)] {
        // Writing to a string does not fail.
        let _ = writeln!(out, "faces of {name} {}", counts(faces));
    }
    for finding in findings(result) {
        let _ = writeln!(out, "{finding}");
    }
    let _ =
        writeln!(out, "seconds    {:.3} prepare, {:.3} solve", result.seconds.prepare, result.seconds.solve);
    out
}
