//! Faces that the model refuses become skipped ones.

use super::assembled::Assembled;
use super::report::{ReadReport, Skipped, order_skipped};
use crate::error::Result;
use crate::model::{Model, ModelArrays};
use crate::threads::parallel;

/// Makes a model of the faces read. Those that it refuses, as their loops cross, are
/// skipped in the report.
///
/// # Errors
/// Those of [`Model::from_faces`] that concern no face, or every one.
pub fn into_model(read: Assembled) -> Result<(Model, ReadReport)> {
    let refused = match Model::from_faces(read.model.clone()) {
        Ok(model) => return Ok((model, read.report())),
        Err(error) if read.model.faces.len() == 1 => return Err(error),
        Err(_) => parallel::map(read.model.faces.len(), |index| refusal(&read.model, index)),
    };
    let Assembled { model: ModelArrays { name, unit, faces, instances }, counts, skipped, notes, shapes } =
        read;
    let model = ModelArrays { name, unit, faces: Vec::new(), instances };
    let mut kept = Assembled { model, counts: Vec::new(), skipped, notes, shapes };
    let mut indices = Vec::with_capacity(refused.len());
    for ((face, counts), refusal) in faces.into_iter().zip(counts).zip(refused) {
        indices.push(match refusal {
            None => {
                kept.model.faces.push(face);
                kept.counts.push(counts);
                Some(kept.model.faces.len() - 1)
            }
            Some((code, why)) => {
                let face = kept.face_id(counts.number);
                kept.skipped.push(Skipped { face, entity: counts.entity, code, why });
                None
            }
        });
    }
    for instance in &mut kept.model.instances {
        instance.surfaces = instance.surfaces.iter().filter_map(|&index| *indices.get(index)?).collect();
    }
    order_skipped(&mut kept.skipped, &mut kept.notes);
    Ok((Model::from_faces(kept.model.clone())?, kept.report()))
}

/// Returns the code and message with which a model of this one face is refused.
fn refusal(arrays: &ModelArrays, index: usize) -> Option<(&'static str, String)> {
    let alone = ModelArrays { faces: vec![arrays.faces[index].clone()], ..ModelArrays::default() };
    let error = Model::from_faces(alone).err()?;
    Some((error.code(), error.to_string()))
}
