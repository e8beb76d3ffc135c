//! A body with what pairs it: names, invariants and vertices.

use super::surface::middle_and_axes;
use crate::bvh::Aabb;
use crate::engine::PreparedModel;
use crate::engine::prepared::mirror_image;
use crate::error::Result;
use crate::facets::Facet;
use crate::model::level;
use crate::sorting::sort_by_number;
use glam::DVec3;
use std::collections::BTreeMap;

/// The part by which areas and moments of parts may differ that are tried as copies: a wrong one costs a pairing or
/// time, never a proof.
const ALIKE: f64 = 1e-2;

/// The largest number of vertices by which a motion is guessed.
const MAX_VERTICES: usize = 96;

/// A body of A or B.
pub(super) struct Part {
    /// A name of no other part of its model.
    pub(super) name: String,
    /// The name as the file has it.
    pub(super) given: Option<String>,
    pub(super) model: PreparedModel,
    /// The indices of its faces in its whole model.
    pub(super) faces: Vec<usize>,
    pub(super) aabb: Aabb,
    volume: Option<f64>,
    area: f64,
    /// The centroid, of a sheet that of its surface.
    pub(super) center: DVec3,
    /// The principal moments, ascending, and axes, of a sheet those of its surface.
    pub(super) principal: Option<([f64; 3], [DVec3; 3])>,
    /// Corners of patches or triangles, those farthest from the centre.
    pub(super) vertices: Vec<DVec3>,
}

/// Returns the bodies of a model, which is no cloud.
///
/// # Errors
/// Those of [`PreparedModel::single_bodies`].
pub(super) fn parts_of(model: &PreparedModel) -> Result<Vec<Part>> {
    let all = model.bodies().into_iter().zip(model.single_bodies()?).zip(model.body_facts());
    let part = |((body, single), facts): ((_, PreparedModel), _)| {
        let (body, facts): (crate::engine::Body, &crate::Facts) = (body, facts);
        let levels: Vec<String> = body.path.iter().map(|name| level(name)).collect();
        let vertices = vertices(&single);
        let solid = facts.centroid.zip(facts.principal_moments).zip(facts.principal_axes);
        let middles = |of: [crate::interval::Interval; 3]| of.map(|one| one.middle());
        let about = match solid {
            Some(((centroid, moments), axes)) => {
                Some((middles(centroid).into(), middles(moments), axes.map(DVec3::from_array)))
            }
            None => middle_and_axes(&single),
        };
        let center = about.map_or(single.control_box().center(), |(center, ..)| center);
        Part {
            name: body.full_name,
            given: (!levels.is_empty()).then(|| levels.join(" / ")),
            faces: body.faces,
            aabb: single.control_box(),
            volume: facts.volume.map(|volume| volume.middle()),
            area: facts.area.map_or(0.0, |area| area.middle()),
            center,
            principal: about.map(|(_, moments, axes)| (moments, axes)),
            vertices: farthest(vertices, center),
            model: single,
        }
    };
    Ok(all.map(part).collect())
}

impl Part {
    /// Returns the mirror image, by the change of the sign of every x.
    ///
    /// # Errors
    /// Those of [`PreparedModel::mirrored`].
    pub(super) fn mirrored(&self) -> Result<Self> {
        let model = self.model.mirrored()?;
        Ok(Self {
            name: self.name.clone(),
            given: self.given.clone(),
            faces: self.faces.clone(),
            aabb: model.control_box(),
            volume: self.volume,
            area: self.area,
            center: mirror_image(self.center),
            principal: self.principal.map(|(moments, axes)| (moments, axes.map(mirror_image))),
            vertices: self.vertices.iter().map(|&vertex| mirror_image(vertex)).collect(),
            model,
        })
    }

    /// Returns whether this part may be a copy of another one up to `limit`, by volume, area and moments.
    pub(super) fn is_like(&self, other: &Self, limit: f64) -> bool {
        let area = 0.5 * (self.area + other.area);
        let is_near = |a: f64, b: f64| (a - b).abs() <= ALIKE * (a.abs() + b.abs());
        let volumes = match (self.volume, other.volume) {
            (Some(a), Some(b)) => (a - b).abs() <= 2.0 * limit * area + 1e-6 * (a + b),
            (None, None) => true,
            _ => false,
        };
        let is_thin = limit > ALIKE * self.aabb.diagonal();
        let moments = match (&self.principal, &other.principal) {
            (Some((a, _)), Some((b, _))) => is_thin || a.iter().zip(b).all(|(&a, &b)| is_near(a, b)),
            _ => true,
        };
        volumes && moments && (is_thin || is_near(self.area, other.area))
    }
}

/// Returns the corners of all patches or triangles, each once.
fn vertices(model: &PreparedModel) -> Vec<DVec3> {
    let mut found: BTreeMap<[u64; 3], DVec3> = BTreeMap::new();
    let mut add = |point: DVec3| {
        found.entry(point.to_array().map(|x| (x + 0.0).to_bits())).or_insert(point);
    };
    match model.facets() {
        Some(facets) => (0..facets.target.len() as u32).for_each(|place| match facets.target.facet(place) {
            Facet::Triangle(corners) => corners.into_iter().for_each(&mut add),
            Facet::Point(point) => add(point),
        }),
        None => model.bezier().patches.iter().for_each(|patch| {
            for at in [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]] {
                add(patch.point(at));
            }
        }),
    }
    found.into_values().collect()
}

/// Returns the vertices that are farthest from the centre, the farthest first.
fn farthest(mut vertices: Vec<DVec3>, center: DVec3) -> Vec<DVec3> {
    sort_by_number(&mut vertices, |vertex| -vertex.distance_squared(center));
    vertices.truncate(MAX_VERTICES);
    vertices
}
