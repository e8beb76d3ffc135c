//! The command `distance`.

use crate::arguments::DistanceArguments;
use crate::failure::Failure;
use crate::input::{is_judged, read};
use crate::output::json::{OfFiles, print_json};
use crate::output::print;
use crate::output::progress::Bar;
use crate::output::report;
use nurbs_hausdorff::{Backend, Details, DistanceResult, Engine, MethodName};

/// Exit statuses with `--limit`.
const WITHIN: u8 = 0;
const BEYOND: u8 = 1;
const UNDECIDED: u8 = 3;

/// Computes and prints the distance, and returns the exit status.
pub(crate) fn run(arguments: &DistanceArguments) -> Result<u8, Failure> {
    let options = arguments.options()?;
    options.validate()?;
    let (a, b) = (read(&arguments.a)?, read(&arguments.b)?);
    // Method certified usually ends in float64 before a GPU could be initialised.
    let staged = options.method.name() != MethodName::Certified || options.deviations;
    let uses_gpu = staged || options.backend == Backend::Gpu;
    let backend = if uses_gpu { options.backend } else { Backend::Cpu };
    let engine = Engine::new_blocking(backend)?;
    let mut bar = Bar::new();
    let mut result = engine.distance(&a.prepared, &b.prepared, &options).monitored(&mut bar).wait()?;
    drop(bar);
    let is_judged = arguments.limit.is_none() || is_judged(&a, &b, arguments.allow_skipped);
    if !is_judged {
        forget_verdict(&mut result);
    }
    if arguments.json {
        print_json(&OfFiles::new(&result, &a, &b))?;
    } else {
        print(&report::text(&result))?;
    }
    let Some(limit) = arguments.limit else { return Ok(WITHIN) };
    Ok(match result.with_gaps.within {
        _ if !is_judged => UNDECIDED,
        within if arguments.strict_gaps => {
            within.map_or(UNDECIDED, |within| if within { WITHIN } else { BEYOND })
        }
        _ => verdict(&result, limit),
    })
}

/// Takes the verdict out of a result, and out of those of both directions.
fn forget_verdict(result: &mut DistanceResult) {
    if let Details::Certified(details) = &mut result.details {
        details.within = None;
    }
    result.with_gaps.within = None;
    for direction in [&mut result.forward, &mut result.reverse].into_iter().flatten() {
        forget_verdict(direction);
    }
}

/// The exit status that follows from the interval and the limit, for all methods.
fn verdict(result: &DistanceResult, limit: f64) -> u8 {
    if result.upper <= limit {
        WITHIN
    } else if result.lower > limit {
        BEYOND
    } else {
        UNDECIDED
    }
}
