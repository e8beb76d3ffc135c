//! CAD files within others: what gzip compressed, and the shapes of FreeCAD documents.

mod document;
mod freecad;
mod joined;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests;

use flate2::read::MultiGzDecoder;
pub(super) use freecad::read_document;
use nurbs_hausdorff::workspace::Budget;
use nurbs_hausdorff::{Error, Model, Result};

/// The ending of names of files that gzip compressed.
const GZIP_ENDING: &str = ".gz";

/// Returns what gzip compressed, and its name without `.gz`; anything else as it is. O(length).
///
/// # Errors
/// [`Error::FileTooLarge`] before more than [`Model::MAX_JSON_BYTES`] are in memory;
/// [`Error::CadUnreadable`] for damaged content.
pub fn inflated(bytes: Vec<u8>, name: &str) -> Result<(Vec<u8>, &str)> {
    if !super::format::is_gzip(&bytes) {
        return Ok((bytes, name));
    }
    let mut budget = Budget::new(Model::MAX_JSON_BYTES);
    let content = budget.read(MultiGzDecoder::new(bytes.as_slice()), unreadable)?;
    Ok((content, without_ending(name)))
}

fn without_ending(name: &str) -> &str {
    let parts = name.len().checked_sub(GZIP_ENDING.len()).and_then(|at| name.split_at_checked(at));
    match parts {
        Some((stem, ending)) if ending.eq_ignore_ascii_case(GZIP_ENDING) => stem,
        _ => name,
    }
}

fn unreadable(found: impl ToString) -> Error {
    Error::CadUnreadable { found: found.to_string() }
}
