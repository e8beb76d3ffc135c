//! The command `convert`.

use crate::arguments::files::ConvertArguments;
use crate::failure::Failure;
use crate::input::{CadReport, Input, STANDARD_STREAM, read};
use crate::output::file::write_file;
use crate::output::json::{OfFile, line};
use crate::output::print;
use std::fmt::Write as _;

/// Writes the model as interchange JSON, and prints the report on reading it: on standard
/// error where standard output holds the model.
pub(crate) fn run(arguments: &ConvertArguments) -> Result<(), Failure> {
    let input = read(&arguments.input)?;
    let json = input.surfaces("a conversion to interchange JSON")?.to_json()?;
    let Input { report, source, .. } = input;
    let report =
        if arguments.json { line(&OfFile::new("convert", &report, &source))? } else { text(&report) };
    if arguments.output.as_os_str() == STANDARD_STREAM {
        eprint!("{report}");
        return print(&json);
    }
    write_file(&arguments.output, arguments.overwrite, |out| out.write_all(json.as_bytes()))?;
    print(&report)
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
