//! The files of two directories by their relative paths.

use crate::failure::Failure;
use globset::{GlobBuilder, GlobMatcher};
use nurbs_hausdorff::Error;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use walkdir::WalkDir;

/// The endings of the files compared where no pattern is given, in small letters; each may be followed
/// by `.gz`.
const ENDINGS: [&str; 22] = [
    "brep", "brp", "csv", "e57", "fcstd", "glb", "gltf", "iges", "igs", "json", "las", "laz", "obj", "ply",
    "pts", "step", "stl", "stp", "txt", "xyz", "3dm", "3mf",
];

/// A relative path, with `/` between its parts, and the files that it names in A and B.
pub(super) struct TreePair {
    pub(super) path: String,
    pub(super) a: Option<PathBuf>,
    pub(super) b: Option<PathBuf>,
}

/// Returns the files whose relative path matches a pattern, or which have an ending of a model if
/// there is none, in the order of their paths.
///
/// # Errors
/// [`Error::OptionInvalid`] for a pattern, or if there are no files: a check of nothing does not pass; [`Error::FileUnreadable`] of a directory.
pub(super) fn pairs(a: &Path, b: &Path, pattern: Option<&str>) -> Result<Vec<TreePair>, Failure> {
    let pattern = pattern.map(compiled).transpose()?;
    let mut pairs: BTreeMap<String, [Option<PathBuf>; 2]> = BTreeMap::new();
    for (side, root) in [a, b].into_iter().enumerate() {
        for entry in WalkDir::new(root).follow_links(true) {
            let entry = entry.map_err(|error| Error::FileUnreadable {
                path: error.path().unwrap_or(root).display().to_string(),
                found: error.to_string(),
            })?;
            if !entry.file_type().is_file() {
                continue;
            }
            let relative = relative(root, entry.path());
            if is_included(&relative, pattern.as_ref()) {
                pairs.entry(relative).or_default()[side] = Some(entry.into_path());
            }
        }
    }
    if pairs.is_empty() {
        let found = format!("no file of {} or {} is a model to compare", a.display(), b.display());
        return Err(Error::OptionInvalid { found }.into());
    }
    Ok(pairs.into_iter().map(|(path, [a, b])| TreePair { path, a, b }).collect())
}

fn relative(root: &Path, path: &Path) -> String {
    let relative = path.strip_prefix(root).unwrap_or(path);
    let parts: Vec<_> = relative.iter().map(|part| part.to_string_lossy()).collect();
    parts.join("/")
}

fn is_included(relative: &str, pattern: Option<&GlobMatcher>) -> bool {
    match pattern {
        Some(pattern) => pattern.is_match(relative),
        None => {
            let lower = relative.to_ascii_lowercase();
            let name = lower.strip_suffix(".gz").unwrap_or(&lower);
            name.rsplit_once('.').is_some_and(|(_, ending)| ENDINGS.contains(&ending))
        }
    }
}

/// Returns the pattern; one without `/` matches names in every folder.
fn compiled(pattern: &str) -> Result<GlobMatcher, Error> {
    let anywhere = if pattern.contains('/') { pattern.to_owned() } else { format!("**/{pattern}") };
    let glob = GlobBuilder::new(&anywhere).literal_separator(true).build();
    let invalid = |error: globset::Error| Error::OptionInvalid { found: format!("--include: {error}") };
    Ok(glob.map_err(invalid)?.compile_matcher())
}
