//! The command `score`.

use crate::arguments::score::ScoreArguments;
use crate::commands::comparisons::answered;
use crate::failure::Failure;
use crate::input::is_judged;
use crate::output::digits::{bounded, number};
use crate::output::json::{Asked, OfFiles, print_json};
use crate::output::print;
use crate::reports::Verdict;
use nurbs_hausdorff::{Interval, Placement, Requirement, Score, ScoredModel};
use std::fmt::{Result, Write};
use std::path::Path;

/// Scores the candidate, prints the numbers and returns the exit status.
pub(crate) fn run(arguments: &ScoreArguments) -> std::result::Result<u8, Failure> {
    let files: [&Path; 2] = [&arguments.candidate, &arguments.truth];
    let (mut score, [a, b]) = answered(&arguments.options()?, files, arguments.placement.units)?;
    if !score.requirements.is_empty() && !is_judged(&a, &b, arguments.allow_skipped) {
        score.met = None;
    }
    let verdict = of(&score);
    if arguments.json {
        print_json(&OfFiles::new(asked(verdict), &score, &a, &b))?;
    } else {
        let mut text = first(&score);
        // Writing to a string does not fail.
        let _ = lines(&mut text, &score);
        print(&text)?;
    }
    Ok(verdict.unwrap_or(Verdict::Passed).status())
}

/// Returns the verdict of a score, if something was required.
pub(crate) fn of(score: &Score) -> Option<Verdict> {
    (!score.requirements.is_empty()).then(|| Verdict::of(score.met))
}

/// Returns what is echoed of the question.
pub(crate) fn asked(verdict: Option<Verdict>) -> Asked {
    Asked { command: "score", verdict, limit: None, symmetric: None }
}

fn text(of: &Interval) -> String {
    bounded(of.middle(), [of.lower, of.upper])
}

/// Returns the first line: the verdict with the number that decides it, or F1 at the least threshold.
fn first(score: &Score) -> String {
    let deciding = |met| score.requirements.iter().find(|one| one.met == met);
    let (word, one) = match score.met {
        Some(true) => ("MET", score.requirements.first()),
        Some(false) => ("MISSED", deciding(Some(false))),
        None => ("UNDECIDED", deciding(None).or(score.requirements.first())),
    };
    if let Some(Requirement { number: name, at_least, at_most, found, met, .. }) = one {
        let (bound, end) = match (at_least, at_most) {
            (Some(least), _) => {
                (format!("at least {}", number(*least)), format!("at most {}", number(found.upper)))
            }
            (_, most) => {
                let most = number(most.unwrap_or(f64::INFINITY));
                (format!("at most {most}"), format!("at least {}", number(found.lower)))
            }
        };
        // Of what is missed, the end that decides: the other one may not have been looked for.
        let found = if *met == Some(false) { end } else { text(found) };
        return format!("{word} {name} {bound}: {found}\n");
    }
    match score.thresholds.first() {
        Some(at) => format!("f1 {} within {}\n", text(&at.f1), number(at.threshold)),
        None => "no score\n".to_owned(),
    }
}

