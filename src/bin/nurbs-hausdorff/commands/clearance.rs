//! The command `clearance`.

use crate::arguments::ClearanceArguments;
use crate::failure::Failure;
use crate::input::{is_judged, read};
use crate::output::json::{OfFiles, print_json};
use crate::output::print;
use crate::output::progress::Bar;
use crate::output::report::GAPS_DECIDE;
use nurbs_hausdorff::{ClearanceResult, Engine, Overlap, SurfacePoint};
use std::fmt::{Result, Write};

/// Measures the clearance, prints it and returns the exit status.
pub(crate) fn run(arguments: &ClearanceArguments) -> std::result::Result<u8, Failure> {
    let options = arguments.options()?;
    options.validate()?;
    let (a, b) = (read(&arguments.a)?, read(&arguments.b)?);
    let engine = Engine::cpu();
    let mut bar = Bar::new();
    let mut result = engine.clearance(&a.prepared, &b.prepared, &options).monitored(&mut bar).wait()?;
    drop(bar);
    if arguments.limit.is_some() && !is_judged(&a, &b, arguments.allow_skipped) {
        (result.at_least, result.with_gaps.at_least) = (None, None);
    }
    if arguments.json {
        print_json(&OfFiles::new(&result, &a, &b))?;
    } else {
        let mut text = String::new();
        // Writing to a string does not fail.
        let _ = lines(&mut text, &result, arguments.limit);
        print(&text)?;
    }
    let verdict = if arguments.strict_gaps { result.with_gaps.at_least } else { result.at_least };
    Ok(match (arguments.limit, verdict) {
        (None, _) | (_, Some(true)) => 0,
        (_, Some(false)) => 1,
        (_, None) => 3,
    })
}

fn lines(out: &mut String, result: &ClearanceResult, limit: Option<f64>) -> Result {
    writeln!(out, "clearance  between {:?} and {:?}", result.lower, result.upper)?;
    if let Some(limit) = limit {
        let verdict = match result.at_least {
            Some(true) => "at least",
            Some(false) => "less than",
            None => "undecided at",
        };
        let doubt = if result.with_gaps.at_least == result.at_least { "" } else { GAPS_DECIDE };
        writeln!(out, "verdict    {verdict} {limit:?}{doubt}")?;
    }
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
        _ => "unknown".to_owned(),
    };
    writeln!(out, "overlap    {overlap}")?;
    let stop = if result.converged { "converged" } else { "not converged" };
    writeln!(out, "search     {stop}, {} pairs of cells", result.cells)?;
    writeln!(out, "seconds    {:.3} prepare, {:.3} solve", result.seconds.prepare, result.seconds.solve)
}
