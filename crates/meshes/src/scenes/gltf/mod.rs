//! glTF 2.0 and GLB, with buffers embedded or in files beside it.

mod buffers;
mod json;

use super::Scene;
use crate::soup::strip;
use crate::{Beside, MeshFormat, Soup};
use buffers::{buffers, chunks};
use glam::{DAffine3, DVec3};
use json::{Mesh, Node, Primitive, Root, TRIANGLES};
use nurbs_hausdorff::{Error, Result};
use std::borrow::Cow;
use std::collections::HashSet;

pub(crate) use buffers::names_beside;

const FORMAT: MeshFormat = MeshFormat::Gltf;

/// The component type of float32 numbers.
const FLOAT: u32 = 5126;

/// The component types of indices, which have no sign.
const BYTE: u32 = 5121;
const SHORT: u32 = 5123;
const INT: u32 = 5125;

/// The extension that places a mesh at many places of a node.
const INSTANCING: &str = "EXT_mesh_gpu_instancing";

/// A file with the bytes of its buffers.
struct File<'a> {
    root: Root,
    buffers: Vec<Cow<'a, [u8]>>,
}

/// Reads the triangles of the scene, at the places of its nodes. Skins, weights of morph targets, points and lines
/// are not measured, and are named.
///
/// # Errors
/// [`Error::MeshSyntax`]; also of extensions that change the shape, and of buffers that are missing.
pub(crate) fn read(bytes: &[u8], beside: &Beside) -> Result<Soup> {
    let (json, binary) = chunks(bytes)?;
    let root: Root = serde_json::from_slice(json).map_err(|error| FORMAT.syntax(error.to_string()))?;
    if let Some(name) = root.extensions_required.iter().find(|name| !is_only_appearance(name)) {
        return Err(FORMAT.syntax(format!("the extension {name:?}, which is not read")));
    }
    let buffers = buffers(&root, binary, beside)?;
    let file = File { root, buffers };
    let mut scene = Scene::new(FORMAT, 1.0);
    if file.root.extensions_used.iter().any(|name| name == INSTANCING) {
        scene.soup.skip(INSTANCING, "the instances of meshes by this extension are not read");
    }
    let scenes = &file.root.scenes;
    let roots = match (scenes.get(file.root.scene.unwrap_or(0)), file.root.scene) {
        (Some(scene), _) => scene.nodes.clone(),
        (None, Some(stated)) => return Err(missing("scene", stated)),
        // A file without scenes is a library of meshes: all its nodes that are nobody's children.
        (None, None) => {
            let mut is_child = vec![false; file.root.nodes.len()];
            for &child in file.root.nodes.iter().flat_map(|node| &node.children) {
                if let Some(is_child) = is_child.get_mut(child) {
                    *is_child = true;
                }
            }
            (0..file.root.nodes.len()).filter(|&node| !is_child[node]).collect()
        }
    };
    if scenes.len() > 1 {
        let others = scenes.len() - 1;
        scene.soup.note("scenes", format!("{others} scenes besides the first or default one are not shown"));
    }
    // Those of other scenes are named with these.
    let of_scenes = scenes.iter().flat_map(|scene| &scene.nodes).chain(&roots).copied();
    file.note_unplaced(&file.below(of_scenes.collect()), &mut scene.soup);
    for node in roots {
        file.place_node(node, &DAffine3::IDENTITY, 0, &mut scene)?;
    }
    Ok(scene.soup)
}

/// Extensions that change neither the shape nor how it is stored.
fn is_only_appearance(name: &str) -> bool {
    name.starts_with("KHR_materials_") || name == "KHR_texture_transform" || name == "KHR_lights_punctual"
}

