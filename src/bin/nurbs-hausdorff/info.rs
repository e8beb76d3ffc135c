//! The command `info`.

use crate::args::InfoArguments;
use crate::failure::Failure;
use crate::files::read;
use crate::output::{print, print_json};
use nurbs_hausdorff::ModelInfo;
use std::fmt::Write;

/// Prints the surfaces, patches and bounding box of the model.
pub(crate) fn run(arguments: &InfoArguments) -> Result<(), Failure> {
    let info = ModelInfo::new(&read(&arguments.model)?);
    if arguments.json {
        return print_json(&info);
    }
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = lines(&mut text, &info);
    print(&text)
}

fn lines(out: &mut String, info: &ModelInfo) -> std::fmt::Result {
    let [min, max] = info.bounding_box;
    writeln!(out, "model     {}", info.name.as_deref().unwrap_or("without a name"))?;
    writeln!(out, "box       {min:?} to {max:?}, diagonal {:?}", info.diagonal)?;
    if let Some(unit) = info.unit {
        writeln!(out, "unit      {unit:?} m")?;
    }
    writeln!(out, "surfaces  {}, {} Bézier patches", info.surfaces.len(), info.patches)?;
    for (index, surface) in info.surfaces.iter().enumerate() {
        let [p, q] = surface.degree;
        let [rows, columns] = surface.counts;
        let [[u_start, u_end], [v_start, v_end]] = surface.domain;
        let kind = if surface.rational { "rational" } else { "polynomial" };
        let ends = if surface.clamped == [true, true] { "clamped" } else { "unclamped" };
        let loops = if surface.loops == 0 { String::new() } else { format!("  {} loops", surface.loops) };
        let patches = surface.patches;
        writeln!(
            out,
            "{index:>8}  degree {p},{q}  net {rows}x{columns}  {kind}  {ends}  \
             [{u_start:?}, {u_end:?}] x [{v_start:?}, {v_end:?}]{loops}  {patches} patches"
        )?;
    }
    Ok(())
}
