//! glTF 2.0 with embedded buffers, and GLB.

use super::scene::{MAX_DEPTH, place};
use super::{MeshFormat, Soup};
use crate::error::{Error, Result};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use glam::{DAffine3, DMat4, DQuat, DVec3};
use serde::Deserialize;
use std::borrow::Cow;

const FORMAT: MeshFormat = MeshFormat::Gltf;

/// The component type of float32 numbers.
const FLOAT: u32 = 5126;

/// The parts of the JSON that place triangles. Fields that are not named are left unread.
#[derive(Deserialize, Default)]
#[serde(rename_all = "camelCase", default)]
struct Root {
    scene: Option<usize>,
    scenes: Vec<Scene>,
    nodes: Vec<Node>,
    meshes: Vec<Mesh>,
    accessors: Vec<Accessor>,
    buffer_views: Vec<View>,
    buffers: Vec<Buffer>,
    extensions_required: Vec<String>,
}

#[derive(Deserialize)]
struct Scene {
    #[serde(default)]
    nodes: Vec<usize>,
}

#[derive(Deserialize)]
struct Node {
    name: Option<String>,
    mesh: Option<usize>,
    #[serde(default)]
    children: Vec<usize>,
    matrix: Option<[f64; 16]>,
    translation: Option<[f64; 3]>,
    rotation: Option<[f64; 4]>,
    scale: Option<[f64; 3]>,
}

#[derive(Deserialize)]
struct Mesh {
    name: Option<String>,
    primitives: Vec<Primitive>,
}

#[derive(Deserialize)]
struct Primitive {
    attributes: Attributes,
    indices: Option<usize>,
    #[serde(default = "triangles")]
    mode: u32,
}

#[derive(Deserialize)]
struct Attributes {
    #[serde(rename = "POSITION")]
    position: Option<usize>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Accessor {
    buffer_view: Option<usize>,
    #[serde(default)]
    byte_offset: usize,
    component_type: u32,
    count: usize,
    #[serde(rename = "type")]
    kind: String,
    sparse: Option<serde::de::IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct View {
    buffer: usize,
    #[serde(default)]
    byte_offset: usize,
    byte_length: usize,
    byte_stride: Option<usize>,
}

#[derive(Deserialize)]
struct Buffer {
    uri: Option<String>,
}

/// The mode of primitives that are lists of triangles, which is the default.
const TRIANGLES: u32 = 4;

fn triangles() -> u32 {
    TRIANGLES
}

/// A file with the bytes of its buffers.
struct File<'a> {
    root: Root,
    buffers: Vec<Cow<'a, [u8]>>,
}

pub(super) fn read(bytes: &[u8]) -> Result<Soup> {
    let (json, binary) = chunks(bytes)?;
    let root: Root = serde_json::from_slice(json).map_err(|error| FORMAT.syntax(error.to_string()))?;
    if let Some(name) = root.extensions_required.iter().find(|name| !is_only_appearance(name)) {
        return Err(FORMAT.syntax(format!("the extension {name:?}, which is not read")));
    }
    let mut buffers = Vec::with_capacity(root.buffers.len());
    for buffer in &root.buffers {
        buffers.push(match &buffer.uri {
            None => Cow::Borrowed(binary),
            Some(uri) => Cow::Owned(decoded(uri)?),
        });
    }
    let file = File { root, buffers };
    let mut soup = Soup { unit: Some(1.0), ..Soup::default() };
    let scenes = &file.root.scenes;
    let roots = match scenes.get(file.root.scene.unwrap_or(0)) {
        Some(scene) => scene.nodes.clone(),
        // A file without scenes is a library of meshes: all its nodes that are nobody's children.
        None => {
            let is_child = |node: &usize| file.root.nodes.iter().any(|other| other.children.contains(node));
            (0..file.root.nodes.len()).filter(|node| !is_child(node)).collect()
        }
    };
    for node in roots {
        file.place_node(node, &DAffine3::IDENTITY, 0, &mut soup)?;
    }
    Ok(soup)
}

/// Extensions that change neither the shape nor how it is stored.
fn is_only_appearance(name: &str) -> bool {
    name.starts_with("KHR_materials_") || name == "KHR_texture_transform" || name == "KHR_lights_punctual"
}

/// Returns the JSON of a file and the binary chunk of a GLB.
fn chunks(bytes: &[u8]) -> Result<(&[u8], &[u8])> {
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes, &[]));
    }
    let mut rest = bytes.get(12..).unwrap_or(&[]);
    let mut found: [&[u8]; 2] = [&[], &[]];
    for chunk in &mut found {
        let [a, b, c, d, _, _, _, _, after @ ..] = rest else { break };
        let length = u32::from_le_bytes([*a, *b, *c, *d]) as usize;
        *chunk = after.get(..length).ok_or_else(|| FORMAT.syntax("a chunk that is longer than the file"))?;
        rest = &after[length..];
    }
    Ok(found.into())
}

