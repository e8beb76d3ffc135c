//! The command `align`.

use super::asked::answered;
use crate::arguments::comparisons::align::AlignArguments;
use crate::arguments::models::Placement;
use crate::failure::Failure;
use crate::output::digits::{coordinates, interval_beside, number};
use crate::output::json::{Asked, OfFiles, print_json};
use crate::output::print;
use crate::reports::Verdict;
use clap::ValueEnum;
use nurbs_hausdorff::{BestFit, DVec3, RigidTransform};
use serde::Serialize;
use std::fmt::Write;
use std::path::Path;

/// Other poses that are printed; `--json` has all.
const MOST_PRINTED: usize = 6;

/// Fits A to B, prints the motion and returns the exit status: 0 of a fit, 3 of none.
pub(crate) fn run(arguments: &AlignArguments) -> Result<u8, Failure> {
    let files: [&Path; 2] = [&arguments.a, &arguments.b];
    let (fit, [a, b]) = answered(&arguments.options()?, files, arguments.placement.units)?;
    let verdict = Verdict::of(judged(&fit, arguments.limit));
    if arguments.json {
        let limit = arguments.limit;
        let asked = Asked { command: "align", verdict: Some(verdict), limit, symmetric: None };
        let result = Aligned::new(&fit);
        print_json(&OfFiles::new(asked, &result, &a, &b))?;
    } else {
        let diagonal = a.prepared.bounding_box().diagonal();
        let mut text = String::new();
        // Writing to a string does not fail.
        let _ = lines(&mut text, &fit, (arguments.side(), arguments.limit, diagonal));
        let _ = next_command(&mut text, arguments, &fit);
        print(&text)?;
    }
    Ok(verdict.status())
}

/// Returns whether A fits: within the limit, if there is one and a zone.
pub(crate) fn judged(fit: &BestFit, limit: Option<f64>) -> Option<bool> {
    match (&fit.zone, limit) {
        (Some(zone), Some(_)) => zone.passes,
        _ => fit.converged.then_some(true),
    }
}

/// The result with the motion in all forms.
#[derive(Serialize)]
pub(crate) struct Aligned<'a> {
    motion: Motion,
    #[serde(flatten)]
    fit: &'a BestFit,
}

impl<'a> Aligned<'a> {
    pub(crate) fn new(fit: &'a BestFit) -> Self {
        Self { motion: Motion::of(&fit.transform), fit }
    }
}

/// A motion: a rotation about an axis through the origin, then a translation; the same as the rows
/// of a matrix.
#[derive(Serialize)]
struct Motion {
    axis: [f64; 3],
    degrees: f64,
    translation: [f64; 3],
    matrix: [[f64; 4]; 3],
}

impl Motion {
    fn of(transform: &RigidTransform) -> Self {
        let rotation = transform.rotation();
        // Of the two quaternions of a rotation the one with the smaller angle.
        let (axis, angle) = (if rotation.w < 0.0 { -rotation } else { rotation }).to_axis_angle();
        let columns = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| transform.rotate(axis));
        let offset = transform.offset();
        let row = |index: usize| [columns[0][index], columns[1][index], columns[2][index], offset[index]];
        Self {
            axis: axis.to_array(),
            degrees: angle.to_degrees(),
            translation: offset.to_array(),
            matrix: [row(0), row(1), row(2)],
        }
    }
}

/// Returns an estimate with the digits that it has.
fn estimate(value: f64) -> String {
    number(format!("{value:.3e}").parse().unwrap_or(value))
}

fn motion(transform: &RigidTransform, diagonal: f64) -> String {
    let Motion { axis, degrees, translation, .. } = Motion::of(transform);
    let by = coordinates(translation, diagonal);
    format!("turned by {}° about {}, moved by {by}", estimate(degrees), coordinates(axis, 1.0))
}

