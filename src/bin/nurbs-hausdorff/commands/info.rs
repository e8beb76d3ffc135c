//! The command `info`.

use crate::arguments::InfoArguments;
use crate::failure::Failure;
use crate::input::{Input, read};
use crate::output::json::{OfFile, print_json};
use crate::output::print;
use crate::output::report::short;
use nurbs_hausdorff::{ModelInfo, Note, ReadReport, Skipped};
use serde::Serialize;
use std::fmt::Write;

/// Prints the faces, patches, areas and bounding box of the model.
pub(crate) fn run(arguments: &InfoArguments) -> Result<(), Failure> {
    let input = read(&arguments.model)?;
    let info = ModelInfo::of_prepared(input.surfaces("the table of faces")?, &input.prepared);
    let Input { report, source, .. } = input;
    if arguments.json {
        let ReadReport { skipped, notes, .. } = &report.read;
        let info = Info { info: &info, skipped, notes };
        return print_json(&OfFile::new("info", &info, &source));
    }
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = lines(&mut text, &info);
    print(&text)
}

/// A model in numbers, with the faces that were left out of it and the notes on others.
#[derive(Serialize)]
struct Info<'a> {
    #[serde(flatten)]
    info: &'a ModelInfo,
    skipped: &'a [Skipped],
    notes: &'a [Note],
}

fn lines(out: &mut String, info: &ModelInfo) -> std::fmt::Result {
    let [min, max] = info.bounding_box;
    writeln!(out, "model     {}", info.name.as_deref().unwrap_or("without a name"))?;
    writeln!(out, "box       {min:?} to {max:?}, diagonal {:?}", info.diagonal)?;
    if let Some(unit) = info.unit {
        writeln!(out, "unit      {unit:?} m")?;
    }
    writeln!(out, "area      {} to {}", short(info.area.lower), short(info.area.upper))?;
    let trimmed = if info.trimmed > 0 { format!("{} trimmed, ", info.trimmed) } else { String::new() };
    writeln!(out, "faces     {}, {trimmed}{} Bézier patches", info.faces.len(), info.patches)?;
    if info.trimmed > 0 || info.gap > 0.0 {
        writeln!(out, "gap       {:?}, deviation of the pieces {:?}", info.gap, info.deviation)?;
    }
    for (index, face) in info.faces.iter().enumerate() {
        let [p, q] = face.degree;
        let [rows, columns] = face.counts;
        let [[u_start, u_end], [v_start, v_end]] = face.domain;
        let kind = if face.rational { "rational" } else { "polynomial" };
        let ends = if face.clamped == [true, true] { "clamped" } else { "unclamped" };
        let (patches, area) = (face.patches, short(face.area.lower));
        let trim = face.trim.as_ref().map_or(String::new(), |loops| {
            format!("  {} loops of {} curves", loops.len(), loops.iter().sum::<usize>())
        });
        let name = face.face_name.as_ref().map_or(String::new(), |name| format!("  {name}"));
        writeln!(
            out,
            "{index:>8}  degree {p},{q}  net {rows}x{columns}  {kind}  {ends}  \
             [{u_start:?}, {u_end:?}] x [{v_start:?}, {v_end:?}]  {patches} patches  area {area}{trim}{name}"
        )?;
    }
    Ok(())
}