/// Writes the lines below the first.
fn lines(out: &mut String, score: &Score) -> Result {
    if let Some(hint) = &score.hint {
        writeln!(out, "{:<17} {hint}", "hint")?;
    }
    placement(out, &score.placement)?;
    model(out, "candidate", &score.candidate)?;
    model(out, "truth", &score.truth)?;
    let mut line = |name: &str, found: Option<&Interval>| match found {
        Some(found) => writeln!(out, "{name:<17} {}", text(found)),
        None => Ok(()),
    };
    line("volume ratio", score.volume.as_ref().map(|volume| &volume.ratio))?;
    line("area ratio", score.area.as_ref().map(|area| &area.ratio))?;
    line("centroid distance", score.centroid_distance.as_ref())?;
    for (axis, difference) in ["x", "y", "z"].iter().zip(&score.extent_differences) {
        line(&format!("extent {axis} differs"), Some(difference))?;
    }
    for (name, found) in [("to the truth", &score.forward), ("to the candidate", &score.reverse)] {
        line(name, found.as_ref().map(|of| &of.mean))?;
    }
    line("chamfer", score.chamfer.as_ref())?;
    line("chamfer squared", score.chamfer_squared.as_ref())?;
    for at in &score.thresholds {
        let within = number(at.threshold);
        line(&format!("precision {within}"), Some(&at.precision))?;
        line(&format!("recall {within}"), Some(&at.recall))?;
        line(&format!("f1 {within}"), Some(&at.f1))?;
        if let Some(normals) = at.normals {
            let like = format!("{within}, {}°", number(normals.normal_angle));
            line(&format!("normal precision {like}"), Some(&normals.normal_precision))?;
            line(&format!("normal recall {like}"), Some(&normals.normal_recall))?;
            line(&format!("normal f1 {like}"), Some(&normals.normal_f1))?;
        }
        if let Some(edges) = at.edges {
            line(&format!("edge precision {within}"), Some(&edges.edge_precision))?;
            line(&format!("edge recall {within}"), Some(&edges.edge_recall))?;
            line(&format!("edge f1 {within}"), Some(&edges.edge_f1))?;
        }
    }
    line("hausdorff", score.hausdorff.as_ref().map(|of| &of.distance))?;
    line("iou", score.iou.as_ref())?;
    if let Some(faces) = score.faces {
        let of = |[changed, all]: [usize; 2]| format!("{changed} of {all}");
        let (one, other) = (of(faces.changed_of_candidate), of(faces.changed_of_truth));
        writeln!(out, "faces changed     {one} of the candidate, {other} of the truth")?;
    }
    let end = match (score.ended_early, score.converged) {
        (true, _) => "ended early, as a requirement is missed",
        (false, true) => "converged",
        (false, false) => "not converged",
    };
    writeln!(out, "search            {end}, {:.3} s", score.seconds.prepare + score.seconds.solve)
}

fn placement(out: &mut String, Placement { align, scale, transform, fit, .. }: &Placement) -> Result {
    let name = serde_json::to_value(align).ok().and_then(|name| name.as_str().map(str::to_owned));
    write!(out, "alignment         {}", name.unwrap_or_default())?;
    if *scale != 1.0 {
        write!(out, ", times {}", number(*scale))?;
    }
    let [x, y, z] = transform.offset().to_array();
    write!(out, ", moved by {x:?} {y:?} {z:?}")?;
    if let Some(fit) = fit {
        let turned = transform.rotation().to_array();
        write!(out, ", turned by {turned:?}, {} starts", fit.tried)?;
        match (fit.converged, fit.ambiguous.len()) {
            (false, _) => write!(out, ", no fit")?,
            (true, 0) => {}
            (true, others) => write!(out, ", ambiguous: {others} other poses fit as well")?,
        }
    }
    writeln!(out)
}

fn model(out: &mut String, name: &str, model: &ScoredModel) -> Result {
    let valid = match (model.valid.lower > 0.0, model.valid.upper > 0.0) {
        (true, _) => "valid",
        (false, false) => "not valid",
        (false, true) => "validity undecided",
    };
    let closed = if model.closed { "closed" } else { "open" };
    let oriented = match model.oriented {
        Some(true) => "oriented",
        Some(false) => "not oriented",
        None => "orientation undecided",
    };
    let ScoredModel { bodies, sheets, duplicates, self_overlaps, .. } = model;
    let itself = match model.embedded {
        Some(false) if *self_overlaps > 0 => format!(", {self_overlaps} of them meet themselves"),
        None if bodies + sheets > 0 => ", embedding undecided".to_owned(),
        _ => String::new(),
    };
    writeln!(
        out,
        "{name:<17} {valid}: {closed}, {oriented}, bodies {bodies}{itself}, sheets {sheets}, copies of faces {duplicates}"
    )
}
