//! The steps in which a map is made: its vertices are measured, then the middles of some edges.

use super::base::Surface;
use super::placing::Placing;
use super::triangles::Edge;
use super::{FLOOR, Map, Vertex};
use crate::engine::Signs;
use crate::pictures::{Place, Shown};
use glam::DVec3;
use std::collections::{HashMap, HashSet};

/// The value of a vertex that was not measured: no deviation.
const NOT_MEASURED: [f64; 2] = [0.0; 2];

/// A map that is being made.
#[derive(Debug)]
pub(crate) struct MapBuilder {
    pub(super) map: Map,
    placing: Placing,
    /// The larger diagonal of both models.
    pub(super) diagonal: f64,
    /// The vertices that are to be measured, and the edges whose middles they are; of the first ones none.
    pub(super) pending: (Vec<Vertex>, Vec<Edge>),
    /// Edges in whose middles the deviation is the mean of that at the ends.
    pub(super) settled: HashSet<Edge>,
    /// Rounds of splitting so far, and the edges tried in them.
    pub(super) rounds: usize,
    pub(super) tried: usize,
    shown: Shown,
}

impl MapBuilder {
    /// Begins the map of a model with what is known of it; `diagonal` is the larger one of both models in
    /// the result's unit.
    pub(crate) fn new(surface: &Surface<'_>, shown: &Shown, placing: Placing, diagonal: f64) -> Self {
        let map = surface.placed(&placing);
        let mut shown = shown.clone();
        let largest = shown.uppers.iter().copied().reduce(f64::max);
        if let Some(largest) = largest.filter(|_| surface.is_mesh) {
            // Bounds are of its groups, which its triangles here do not have.
            shown.uppers = vec![largest];
            shown.farthest = shown.farthest.map(|farthest| Place { face: 0, ..farthest });
        }
        // Deviations that have no colour need not be measured.
        let is_even = largest.is_some_and(|largest| largest <= FLOOR * diagonal);
        let pending = if is_even { Vec::new() } else { map.vertices.clone() };
        let (pending, settled) = ((pending, Vec::new()), HashSet::new());
        Self { map, placing, diagonal, pending, settled, rounds: 0, tried: 0, shown }
    }

    /// Returns the points to be measured next, x, y, z each, in the coordinates of the other model; none
    /// if the map is complete.
    pub(crate) fn pending(&self) -> Vec<f64> {
        let (points, _) = self.different();
        points.into_iter().flat_map(|point| self.placing.of_other(point).to_array()).collect()
    }

    /// Takes the signed deviations, NaN without a sign, and the distances of these points, in the other
    /// model's unit.
    pub(crate) fn measured(&mut self, signed: &[f64], distances: &[f64]) {
        let (_, places) = self.different();
        let value = |&place: &usize| match (signed.get(place), distances.get(place)) {
            (Some(&signed), Some(&distance)) => [signed, distance].map(|value| self.placing.measured(value)),
            _ => NOT_MEASURED,
        };
        let values: Vec<[f64; 2]> = places.iter().map(value).collect();
        let (vertices, edges) = std::mem::take(&mut self.pending);
        if self.map.values.is_empty() {
            self.map.values = values;
        } else {
            self.split(edges, vertices, &values);
        }
        self.choose();
    }

    /// Returns the points that are pending, equal ones once, and the place of each vertex's: faces beside
    /// each other have vertices in common.
    fn different(&self) -> (Vec<DVec3>, Vec<usize>) {
        let (mut points, mut known) = (Vec::new(), HashMap::new());
        let mut place = |vertex: &Vertex| {
            *known.entry(vertex.point.to_array().map(f64::to_bits)).or_insert_with(|| {
                points.push(vertex.point);
                points.len() - 1
            })
        };
        let places = self.pending.0.iter().map(&mut place).collect();
        (points, places)
    }

    /// Ends the map.
    pub(crate) fn finish(mut self, signs: Signs) -> Map {
        self.map.signs = signs;
        self.map.values.resize(self.map.vertices.len(), NOT_MEASURED);
        self.map.limit(&self.shown.uppers);
        if let Some(farthest) = self.shown.farthest {
            self.map.add_farthest(farthest);
        }
        self.map
    }
}
