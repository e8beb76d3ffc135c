//! Counts of what a model consists of, and of what is wrong with it.

use super::super::PreparedModel;
use crate::facets::Facet;
use crate::model::{Face, Model};
use glam::DVec3;
use serde::Serialize;
use std::collections::{BTreeMap, HashMap, HashSet};

/// Numbers of faces by their kind, and of parts that are free, degenerate or double.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct Counts {
    /// The numbers of faces by the kind of their surface in the source, `nurbs` where it states none.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub kinds: BTreeMap<String, usize>,
    /// The number of triangles of a mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub triangles: Option<usize>,
    /// The number of points of a cloud.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub points: Option<usize>,
    /// The number of edges without a partner; none of points.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub free_edges: Option<usize>,
    /// The number of faces with the surface and the loops of one before.
    pub duplicate_faces: usize,
    /// The number of triangles with the corners of one before.
    pub duplicate_triangles: usize,
    /// The number of triangles whose corners are on a line, to the precision of float64.
    pub degenerate_triangles: usize,
    /// The length of the shortest edge of a triangle that is no point.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub smallest_edge: Option<f64>,
}

impl Counts {
    /// Counts. O(size).
    pub(super) fn new(model: Option<&Model>, prepared: &PreparedModel) -> Self {
        let mut counts = Self::default();
        if !prepared.is_cloud() {
            counts.free_edges = Some(prepared.bodies().iter().map(|body| body.free_edges).sum());
        }
        if let Some(model) = model {
            counts.count_faces(model);
        }
        counts.count_facets(prepared);
        counts
    }

    /// Counts what a prepared model consists of. O(size).
    pub(in crate::engine) fn of_prepared(prepared: &PreparedModel) -> Self {
        Self::new(prepared.source(), prepared)
    }

    fn count_faces(&mut self, model: &Model) {
        for face in model.faces() {
            *self.kinds.entry(face.kind().unwrap_or("nurbs").to_owned()).or_default() += 1;
        }
        let first = first_alike(model).into_iter().enumerate();
        self.duplicate_faces = first.filter(|(face, first)| face != first).count();
    }

    fn count_facets(&mut self, prepared: &PreparedModel) {
        let Some(facets) = prepared.facets() else { return };
        let count = facets.target.len();
        if facets.target.is_cloud() {
            self.points = Some(count);
            return;
        }
        self.triangles = Some(count);
        let (mut known, mut shortest) = (HashSet::with_capacity(count), f64::INFINITY);
        for place in 0..count as u32 {
            let mut vertices = facets.target.corners(place);
            vertices.sort_unstable();
            self.duplicate_triangles += usize::from(!known.insert(vertices));
            let Facet::Triangle([a, b, c]) = facets.target.facet(place) else { continue };
            self.degenerate_triangles += usize::from((b - a).cross(c - a) == DVec3::ZERO);
            for length in [a.distance(b), b.distance(c), c.distance(a)] {
                if length > 0.0 && length < shortest {
                    shortest = length;
                }
            }
        }
        self.smallest_edge = shortest.is_finite().then_some(shortest);
    }
}

/// Returns for each face the first one with the same surface and loops. O(faces) where few begin at one point.
pub(in crate::engine) fn first_alike(model: &Model) -> Vec<usize> {
    let mut known: HashMap<[u64; 3], Vec<(usize, Face<'_>)>> = HashMap::new();
    let mut all = Vec::new();
    for (index, face) in model.faces().enumerate() {
        let [x, y, z, _] = face.surface().control_points()[0];
        let alike = known.entry([x, y, z].map(f64::to_bits)).or_default();
        let is_same = |(_, other): &&(usize, Face<'_>)| {
            other.surface() == face.surface() && other.trim() == face.trim()
        };
        let first = alike.iter().find(is_same).map(|(first, _)| *first);
        if first.is_none() {
            alike.push((index, face));
        }
        all.push(first.unwrap_or(index));
    }
    all
}
