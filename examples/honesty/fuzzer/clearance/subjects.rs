//! The models that are posed, with what the checks need of each.

use super::super::sheet::{Sheet, sheets};
use super::cloud::{Cloud, Sample};
use super::inside::Triangles;
use crate::proof;
use fastrand::Rng;
use glam::DVec3;
use nurbs_hausdorff::internals::engine::PreparedModel;
use nurbs_hausdorff::internals::untrim::untrim;
use nurbs_hausdorff::shapes::{list, shape};
use nurbs_hausdorff::{Model, NurbsSurface};
use nurbs_hausdorff_cad::from_step;
use std::path::Path;
use std::process::Command;
use std::sync::{Arc, OnceLock};

/// The deviation that trimmed faces are cut with for the checks, relative to the diagonal.
const MAX_DEVIATION: f64 = 1e-9;

/// About the number of samples of a model, and the least and largest along an axis of a surface.
const SAMPLES: f64 = 4000.0;
const SAMPLES_ALONG: [f64; 2] = [4.0, 40.0];

/// The distance from the triangles below which nothing is said of a side, relative to the diagonal.
const MARGIN: f64 = 0.02;

/// Shapes of the catalogue with more control points are left out, and parts with more control points
/// or faces.
const MAX_CONTROL_POINTS: usize = 2000;
const MAX_OF_PARTS: usize = 20_000;
const MAX_FACES: usize = 600;

/// A model with its samples.
pub(super) struct Subject {
    pub(super) name: String,
    pub(super) prepared: PreparedModel,
    pub(super) model: Model,
    /// The model's pieces, untrimmed.
    pub(super) plain: Model,
    /// The pieces relative to `origin`.
    pub(super) sheets: Vec<Sheet>,
    pub(super) origin: DVec3,
    pub(super) cloud: Cloud,
    triangles: Option<Triangles>,
    definition: OnceLock<proof::Model>,
}

impl Subject {
    /// Returns `None` for models that cannot be cut.
    pub(super) fn new(name: &str, model: Model) -> Option<Self> {
        let prepared = PreparedModel::new(&model).ok()?;
        let plain = pieces(&model)?;
        let origin = model.bounding_box().center();
        let sheets = sheets(&plain, origin);
        let along = (SAMPLES / sheets.len() as f64).sqrt().clamp(SAMPLES_ALONG[0], SAMPLES_ALONG[1]) as usize;
        let grids: Vec<Vec<Sample>> =
            sheets.iter().enumerate().map(|(index, sheet)| grid(index, sheet, along)).collect();
        let triangles = prepared.solid().closed.then(|| triangles(&model, &grids, along));
        let cloud = Cloud::new(grids.concat());
        let definition = OnceLock::new();
        Some(Self {
            name: name.to_owned(),
            prepared,
            model,
            plain,
            sheets,
            origin,
            cloud,
            triangles,
            definition,
        })
    }

    pub(super) fn deviation(&self) -> f64 {
        self.prepared.deviation()
            + if self.model.is_trimmed() {
                MAX_DEVIATION * self.prepared.bounding_box().diagonal()
            } else {
                0.0
            }
    }

    /// Returns the pieces as the proofs read them: by their definition, without the library.
    pub(super) fn definition(&self) -> &proof::Model {
        self.definition.get_or_init(|| proof::Model::from_json(&self.plain.to_json().unwrap()).unwrap())
    }

    /// Returns the largest coordinate.
    pub(super) fn largest(&self) -> f64 {
        let aabb = self.model.bounding_box();
        aabb.min.abs().max(aabb.max.abs()).max_element()
    }

    /// Returns a point of the faces.
    pub(super) fn any_point(&self, rng: &mut Rng) -> DVec3 {
        let samples = self.cloud.samples();
        samples[rng.usize(0..samples.len())].point + self.origin
    }

    /// Returns whether a point is inside the solid; `None` near its faces.
    pub(super) fn is_inside(&self, point: DVec3) -> Option<bool> {
        self.triangles.as_ref()?.contain(point - self.origin)
    }
}

