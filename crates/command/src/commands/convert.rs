//! The command `convert`.

use crate::arguments::ConvertArguments;
use crate::failure::Failure;
use crate::input::{CadReport, Input, STANDARD_STREAM, read};
use crate::output::json::{OfFile, line};
use crate::output::print;
use std::fmt::Write as _;
use std::fs::OpenOptions;
use std::io::{ErrorKind, Write as _};
use std::path::Path;

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
    write(&arguments.output, &json, arguments.overwrite)?;
    print(&report)
}

/// Writes a file that is not there yet, or is to be replaced.
fn write(path: &Path, text: &str, overwrite: bool) -> Result<(), Failure> {
    let mut options = OpenOptions::new();
    options.write(true).truncate(true).create(overwrite).create_new(!overwrite);
    options.open(path).and_then(|mut file| file.write_all(text.as_bytes())).map_err(|error| {
        match error.kind() {
            ErrorKind::AlreadyExists => Failure::Exists(path.to_owned()),
            _ => Failure::File { path: path.to_owned(), error },
        }
    })
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
