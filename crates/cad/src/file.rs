//! Files of every kind that hold a model, recognised by their content.

#[cfg(feature = "archives")]
use super::archive;
use super::{foreign, format, from_brep, from_iges, from_step};
#[cfg(feature = "archives")]
use nurbs_hausdorff::workspace::into_model;
use nurbs_hausdorff::{Error, Model, ReadReport, Result};

/// The kind of a model's file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum FileKind {
    /// STEP: ISO 10303-21.
    Step,
    /// IGES of version 5.3 or earlier.
    Iges,
    /// The BREP text of OpenCASCADE.
    Brep,
    /// A document of FreeCAD.
    #[cfg(feature = "archives")]
    FreeCad,
    /// The interchange JSON, whose faces are read without a change.
    Json,
}

impl FileKind {
    /// Returns the kind's name: `step`, `iges`, `brep`, `fcstd` or `json`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Step => "step",
            Self::Iges => "iges",
            Self::Brep => "brep",
            #[cfg(feature = "archives")]
            Self::FreeCad => "fcstd",
            Self::Json => "json",
        }
    }
}

/// Reads a file of interchange JSON, STEP, IGES or OpenCASCADE's BREP text, or with the feature
/// `archives` a FreeCAD document or any of these that gzip compressed, found by its content. `path`
/// names the file in errors only. O(length).
///
/// # Errors
/// [`Error::FormatUnsupported`], else those of [`Model::from_json`], [`from_step`],
/// [`from_iges`] and [`from_brep`]; of archives also [`Error::CadUnreadable`], and
/// [`Error::FileTooLarge`] before more than [`Model::MAX_JSON_BYTES`] are unpacked.
pub fn from_file(bytes: Vec<u8>, path: &str) -> Result<(Model, ReadReport, FileKind)> {
    #[cfg(feature = "archives")]
    let (bytes, path) = archive::inflated(bytes, path)?;
    #[cfg(feature = "archives")]
    if format::is_zip(&bytes) {
        let (model, report) = into_model(archive::read_document(&bytes)?)?;
        return Ok((model, report, FileKind::FreeCad));
    }
    if let Some(refused) = foreign::refused(&bytes, path) {
        return Err(refused);
    }
    if format::is_binary_brep(&bytes) {
        return Err(Error::BrepSyntax {
            line: 1,
            found: "an OpenCASCADE BREP file in binary".to_owned(),
            expected: "BREP text, as BRepTools::Write writes it".to_owned(),
        });
    }
    let of_kind = |kind| move |(model, report)| (model, report, kind);
    if format::is_step(&bytes) {
        return from_step(&bytes).map(of_kind(FileKind::Step));
    }
    if format::is_iges(&bytes) {
        return from_iges(&bytes).map(of_kind(FileKind::Iges));
    }
    if format::is_brep(&bytes) {
        return from_brep(&text(bytes)?).map(of_kind(FileKind::Brep));
    }
    if !format::is_json(&bytes) {
        return Err(foreign::unknown());
    }
    let text = text(bytes)?;
    let model = Model::from_json(&text)?;
    let report = ReadReport::of_exact(&model);
    Ok((model, report, FileKind::Json))
}

fn text(bytes: Vec<u8>) -> Result<String> {
    String::from_utf8(bytes).map_err(|error| Error::JsonShape { found: error.to_string() })
}
