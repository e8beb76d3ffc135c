//! The command `info`.

use crate::arguments::files::InfoArguments;
use crate::arguments::models::Unit;
use crate::failure::Failure;
use crate::input::{Input, read};
use crate::output::digits::held;
use crate::output::json::{OfFile, print_json};
use crate::output::print;
use crate::output::report::short;
use clap::ValueEnum;
use nurbs_hausdorff::{
    BodyInfo, BodyKind, Error, FaceForm, Facts, Interval, ModelInfo, Note, Orientation, ReadReport, Skipped,
    VolumeUnknown,
};
use serde::{Deserialize, Serialize};
use std::fmt::Write;

/// Prints the facts, bodies, faces, patches and areas of the model.
pub(crate) fn run(arguments: &InfoArguments) -> Result<(), Failure> {
    let input = read(&arguments.model)?;
    let options = InfoOptions { unit: arguments.unit, density: arguments.density };
    let stated = Stated::new(&input, &options)?;
    if arguments.json {
        return print_json(&OfFile::new("info", &stated.with_report(&input), &input.source));
    }
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = lines(&mut text, &stated);
    print(&text)
}

/// The unit of the facts, that of the model if it is left out, and the density, mass per volume in it.
#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct InfoOptions {
    unit: Option<Unit>,
    density: Option<f64>,
}

/// A model in numbers, as it is stated.
pub(crate) struct Stated {
    info: ModelInfo,
    /// The name of the unit of the facts, if they are not in that of the model.
    unit: Option<String>,
    /// The volume times the density.
    mass: Option<Interval>,
}

impl Stated {
    /// # Errors
    /// [`Error::OptionOutOfRange`] for a unit of a model that has none, and for a density that is no
    /// finite number above 0.
    pub(crate) fn new(input: &Input, options: &InfoOptions) -> Result<Self, Failure> {
        let mut info = match &input.model {
            Some(model) => ModelInfo::of_prepared(model, &input.prepared),
            None => ModelInfo::of_facets(&input.prepared),
        };
        if let Some(unit) = options.unit {
            convert(&mut info, unit)?;
        }
        let density = options.density;
        if let Some(found) = density.filter(|density| !(*density > 0.0 && density.is_finite())) {
            let expected = "a finite number above 0";
            let found = found.to_string();
            return Err(Error::OptionOutOfRange { option: "density", found, expected }.into());
        }
        let mass = density.zip(info.facts.volume).map(|(density, volume)| volume * density);
        let unit = options.unit.and_then(|unit| unit.to_possible_value());
        Ok(Self { info, unit: unit.map(|unit| unit.get_name().to_owned()), mass })
    }

    /// Returns what is printed as JSON.
    pub(crate) fn with_report<'a>(&'a self, input: &'a Input) -> Info<'a> {
        let ReadReport { skipped, notes, .. } = &input.report.read;
        Info { info: &self.info, unit_of_facts: self.unit.as_deref(), mass: self.mass, skipped, notes }
    }
}

/// A model in numbers, with the faces that were left out of it and the notes on others.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Info<'a> {
    #[serde(flatten)]
    info: &'a ModelInfo,
    #[serde(skip_serializing_if = "Option::is_none")]
    unit_of_facts: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mass: Option<Interval>,
    skipped: &'a [Skipped],
    notes: &'a [Note],
}

/// States the facts in another unit.
///
/// # Errors
/// [`Error::OptionInvalid`] if the unit of the model is not known.
fn convert(info: &mut ModelInfo, unit: Unit) -> Result<(), Failure> {
    let Some(own) = info.unit else {
        let expected = "no unit where the file states none";
        return Err(Error::OptionOutOfRange { option: "unit", found: format!("{unit:?}"), expected }.into());
    };
    // Metres of inches and millimetres are decimal numbers that float64 rounds once.
    let metres = |metres: f64| Interval { lower: metres.next_down(), upper: metres.next_up() };
    let same = own == unit.metres();
    let factor = if same { Interval::exactly(1.0) } else { metres(own).over(metres(unit.metres())) };
    info.facts = info.facts.scaled(factor);
    info.bodies.iter_mut().for_each(|body| body.facts = body.facts.scaled(factor));
    Ok(())
}

fn lines(out: &mut String, Stated { info, unit, mass }: &Stated) -> std::fmt::Result {
    writeln!(out, "model     {}", info.name.as_deref().unwrap_or("without a name"))?;
    if let Some(unit) = info.unit {
        writeln!(out, "unit      {unit:?} m")?;
    }
    if let Some(unit) = unit {
        writeln!(out, "facts in  {unit}")?;
    }
    facts(out, &info.facts)?;
    if let Some(mass) = mass {
        writeln!(out, "mass      {mass}")?;
    }
    counts(out, info)?;
    for (index, body) in info.bodies.iter().enumerate() {
        self::body(out, index, body)?;
    }
    if unit.is_some() {
        writeln!(out, "faces in  the model's unit")?;
    }
    faces(out, info)
}

