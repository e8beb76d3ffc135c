//! 3MF: a zip archive of XML.

mod extensions;
mod package;

use super::Scene;
use crate::{MAX_BYTES, MeshFormat, Soup};
use extensions::{refuse_element, refuse_required};
use glam::{DAffine3, DMat3, DVec3};
use nurbs_hausdorff::Result;
use nurbs_hausdorff::workspace::Budget;
use package::{is_model, is_relationships, part_name, roots, stated_models};
use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, XmlVersion};
use std::collections::HashSet;
use std::collections::btree_map::{BTreeMap, Entry};
use std::io::Cursor;
use zip::ZipArchive;

const FORMAT: MeshFormat = MeshFormat::ThreeMf;

/// An object of a model part: a mesh, components, or both.
#[derive(Default)]
struct Object {
    name: Option<String>,
    /// The type, where it is stated.
    kind: Option<String>,
    vertices: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    components: Vec<Component>,
}

/// An object at a place.
struct Component {
    /// The part that has the object, where it is another one.
    path: Option<String>,
    object: String,
    transform: DAffine3,
}

/// One XML part of a package.
struct PackagePart {
    unit: f64,
    objects: BTreeMap<String, Object>,
    items: Vec<Component>,
}

/// The types of objects that are the model: those for its support are not.
const MODEL_KINDS: [&str; 2] = ["model", "surface"];

/// Reads the objects of the model at the places of the build's items. Supports and other objects are no part of the
/// model, and are noted; an object without triangles and components is listed as skipped.
///
/// # Errors
/// [`nurbs_hausdorff::Error::MeshSyntax`]; also of shapes that are not triangles and of extensions that are required and
/// not read, by their names. [`nurbs_hausdorff::Error::FileTooLarge`] for more than 1 GiB of XML.
pub(crate) fn read(bytes: &[u8]) -> Result<Soup> {
    let mut archive =
        ZipArchive::new(Cursor::new(bytes)).map_err(|error| FORMAT.syntax(error.to_string()))?;
    let names: Vec<String> = archive.file_names().flatten().map(std::borrow::Cow::into_owned).collect();
    let mut budget = Budget::new(MAX_BYTES);
    let mut content = |name: &str| {
        let file = archive.by_name(name).map_err(|error| FORMAT.syntax(error.to_string()))?;
        budget.read(file, |found| FORMAT.syntax(found))
    };
    let stated = match names.iter().find(|name| is_relationships(name)) {
        Some(name) => stated_models(&content(name)?)?,
        None => Vec::new(),
    };
    let mut parts = BTreeMap::new();
    for entry in &names {
        let name = part_name(entry);
        if !is_model(&name) && stated.iter().all(|path| part_name(path) != name) {
            continue;
        }
        let part = parse(&content(entry)?)?;
        if parts.insert(name, part).is_some() {
            return Err(FORMAT.syntax(format!("two parts of the name {entry:?}")));
        }
    }
    let built = parts.iter().map(|(name, part)| (name.as_str(), !part.items.is_empty()));
    let roots = roots(stated, built);
    let [root, others @ ..] = roots.as_slice() else { return Err(FORMAT.syntax("the archive has no model")) };
    let root_name = part_name(root);
    let part = parts.get(&root_name).ok_or_else(|| FORMAT.syntax(format!("there is no part {root:?}")))?;
    let mut scene = Scene::new(FORMAT, part.unit);
    for other in others {
        scene.soup.note(other, format!("the model that is built is read from {root:?}, which comes first"));
    }
    let mut met = HashSet::new();
    for item in &part.items {
        place_object(&parts, &root_name, item, &DAffine3::IDENTITY, 0, (&mut scene, &mut met))?;
    }
    let objects =
        parts.iter().flat_map(|(path, part)| part.objects.iter().map(move |(id, one)| (path, id, one)));
    let is_left = |(path, id, object): &(&String, &String, &Object)| {
        !object.triangles.is_empty() && !met.contains(&(path.as_str(), id.as_str()))
    };
    let left = objects.filter(is_left).count();
    if left > 0 {
        scene
            .soup
            .note("objects", format!("{left} objects that no item of the build places are no part of it"));
    }
    Ok(scene.soup)
}

/// Objects by the paths of their parts and their ids.
type Met<'a> = HashSet<(&'a str, &'a str)>;

/// Places an object and its components, and enters them among those met.
fn place_object<'a>(
    parts: &'a BTreeMap<String, PackagePart>,
    path: &'a str,
    component: &'a Component,
    parent: &DAffine3,
    depth: usize,
    (scene, met): (&mut Scene, &mut Met<'a>),
) -> Result<()> {
    scene.enter(depth)?;
    let path = component.path.as_deref().unwrap_or(path);
    let object = parts.get(path).and_then(|part| part.objects.get(&component.object));
    let object = object.ok_or_else(|| FORMAT.syntax(format!("there is no object {:?}", component.object)))?;
    met.insert((path, &component.object));
    let called = object.name.as_deref().unwrap_or(&component.object);
    if let Some(kind) = object.kind.as_deref().filter(|kind| !MODEL_KINDS.contains(kind)) {
        let kind: String = kind.chars().take(32).collect();
        scene.soup.note(called, format!("it is of the type {kind:?} and no part of the model"));
        return Ok(());
    }
    if object.triangles.is_empty() && object.components.is_empty() {
        scene.soup.skip(called, "it has neither triangles nor components, and nothing else is read");
        return Ok(());
    }
    let transform = *parent * component.transform;
    scene.place(object.name.as_deref(), &object.vertices, &object.triangles, &transform)?;
    for component in &object.components {
        place_object(parts, path, component, &transform, depth + 1, (&mut *scene, &mut *met))?;
    }
    Ok(())
}

