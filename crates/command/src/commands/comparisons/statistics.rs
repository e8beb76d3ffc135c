//! The command `statistics`.

use super::asked::answered;
use crate::arguments::comparisons::StatisticsArguments;
use crate::failure::Failure;
use crate::output::json::{Asked, OfFiles, print_json};
use crate::output::print;
use crate::output::report::hint;
use nurbs_hausdorff::{CertifiedStatistics, Interval, Measure};
use std::fmt::{Result, Write};
use std::path::Path;

/// Computes the statistics and prints them.
pub(crate) fn run(arguments: &StatisticsArguments) -> std::result::Result<(), Failure> {
    let files: [&Path; 2] = [&arguments.a, &arguments.b];
    let (result, [a, b]) = answered(&arguments.options()?, files, arguments.placement.units)?;
    if arguments.json {
        // The result states the limit, by which nothing is judged.
        let asked = Asked { command: "statistics", verdict: None, limit: None, symmetric: None };
        return print_json(&OfFiles::new(asked, &result, &a, &b));
    }
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = lines(&mut text, &result);
    print(&text)
}

fn lines(out: &mut String, result: &CertifiedStatistics) -> Result {
    let between = |Interval { lower, upper }: Interval| format!("between {lower:?} and {upper:?}");
    let total = match result.over {
        Measure::Count => "points",
        _ => "area",
    };
    writeln!(out, "{total:<10} {}", between(result.total))?;
    writeln!(out, "mean       {}", between(result.mean))?;
    writeln!(out, "rms        {}", between(result.rms))?;
    for percentile in &result.percentiles {
        writeln!(out, "part {:<5} within a distance {}", percentile.part, between(percentile.distance))?;
    }
    if let Some(beyond) = result.beyond {
        writeln!(out, "beyond     {:?}: a part {}", beyond.limit, between(beyond.part))?;
    }
    if let Some(notice) = &result.notice {
        writeln!(out, "notice     {notice}")?;
    }
    hint(out, result.hint.as_deref())?;
    let stop = if result.converged { "converged" } else { "not converged" };
    writeln!(out, "search     {stop}, {} parts", result.cells)?;
    writeln!(out, "seconds    {:.3} prepare, {:.3} solve", result.seconds.prepare, result.seconds.solve)
}
