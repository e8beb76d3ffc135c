//! The command `gaps`.

use super::asked::answered;
use crate::arguments::comparisons::clearance::GapsArguments;
use crate::failure::Failure;
use crate::input::{Input, is_judged};
use crate::output::digits::{bounded, number};
use crate::output::headline::place;
use crate::output::json::{Asked, OfFiles, print_json};
use crate::output::print;
use crate::output::report::hint;
use crate::reports::Verdict;
use nurbs_hausdorff::{FaceGap, GapsResult};
use std::fmt::{Result, Write};
use std::path::Path;

/// Finds the pairs of faces, prints them and returns the exit status.
pub(crate) fn run(arguments: &GapsArguments) -> std::result::Result<u8, Failure> {
    let compared = &arguments.search.compared;
    let files: [&Path; 2] = [&compared.a, &compared.b];
    let (result, [a, b]) = answered(&arguments.options()?, files, compared.placement.units)?;
    let is_known = is_judged(&a, &b, compared.allow_skipped) && is_known(&result);
    if compared.json {
        let verdict = (!is_known).then_some(Verdict::Undecided);
        let asked = Asked { command: "gaps", verdict, limit: None, symmetric: None };
        print_json(&OfFiles::new(asked, &result, &a, &b))?;
    } else {
        let mut text = String::new();
        // Writing to a string does not fail.
        let _ = lines(&mut text, &result, [&a, &b]);
        print(&text)?;
    }
    Ok(if is_known { Verdict::Passed } else { Verdict::Undecided }.status())
}

/// Returns whether it is certain of every pair of faces on which side of the distance it is, but for those whose interval
/// is as narrow as was asked.
pub(crate) fn is_known(result: &GapsResult) -> bool {
    result.complete && result.pairs.iter().all(|pair| pair.converged || pair.upper < result.below)
}

fn lines(out: &mut String, result: &GapsResult, [a, b]: [&Input; 2]) -> Result {
    let what = if result.complete { "" } else { ", of those that were compared before a budget ended it" };
    let is_certain = |pair: &&FaceGap| pair.upper < result.below;
    let certain = result.pairs.iter().filter(is_certain).count();
    let count = match certain {
        0 => "no faces certainly come".to_owned(),
        1 => "1 pair of faces comes".to_owned(),
        count => format!("{count} pairs of faces come"),
    };
    let count = if result.pairs.is_empty() { "no faces come" } else { &count };
    let more = match result.pairs.len() - certain {
        0 => String::new(),
        open => format!(", {open} may"),
    };
    writeln!(out, "{count} nearer than {}{more}{what}", number(result.below))?;
    for pair in &result.pairs {
        let FaceGap { lower, upper, witness, .. } = pair;
        let [of_a, of_b] = [(&witness.a, a, " of A"), (&witness.b, b, " of B")]
            .map(|(point, input, of)| place(point, input, of, result.diagonal));
        let doubt = if is_certain(&pair) { "" } else { ", undecided" };
        writeln!(out, "{} between {of_a} and {of_b}{doubt}", bounded(*upper, [*lower, *upper]))?;
    }
    hint(out, result.hint.as_deref())?;
    writeln!(out, "seconds    {:.3} prepare, {:.3} solve", result.seconds.prepare, result.seconds.solve)
}