/// Writes a fit of a model of this diagonal whose zone is of one side, if any is named, beside a limit.
fn lines(
    out: &mut String,
    fit: &BestFit,
    (side, limit, diagonal): (&str, Option<f64>, f64),
) -> std::fmt::Result {
    let word = if fit.converged { "FITTED" } else { "NOT FITTED" };
    let [rms, before, random] = [fit.rms, fit.rms_before, fit.rms_random].map(estimate);
    let counted = if fit.counted < fit.samples {
        format!("{} of {}", fit.counted, fit.samples)
    } else {
        fit.samples.to_string()
    };
    writeln!(out, "{word}: rms {rms} of {counted} samples, {before} before")?;
    if !fit.converged {
        writeln!(
            out,
            "doubt      random poses have {random}: too near, or the steps ended before the fit did"
        )?;
    }
    writeln!(out, "motion     {}", motion(&fit.transform, diagonal))?;
    zone_lines(out, fit, (side, limit))?;
    if !fit.taken.is_empty() {
        let taken: Vec<String> = fit.taken.iter().map(usize::to_string).collect();
        writeln!(out, "datums     take {} of six freedoms", taken.join(", "))?;
    }
    writeln!(out, "steps      {}, from {} poses", fit.steps, fit.tried)?;
    if let Some(beyond) = fit.left_out.beyond {
        let count = fit.left_out.points.len() / 3;
        writeln!(out, "left out   {count} samples, farther than {}", estimate(beyond))?;
    }
    if fit.freedoms > 0 {
        writeln!(out, "free       {} motions that change no distance", fit.freedoms)?;
    }
    for pose in fit.ambiguous.iter().take(MOST_PRINTED) {
        writeln!(out, "or         rms {}, {}", estimate(pose.rms), motion(&pose.transform, diagonal))?;
    }
    let more = fit.ambiguous.len().saturating_sub(MOST_PRINTED);
    if more > 0 {
        writeln!(out, "or         {more} more poses, which --json lists")?;
    }
    Ok(())
}

/// Writes the interval of the least largest distance.
fn zone_lines(out: &mut String, fit: &BestFit, (side, limit): (&str, Option<f64>)) -> std::fmt::Result {
    writeln!(out, "largest    {} of the samples", estimate(fit.largest))?;
    let Some(zone) = &fit.zone else { return Ok(()) };
    let proof = if fit.zone_proven == Some(true) { "" } else { ", which is not proven to be the least" };
    writeln!(out, "zone       {}{side}{proof}", interval_beside(limit, [zone.lower, zone.upper]))?;
    let words = match zone.passes {
        Some(true) => "the pose found is within the limit",
        Some(false) => "no motion of the box is within the limit",
        None => "no motion of the box is below the zone",
    };
    writeln!(
        out,
        "           {words}: turns up to {}°, shifts up to {}, {} boxes",
        number(zone.degrees),
        number(zone.translation),
        zone.boxes
    )
}

/// Returns the options about units, as they were given.
fn units_text(Placement { scale_units, units, .. }: &Placement) -> String {
    let mut text = if *scale_units { " --scale-units".to_owned() } else { String::new() };
    for (option, unit) in [("--unit-of-a", units.unit_of_a), ("--unit-of-b", units.unit_of_b)] {
        if let Some(value) = unit.and_then(|unit| unit.to_possible_value()) {
            text.push_str(&format!(" {option} {}", value.get_name()));
        }
    }
    text
}

/// Returns a word as shells read it.
fn quoted(word: &str) -> String {
    let is_plain = |one: char| one.is_alphanumeric() || "/._-+,:@%=".contains(one);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}

/// Writes the command that measures the pair in the pose found.
fn next_command(out: &mut String, arguments: &AlignArguments, fit: &BestFit) -> std::fmt::Result {
    let Motion { axis: [x, y, z], degrees, translation: [a, b, c], .. } = Motion::of(&fit.transform);
    let units = units_text(&arguments.placement);
    let [of_a, of_b] = [&arguments.a, &arguments.b].map(|path| quoted(&path.display().to_string()));
    writeln!(
        out,
        "measure    nurbs-hausdorff distance {of_a} {of_b}{units} --rotate={x:?},{y:?},{z:?},{degrees:?} \
         --translate={a:?},{b:?},{c:?}"
    )
}
