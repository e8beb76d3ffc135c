//! The command `clearance`.

use super::asked::answered;
use crate::arguments::comparisons::clearance::ClearanceArguments;
use crate::failure::Failure;
use crate::input::{Input, is_judged};
use crate::output::digits::bounded_beside;
use crate::output::headline::{self, GAPS_DECIDE, place};
use crate::output::json::{Asked, OfFiles, print_json};
use crate::output::print;
use crate::output::report::hint;
use crate::reports::Verdict;
use nurbs_hausdorff::{ClearanceResult, Overlap, OverlapUnknown, SurfacePoint, result::Stop};
use std::fmt::{Result, Write};
use std::path::Path;

/// Measures the clearance, prints it and returns the exit status.
pub(crate) fn run(arguments: &ClearanceArguments) -> std::result::Result<u8, Failure> {
    let compared = &arguments.search.compared;
    let files: [&Path; 2] = [&compared.a, &compared.b];
    let (mut result, [a, b]) = answered(&arguments.options()?, files, compared.placement.units)?;
    if arguments.limit.is_some() && !is_judged(&a, &b, compared.allow_skipped) {
        (result.at_least, result.with_gaps.at_least) = (None, None);
    }
    let at_least = if arguments.strict_gaps { result.with_gaps.at_least } else { result.at_least };
    let verdict = arguments.limit.map(|_| Verdict::of(at_least));
    if compared.json {
        let asked = Asked { command: "clearance", verdict, limit: arguments.limit, symmetric: None };
        print_json(&OfFiles::new(asked, &result, &a, &b))?;
    } else {
        let mut text = first(&result, arguments.limit.map(|limit| (limit, at_least)), [&a, &b]);
        // Writing to a string does not fail.
        let _ = lines(&mut text, &result);
        print(&text)?;
    }
    Ok(verdict.unwrap_or(Verdict::Passed).status())
}

/// Returns the first line: the verdict, the clearance and the places.
fn first(result: &ClearanceResult, judged: Option<(f64, Option<bool>)>, [a, b]: [&Input; 2]) -> String {
    let word = |at_least| match at_least {
        Some(true) => "at least",
        Some(false) => "less than",
        None => "undecided",
    };
    let verdict = judged.map(|(limit, at_least)| headline::verdict(word(at_least), limit));
    let doubt = match (judged, result.at_least) {
        (Some(_), None) => why_undecided(result.stop),
        (_, at_least) if result.with_gaps.at_least == at_least => "",
        _ => GAPS_DECIDE,
    };
    let (of_a, of_b) = (
        place(&result.witness.a, a, " of A", result.diagonal),
        place(&result.witness.b, b, " of B", result.diagonal),
    );
    let limit = judged.map(|(limit, _)| limit);
    let found = bounded_beside(limit, result.upper, [result.lower, result.upper]);
    let has_common = matches!(result.overlap, Some(Overlap::Intersecting { .. } | Overlap::Contained { .. }));
    if has_common && matches!(judged, Some((_, Some(false)))) {
        return format!("OVERLAPPING: the boundaries are {found} apart, at {of_a} and {of_b}{doubt}\n");
    }
    let verdict = verdict.unwrap_or_else(|| "clearance ".to_owned());
    format!("{verdict}{found} between {of_a} and {of_b}{doubt}\n")
}

/// Returns why a limit is not decided by the search, at the end of the verdict's line.
fn why_undecided(stop: Stop) -> &'static str {
    match stop {
        Stop::Cells | Stop::Time | Stop::Cancelled => ", as a budget ended the search",
        Stop::Precision => ", as the clearance is the limit but for the rounding of the coordinates",
        // Faces were left out, which is said on standard error.
        _ => "",
    }
}

/// Returns why nothing is stated of an overlap.
fn reason(unknown: OverlapUnknown) -> &'static str {
    match unknown {
        OverlapUnknown::AOpen => "A is not closed",
        OverlapUnknown::BOpen => "B is not closed",
        OverlapUnknown::BothOpen => "neither model is closed",
        OverlapUnknown::TooLarge => "a mesh has more than 250,000 triangles, which are not joined",
        OverlapUnknown::Side => "it is not decided whether points of one model are inside the other",
        OverlapUnknown::Cracks => "the boundaries are nearer than their faces' cracks are wide",
        OverlapUnknown::Limit => "the limit was decided before the boundaries were known to meet",
        OverlapUnknown::Budget => "a budget ended the search before it was known",
        OverlapUnknown::Precision => "the rounding of the coordinates does not decide",
        _ => "",
    }
}

/// Writes the lines below the first.
fn lines(out: &mut String, result: &ClearanceResult) -> Result {
    writeln!(out, "interval   [{:?}, {:?}]", result.lower, result.upper)?;
    let mut point = |name: &str, SurfacePoint { face, u, v, point: [x, y, z], .. }: &SurfacePoint| {
        writeln!(out, "nearest    {name} face {face} at u {u:?} v {v:?}: {x:?} {y:?} {z:?}")
    };
    point("A", &result.witness.a)?;
    point("B", &result.witness.b)?;
    let place = |[x, y, z]: [f64; 3]| format!(", both have {x:?} {y:?} {z:?} inside");
    let overlap = match result.overlap {
        Some(Overlap::None) => "none".to_owned(),
        Some(Overlap::Touching) => "touching".to_owned(),
        Some(Overlap::Intersecting { inside_both }) => format!("intersecting{}", place(inside_both)),
        Some(Overlap::Contained { inside_both }) => format!("contained{}", place(inside_both)),
        _ => format!("unknown: {}", result.overlap_unknown.map_or("", reason)),
    };
    writeln!(out, "overlap    {overlap}")?;
    hint(out, result.hint.as_deref())?;
    let stop = if result.converged { "converged" } else { "not converged" };
    writeln!(out, "search     {stop}, {} pairs of cells", result.cells)?;
    writeln!(out, "seconds    {:.3} prepare, {:.3} solve", result.seconds.prepare, result.seconds.solve)
}
