//! The bytes of buffers: the chunk of a GLB, data URIs, and files beside the glTF.

use super::FORMAT;
use super::json::Root;
use crate::Beside;
use crate::scenes::uri::{path, unescaped};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use nurbs_hausdorff::Result;
use std::borrow::Cow;

/// The first word of a GLB, and the bytes of its header.
const GLB: &[u8] = b"glTF";
const GLB_HEADER: usize = 12;

/// Returns the JSON of a file and the binary chunk of a GLB.
pub(super) fn chunks(bytes: &[u8]) -> Result<(&[u8], &[u8])> {
    if !bytes.starts_with(GLB) {
        return Ok((bytes, &[]));
    }
    let mut rest = bytes.get(GLB_HEADER..).unwrap_or(&[]);
    let mut found: [&[u8]; 2] = [&[], &[]];
    for chunk in &mut found {
        let [a, b, c, d, _, _, _, _, after @ ..] = rest else { break };
        let length = u32::from_le_bytes([*a, *b, *c, *d]) as usize;
        *chunk = after.get(..length).ok_or_else(|| FORMAT.syntax("a chunk that is longer than the file"))?;
        rest = &after[length..];
    }
    Ok(found.into())
}

/// Returns the names of the files in which a glTF or GLB has its buffers, as paths from its folder; none of
/// other bytes.
pub(crate) fn names_beside(bytes: &[u8]) -> Vec<String> {
    let root = chunks(bytes).ok().and_then(|(json, _)| serde_json::from_slice::<Root>(json).ok());
    let uris = root.into_iter().flat_map(|root| root.buffers).filter_map(|buffer| buffer.uri);
    uris.filter(|uri| !uri.starts_with("data:")).map(|uri| path(&uri)).collect()
}

/// Returns the bytes of each buffer.
///
/// # Errors
/// [`nurbs_hausdorff::Error::MeshSyntax`] for a file that is not beside the glTF, and for data that is not Base64.
pub(super) fn buffers<'a>(root: &Root, binary: &'a [u8], beside: &'a Beside) -> Result<Vec<Cow<'a, [u8]>>> {
    let bytes = |uri: &String| match uri.strip_prefix("data:") {
        Some(data) => decoded(data).map(Cow::Owned),
        None => match beside.get(&path(uri)) {
            Some(bytes) => Ok(Cow::Borrowed(bytes.as_slice())),
            None => {
                let name: String = uri.chars().take(100).collect();
                Err(FORMAT.syntax(format!("its buffer {name:?} is missing, expected that file beside it")))
            }
        },
    };
    let of = |uri: &Option<String>| uri.as_ref().map_or(Ok(Cow::Borrowed(binary)), bytes);
    root.buffers.iter().map(|buffer| of(&buffer.uri)).collect()
}

/// Returns the bytes of a data URI after its scheme.
fn decoded(data: &str) -> Result<Vec<u8>> {
    let (kind, data) = data.split_once(',').ok_or_else(|| FORMAT.syntax("a data URI without data"))?;
    match kind.ends_with(";base64") {
        true => STANDARD.decode(data).map_err(|error| FORMAT.syntax(error.to_string())),
        false => Ok(unescaped(data)),
    }
}