fn parse(xml: &[u8]) -> Result<PackagePart> {
    let mut reader = Reader::from_reader(xml);
    let mut part = PackagePart { unit: 1e-3, objects: BTreeMap::new(), items: Vec::new() };
    let mut current: Option<(String, Object)> = None;
    loop {
        let event = reader.read_event().map_err(|error| FORMAT.syntax(error.to_string()))?;
        let is_empty = matches!(event, Event::Empty(_));
        match event {
            Event::Start(element) | Event::Empty(element) => match element.local_name().as_ref() {
                "model" => {
                    refuse_required(&element)?;
                    part.unit = unit(attribute(&element, "unit")?.as_deref())?;
                }
                "object" => {
                    let id =
                        attribute(&element, "id")?.ok_or_else(|| FORMAT.syntax("an object without id"))?;
                    let [name, kind] = [attribute(&element, "name")?, attribute(&element, "type")?];
                    refuse_element("object", &element, name.as_deref().unwrap_or(&id))?;
                    current = Some((id, Object { name, kind, ..Object::default() }));
                    if is_empty {
                        part.store(current.take())?;
                    }
                }
                "item" => part.items.push(component(&element)?),
                name => {
                    if let Some((id, object)) = &mut current {
                        refuse_element(name, &element, object.name.as_deref().unwrap_or(id))?;
                        object.read(name, &element)?;
                    }
                }
            },
            Event::End(element) if element.local_name().as_ref() == "object" => part.store(current.take())?,
            Event::Eof => break,
            _ => {}
        }
    }
    Ok(part)
}

impl PackagePart {
    /// Takes over an object with its id.
    ///
    /// # Errors
    /// [`nurbs_hausdorff::Error::MeshSyntax`] for a second object of an id: places name objects by it.
    fn store(&mut self, found: Option<(String, Object)>) -> Result<()> {
        let Some((id, object)) = found else { return Ok(()) };
        match self.objects.entry(id) {
            Entry::Vacant(place) => {
                place.insert(object);
                Ok(())
            }
            Entry::Occupied(place) => {
                Err(FORMAT.syntax(format!("two objects with the id {:?}", place.key())))
            }
        }
    }
}

impl Object {
    /// Takes over what an element within an object states.
    fn read(&mut self, name: &str, element: &BytesStart<'_>) -> Result<()> {
        match name {
            "vertex" => self.vertices.push(DVec3::from_array(numbers(element, ["x", "y", "z"])?)),
            "triangle" => self.triangles.push(numbers(element, ["v1", "v2", "v3"])?),
            "component" => self.components.push(component(element)?),
            _ => {}
        }
        Ok(())
    }
}

fn component(element: &BytesStart<'_>) -> Result<Component> {
    let object = attribute(element, "objectid")?.ok_or_else(|| FORMAT.syntax("an item without objectid"))?;
    let path = attribute(element, "path")?.map(|path| part_name(&path));
    let transform =
        attribute(element, "transform")?.map_or(Ok(DAffine3::IDENTITY), |text| transform(&text))?;
    Ok(Component { path, object, transform })
}

/// Returns the affine map of twelve numbers: the images of the axes, then the translation.
fn transform(text: &str) -> Result<DAffine3> {
    let numbers: Vec<f64> = text.split_ascii_whitespace().map_while(|word| word.parse().ok()).collect();
    let columns: [f64; 12] = numbers
        .try_into()
        .map_err(|_| FORMAT.syntax(format!("the transform {text:?}, expected 12 numbers")))?;
    let [a, b, c, d] = [0, 3, 6, 9].map(|k| DVec3::new(columns[k], columns[k + 1], columns[k + 2]));
    Ok(DAffine3::from_mat3_translation(DMat3::from_cols(a, b, c), d))
}

/// Returns an attribute by its name without its namespace, with its entities replaced by what they stand for.
fn attribute(element: &BytesStart<'_>, name: &str) -> Result<Option<String>> {
    for found in element.attributes() {
        let found = found.map_err(|error| FORMAT.syntax(error.to_string()))?;
        if found.key.local_name().as_ref() == name {
            let value = found.normalized_value(XmlVersion::Implicit1_0);
            return Ok(Some(value.map_err(|error| FORMAT.syntax(error.to_string()))?.into_owned()));
        }
    }
    Ok(None)
}

fn numbers<T: std::str::FromStr + Copy, const N: usize>(
    element: &BytesStart<'_>,
    names: [&str; N],
) -> Result<[T; N]> {
    let mut found: [Option<T>; N] = [None; N];
    for (number, name) in found.iter_mut().zip(names) {
        *number = attribute(element, name)?.and_then(|text| text.trim().parse().ok());
    }
    let numbers: Vec<T> = found.into_iter().flatten().collect();
    let position = names.join(", ");
    numbers.try_into().map_err(|_| FORMAT.syntax(format!("an element without the numbers {position}")))
}

/// Returns the metres of a unit; millimetres if none is stated.
fn unit(name: Option<&str>) -> Result<f64> {
    Ok(match name {
        None | Some("millimeter") => 1e-3,
        Some("micron") => 1e-6,
        Some("centimeter") => 1e-2,
        Some("inch") => 0.0254,
        Some("foot") => 0.3048,
        Some("meter") => 1.0,
        Some(other) => return Err(FORMAT.syntax(format!("the unit {other:?}"))),
    })
}
