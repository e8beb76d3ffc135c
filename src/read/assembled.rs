//! The result of a reader, before the model validates it.

use super::report::{FaceCounts, FaceId, Note, ReadReport, Skipped, face_id};
use crate::model::ModelArrays;
use crate::model::trim::FaceArrays;

/// The faces that a reader made of a file, not validated, with the account of each.
#[derive(Default)]
pub struct Assembled {
    /// The faces, with their placements.
    pub model: ModelArrays,
    /// One entry a face of the model.
    pub counts: Vec<FaceCounts>,
    /// The faces that could not be read.
    pub skipped: Vec<Skipped>,
    /// The decisions about faces.
    pub notes: Vec<Note>,
    /// The shapes of a document by the number of their first face, in order; empty for other files.
    pub shapes: Vec<(usize, String)>,
}

impl Assembled {
    /// Returns the faces of a reader in JavaScript, whose curves are all exact, numbered in order.
    #[cfg(all(feature = "wasm", target_arch = "wasm32"))]
    pub fn of_exact(model: ModelArrays) -> Self {
        let curves = |face: &FaceArrays| face.trim.iter().flatten().map(Vec::len).sum();
        let count = |(number, face)| FaceCounts { number, entity: None, exact: curves(face), fitted: 0 };
        let counts = model.faces.iter().enumerate().map(count).collect();
        Self { model, counts, ..Self::default() }
    }

    /// Returns how the file calls the face of a number.
    pub fn face_id(&self, number: usize) -> FaceId {
        face_id(&self.shapes, number)
    }

    /// Returns the report on these faces.
    pub(super) fn report(&self) -> ReadReport {
        let curves = || self.model.faces.iter().filter_map(|face| face.trim.as_ref()).flatten().flatten();
        let gap = |face: &FaceArrays| {
            let curves = face.trim.iter().flatten().flatten();
            face.gap + curves.map(|curve| curve.gap).fold(0.0, f64::max)
        };
        ReadReport {
            faces: self.counts.len(),
            trims: curves().count(),
            exact: self.counts.iter().map(|face| face.exact).sum(),
            fitted: self.counts.iter().map(|face| face.fitted).sum(),
            gap: self.model.faces.iter().map(gap).fold(0.0, f64::max),
            gap_proven: !self.model.faces.iter().any(|face| face.gap_measured),
            unit: self.model.unit,
            skipped: self.skipped.clone(),
            notes: self.notes.clone(),
            sources: self.sources(),
            shapes: self.shapes.clone(),
        }
    }

    /// Returns the counts of the model's faces, which are those of each instance in order.
    fn sources(&self) -> Vec<FaceCounts> {
        if self.model.instances.is_empty() {
            return self.counts.clone();
        }
        let placed = self.model.instances.iter().flat_map(|instance| &instance.surfaces);
        placed.filter_map(|&index| self.counts.get(index).copied()).collect()
    }
}
