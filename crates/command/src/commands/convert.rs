//! The command `convert`.

use crate::arguments::files::ConvertArguments;
use crate::failure::Failure;
use crate::input::{CadReport, Input, read};
use crate::output::file::{is_stream, write_file};
use crate::output::json::{OfFile, line};
use crate::output::print;
use crate::reports::Verdict;
use std::fmt::Write as _;

/// Writes the model as interchange JSON, and prints the report on reading it: on standard
/// error where standard output holds the model. Returns the exit status: 3 if faces were left out.
pub(crate) fn run(arguments: &ConvertArguments) -> Result<u8, Failure> {
    let output = &arguments.output;
    let is_stream = is_stream(output, "json", "a file whose name ends with .json, or -")?;
    let input = read(&arguments.input)?;
    let json = input.surfaces("a conversion to interchange JSON")?.to_json()?;
    let Input { report, source, .. } = input;
    // The JSON does not say what it lacks.
    let status = if report.read.skipped.is_empty() { Verdict::Passed } else { Verdict::Undecided }.status();
    let report =
        if arguments.json { line(&OfFile::new("convert", &report, &source))? } else { text(&report) };
    if is_stream {
        eprint!("{report}");
        return print(&json).map(|()| status);
    }
    write_file(output, arguments.overwrite, |out| out.write_all(json.as_bytes()))?;
    print(&report).map(|()| status)
}

fn text(report: &CadReport) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = lines(&mut text, report);
    text
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
