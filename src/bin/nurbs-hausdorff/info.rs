//! The command `info`.

use crate::args::InfoArguments;
use crate::failure::Failure;
use crate::files::read;
use crate::output::{print, print_json};
use nurbs_hausdorff::{Axis, Model, NurbsSurface, PreparedModel};
use serde::Serialize;
use std::fmt::Write;

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Info {
    name: Option<String>,
    surfaces: Vec<SurfaceInfo>,
    patches: usize,
    bounding_box: [[f64; 3]; 2],
    diagonal: f64,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct SurfaceInfo {
    degree: [usize; 2],
    counts: [usize; 2],
    domain: [[f64; 2]; 2],
    rational: bool,
    clamped: [bool; 2],
    patches: usize,
}

/// Prints the surfaces, patches and bounding box of the model.
pub(crate) fn run(arguments: &InfoArguments) -> Result<(), Failure> {
    let info = info(&read(&arguments.model)?);
    if arguments.json {
        return print_json(&info);
    }
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = lines(&mut text, &info);
    print(&text)
}

fn lines(out: &mut String, info: &Info) -> std::fmt::Result {
    let [min, max] = info.bounding_box;
    writeln!(out, "model     {}", info.name.as_deref().unwrap_or("without a name"))?;
    writeln!(out, "box       {min:?} to {max:?}, diagonal {:?}", info.diagonal)?;
    writeln!(out, "surfaces  {}, {} Bézier patches", info.surfaces.len(), info.patches)?;
    for (index, surface) in info.surfaces.iter().enumerate() {
        let [p, q] = surface.degree;
        let [rows, columns] = surface.counts;
        let [[u_start, u_end], [v_start, v_end]] = surface.domain;
        let kind = if surface.rational { "rational" } else { "polynomial" };
        let ends = if surface.clamped == [true, true] { "clamped" } else { "unclamped" };
        let patches = surface.patches;
        writeln!(
            out,
            "{index:>8}  degree {p},{q}  net {rows}x{columns}  {kind}  {ends}  \
             [{u_start:?}, {u_end:?}] x [{v_start:?}, {v_end:?}]  {patches} patches"
        )?;
    }
    Ok(())
}

fn info(model: &Model) -> Info {
    let prepared = PreparedModel::new(model);
    let bounding_box = model.bounding_box();
    let surface = |(surface, [rows, columns]): (&NurbsSurface, [usize; 2])| {
        let weight = surface.control_points()[0][3];
        SurfaceInfo {
            degree: surface.degree(),
            counts: surface.counts(),
            domain: surface.domain().intervals(),
            rational: surface.control_points().iter().any(|point| point[3] != weight),
            clamped: Axis::BOTH.map(|axis| clamped(surface.knots(axis), surface.degree()[axis])),
            patches: rows * columns,
        }
    };
    Info {
        name: model.name().map(str::to_owned),
        surfaces: model.surfaces().iter().zip(prepared.patch_counts()).map(surface).collect(),
        patches: prepared.patch_counts().map(|[rows, columns]| rows * columns).sum(),
        bounding_box: [bounding_box.min.to_array(), bounding_box.max.to_array()],
        diagonal: bounding_box.diagonal(),
    }
}

/// Whether both end knots are repeated degree + 1 times.
fn clamped(knots: &[f64], degree: usize) -> bool {
    knots[0] == knots[degree] && knots[knots.len() - 1 - degree] == knots[knots.len() - 1]
}
