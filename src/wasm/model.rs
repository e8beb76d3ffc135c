//! The class of models.

use super::convert;
use super::failure::to_object;
use super::surfaces::Surfaces;
use crate::area::Area;
use crate::engine;
use crate::engine::BodyInfo;
use crate::error::{Error, Result};
use crate::facets::{Facets, MeshGroup, PointCloud, TriangleMesh};
use crate::model::Model;
use crate::read::{Assembled, ReadReport, into_model};
use crate::shapes::{list, shape};
use crate::tessellate::{draft, tessellate_patches};
use crate::threads::parallel::Watch;
use crate::untrim::Untrimmed;
use glam::DVec3;
use js_sys::{Function, JsString};
use serde::Serialize;
use std::rc::Rc;
use wasm_bindgen::prelude::*;

/// The largest integer up to which JavaScript's numbers hold every one; a larger number of a
/// face in its file is left out of the report.
const MAX_SAFE_INTEGER: u64 = (1 << 53) - 1;

/// A model ready to be measured, shared with the distances that use it, and the report
/// on reading it from a text.
#[wasm_bindgen]
pub struct PreparedModel {
    /// The model itself, for updates; none of a mesh or a cloud of points.
    source: Option<Rc<Model>>,
    prepared: Rc<engine::PreparedModel>,
    /// The report on reading it from a text.
    report: Option<ReadReport>,
}

#[wasm_bindgen]
impl PreparedModel {
    #[wasm_bindgen(js_name = fromArrays)]
    pub fn from_arrays(surfaces: Surfaces) -> Result<PreparedModel> {
        Self::new(Model::from_faces(surfaces.into_inner())?, None)
    }

    /// A mesh of positions, x, y, z each, and triangles, three indices each, or without triangles
    /// a cloud of points; in metres per unit, if that is known. `counts` are the numbers of triangles of the
    /// groups, `names` their names; an empty name stands for none. Without counts the mesh is one group.
    /// `gap` is the distance from the surface that the triangles stand for, 0 if it is left out.
    #[wasm_bindgen(js_name = fromFacets)]
    pub fn from_facets(
        positions: Vec<f64>,
        triangles: Option<Vec<u32>>,
        unit: Option<f64>,
        counts: Option<Vec<u32>>,
        names: Option<Vec<String>>,
        gap: Option<f64>,
    ) -> Result<PreparedModel> {
        let (points, rest) = positions.as_chunks();
        if !rest.is_empty() {
            return Err(Error::PointOutOfRange { index: points.len(), found: f64::NAN });
        }
        let points: Vec<DVec3> = points.iter().copied().map(DVec3::from_array).collect();
        let facets = match triangles {
            Some(indices) => {
                let mesh = TriangleMesh::of_indices(&points, &indices)?.with_gap(gap.unwrap_or(0.0))?;
                Facets::Mesh(match counts {
                    Some(counts) => mesh.with_groups(groups(&counts, names.unwrap_or_default()))?,
                    None => mesh,
                })
            }
            None => Facets::Cloud(PointCloud::new(points)?),
        };
        let prepared = engine::PreparedModel::of_facets(&facets, unit)?;
        Ok(Self { source: None, prepared: Rc::new(prepared), report: None })
    }

    /// A model of interchange JSON; a unit that the text states comes before this one.
    #[wasm_bindgen(js_name = fromJson)]
    pub fn from_json(text: &JsString, unit: Option<f64>) -> Result<PreparedModel> {
        let model = json_model(text, unit)?;
        let report = ReadReport::of_exact(&model);
        Self::new(model, Some(report))
    }

    /// A model of what the readers' module gave; undefined is an unknown name or unit, and a
    /// unit that the file states comes before this one. The function, if any, is called for every
    /// face that was cut with the part of the faces that is cut and the face's triangles.
    #[wasm_bindgen(js_name = fromRead)]
    pub fn from_read(
        bytes: &[u8],
        name: Option<String>,
        unit: Option<f64>,
        on_face: Option<Function>,
    ) -> std::result::Result<PreparedModel, JsValue> {
        let (model, report) = read_model(bytes, name, unit)?;
        let Some(on_face) = on_face else { return Ok(Self::of_file((model, report), None)?) };
        let (count, mut thrown) = (model.faces().len(), None);
        let mut tell = |index: usize, cut: &Result<Untrimmed>| {
            let Ok(face) = cut else { return };
            let part = JsValue::from((index + 1) as f64 / count as f64);
            let drawn = draft(face).map_err(JsValue::from).and_then(|face| convert::tessellation(&face));
            if thrown.is_none() {
                thrown = drawn.and_then(|face| on_face.call2(&JsValue::UNDEFINED, &part, &face)).err();
            }
        };
        let prepared = Self::of_file((model, report), Some(&mut tell))?;
        thrown.map_or(Ok(prepared), Err)
    }

    /// The report on reading the text, or undefined.
    #[wasm_bindgen(getter)]
    pub fn report(&self) -> std::result::Result<JsValue, JsValue> {
        self.report.as_ref().map_or(Ok(JsValue::UNDEFINED), to_object)
    }