/// Returns the bytes of a data URI.
fn decoded(uri: &str) -> Result<Vec<u8>> {
    let data = uri.strip_prefix("data:").and_then(|data| data.split_once(";base64,"));
    let Some((_, data)) = data else {
        return Err(FORMAT.syntax("a buffer in another file: only GLB and embedded buffers are read"));
    };
    STANDARD.decode(data).map_err(|error| FORMAT.syntax(error.to_string()))
}

impl File<'_> {
    fn place_node(&self, node: usize, parent: &DAffine3, depth: usize, soup: &mut Soup) -> Result<()> {
        if depth > MAX_DEPTH {
            return Err(FORMAT.syntax(format!("a scene of more than {MAX_DEPTH} levels")));
        }
        let node = self.root.nodes.get(node).ok_or_else(|| missing("node", node))?;
        let transform = *parent * node.transform();
        if let Some(mesh) = node.mesh {
            let mesh = self.root.meshes.get(mesh).ok_or_else(|| missing("mesh", mesh))?;
            let name = node.name.as_deref().or(mesh.name.as_deref());
            for primitive in &mesh.primitives {
                self.place_primitive(primitive, name, &transform, soup)?;
            }
        }
        for &child in &node.children {
            self.place_node(child, &transform, depth + 1, soup)?;
        }
        Ok(())
    }

    fn place_primitive(
        &self,
        primitive: &Primitive,
        name: Option<&str>,
        transform: &DAffine3,
        soup: &mut Soup,
    ) -> Result<()> {
        let Some(position) = primitive.attributes.position else { return Ok(()) };
        let number = |bytes: &[u8]| match bytes {
            &[a, b, c, d, ..] => f64::from(f32::from_le_bytes([a, b, c, d])),
            _ => f64::NAN,
        };
        let point = |bytes: &[u8]| DVec3::new(number(bytes), number(&bytes[4..]), number(&bytes[8..]));
        let vertices: Vec<DVec3> = self.items(position, "VEC3", FLOAT)?.map(point).collect();
        let indices: Vec<u32> = match primitive.indices {
            None => (0..vertices.len() as u32).collect(),
            Some(indices) => {
                let kind = self.root.accessors.get(indices).map_or(0, |accessor| accessor.component_type);
                let index = |bytes: &[u8]| match (kind, bytes) {
                    (5121, &[a, ..]) => u32::from(a),
                    (5123, &[a, b, ..]) => u32::from(u16::from_le_bytes([a, b])),
                    (5125, &[a, b, c, d, ..]) => u32::from_le_bytes([a, b, c, d]),
                    _ => u32::MAX,
                };
                self.items(indices, "SCALAR", kind)?.map(index).collect()
            }
        };
        place(soup, name, &vertices, &faces(&indices, primitive.mode)?, transform, FORMAT)
    }

    /// Returns the bytes of each item of an accessor.
    fn items(&self, index: usize, kind: &str, component: u32) -> Result<impl Iterator<Item = &[u8]>> {
        let accessor = self.root.accessors.get(index).ok_or_else(|| missing("accessor", index))?;
        if accessor.kind != kind || accessor.component_type != component || accessor.sparse.is_some() {
            return Err(FORMAT
                .syntax(format!("accessor {index} is sparse or not of the kind {kind}, which is not read")));
        }
        let width = match component {
            5120 | 5121 => 1,
            5122 | 5123 => 2,
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

impl Node {
    fn transform(&self) -> DAffine3 {
        if let Some(matrix) = &self.matrix {
            return DAffine3::from_mat4(DMat4::from_cols_array(matrix));
        }
        DAffine3::from_scale_rotation_translation(
            self.scale.map_or(DVec3::ONE, DVec3::from_array),
            self.rotation.map_or(DQuat::IDENTITY, |rotation| DQuat::from_array(rotation).normalize()),
            self.translation.map_or(DVec3::ZERO, DVec3::from_array),
        )
    }
}

/// Returns the triangles of a primitive; points and lines have none.
fn faces(indices: &[u32], mode: u32) -> Result<Vec<[u32; 3]>> {
    Ok(match mode {
        0..=3 => Vec::new(),
        TRIANGLES => indices.chunks_exact(3).map(|corner| [corner[0], corner[1], corner[2]]).collect(),
        5 => indices.windows(3).map(|corner| [corner[0], corner[1], corner[2]]).collect(),
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
