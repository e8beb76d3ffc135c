//! Reads models.

mod bytes;
mod rhino;

use crate::arguments::models::{Unit, UnitsOfFiles};
use crate::failure::Failure;
pub(crate) use bytes::{STANDARD_STREAM, Source, hexadecimal};
use nurbs_hausdorff::{Error, FaceId, Facets, Model, PreparedModel, ReadReport, Result, one_line};
use nurbs_hausdorff_cad::inflated;
use nurbs_hausdorff_files::{Content, Opened};
use nurbs_hausdorff_meshes::Beside;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Reads the model in a file, or in standard input for `-`, which gzip may have compressed, and prints the faces left out and the notes on others.
///
/// # Errors
/// Those of [`bytes::bytes`], [`nurbs_hausdorff_files::read`] and [`PreparedModel`], all with the path.
pub(crate) fn read(path: &Path) -> std::result::Result<Input, Failure> {
    File::open(path)?.read()
}

/// Reads a model as [`read`] does, in the unit that is given for it.
///
/// # Errors
/// Those of [`read`] and of [`PreparedModel::with_unit`].
pub(crate) fn read_in_unit(path: &Path, unit: Option<Unit>) -> std::result::Result<Input, Failure> {
    Ok(read(path)?.in_unit(unit)?)
}

/// Reads two models as [`read`] does, in the units that are given for them.
///
/// # Errors
/// Those of [`read`] and of [`in_units`].
pub(crate) fn read_both([a, b]: [&Path; 2], units: UnitsOfFiles) -> std::result::Result<[Input; 2], Failure> {
    refuse_one_stream([a, b])?;
    Ok(in_units([read(a)?, read(b)?], units)?)
}

/// Refuses standard input as both of two models: its bytes come once.
///
/// # Errors
/// [`Error::OptionInvalid`].
pub(crate) fn refuse_one_stream(files: [&Path; 2]) -> Result<()> {
    if files.iter().all(|path| path.as_os_str() == STANDARD_STREAM) {
        let found = "found standard input as both models, expected it as one".to_owned();
        return Err(Error::OptionInvalid { found });
    }
    Ok(())
}

/// Returns models in units that are given for them, whatever their files state; the others are unchanged.
///
/// # Errors
/// Those of [`PreparedModel::with_unit`].
pub(crate) fn in_units([a, b]: [Input; 2], units: UnitsOfFiles) -> Result<[Input; 2]> {
    Ok([a.in_unit(units.unit_of_a)?, b.in_unit(units.unit_of_b)?])
}

/// A file whose bytes are read.
pub(crate) struct File {
    path: PathBuf,
    bytes: Vec<u8>,
    beside: Beside,
    source: Source,
}

impl File {
    /// Reads the bytes, with those of the files beside it that it consists of.
    ///
    /// # Errors
    /// Those of [`bytes::bytes`] and [`bytes::beside`], with the path.
    pub(crate) fn open(path: &Path) -> std::result::Result<Self, Failure> {
        let failure = |error| Failure::Model { path: path.to_owned(), error };
        let bytes = bytes::bytes(path).map_err(failure)?;
        let beside = bytes::beside(path, &bytes).map_err(failure)?;
        let source = Source::new(path, &bytes, &beside);
        Ok(Self { path: path.to_owned(), bytes, beside, source })
    }

    /// The path and the hash.
    pub(crate) fn source(&self) -> &Source {
        &self.source
    }

    /// Reads the model, as [`read`].
    ///
    /// # Errors
    /// Those of [`nurbs_hausdorff_files::read`], [`rhino::read`] and [`PreparedModel`], all with the path.
    pub(crate) fn read(self) -> std::result::Result<Input, Failure> {
        let Self { path, bytes, beside, source } = self;
        let input = parse(&path, bytes, &beside, source)?;
        print_notes(&path, &input);
        Ok(input)
    }
}

/// Prints the faces left out and the notes on others on standard error.
fn print_notes(path: &Path, input: &Input) {
    let called = |face: &FaceId| match face {
        FaceId::Number(number) => format!("face {number}"),
        _ => face.to_string(),
    };
    for skipped in &input.report.read.skipped {
        let (path, face, why) = (path.display(), called(&skipped.face), &skipped.why);
        let entity = skipped.entity.map(|entity| format!(" (#{entity})")).unwrap_or_default();
        eprintln!("{}", one_line(&format!("warning: {path}: {face}{entity} is left out: {why}")));
    }
    for note in &input.report.read.notes {
        let (path, face, why) = (path.display(), called(&note.face), &note.why);
        eprintln!("{}", one_line(&format!("note: {path}: {face}: {why}")));
    }
}

