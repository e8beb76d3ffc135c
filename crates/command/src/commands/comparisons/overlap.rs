//! The command `overlap`.

use super::asked::answered;
use crate::arguments::comparisons::OverlapArguments;
use crate::failure::Failure;
use crate::input::is_judged;
use crate::output::json::{Asked, OfFiles, print_json};
use crate::output::print;
use crate::output::report::hint;
use crate::reports::Verdict;
use nurbs_hausdorff::{OverlapResult, VolumesUnknown};
use std::fmt::{Result, Write};
use std::path::Path;

/// Measures the volumes, prints them and returns the exit status.
pub(crate) fn run(arguments: &OverlapArguments) -> std::result::Result<u8, Failure> {
    let compared = &arguments.compared;
    let files: [&Path; 2] = [&compared.a, &compared.b];
    let (result, [a, b]) = answered(&arguments.options()?, files, compared.placement.units)?;
    let is_known = is_judged(&a, &b, compared.allow_skipped) && result.volumes.is_some();
    if compared.json {
        let verdict = (!is_known).then_some(Verdict::Undecided);
        let asked = Asked { command: "overlap", verdict, limit: None, symmetric: None };
        print_json(&OfFiles::new(asked, &result, &a, &b))?;
    } else {
        let mut text = String::new();
        // Writing to a string does not fail.
        let _ = lines(&mut text, &result);
        print(&text)?;
    }
    Ok(if is_known { Verdict::Passed } else { Verdict::Undecided }.status())
}

fn lines(out: &mut String, result: &OverlapResult) -> Result {
    match (&result.ratio, &result.volumes) {
        (Some(ratio), Some(volumes)) => {
            writeln!(
                out,
                "ratio {ratio} of volumes: {} in common of {}",
                volumes.intersection, volumes.union
            )?;
            writeln!(out, "common     {}", volumes.intersection)?;
            writeln!(out, "union      {}", volumes.union)?;
            writeln!(out, "only A     {}", volumes.only_a)?;
            writeln!(out, "only B     {}", volumes.only_b)?;
        }
        _ => writeln!(out, "UNDECIDED: no volumes, as {}", result.volumes_unknown.map_or("", reason))?,
    }
    if let Some(volume) = result.volume_of_gap.filter(|&volume| volume > 0.0) {
        writeln!(out, "gaps       about {volume:.0e}, which no interval includes")?;
    }
    hint(out, result.hint.as_deref())?;
    let stop = if result.converged { "converged" } else { "not converged" };
    writeln!(out, "search     {stop}, {} pieces", result.cells)?;
    writeln!(out, "seconds    {:.3} prepare, {:.3} solve", result.seconds.prepare, result.seconds.solve)
}

/// Returns why there are no volumes.
fn reason(unknown: VolumesUnknown) -> &'static str {
    match unknown {
        VolumesUnknown::AOpen => "A is not closed",
        VolumesUnknown::BOpen => "B is not closed",
        VolumesUnknown::BothOpen => "neither model is closed",
        VolumesUnknown::TooLarge => "a mesh has more than 250,000 triangles, which are not joined",
        VolumesUnknown::AVolume => "a body of A has none",
        VolumesUnknown::BVolume => "a body of B has none",
        VolumesUnknown::ABodies => "bodies of A meet or overlap",
        VolumesUnknown::BBodies => "bodies of B meet or overlap",
        VolumesUnknown::ACrossed => "a body of A meets itself",
        VolumesUnknown::BCrossed => "a body of B meets itself",
        VolumesUnknown::Refuted => "what was found contradicts the volumes of both models",
        _ => "",
    }
}
