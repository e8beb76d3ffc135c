//! The command `diff`.

use crate::arguments::comparisons::DiffArguments;
use crate::arguments::models::UnitsOfFiles;
use crate::failure::Failure;
use crate::input::{Input, is_judged};
use crate::output::digits::{bounded_beside, coordinates, held};
use crate::output::headline::{self, GAPS_DECIDE};
use crate::output::json::{Asked, OfFiles, raw};
use crate::output::progress::Bar;
use crate::pairs::{self, Comparison};
use crate::reports::{Answer, Verdict};
use nurbs_hausdorff::{
    DiffOptions, DiffResult, Engine, FaceChange, FaceCounterpart, FaceDifference, FaceState, FarthestPoint,
    KnownDeviation, PartsUnknown, Query,
};
use nurbs_hausdorff_pictures::PictureOptions;
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

    fn units(&self) -> UnitsOfFiles {
        self.arguments.placement.units
    }

    fn compare(&self, a: &Input, b: &Input) -> Result<(Answer, PictureOptions), Failure> {
        let mut bar = Bar::new();
        let diff = self.options.ask(&self.engine, [&a.prepared, &b.prepared]);
        let mut result = diff.monitored(&mut bar).wait()?;
        drop(bar);
        let is_timed = self.options.max_seconds.is_some() && result.state == FaceState::Undecided;
        if !is_judged(a, b, self.arguments.allow_skipped) {
            (result.state, result.with_gaps) = (FaceState::Undecided, FaceState::Undecided);
        }
        let state = if self.arguments.strict_gaps { result.with_gaps } else { result.state };
        let verdict = Verdict::from(state);
        // The result states the limit.
        let asked = Asked { command: Self::NAME, verdict: Some(verdict), limit: None, symmetric: None };
        let summary = summary(&result, a, b);
        let answer = Answer {
            verdict,
            limit: Some(result.limit),
            judged: false,
            word: word(state).to_owned(),
            text: format!("{}{summary}\n{}", headline::verdict(word(state), result.limit), text(&result)),
            summary,
            findings: findings(&result),
            seconds: result.seconds.prepare + result.seconds.solve,
            repeatable: !is_timed,
            json: raw(&OfFiles::new(asked, &result, a, b))?,
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
            KnownDeviation {
                uppers: faces.iter().map(|face| face.upper).collect(),
                farthest: farthest.map(|face| {
                    let [a, b] = [&face.witness.a, &face.witness.b].map(|at| at.point);
                    let [point, foot] = if is_a { [a, b] } else { [b, a] };
                    FarthestPoint { face: face.face, point, foot }
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

/// Returns the largest difference, its place, and the numbers of faces in each state.
fn summary(result: &DiffResult, a: &Input, b: &Input) -> String {
    let faces = [(&result.faces_of_a, true), (&result.faces_of_b, false)];
    let all = faces.into_iter().flat_map(|(faces, is_a)| faces.iter().map(move |face| (face, is_a)));
    let largest = all.max_by(|(one, _), (other, _)| {
        one.lower.total_cmp(&other.lower).then(one.upper.total_cmp(&other.upper))
    });
    let largest = largest.map_or(String::new(), |(face, is_a)| {
        let witness = &face.witness;
        let place = match is_a {
            true => headline::place(&witness.a, a, " of A", result.diagonal),
            false => headline::place(&witness.b, b, " of B", result.diagonal),
        };
        format!("{} on {place}; ", bounded_beside(Some(result.limit), face.lower, [face.lower, face.upper]))
    });
    let [a, b] = [&result.faces_of_a, &result.faces_of_b].map(|faces| counts(faces));
    let parts = result.parts_summary().map_or(String::new(), |parts| format!("{parts}; "));
    let has_changed_faces = result.faces_in(FaceState::Changed).iter().any(|faces| !faces.is_empty());
    // The text begins with the reason of the verdict.
    let first = match result.state {
        FaceState::Changed if !has_changed_faces => format!("{parts}{largest}"),
        _ => format!("{largest}{parts}"),
    };
    format!("{first}faces of A: {a}; of B: {b}{}", doubt(result))
}

/// A line for each face that is not unchanged, those that changed first.
fn findings(result: &DiffResult) -> Vec<String> {
    let mut findings: Vec<String> = result.hint.iter().map(|hint| format!("hint: {hint}")).collect();
    for state in [FaceState::Changed, FaceState::Undecided] {
        for (index, name) in ["A", "B"].into_iter().enumerate() {
            let faces = &result.faces_in(state)[index];
            for face in faces.iter().take(MAX_LISTED) {
                let point = if index == 0 { &face.witness.a } else { &face.witness.b };
                let at = coordinates(point.point, result.diagonal);
                let face_name = point.face_name.as_ref().map_or(String::new(), |name| format!(" ({name})"));
                let became = face
                    .counterpart
                    .as_ref()
                    .map_or(String::new(), |found| became(found, index, result.diagonal));
                findings.push(format!(
                    "{name} face {}{face_name} {}: {} at {at}{became}",
                    face.face,
                    word(state),
                    bounded_beside(Some(result.limit), face.lower, [face.lower, face.upper])
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

/// Says what became of a round face of A, or what one of B was.
fn became(found: &FaceCounterpart, index: usize, diagonal: f64) -> String {
    let [own, other] = [&found.radius, &found.other_radius].map(held);
    let [before, after] = if index == 0 { [own, other] } else { [other, own] };
    let resized = format!("radius {before} before, {after} after");
    let moved = format!("moved by {}", coordinates(found.shift, diagonal));
    let change = match found.change {
        FaceChange::Resized => resized,
        FaceChange::Moved => moved,
        _ => format!("{resized}, {moved}"),
    };
    format!("; {change} ({} face {})", ["B", "A"][index], found.face)
}

/// Returns the lines below the first.
fn text(result: &DiffResult) -> String {
    let mut out = String::new();
    for (name, faces) in [("A", &result.faces_of_a), ("B", &result.faces_of_b)] {
        // Writing to a string does not fail, here and below.
        let _ = writeln!(out, "faces of {name} {}", counts(faces));
    }
    for finding in findings(result) {
        let _ = writeln!(out, "{finding}");
    }
    if let Some(why) = result.parts_unknown {
        let why = match why {
            PartsUnknown::TooMany => "a model has more than 2,000 bodies",
            _ => "the time was spent before",
        };
        let _ = writeln!(out, "parts      not compared, as {why}");
    }
    for part in result.part_lines() {
        let _ = writeln!(out, "part       {part}");
    }
    let _ =
        writeln!(out, "seconds    {:.3} prepare, {:.3} solve", result.seconds.prepare, result.seconds.solve);
    out
}