/// A model that was read.
pub(crate) struct Input {
    /// The surfaces, without the faces left out; none of a mesh or a cloud of points.
    pub(crate) model: Option<Model>,
    pub(crate) prepared: PreparedModel,
    pub(crate) report: CadReport,
    pub(crate) source: Source,
}

impl Input {
    /// Returns the model with coordinates in a unit, if one is given, whatever its file states.
    ///
    /// # Errors
    /// Those of [`PreparedModel::with_unit`].
    fn in_unit(self, unit: Option<Unit>) -> Result<Self> {
        let Some(metres) = unit.map(Unit::metres) else { return Ok(self) };
        if let Some(stated) = self.prepared.unit().filter(|&stated| stated != metres) {
            let path = self.source.path();
            eprintln!(
                "note: {path}: its coordinates in units of {stated:?} m are taken as ones of {metres:?} m"
            );
        }
        let model = self.model.map(|model| model.with_unit(metres)).transpose()?;
        let prepared = self.prepared.with_unit(metres, model.as_ref())?;
        Ok(Self { model, prepared, ..self })
    }
}

/// Returns whether a verdict holds for the files: no faces were left out of their models, or that is
/// allowed. Says on standard error why it does not.
pub(crate) fn is_judged(a: &Input, b: &Input, allow_skipped: bool) -> bool {
    let skipped: usize = [a, b].map(|input| input.report.read.skipped.len()).iter().sum();
    let is_judged = allow_skipped || skipped == 0;
    if !is_judged {
        eprintln!("undecided: {skipped} faces were left out; --allow-skipped judges the others");
    }
    is_judged
}

/// The reader of all files but 3DM, as the npm package calls it.
const READER: &str = "built-in";

/// The points of a file.
pub(crate) struct Points {
    /// x, y, z each.
    pub(crate) coordinates: Vec<f64>,
    /// Metres per unit, if the file states it.
    pub(crate) unit: Option<f64>,
    pub(crate) source: Source,
}

/// Reads the points of a cloud, or the corners of a mesh, as [`read`] does.
///
/// # Errors
/// Those of [`bytes::bytes`] and [`nurbs_hausdorff_files::read_facets`], with the path; [`Error::FormatUnsupported`] for
/// other files.
pub(crate) fn read_points(path: &Path) -> std::result::Result<Points, Failure> {
    let failed = |error| Failure::Model { path: path.to_owned(), error };
    let File { bytes, beside, source, .. } = File::open(path)?;
    let file =
        nurbs_hausdorff_files::read_facets(bytes, &path.display().to_string(), &beside).map_err(failed)?;
    let points = match &file.facets {
        Facets::Mesh(mesh) => mesh.vertices(),
        Facets::Cloud(cloud) => cloud.points(),
    };
    let coordinates = points.iter().flat_map(|point| point.to_array()).collect();
    Ok(Points { coordinates, unit: file.unit, source })
}

/// A report, with the kind of the file and its reader.
#[derive(Serialize)]
pub(crate) struct CadReport {
    pub(crate) kind: &'static str,
    reader: &'static str,
    #[serde(flatten)]
    pub(crate) read: ReadReport,
}

fn parse(
    path: &Path,
    bytes: Vec<u8>,
    beside: &Beside,
    source: Source,
) -> std::result::Result<Input, Failure> {
    let failed = |error| Failure::Model { path: path.to_owned(), error };
    let name = path.display().to_string();
    let (bytes, name) = inflated(bytes, &name).map_err(failed)?;
    if let Some(program) = rhino::reader(&bytes) {
        let (model, mut read) = rhino::read(&program, path, &bytes)?;
        let (model, prepared) = PreparedModel::new_skipping(model, &mut read).map_err(failed)?;
        let report = CadReport { kind: rhino::KIND, reader: rhino::READER, read };
        return Ok(Input { model: Some(model), prepared, report, source });
    }
    let Opened { content, prepared, report: read, kind, .. } =
        nurbs_hausdorff_files::read(bytes, name, beside).map_err(failed)?;
    let model = match content {
        Content::Surfaces(model) => Some(model),
        Content::Facets(_) => None,
    };
    Ok(Input { model, prepared, report: CadReport { kind, reader: READER, read }, source })
}

impl Input {
    /// Returns the surfaces.
    ///
    /// # Errors
    /// [`Error::FacetsUnsupported`] of a mesh or a cloud, with the computation that needs surfaces.
    pub(crate) fn surfaces(&self, found: &'static str) -> Result<&Model> {
        self.model.as_ref().ok_or(Error::FacetsUnsupported { found })
    }
}
