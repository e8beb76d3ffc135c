//! Extensions of 3MF: those that do not change the shape, and the refusal of the others by name.

use super::{FORMAT, attribute};
use nurbs_hausdorff::Result;
use quick_xml::events::BytesStart;

/// The namespaces of extensions that may be required: parts in several files, materials, and sets of
/// triangles.
const READ: [&str; 3] = [
    "http://schemas.microsoft.com/3dmanufacturing/production/2015/06",
    "http://schemas.microsoft.com/3dmanufacturing/material/2015/02",
    "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07",
];

/// The elements of objects whose shape is not that of their triangles.
const SHAPES: [(&str, &str); 4] = [
    ("beamlattice", "a beam lattice"),
    ("booleanshape", "a shape of boolean operations"),
    ("displacementmesh", "a mesh with displacements"),
    ("levelset", "a level set of a function"),
];

/// The attribute that gives an object the slices of its shape.
const SLICES: &str = "slicestackid";

/// Refuses a model that requires an extension that is not read.
///
/// # Errors
/// [`nurbs_hausdorff::Error::MeshSyntax`] with its namespace.
pub(super) fn refuse_required(model: &BytesStart<'_>) -> Result<()> {
    let Some(required) = attribute(model, "requiredextensions")? else { return Ok(()) };
    for prefix in required.split_ascii_whitespace() {
        // The prefix stands for the namespace that it is declared for.
        let namespace = attribute(model, prefix)?.unwrap_or_else(|| prefix.to_owned());
        if !READ.contains(&namespace.as_str()) {
            let shown: String = namespace.chars().take(100).collect();
            return Err(
                FORMAT.syntax(format!("the model requires the extension {shown:?}, which is not read"))
            );
        }
    }
    Ok(())
}

/// Refuses an element that gives an object a shape which is not that of its triangles.
///
/// # Errors
/// [`nurbs_hausdorff::Error::MeshSyntax`] with the name of the object.
pub(super) fn refuse_element(name: &str, element: &BytesStart<'_>, object: &str) -> Result<()> {
    let shape = SHAPES.iter().find(|(shape, _)| *shape == name).map(|(_, shape)| *shape);
    let sliced = || Ok(attribute(element, SLICES)?.map(|_| "slices"));
    let shape = if name == "object" { sliced()? } else { shape };
    match shape {
        Some(shape) => Err(FORMAT.syntax(format!("object {object:?} has {shape}, expected triangles alone"))),
        None => Ok(()),
    }
}
