//! The steps in which a map is made: its vertices are measured, then the middles of some edges.

use super::placing::Placing;
use super::triangles::Edge;
use super::witness::Farthest;
use super::{FarthestPoint, KnownDeviation};
use super::{Fineness, Map, limited};
use glam::DVec3;
use std::collections::{HashMap, HashSet};

/// The value of a vertex that was not measured: no deviation.
pub(super) const NOT_MEASURED: [f64; 2] = [0.0; 2];

/// The difference of distances, in diagonals, up to which they count as the same: twice the precision of a
/// search by default, to whose upper end distances are limited.
const SAME: f64 = 2e-6;

/// A map that is being made: [`Self::pending`] points are [`Self::measured`] until there are none, first the
/// vertices of its base, then, once [`Self::refine`] was called, the middles of edges.
#[derive(Debug)]
pub(crate) struct MapBuilder {
    pub(super) map: Map,
    pub(super) placing: Placing,
    /// The larger diagonal of both models.
    pub(super) diagonal: f64,
    pub(super) fineness: Fineness,
    shown: KnownDeviation,
    /// No distance exceeds it.
    pub(super) upper: f64,
    pending: Pending,
    /// The feet of the points measured last, by the vertices or edges that were pending.
    pub(super) feet: Vec<DVec3>,
    /// The deviation by which colours may be off.
    pub(super) step: f64,
    /// Edges in whose middles the deviation is the mean of that at the ends.
    pub(super) settled: HashSet<Edge>,
    /// Rounds of splitting so far, and the edges tried in them.
    pub(super) rounds: usize,
    pub(super) tried: usize,
}

/// What is to be measured.
#[derive(Debug, Default)]
struct Pending {
    /// x, y, z of the points in the coordinates of the other model, equal ones once: faces beside each other have
    /// vertices in common.
    points: Vec<f64>,
    /// The point of each vertex or edge.
    places: Vec<usize>,
    /// The edges in whose middles the points are; none for those of the base.
    edges: Vec<Edge>,
}

impl MapBuilder {
    /// Begins the map of a model with the triangles `base` and the known bounds on its deviation. `diagonal` is the
    /// larger one of both models, in the result's unit.
    pub(crate) fn new(
        base: &Map,
        shown: &KnownDeviation,
        placing: Placing,
        diagonal: f64,
        fineness: Fineness,
    ) -> Self {
        let mut shown = shown.clone();
        let upper = shown.uppers.iter().copied().reduce(f64::max).unwrap_or(f64::INFINITY);
        if base.is_mesh || base.triangles.corners.is_empty() {
            // Bounds are of its groups, which its triangles here do not have.
            shown.uppers = if shown.uppers.is_empty() { Vec::new() } else { vec![upper] };
            shown.farthest = shown.farthest.map(|farthest| FarthestPoint { face: 0, ..farthest });
        }
        let mut builder = Self {
            map: base.clone(),
            placing,
            diagonal,
            fineness,
            shown,
            upper,
            pending: Pending::default(),
            feet: Vec::new(),
            step: 0.0,
            settled: HashSet::new(),
            rounds: 0,
            tried: 0,
        };
        let points = base.vertices.iter().map(|vertex| vertex.point).collect();
        builder.ask(points, Vec::new());
        builder
    }

    /// Returns the points to be measured next, x, y, z each, in the coordinates of the other model; none
    /// if the map is complete, or to be [refined](Self::refine).
    pub(crate) fn pending(&self) -> &[f64] {
        &self.pending.points
    }

    pub(crate) fn placing(&self) -> &Placing {
        &self.placing
    }

    /// Returns what has been measured.
    pub(crate) fn map(&self) -> &Map {
        &self.map
    }

    /// Takes the signed deviations, NaN without a sign, the distances and the nearest points of the pending points,
    /// in the other model's unit and coordinates.
    pub(crate) fn measured(&mut self, signed: &[f64], distances: &[f64], feet: &[f64]) {
        let Pending { places, edges, .. } = std::mem::take(&mut self.pending);
        let (placing, upper) = (self.placing, self.upper);
        let feet = feet.as_chunks().0;
        let foot = |&place: &usize| {
            feet.get(place).map_or(DVec3::NAN, |&foot| placing.foot(DVec3::from_array(foot)))
        };
        self.feet = places.iter().map(foot).collect();
        let value = |&place: &usize| match (signed.get(place), distances.get(place)) {
            (Some(&signed), Some(&distance)) => {
                limited([signed, distance].map(|value| placing.measured(value)), upper)
            }
            _ => NOT_MEASURED,
        };
        let values: Vec<[f64; 2]> = places.iter().map(value).collect();
        if self.map.values.is_empty() {
            self.map.values = values;
            self.map.feet = std::mem::take(&mut self.feet);
            self.complete_base();
        } else {
            self.split(edges, &values);
            self.map.limit(&self.shown.uppers);
            self.choose();
        }
    }

    /// Begins to split the edges along which the deviation may be off by a step, of a base that was measured.
    pub(crate) fn refine(&mut self) {
        self.step = self.step_of();
        // Deviations of either sign differ by twice as much at most.
        if !self.map.values.is_empty() && 2.0 * self.upper > self.step {
            self.choose();
        }
    }

    /// Asks for points of the map's model, in whose edges' middles they are.
    pub(super) fn ask(&mut self, points: Vec<DVec3>, edges: Vec<Edge>) {
        let mut known: HashMap<[u64; 3], usize> = HashMap::with_capacity(points.len());
        let mut pending = Pending { edges, ..Pending::default() };
        for point in points {
            let next = known.len();
            let place = *known.entry(point.to_array().map(f64::to_bits)).or_insert(next);
            if place == next {
                pending.points.extend(self.placing.of_other(point).to_array());
            }
            pending.places.push(place);
        }
        self.pending = pending;
    }

    /// Keeps the measured base within what is known, with the farthest point.
    pub(super) fn complete_base(&mut self) {
        self.map.limit(&self.shown.uppers);
        let Some(FarthestPoint { face, point, foot }) = self.shown.farthest else { return };
        let [point, foot] = [point, foot].map(DVec3::from_array);
        let distance = point.distance(foot);
        let farthest = Farthest { face, point: self.placing.unplaced(point), foot, distance };
        self.map.add_farthest(farthest, SAME * self.diagonal);
    }
}
