//! Models of the papers' sizes, read from a folder next to the project, or shapes in
//! their place.

use super::super::Anyhow;
use super::plan::{Plan, Source};
use nurbs_hausdorff::Model;
use nurbs_hausdorff::shapes::shape;
use std::path::{Path, PathBuf};

/// Reads a model of `../shared/models`; `None` if the file does not exist.
pub(crate) fn shared(name: &str) -> Anyhow<Option<Model>> {
    let path: PathBuf =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/models").join(format!("{name}.json"));
    if !path.is_file() {
        return Ok(None);
    }
    Ok(Some(Model::from_json(&std::fs::read_to_string(path)?)?))
}

/// Returns the model that the source's shape replaces, if its file exists, else the shape.
pub(crate) fn model(source: Source) -> Anyhow<Model> {
    let found = source.stands_for.map_or(Ok(None), shared)?;
    match found {
        None => Ok(shape(source.shape)?),
        Some(model) if source.first_surface => {
            let name = model.name().map(|name| format!("{name}, first surface"));
            Ok(Model::new(name, model.surfaces()[..1].to_vec())?)
        }
        Some(model) => Ok(model),
    }
}

/// Returns the models of a sweep's pair.
pub(crate) fn models_of(pair: &str) -> Anyhow<[Model; 2]> {
    let plan = Plan::read()?;
    let pair = plan.pairs.iter().find(|known| known.name == pair).ok_or("no such pair")?;
    Ok([model(pair.a)?, model(pair.b)?])
}
