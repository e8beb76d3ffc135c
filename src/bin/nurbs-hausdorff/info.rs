//! The command `info`.

use crate::args::InfoArguments;
use crate::failure::Failure;
use crate::files::read;
use crate::output::{print, print_json};
use nurbs_hausdorff::trim::TrimPiece;
use nurbs_hausdorff::{Axis, Face, Model, PreparedModel};
use serde::Serialize;
use std::fmt::Write;

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Info {
    name: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    unit: Option<f64>,
    /// The number of faces that are trimmed.
    trimmed: usize,
    /// An upper bound on the distance from the source.
    gap: f64,
    /// The Hausdorff distance, at most, of the trimmed faces from the pieces measured.
    deviation: f64,
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
    /// The numbers of curves of the trimming loops.
    #[serde(skip_serializing_if = "Option::is_none")]
    trim: Option<Vec<usize>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    part: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    kind: Option<String>,
    gap: f64,
    patches: usize,
}

/// Prints the surfaces, patches and bounding box of the model.
pub(crate) fn run(arguments: &InfoArguments) -> Result<(), Failure> {
    let info = info(&read(&arguments.model)?)?;
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
    if let Some(unit) = info.unit {
        writeln!(out, "unit      {unit:?} m")?;
    }
    let trimmed = if info.trimmed > 0 { format!("{} trimmed, ", info.trimmed) } else { String::new() };
    writeln!(out, "surfaces  {}, {trimmed}{} Bézier patches", info.surfaces.len(), info.patches)?;
    if info.trimmed > 0 || info.gap > 0.0 {
        writeln!(out, "gap       {:?}, deviation of the pieces {:?}", info.gap, info.deviation)?;
    }
    for (index, surface) in info.surfaces.iter().enumerate() {
        let [p, q] = surface.degree;
        let [rows, columns] = surface.counts;
        let [[u_start, u_end], [v_start, v_end]] = surface.domain;
        let kind = if surface.rational { "rational" } else { "polynomial" };
        let ends = if surface.clamped == [true, true] { "clamped" } else { "unclamped" };
        let patches = surface.patches;
        let trim = surface.trim.as_ref().map_or(String::new(), |loops| {
            format!("  {} loops of {} curves", loops.len(), loops.iter().sum::<usize>())
        });
        let part = surface.part.as_ref().map_or(String::new(), |part| format!("  {part}"));
        writeln!(
            out,
            "{index:>8}  degree {p},{q}  net {rows}x{columns}  {kind}  {ends}  \
             [{u_start:?}, {u_end:?}] x [{v_start:?}, {v_end:?}]  {patches} patches{trim}{part}"
        )?;
    }
    Ok(())
}

fn info(model: &Model) -> nurbs_hausdorff::Result<Info> {
    let prepared = PreparedModel::new(model)?;
    let bounding_box = prepared.bounding_box();
    let surface = |(face, patches): (Face<'_>, usize)| {
        let surface = face.surface();
        let weight = surface.control_points()[0][3];
        SurfaceInfo {
            degree: surface.degree(),
            counts: surface.counts(),
            domain: surface.domain().intervals(),
            rational: surface.control_points().iter().any(|point| point[3] != weight),
            clamped: Axis::BOTH.map(|axis| clamped(surface.knots(axis), surface.degree()[axis])),
            trim: face.trim().map(|trim| trim.loops().iter().map(|curves| curve_count(curves)).collect()),
            part: face.part().map(str::to_owned),
            kind: face.kind().map(str::to_owned),
            gap: face.gap(),
            patches,
        }
    };
    Ok(Info {
        name: model.name().map(str::to_owned),
        unit: model.unit(),
        trimmed: model.faces().filter(|face| face.trim().is_some()).count(),
        gap: model.gap(),
        deviation: prepared.deviation(),
        surfaces: model.faces().zip(prepared.face_patch_counts()).map(surface).collect(),
        patches: prepared.face_patch_counts().sum(),
        bounding_box: [bounding_box.min.to_array(), bounding_box.max.to_array()],
        diagonal: bounding_box.diagonal(),
    })
}

/// Returns the number of curves of a loop, of which each has one piece or more.
fn curve_count(pieces: &[TrimPiece]) -> usize {
    pieces.last().map_or(0, |piece| piece.curve as usize + 1)
}

/// Whether both end knots are repeated degree + 1 times.
fn clamped(knots: &[f64], degree: usize) -> bool {
    knots[0] == knots[degree] && knots[knots.len() - 1 - degree] == knots[knots.len() - 1]
}