impl File<'_> {
    /// Returns these nodes and those below them.
    fn below(&self, mut pending: Vec<usize>) -> HashSet<usize> {
        let mut met = HashSet::new();
        while let Some(index) = pending.pop() {
            if let Some(node) = self.root.nodes.get(index).filter(|_| met.insert(index)) {
                pending.extend(&node.children);
            }
        }
        met
    }

    /// Notes the meshes that none of these nodes has, and the other nodes with meshes that one of these has.
    fn note_unplaced(&self, placed: &HashSet<usize>, soup: &mut Soup) {
        let Root { nodes, meshes, .. } = &self.root;
        let mesh_of = |index: &usize| nodes[*index].mesh.filter(|&mesh| mesh < meshes.len());
        let shown: HashSet<usize> = placed.iter().filter_map(mesh_of).collect();
        let unplaced = meshes.len() - shown.len();
        if unplaced > 0 {
            soup.note("meshes", format!("{unplaced} meshes that no node of the scene has are not shown"));
        }
        let is_shown_elsewhere = |index: &usize| mesh_of(index).is_some_and(|mesh| shown.contains(&mesh));
        let others =
            (0..nodes.len()).filter(|index| !placed.contains(index)).filter(is_shown_elsewhere).count();
        if others > 0 {
            soup.note("nodes", format!("{others} nodes with meshes that no scene has are not shown"));
        }
    }

    fn place_node(&self, node: usize, parent: &DAffine3, depth: usize, scene: &mut Scene) -> Result<()> {
        scene.enter(depth)?;
        let node = self.root.nodes.get(node).ok_or_else(|| missing("node", node))?;
        let transform = *parent * node.transform();
        if let Some(mesh) = node.mesh {
            let mesh = self.root.meshes.get(mesh).ok_or_else(|| missing("mesh", mesh))?;
            let name = node.name.as_deref().or(mesh.name.as_deref());
            note_pose(node, mesh, name.unwrap_or("a node"), &mut scene.soup);
            for primitive in &mesh.primitives {
                self.place_primitive(primitive, name, &transform, scene)?;
            }
        }
        for &child in &node.children {
            self.place_node(child, &transform, depth + 1, scene)?;
        }
        Ok(())
    }

    fn place_primitive(
        &self,
        primitive: &Primitive,
        name: Option<&str>,
        transform: &DAffine3,
        scene: &mut Scene,
    ) -> Result<()> {
        if primitive.mode < TRIANGLES {
            scene.soup.note(name.unwrap_or("a node"), "its points or lines are no surface");
            return Ok(());
        }
        let Some(position) = primitive.attributes.position else {
            let name = name.unwrap_or("a node");
            match primitive.extensions {
                Some(_) => scene.soup.skip(name, "its positions, which an extension may state, are not read"),
                None => scene.soup.note(name, "a primitive without positions is no surface"),
            }
            return Ok(());
        };
        let number = |bytes: &[u8]| match bytes {
            &[a, b, c, d, ..] => f64::from(f32::from_le_bytes([a, b, c, d])),
            _ => f64::NAN,
        };
        let point = |bytes: &[u8]| DVec3::new(number(bytes), number(&bytes[4..]), number(&bytes[8..]));
        let vertices: Vec<DVec3> = self.items(position, "VEC3", FLOAT)?.map(point).collect();
        let indices: Vec<u32> = match primitive.indices {
            None => (0..vertices.len() as u32).collect(),
            Some(indices) => {
                let kind = self.root.accessors.get(indices).map_or(BYTE, |accessor| accessor.component_type);
                if ![BYTE, SHORT, INT].contains(&kind) {
                    return Err(FORMAT.syntax(format!("indices of the component type {kind}")));
                }
                let index = |bytes: &[u8]| match (kind, bytes) {
                    (BYTE, &[a, ..]) => u32::from(a),
                    (SHORT, &[a, b, ..]) => u32::from(u16::from_le_bytes([a, b])),
                    (INT, &[a, b, c, d, ..]) => u32::from_le_bytes([a, b, c, d]),
                    _ => u32::MAX,
                };
                self.items(indices, "SCALAR", kind)?.map(index).collect()
            }
        };
        scene.place(name, &vertices, &faces(&indices, primitive.mode)?, transform)
    }

    /// Returns the bytes of each item of an accessor.
    fn items(&self, index: usize, kind: &str, component: u32) -> Result<impl Iterator<Item = &[u8]>> {
        let accessor = self.root.accessors.get(index).ok_or_else(|| missing("accessor", index))?;
        if accessor.kind != kind || accessor.component_type != component || accessor.sparse.is_some() {
            return Err(FORMAT
                .syntax(format!("accessor {index} is sparse or not of the kind {kind}, which is not read")));
        }
        let width = match component {
            5120 | BYTE => 1,
            5122 | SHORT => 2,
            _ => 4,
        };
        let size = width * if kind == "VEC3" { 3 } else { 1 };
        let view =
            accessor.buffer_view.ok_or_else(|| FORMAT.syntax(format!("accessor {index} has no data")))?;
        let view = self.root.buffer_views.get(view).ok_or_else(|| missing("buffer view", view))?;
        let buffer = self.buffers.get(view.buffer).ok_or_else(|| missing("buffer", view.buffer))?;
        let bytes = buffer
            .get(view.byte_offset..)
            .and_then(|bytes| bytes.get(..view.byte_length))
            .and_then(|bytes| bytes.get(accessor.byte_offset..));
        let stride = view.byte_stride.unwrap_or(size).max(size);
        let fits = |bytes: &&[u8]| {
            accessor.count == 0
                || (accessor.count - 1)
                    .checked_mul(stride)
                    .and_then(|start| start.checked_add(size))
                    .is_some_and(|length| length <= bytes.len())
        };
        let bytes = bytes
            .filter(fits)
            .ok_or_else(|| FORMAT.syntax(format!("accessor {index} reaches beyond its buffer")))?;
        Ok((0..accessor.count).map(move |item| &bytes[item * stride..item * stride + size]))
    }
}

/// Notes what poses a mesh differently from its positions and transforms.
fn note_pose(node: &Node, mesh: &Mesh, name: &str, soup: &mut Soup) {
    if node.skin.is_some() {
        soup.note(name, "its skin is not applied: it is measured as its node places it");
    }
    let weights = if node.weights.is_empty() { &mesh.weights } else { &node.weights };
    if weights.iter().any(|&weight| weight != 0.0) {
        soup.note(name, "its morph targets are not applied: it is measured without their weights");
    }
}

/// Returns the triangles of a primitive.
fn faces(indices: &[u32], mode: u32) -> Result<Vec<[u32; 3]>> {
    Ok(match mode {
        TRIANGLES if !indices.len().is_multiple_of(3) => {
            let found = indices.len();
            return Err(FORMAT.syntax(format!("triangles of {found} indices, expected a multiple of 3")));
        }
        TRIANGLES => indices.chunks_exact(3).map(|corner| [corner[0], corner[1], corner[2]]).collect(),
        5 => strip(indices).collect(),
        6 => match indices {
            [first, rest @ ..] => rest.windows(2).map(|pair| [*first, pair[0], pair[1]]).collect(),
            [] => Vec::new(),
        },
        _ => return Err(FORMAT.syntax(format!("a primitive of mode {mode}"))),
    })
}

fn missing(what: &str, index: usize) -> Error {
    FORMAT.syntax(format!("there is no {what} {index}"))
}
