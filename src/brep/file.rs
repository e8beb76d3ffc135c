//! Files of every kind that this crate reads, recognised by their content.

use super::format;
use crate::error::{Error, Result};
use crate::model::Model;
use crate::read::ReadReport;

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
    /// The interchange JSON, whose faces are read without a change.
    Json,
}

impl FileKind {
    /// Returns the kind's name: `step`, `iges`, `brep` or `json`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Step => "step",
            Self::Iges => "iges",
            Self::Brep => "brep",
            Self::Json => "json",
        }
    }
}

impl Model {
    /// Reads a file of interchange JSON, STEP, IGES or OpenCASCADE's BREP text, found by its
    /// content. `path` names the file in errors only. O(length).
    ///
    /// # Errors
    /// [`Error::FormatUnsupported`], else those of [`Model::from_json`], [`Model::from_step`],
    /// [`Model::from_iges`] and [`Model::from_brep`].
    pub fn from_file(bytes: Vec<u8>, path: &str) -> Result<(Self, ReadReport, FileKind)> {
        if let Some(found) = format::unsupported(&bytes) {
            return Err(Error::FormatUnsupported { found, path: path.to_owned() });
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
            return Self::from_step(&bytes).map(of_kind(FileKind::Step));
        }
        if format::is_iges(&bytes) {
            return Self::from_iges(&bytes).map(of_kind(FileKind::Iges));
        }
        let text = String::from_utf8(bytes).map_err(|error| Error::JsonShape { found: error.to_string() })?;
        if format::is_brep(&text) {
            return Self::from_brep(&text).map(of_kind(FileKind::Brep));
        }
        let model = Self::from_json(&text)?;
        let report = ReadReport::of_exact(&model);
        Ok((model, report, FileKind::Json))
    }
}