/// Writes the facts of a model.
fn facts(out: &mut String, facts: &Facts) -> std::fmt::Result {
    let three = |of: &[Interval; 3]| of.map(|one| one.to_string()).join(", ");
    writeln!(out, "extents   {}", three(&facts.extents))?;
    writeln!(out, "from      {}", three(&facts.min))?;
    writeln!(out, "to        {}", three(&facts.max))?;
    if let Some(area) = &facts.area {
        writeln!(out, "area      {area}")?;
    }
    match (&facts.volume, facts.volume_unknown) {
        (Some(volume), _) => writeln!(out, "volume    {volume}")?,
        (None, Some(why)) => writeln!(out, "volume    not known: {}", reason(why))?,
        (None, None) => {}
    }
    if let Some(centroid) = &facts.centroid {
        writeln!(out, "centroid  {}", three(centroid))?;
    }
    if let Some(moments) = &facts.principal_moments {
        writeln!(out, "moments   {}", three(moments))?;
    }
    Ok(())
}

fn reason(why: VolumeUnknown) -> &'static str {
    match why {
        VolumeUnknown::Open => "edges of faces have no partner",
        VolumeUnknown::NotOrientable => "the faces have no two sides",
        VolumeUnknown::Nesting => "which shells are voids is not decided",
        VolumeUnknown::Points => "points have none",
        _ => "for a reason that this version does not name",
    }
}

/// Writes what the model consists of.
fn counts(out: &mut String, info: &ModelInfo) -> std::fmt::Result {
    let counts = &info.counts;
    let trimmed = if info.trimmed > 0 { format!("{} trimmed, ", info.trimmed) } else { String::new() };
    match (counts.triangles, counts.points) {
        (Some(triangles), _) => writeln!(out, "triangles {triangles}")?,
        (None, Some(points)) => writeln!(out, "points    {points}")?,
        (None, None) => {
            writeln!(out, "faces     {}, {trimmed}{} Bézier patches", info.faces.len(), info.patches)?;
        }
    }
    if counts.kinds.len() > 1 {
        let kinds = counts.kinds.iter().map(|(kind, count)| format!("{count} {kind}"));
        writeln!(out, "kinds     {}", kinds.collect::<Vec<_>>().join(", "))?;
    }
    for (count, what) in [
        (counts.free_edges.unwrap_or(0), "free edges"),
        (counts.duplicate_faces, "faces that stand twice"),
        (counts.duplicate_triangles, "triangles that stand twice"),
        (counts.degenerate_triangles, "triangles on a line"),
    ] {
        if count > 0 {
            writeln!(out, "note      {count} {what}")?;
        }
    }
    if info.trimmed > 0 || info.gap > 0.0 {
        writeln!(out, "gap       {:?}, deviation of the pieces {:?}", info.gap, info.deviation)?;
    }
    Ok(())
}

/// Writes a line on a body.
fn body(out: &mut String, index: usize, BodyInfo { body, facts, .. }: &BodyInfo) -> std::fmt::Result {
    let kind = match body.kind {
        BodyKind::Solid => "solid",
        BodyKind::Sheet => "sheet",
        _ => "points",
    };
    let turned = match body.orientation {
        Some(Orientation::InsideOut) => ", inside out",
        Some(Orientation::Mixed) => ", faces against each other",
        Some(Orientation::NotOrientable) => ", not orientable",
        _ => "",
    };
    let voids = if body.voids > 0 { format!(", {} voids", body.voids) } else { String::new() };
    let volume = facts.volume.map_or(String::new(), |volume| format!("  volume {volume}"));
    let name = if body.path.is_empty() { String::new() } else { format!("  {}", body.path.join(" / ")) };
    writeln!(out, "body {index:>4} {kind}{turned}{voids}, {} faces{volume}{name}", body.faces.len())
}

/// Writes a line on each face.
fn faces(out: &mut String, info: &ModelInfo) -> std::fmt::Result {
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
        let form = face.form.as_ref().map_or(String::new(), |form| format!("{}  ", form_text(form)));
        writeln!(
            out,
            "{index:>8}  {form}degree {p},{q}  net {rows}x{columns}  {kind}  {ends}  \
             [{u_start:?}, {u_end:?}] x [{v_start:?}, {v_end:?}]  {patches} patches  area {area}{trim}{name}"
        )?;
    }
    Ok(())
}

/// Names the elementary surface that a face lies on, with a radius that its interval holds.
fn form_text(form: &FaceForm) -> String {
    match form {
        FaceForm::Plane { .. } => "plane".to_owned(),
        FaceForm::Sphere { radius, .. } => format!("sphere R {}", held(radius)),
        FaceForm::Cylinder { radius, .. } => format!("cylinder R {}", held(radius)),
        FaceForm::Cone { half_angle, .. } => format!("cone ≈ {half_angle:.4}°"),
        FaceForm::Torus { radius, .. } => format!("torus R {}", held(radius)),
        _ => String::new(),
    }
}
