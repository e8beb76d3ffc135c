//! The models of `../shared/models`, and the small files of `../shared/faults`.

use super::root::root;
use nurbs_hausdorff::Model;
use std::io::Write;
use std::path::PathBuf;

/// The folder of models beside the project, if it is there. If not, says so on
/// a line of its own that begins with SKIPPED, past libtest's capturing.
pub fn folder(test: &str) -> Option<PathBuf> {
    shared(test, "models")
}

/// The folder of files of one matter each, as [`folder`].
pub fn faults(test: &str) -> Option<PathBuf> {
    shared(test, "faults")
}

fn shared(test: &str, name: &str) -> Option<PathBuf> {
    let folder = root().join("../shared").join(name);
    if folder.is_dir() {
        return Some(folder);
    }
    let line = format!("\nSKIPPED {test}: there is no ../shared/{name}\n");
    std::io::stderr().write_all(line.as_bytes()).unwrap();
    None
}

/// The bytes of a file of `../shared/faults`, if it is there, as [`folder`].
pub fn fault(test: &str, path: &str) -> Option<Vec<u8>> {
    let file = root().join("../shared/faults").join(path);
    if let Ok(bytes) = std::fs::read(file) {
        return Some(bytes);
    }
    let line = format!("\nSKIPPED {test}: there is no ../shared/faults/{path}\n");
    std::io::stderr().write_all(line.as_bytes()).unwrap();
    None
}

/// Every model of the folder with its file's name, in order of name; none if
/// there is no folder.
pub fn all(test: &str) -> impl Iterator<Item = (String, Model)> {
    let mut paths: Vec<PathBuf> = folder(test)
        .into_iter()
        .flat_map(|folder| std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "json"))
        .collect();
    paths.sort();
    paths.into_iter().map(|path| {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let model = Model::from_json(&std::fs::read_to_string(path).unwrap());
        (name.clone(), model.unwrap_or_else(|error| panic!("{name}: {error}")))
    })
}
