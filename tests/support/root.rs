//! The folder of the project.

use std::path::{Path, PathBuf};

/// The folder of the workspace, from any of its crates.
pub fn root() -> PathBuf {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.ancestors().find(|folder| folder.join("Cargo.lock").is_file()).unwrap_or(own).to_owned()
}
