//! The command `grid`.

use crate::arguments::grid::GridArguments;
use crate::failure::Failure;
use crate::input::{Input, read};
use crate::output::file::write_file;
use crate::output::grid::GridFormat;
use crate::output::json::{OfFile, print_json};
use crate::output::print;
use crate::output::progress::Bar;
use nurbs_hausdorff::{Engine, Error, Grid, Precision, ReadReport, SignedDistances, Skipped};
use serde::Serialize;
use std::fmt::Write as _;

/// Measures the signed distances, writes them and prints their grid.
pub(crate) fn run(arguments: &GridArguments) -> Result<(), Failure> {
    let format = GridFormat::of_path(&arguments.output).ok_or_else(|| Error::OptionOutOfRange {
        option: "output",
        found: format!("{:?}", arguments.output),
        expected: "a file whose name ends with .npy, .nrrd or .vti",
    })?;
    if !arguments.overwrite && arguments.output.exists() {
        return Err(Failure::Exists(arguments.output.clone()));
    }
    let input = read(&arguments.model)?;
    let options = arguments.options();
    let engine = Engine::cpu();
    let mut bar = Bar::new();
    let found = engine.signed_distances(&input.prepared, &options).monitored(&mut bar).wait()?;
    drop(bar);
    write_file(&arguments.output, arguments.overwrite, |out| format.write(out, &found))?;
    let Input { report, source, .. } = input;
    if arguments.json {
        let ReadReport { skipped, .. } = &report.read;
        return print_json(&OfFile::new("grid", &Summary::new(&found, skipped), &source));
    }
    print(&text(&found))
}

/// The signed distances but for the values, which are in the file.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Summary<'a> {
    #[serde(flatten)]
    grid: Grid,
    precision: Precision,
    bound: f64,
    /// Null if all points were measured.
    band: Option<f64>,
    least: f64,
    greatest: f64,
    inside: usize,
    undecided: usize,
    measured: usize,
    skipped: &'a [Skipped],
}

impl<'a> Summary<'a> {
    fn new(found: &SignedDistances, skipped: &'a [Skipped]) -> Self {
        let [least, greatest] = ends(found);
        Self {
            grid: found.grid,
            precision: found.precision,
            bound: found.bound,
            band: found.band.is_finite().then_some(found.band),
            least,
            greatest,
            inside: inside(found),
            undecided: found.undecided.len(),
            measured: found.measured,
            skipped,
        }
    }
}

/// Returns the least and the greatest value.
fn ends(found: &SignedDistances) -> [f64; 2] {
    let values = || found.values.iter().copied();
    [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)]
}

/// Returns the number of points inside.
fn inside(found: &SignedDistances) -> usize {
    found.values.iter().filter(|value| value.is_sign_negative()).count()
}

fn text(found: &SignedDistances) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = lines(&mut text, found);
    text
}

fn lines(out: &mut String, found: &SignedDistances) -> std::fmt::Result {
    let Grid { origin: [x, y, z], spacing, counts: [width, depth, height], .. } = found.grid;
    let [least, greatest] = ends(found);
    writeln!(
        out,
        "grid      {width} x {depth} x {height} points from {x:?} {y:?} {z:?}, spacing {spacing:?}"
    )?;
    writeln!(out, "distances {least:?} to {greatest:?}, each within {:?}", found.bound)?;
    if found.band.is_finite() {
        writeln!(out, "band      {:?}, {} points measured", found.band, found.measured)?;
    }
    writeln!(out, "inside    {} points, {} undecided", inside(found), found.undecided.len())
}
