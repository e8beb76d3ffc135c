//! The models of `../shared/models`, which are not ours to ship, and the
//! reference intervals of pairs of them.

use glam::DVec3;
use nurbs_hausdorff::Model;
use nurbs_hausdorff::internals::engine::PreparedModel;
use nurbs_hausdorff_cad::{from_iges, from_step};
use nurbs_hausdorff_meshes::{MeshFile, MeshFormat};
use std::path::{Path, PathBuf};

/// A pair with an interval that another program found.
pub(crate) struct Reference {
    pub(crate) a: String,
    pub(crate) b: String,
    /// The translation of A.
    pub(crate) translation: DVec3,
    pub(crate) interval: [f64; 2],
}

/// The folder, if it is there.
pub(crate) fn folder() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/models");
    folder.is_dir().then_some(folder)
}

/// The model of this name.
pub(crate) fn load(folder: &Path, name: &str) -> PreparedModel {
    let text = std::fs::read_to_string(folder.join(format!("{name}.json"))).expect("a model");
    PreparedModel::new(&Model::from_json(&text).expect("a valid model")).expect("valid trims")
}

/// The model of a file: JSON, STL and IGES by their endings, or STEP.
pub(crate) fn load_file(path: &Path) -> PreparedModel {
    let bytes = std::fs::read(path).expect("a file");
    if path.extension().is_some_and(|extension| extension == "json") {
        let text = String::from_utf8(bytes).expect("text");
        return PreparedModel::new(&Model::from_json(&text).expect("a model")).expect("valid trims");
    }
    if path.extension().is_some_and(|extension| extension == "stl") {
        let mesh = MeshFile::read(&bytes, MeshFormat::Stl).expect("a mesh");
        return PreparedModel::of_facets(&mesh.facets, None).expect("a mesh");
    }
    let is_iges = path.extension().is_some_and(|extension| extension == "iges");
    let read = if is_iges { from_iges(&bytes) } else { from_step(&bytes) };
    let (model, mut report) = read.expect("a CAD file");
    PreparedModel::new_skipping(model, &mut report).expect("faces that can be cut").1
}

/// All lines of `reference.jsonl`.
pub(crate) fn references(folder: &Path) -> Vec<Reference> {
    let read = |line: &str| {
        let line: serde_json::Value = serde_json::from_str(line).expect("a line of JSON");
        let name = |side: &str| line[side].as_str().expect("a model's name").to_owned();
        let moved = |axis: usize| line["translate_a"][axis].as_f64().unwrap_or(0.0);
        let end = |end: &str| line["result"][end].as_f64().expect("an end of the interval");
        Reference {
            a: name("a"),
            b: name("b"),
            translation: DVec3::new(moved(0), moved(1), moved(2)),
            interval: ["lower", "upper"].map(end),
        }
    };
    std::fs::read_to_string(folder.join("reference.jsonl"))
        .expect("the references")
        .lines()
        .map(read)
        .collect()
}