/// Returns the triangles of an untrimmed model, relative to the middle of its box.
pub(crate) fn triangles_of(model: &Model) -> Triangles {
    let sheets = sheets(model, model.bounding_box().center());
    let along = (SAMPLES / sheets.len() as f64).sqrt().clamp(SAMPLES_ALONG[0], SAMPLES_ALONG[1]) as usize;
    let grids: Vec<Vec<Sample>> =
        sheets.iter().enumerate().map(|(index, sheet)| grid(index, sheet, along)).collect();
    triangles(model, &grids, along)
}

fn triangles(model: &Model, grids: &[Vec<Sample>], along: usize) -> Triangles {
    let of_grid = |grid: &Vec<Sample>| {
        let at = |i: usize, j: usize| grid[i * (along + 1) + j].point;
        let cells = (0..along).flat_map(|i| (0..along).map(move |j| [i, j]));
        let halves = |[i, j]: [usize; 2]| {
            let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)];
            [[a, b, c], [b, d, c]]
        };
        cells.flat_map(halves).collect::<Vec<_>>()
    };
    Triangles::new(grids.iter().flat_map(of_grid).collect(), MARGIN * model.bounding_box().diagonal())
}

/// Returns samples at evenly spaced parameters of a surface, its ends included.
fn grid(index: usize, sheet: &Sheet, along: usize) -> Vec<Sample> {
    let at = |k: usize| k as f64 / along as f64;
    let place = |i: usize, j: usize| {
        let parameters = sheet.at([at(i), at(j)]);
        Sample { sheet: index, parameters, point: sheet.point(parameters) }
    };
    (0..=along).flat_map(|i| (0..=along).map(move |j| (i, j))).map(|(i, j)| place(i, j)).collect()
}

/// Returns the pieces that the faces are cut into.
fn pieces(model: &Model) -> Option<Model> {
    let max_deviation = MAX_DEVIATION * model.bounding_box().diagonal();
    let mut surfaces: Vec<NurbsSurface> = Vec::new();
    for (index, face) in model.faces().enumerate() {
        match face.trim() {
            None => surfaces.push(face.surface().clone()),
            Some(trim) => {
                let cut = untrim(index, face.surface(), trim, max_deviation).ok()?;
                surfaces.extend(cut.pieces.into_iter().map(|piece| piece.surface));
            }
        }
    }
    Model::new(None, surfaces).ok()
}

/// All models that are posed.
pub(crate) struct Subjects(pub(super) Vec<Arc<Subject>>);

impl Subjects {
    /// Returns the shapes that ship, with the parts of `../shared/models` if these are asked for and
    /// the folder is there.
    pub(crate) fn new(with_parts: bool) -> Self {
        let shapes = list().map(|info| (info.name.to_owned(), shape(info.name).unwrap()));
        let small = shapes.filter(|(_, model)| control_points(model) <= MAX_CONTROL_POINTS);
        let parts = if with_parts { parts() } else { Vec::new() };
        let subject = |(name, model): (String, Model)| Subject::new(&name, model).map(Arc::new);
        Self(small.chain(parts).filter_map(subject).collect())
    }
}

fn control_points(model: &Model) -> usize {
    model.surfaces().iter().map(|surface| surface.control_points().len()).sum()
}

/// Returns the parts of `../shared/models`: STEP files, and JSON.
fn parts() -> Vec<(String, Model)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/models");
    let mut paths: Vec<_> = ["", "step", "so101"]
        .iter()
        .filter_map(|part| std::fs::read_dir(folder.join(part)).ok())
        .flatten()
        .map(|entry| entry.unwrap().path())
        .collect();
    paths.sort();
    let read = |path: &Path| {
        let name = path.file_name()?.to_string_lossy().into_owned();
        let lower = name.to_lowercase();
        let model = if lower.ends_with(".json") {
            Model::from_json(&std::fs::read_to_string(path).ok()?).ok()?
        } else if lower.ends_with(".step.gz") || lower.ends_with(".stp.gz") {
            let bytes = Command::new("gunzip").arg("-c").arg(path).output().ok()?.stdout;
            from_step(&bytes).ok()?.0
        } else {
            return None;
        };
        let is_small = model.faces().len() <= MAX_FACES && control_points(&model) <= MAX_OF_PARTS;
        is_small.then_some((name, model))
    };
    paths.iter().filter_map(|path| read(path)).collect()
}
