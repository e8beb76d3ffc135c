//! The command `convert`.

use crate::arguments::ConvertArguments;
use crate::failure::Failure;
use crate::input::{CadReport, Input, read};
use crate::output::{print, print_json};
use std::fmt::Write;

/// Writes the model as interchange JSON, and prints the report on reading it.
pub(crate) fn run(arguments: &ConvertArguments) -> Result<(), Failure> {
    let Input { model, report, .. } = read(&arguments.input)?;
    let json = model.to_json()?;
    std::fs::write(&arguments.output, json).map_err(Failure::Output)?;
    if arguments.json {
        return print_json(&report);
    }
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = lines(&mut text, &report);
    print(&text)
}

fn lines(out: &mut String, CadReport { kind, read, .. }: &CadReport) -> std::fmt::Result {
    writeln!(out, "kind      {kind}")?;
    writeln!(out, "faces     {}, {} left out", read.faces, read.skipped.len())?;
    writeln!(out, "trims     {}, {} exact, {} fitted", read.trims, read.exact, read.fitted)?;
    writeln!(out, "gap       {:?}", read.gap)?;
    match read.unit {
        Some(unit) => writeln!(out, "unit      {unit:?} m"),
        None => writeln!(out, "unit      unknown"),
    }
}
