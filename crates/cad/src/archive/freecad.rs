//! The shapes of a FreeCAD document as one model.

use super::document::{Kernel, Object, objects};
use super::joined::Joined;
use super::unreadable;
use crate::read_brep;
use nurbs_hausdorff::workspace::{Assembled, Budget};
use nurbs_hausdorff::{Error, Model, Result};
use std::collections::{HashMap, HashSet};
use std::io::Cursor;
use zip::ZipArchive;
use zip::result::ZipError;

const DOCUMENT: &str = "Document.xml";

/// The file that says which objects are shown. Documents made without a window have none, and say it of the objects.
const VIEWS: &str = "GuiDocument.xml";

const PLACED: &str = "its parts are placed by a container: export the document as STEP";
const BINARY: &str = "its shape is stored in binary: export the document as STEP";
const MESH: &str = "its triangles are not read: export the object as STL or PLY";
const POINTS: &str = "its points are no surface";
const ELEMENTS: &str = "its mesh of an analysis is no shape";

/// The code of notes on objects that are not measured.
const NOT_MEASURED: &str = "NOT_MEASURED";

/// Reads the visible shapes of a FreeCAD document, in millimetres. A body's features are left out, as
/// the body's own shape is that of the last, and so are the members of a part that is hidden. Shapes without faces, as
/// sketches are, have no part in it. Meshes are listed as skipped, and points and meshes of an analysis are noted.
///
/// # Errors
/// [`Error::FormatUnsupported`] for other archives; [`Error::FileTooLarge`] before more than
/// [`Model::MAX_JSON_BYTES`] are unpacked; [`Error::CadUnreadable`]; [`Error::EmptyDocument`].
pub(crate) fn read_document(bytes: &[u8]) -> Result<Assembled> {
    let mut archive = Archive::new(bytes)?;
    if !archive.has(DOCUMENT) {
        return Err(archive.unsupported());
    }
    let objects = objects(&archive.content(DOCUMENT)?, "ObjectData", "Object")?;
    let views = match archive.has(VIEWS) {
        true => Some(self::objects(&archive.content(VIEWS)?, "ViewProviderData", "ViewProvider")?),
        false => None,
    };
    let shown = views.as_ref().unwrap_or(&objects);
    let hidden = shown.iter().filter(|view| view.is_hidden()).map(|view| view.name.as_str());
    let omitted = omitted(&objects, hidden);
    let mut joined = Joined::default();
    for object in objects.iter().filter(|object| !omitted.contains(object.name.as_str())) {
        read_object(&mut archive, object, &mut joined)?;
    }
    joined.into_assembled()
}

/// Returns the names of the objects that are no part of the model: those hidden, the features of bodies, and all that
/// stands below a part that is hidden.
fn omitted<'a>(objects: &'a [Object], hidden: impl Iterator<Item = &'a str>) -> HashSet<&'a str> {
    let by_name: HashMap<&str, &Object> =
        objects.iter().map(|object| (object.name.as_str(), object)).collect();
    let mut omitted: HashSet<&str> = hidden.collect();
    let is_closed = |object: &&Object| object.is_part() && omitted.contains(object.name.as_str());
    let closed = objects.iter().filter(|object| object.is_body() || is_closed(object));
    let mut pending: Vec<&str> = closed.flat_map(|object| &object.members).map(String::as_str).collect();
    let mut met = HashSet::new();
    while let Some(name) = pending.pop() {
        if met.insert(name) {
            let members = by_name.get(name).map(|object| &object.members);
            pending.extend(members.into_iter().flatten().map(String::as_str));
        }
    }
    omitted.extend(met);
    omitted
}

fn read_object(archive: &mut Archive<'_>, object: &Object, joined: &mut Joined) -> Result<()> {
    let unsupported = |why: &str| ("FORMAT_UNSUPPORTED", why.to_owned());
    let left_out = match &object.file {
        _ if object.is_container() => Some(unsupported(PLACED)),
        None => match object.kernel {
            Some(Kernel::Mesh) => Some(unsupported(MESH)),
            Some(Kernel::Points) => {
                joined.note(&object.name, NOT_MEASURED, POINTS);
                None
            }
            Some(Kernel::Elements) => {
                joined.note(&object.name, NOT_MEASURED, ELEMENTS);
                None
            }
            None => None,
        },
        Some(file) if file.ends_with(".bin") => Some(unsupported(BINARY)),
        Some(file) if !file.is_empty() && !archive.has(file) => {
            Some(("CAD_UNREADABLE", format!("its shape is in {file}, which the archive does not have")))
        }
        Some(file) => {
            let text = archive.content(file)?;
            let shape = match text.trim_ascii().is_empty() {
                true => Err(Error::EmptyModel),
                false => {
                    std::str::from_utf8(&text).map_err(unreadable).and_then(|text| read_brep(text, None))
                }
            };
            match shape {
                Ok(shape) => return joined.push(&object.name, shape),
                Err(Error::EmptyModel) => None,
                Err(error) => Some((error.code(), error.to_string())),
            }
        }
    };
    joined.leave_out(&object.name, left_out);
    Ok(())
}

/// A zip archive that unpacks a bounded number of bytes.
struct Archive<'a> {
    zip: ZipArchive<Cursor<&'a [u8]>>,
    budget: Budget,
}

impl<'a> Archive<'a> {
    fn new(bytes: &'a [u8]) -> Result<Self> {
        let zip = ZipArchive::new(Cursor::new(bytes)).map_err(unreadable)?;
        Ok(Self { zip, budget: Budget::new(Model::MAX_JSON_BYTES) })
    }

    fn has(&self, name: &str) -> bool {
        self.zip.index_for_name(name).is_some()
    }

    /// Returns the content of a file; empty if the archive has none of the name.
    fn content(&mut self, name: &str) -> Result<Vec<u8>> {
        match self.zip.by_name(name) {
            Ok(file) => self.budget.read(file, unreadable),
            Err(ZipError::FileNotFound) => Ok(Vec::new()),
            Err(error) => Err(unreadable(error)),
        }
    }

    /// Returns the error for an archive that is no document.
    fn unsupported(&self) -> Error {
        let (found, advice) = match self.has("[Content_Types].xml") {
            true => ("a 3MF file or a package like it", "a 3MF file is known by the ending .3mf of its name"),
            false => ("a zip archive", "unpack it, and choose the file inside"),
        };
        Error::FormatUnsupported { found, advice: advice.to_owned() }
    }
}