    /// The model as interchange JSON, from which [`Self::from_json`] makes an equal one; undefined of a mesh, a cloud
    /// of points, and a model whose text would be too long for it.
    #[wasm_bindgen(js_name = toJson)]
    pub fn to_json(&self) -> Result<Option<String>> {
        let Some(source) = &self.source else { return Ok(None) };
        Ok(Some(source.to_json()?).filter(|json| json.len() as u64 <= Model::MAX_JSON_BYTES))
    }

    /// The model as it is now, whatever becomes of this one.
    pub fn held(&self) -> PreparedModel {
        Self { source: self.source.clone(), prepared: self.inner(), report: None }
    }

    /// `{json, report}` of what the readers' module gave, as [`Self::from_read`].
    #[wasm_bindgen(js_name = readToJson)]
    pub fn read_to_json(
        bytes: &[u8],
        name: Option<String>,
        unit: Option<f64>,
    ) -> std::result::Result<JsValue, JsValue> {
        interchange(read_model(bytes, name, unit)?)
    }

    /// A model of interchange JSON that a reader made: faces that are refused are in the
    /// report, by their index.
    #[wasm_bindgen(js_name = fromReader)]
    pub fn from_reader(text: &JsString) -> Result<PreparedModel> {
        Self::of_file(reader_model(text)?, None)
    }

    /// `{json, report}` of interchange JSON that a reader made, as [`Self::from_reader`].
    #[wasm_bindgen(js_name = readerToJson)]
    pub fn reader_to_json(text: &JsString) -> std::result::Result<JsValue, JsValue> {
        interchange(reader_model(text)?)
    }

    /// `{json, report}` of interchange JSON, validated and written anew, as [`Self::from_json`].
    #[wasm_bindgen(js_name = jsonToJson)]
    pub fn json_to_json(text: &JsString, unit: Option<f64>) -> std::result::Result<JsValue, JsValue> {
        let model = json_model(text, unit)?;
        to_object(&Interchange { json: model.to_json()?, report: ReadReport::of_exact(&model) })
    }

    /// One of [`shapes`].
    pub fn shape(name: &str) -> Result<PreparedModel> {
        Self::new(shape(name)?, None)
    }

    #[wasm_bindgen(getter)]
    pub fn name(&self) -> Option<String> {
        self.prepared.name().map(str::to_owned)
    }

    /// Metres per unit.
    #[wasm_bindgen(getter)]
    pub fn unit(&self) -> Option<f64> {
        self.prepared.unit()
    }

    #[wasm_bindgen(getter)]
    pub fn gap(&self) -> f64 {
        self.prepared.gap()
    }

    /// Whether the gap is an upper bound.
    #[wasm_bindgen(getter, js_name = gapProven)]
    pub fn is_gap_proven(&self) -> bool {
        self.prepared.is_gap_proven()
    }

    /// The name of a face, below [`Self::face_count`].
    #[wasm_bindgen(js_name = faceName)]
    pub fn face_name(&self, face: usize) -> Option<String> {
        if face < self.prepared.face_count() {
            self.prepared.face_name(face).map(str::to_owned)
        } else {
            None
        }
    }

    /// Red, green and blue of a face; empty without a colour.
    #[wasm_bindgen(js_name = faceColor)]
    pub fn face_color(&self, face: usize) -> Vec<f64> {
        self.prepared.face_color(face).map_or_else(Vec::new, |color| color.to_vec())
    }

    #[wasm_bindgen(getter, js_name = faceCount)]
    pub fn face_count(&self) -> usize {
        self.prepared.face_count()
    }

    /// The smallest x, y, z, then the largest.
    #[wasm_bindgen(getter, js_name = boundingBox)]
    pub fn bounding_box(&self) -> Vec<f64> {
        let aabb = self.prepared.bounding_box();
        [aabb.min.to_array(), aabb.max.to_array()].concat()
    }

    /// Replaces the control points of a face's surface, x, y, z, w each; distances that are
    /// being computed keep the old ones.
    pub fn update(&mut self, face: usize, control_points: Vec<f64>) -> Result<()> {
        let (points, _) = control_points.as_chunks();
        let found = "a change of control points";
        let source = self.source.as_ref().ok_or(Error::FacetsUnsupported { found })?;
        let source = source.with_control_points(face, points.to_vec())?;
        self.prepared = Rc::new(self.prepared.updated(&source)?);
        self.source = Some(Rc::new(source));
        Ok(())
    }

    /// `{lower, upper, faces}`: the area and those of the faces.
    pub fn area(&self) -> std::result::Result<JsValue, JsValue> {
        to_object(&ModelArea { sum: self.prepared.area(), faces: self.prepared.face_areas() })
    }

    /// Whether the faces close, the shells and the free edges.
    pub fn solid(&self) -> std::result::Result<JsValue, JsValue> {
        to_object(&self.prepared.solid())
    }

