//! Faces that the model refuses become skipped ones.

use super::report::{ReadReport, Skipped};
use crate::error::Result;
use crate::model::{Model, ModelArrays};
use crate::parallel;

/// Makes a model of the faces read. Those that it refuses, as their loops cross, are moved
/// from the arrays to the report.
///
/// # Errors
/// Those of [`Model::from_faces`] that concern no face, or every one.
pub fn into_model(arrays: ModelArrays, report: &mut ReadReport) -> Result<Model> {
    let refused = match Model::from_faces(arrays.clone()) {
        Ok(model) => return Ok(model),
        Err(error) if arrays.faces.len() == 1 => return Err(error),
        Err(_) => parallel::map(arrays.faces.len(), |index| refusal(&arrays, index)),
    };
    // The numbers in the file of the faces read, in order.
    let numbers: Vec<usize> = (0..arrays.faces.len() + report.skipped.len())
        .filter(|number| !report.skipped.iter().any(|skipped| skipped.face == *number))
        .collect();
    let mut kept = ModelArrays { faces: Vec::new(), instances: arrays.instances, ..arrays };
    let mut indices = Vec::with_capacity(refused.len());
    for ((face, refusal), number) in arrays.faces.into_iter().zip(refused).zip(numbers) {
        indices.push(match refusal {
            None => {
                kept.faces.push(face);
                Some(kept.faces.len() - 1)
            }
            Some((code, why)) => {
                report.skipped.push(Skipped { face: number, code, why });
                report.surfaces -= 1;
                None
            }
        });
    }
    for instance in &mut kept.instances {
        instance.surfaces = instance.surfaces.iter().filter_map(|&index| indices[index]).collect();
    }
    report.skipped.sort_by_key(|skipped| skipped.face);
    Model::from_faces(kept)
}

/// Returns the code and message with which a model of this one face is refused.
fn refusal(arrays: &ModelArrays, index: usize) -> Option<(&'static str, String)> {
    let alone = ModelArrays { faces: vec![arrays.faces[index].clone()], ..ModelArrays::default() };
    let error = Model::from_faces(alone).err()?;
    Some((error.code(), error.to_string()))
}
