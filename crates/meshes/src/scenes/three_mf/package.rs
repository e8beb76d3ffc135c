//! The package of a 3MF: the names of its parts, and the part with the model that is built.

use super::{FORMAT, attribute};
use crate::scenes::uri::path;
use nurbs_hausdorff::Result;
use quick_xml::Reader;
use quick_xml::events::Event;

/// The part that states the relationships of the package.
const RELATIONSHIPS: &str = "_rels/.rels";

/// The type of the relationship to the model that is built.
const MODEL_TYPE: &str = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";

/// The path of that model where no relationship states it.
const DEFAULT_MODEL: &str = "3D/3dmodel.model";

/// The ending of the names of parts with models.
const MODEL_ENDING: &str = ".model";

/// Returns the name of a part by its path from the root of the package. Names that differ in escapes or in the case
/// of ASCII letters alone are those of one part.
pub(super) fn part_name(uri: &str) -> String {
    path(uri).trim_start_matches('/').to_ascii_lowercase()
}

/// Whether an entry of the archive has the relationships of the package.
pub(super) fn is_relationships(entry: &str) -> bool {
    part_name(entry) == RELATIONSHIPS
}

/// Whether a part has a model by the ending of its name.
pub(super) fn is_model(part: &str) -> bool {
    part.ends_with(MODEL_ENDING)
}

/// Returns the paths of the models that the relationships of a package state, each once, in the order of the file.
///
/// # Errors
/// [`nurbs_hausdorff::Error::MeshSyntax`] for XML that cannot be read.
pub(super) fn stated_models(relationships: &[u8]) -> Result<Vec<String>> {
    let mut reader = Reader::from_reader(relationships);
    let mut models: Vec<String> = Vec::new();
    loop {
        match reader.read_event().map_err(|error| FORMAT.syntax(error.to_string()))? {
            Event::Start(element) | Event::Empty(element)
                if element.local_name().as_ref() == "Relationship" =>
            {
                if attribute(&element, "Type")?.as_deref() != Some(MODEL_TYPE) {
                    continue;
                }
                let path = attribute(&element, "Target")?
                    .ok_or_else(|| FORMAT.syntax("a relationship without a target"))?;
                if models.iter().all(|model| part_name(model) != part_name(&path)) {
                    models.push(path);
                }
            }
            Event::Eof => return Ok(models),
            _ => {}
        }
    }
}

/// Returns the paths of the parts that may have the model that is built, the one that is read first: those that
/// relationships state, else the one of the usual name, else those with items of a build by their names.
pub(super) fn roots<'a>(stated: Vec<String>, built: impl Iterator<Item = (&'a str, bool)>) -> Vec<String> {
    if !stated.is_empty() {
        return stated;
    }
    let mut others = Vec::new();
    for (name, has_items) in built {
        if name == part_name(DEFAULT_MODEL) {
            return vec![name.to_owned()];
        }
        others.extend(has_items.then(|| name.to_owned()));
    }
    others.sort_unstable();
    others
}