    /// The elementary surfaces that the faces lie on; null for other surfaces.
    #[wasm_bindgen(js_name = faceForms)]
    pub fn face_forms(&self) -> std::result::Result<JsValue, JsValue> {
        to_object(&self.prepared.face_forms())
    }

    /// Volume, area, extents and the like as intervals.
    pub fn facts(&self) -> std::result::Result<JsValue, JsValue> {
        to_object(self.prepared.facts())
    }

    /// The bodies with their facts.
    pub fn bodies(&self) -> std::result::Result<JsValue, JsValue> {
        to_object(&BodyInfo::of(&self.prepared))
    }

    /// Triangles to display, by a plain object of options.
    pub fn tessellate(&self, options: &JsValue) -> std::result::Result<JsValue, JsValue> {
        self.prepared.require_surfaces("a tessellation")?;
        let options = convert::tessellation_options(options)?;
        convert::tessellation(&tessellate_patches(self.prepared.bezier(), self.prepared.pieces(), &options)?)
    }
}

impl PreparedModel {
    /// Makes the model of a file without the faces that cannot be cut.
    fn of_file(
        (model, mut report): (Model, ReadReport),
        watch: Watch<'_, Result<Untrimmed>>,
    ) -> Result<Self> {
        let (source, prepared) = engine::PreparedModel::new_watched(model, &mut report, watch)?;
        Ok(Self { prepared: Rc::new(prepared), source: Some(Rc::new(source)), report: Some(report) })
    }

    fn new(source: Model, report: Option<ReadReport>) -> Result<Self> {
        let prepared = Rc::new(engine::PreparedModel::new(&source)?);
        Ok(Self { prepared, source: Some(Rc::new(source)), report })
    }

    pub(super) fn inner(&self) -> Rc<engine::PreparedModel> {
        Rc::clone(&self.prepared)
    }
}

/// The models of a check with the levels above the names of their bodies.
#[wasm_bindgen]
#[derive(Default)]
pub struct NamedModels(Vec<(Option<String>, Rc<engine::PreparedModel>)>);

#[wasm_bindgen]
impl NamedModels {
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    pub fn add(&mut self, model: &PreparedModel, name: Option<String>) {
        self.0.push((name, model.inner()));
    }
}

impl NamedModels {
    pub(super) fn named(&self) -> Vec<engine::NamedModel<'_>> {
        self.0.iter().map(|(name, model)| engine::NamedModel { name: name.as_deref(), model }).collect()
    }
}

/// The area of a model with those of its faces.
#[derive(Serialize)]
struct ModelArea<'a> {
    #[serde(flatten)]
    sum: Area,
    faces: &'a [Area],
}

/// A model's interchange JSON, and the report on reading it.
#[derive(Serialize)]
struct Interchange {
    json: String,
    report: ReadReport,
}

/// The interchange JSON of what was read, without the faces that cannot be cut.
fn interchange((model, mut report): (Model, ReadReport)) -> std::result::Result<JsValue, JsValue> {
    let (model, _) = engine::PreparedModel::new_skipping(model, &mut report)?;
    to_object(&Interchange { json: model.to_json()?, report })
}

/// Returns groups of these numbers of triangles. An empty name stands for none.
fn groups(counts: &[u32], names: Vec<String>) -> Vec<MeshGroup> {
    let names = names.into_iter().map(|name| Some(name).filter(|name| !name.is_empty()));
    let names = names.chain(std::iter::repeat(None));
    counts.iter().zip(names).map(|(&count, name)| MeshGroup { name, triangles: count as usize }).collect()
}

/// A text of JavaScript. No text has fewer bytes than characters: one over the limit is
/// not copied into the module's memory.
fn checked(text: &JsString) -> Result<String> {
    let found = u64::from(text.length());
    if found > Model::MAX_JSON_BYTES {
        return Err(Error::FileTooLarge { found, expected: Model::MAX_JSON_BYTES });
    }
    Ok(String::from(text))
}

fn read_model(bytes: &[u8], name: Option<String>, unit: Option<f64>) -> Result<(Model, ReadReport)> {
    let mut read = Assembled::from_bytes(bytes)?;
    read.model.name = name;
    read.model.unit = read.model.unit.or(unit);
    let (model, mut report) = into_model(read)?;
    for skipped in &mut report.skipped {
        skipped.entity = skipped.entity.filter(|&entity| entity <= MAX_SAFE_INTEGER);
    }
    Ok((model, report))
}

fn reader_model(text: &JsString) -> Result<(Model, ReadReport)> {
    into_model(Assembled::of_exact(Model::arrays_of_json(&checked(text)?)?))
}

/// The shapes that the crate makes, each with its name and title.
#[wasm_bindgen]
pub fn shapes() -> std::result::Result<JsValue, JsValue> {
    to_object(&list().collect::<Vec<_>>())
}

fn json_model(text: &JsString, unit: Option<f64>) -> Result<Model> {
    let model = Model::from_json(&checked(text)?)?;
    match unit.filter(|_| model.unit().is_none()) {
        Some(metres) => model.with_unit(metres),
        None => Ok(model),
    }
}
