//! Edges of a map that are split, because they are long, or because the deviation in their middle is
//! not the mean of those at their ends.

use super::builder::MapBuilder;
use super::triangles::Edge;
use super::{FLOOR, Map, Vertex};
use std::collections::HashMap;

/// The longest edge, in diagonals: what is larger than it is seen.
const MAX_EDGE: f64 = 1.0 / 40.0;

/// The shortest edge that is split for its deviation, in diagonals: some pixels.
const MIN_EDGE: f64 = 1.0 / 160.0;

/// The part of the largest deviation by which the middle of an edge may be off.
const STEP: f64 = 1.0 / 40.0;

/// Rounds of splitting: each halves the longest edges.
const MAX_ROUNDS: usize = 8;

/// The largest number of edges that are tried: a picture has some hundred thousand pixels, and a point
/// takes some ten microseconds.
const MAX_TRIED: usize = 24_000;

/// The largest number of edges that are tried in a round, the longest first.
const MAX_AT_ONCE: usize = 6_000;

impl MapBuilder {
    /// Splits the edges that are long or whose middles are off; the others are settled.
    pub(super) fn split(&mut self, edges: Vec<Edge>, middles: Vec<Vertex>, values: &[[f64; 2]]) {
        let step = self.step();
        let mut added = HashMap::new();
        for ((edge, middle), &value) in edges.into_iter().zip(middles).zip(values) {
            let is_long = self.map.length(edge) > MAX_EDGE * self.diagonal;
            if is_long || self.map.is_off(edge, value, step) {
                added.insert(edge, self.map.vertices.len() as u32);
                self.map.vertices.push(middle);
                self.map.values.push(value);
            } else {
                self.settled.insert(edge);
            }
        }
        self.map.triangles.split(&added);
    }

    /// Chooses the edges that are tried next: long ones, and those along which the deviation may be off by
    /// more than a step. A distance changes by at most the way gone, so that it is within half of what an
    /// edge is longer than its ends differ.
    pub(super) fn choose(&mut self) {
        self.rounds += 1;
        if self.rounds > MAX_ROUNDS || self.tried >= MAX_TRIED {
            return;
        }
        let (map, step, diagonal) = (&self.map, self.step(), self.diagonal);
        let mut tried: Vec<(f64, Edge)> = Vec::new();
        for edge in map.triangles.edges() {
            let length = map.length(edge);
            let [one, other] = edge.map(|end| map.values[end as usize]);
            let slack = 0.5 * (length - (one[1] - other[1]).abs());
            let turns = one[0] * other[0] < 0.0 && one[1].max(other[1]) > step;
            let may_be_off = length > MIN_EDGE * diagonal && (slack > step || turns);
            if length > MAX_EDGE * diagonal || may_be_off && !self.settled.contains(&edge) {
                tried.push((length, edge));
            }
        }
        // Edges of one length stay in the order of their vertices.
        tried.sort_by(|(one, _), (other, _)| other.total_cmp(one));
        tried.truncate(MAX_AT_ONCE);
        self.tried += tried.len();
        let edges: Vec<Edge> = tried.into_iter().map(|(_, edge)| edge).collect();
        self.pending = (edges.iter().map(|&edge| map.middle(edge)).collect(), edges);
    }

    /// The deviation by which the colours may be off.
    fn step(&self) -> f64 {
        let largest = self.map.worst().map_or(0.0, |worst| self.map.values[worst][1]);
        (STEP * largest).max(FLOOR * self.diagonal)
    }
}

impl Map {
    fn length(&self, edge: Edge) -> f64 {
        let [from, to] = edge.map(|end| self.vertices[end as usize].point);
        from.distance(to)
    }

    /// Whether the mean of an edge's ends is not the deviation of its middle, to a step.
    fn is_off(&self, edge: Edge, [signed, distance]: [f64; 2], step: f64) -> bool {
        let [from, to] = edge.map(|end| self.values[end as usize]);
        let by_sign = (0.5 * (from[0] + to[0]) - signed).abs();
        let by_distance = (0.5 * (from[1] + to[1]) - distance).abs();
        (if by_sign.is_nan() { by_distance } else { by_sign }) > step
    }

    /// Returns the middle of an edge: drawn on the edge, so that no crack opens, and measured where the
    /// surface is, by the cubic curve with the tangents that the normals at both ends leave; of a mesh,
    /// whose normals here are 0, on the edge.
    fn middle(&self, edge: Edge) -> Vertex {
        let [from, to] = edge.map(|end| self.vertices[end as usize]);
        let way = to.point - from.point;
        // A straight way has no part along the normals at its ends.
        let bulge = (to.normal * to.normal.dot(way) - from.normal * from.normal.dot(way)) / 8.0;
        Vertex {
            position: 0.5 * (from.position + to.position),
            point: 0.5 * (from.point + to.point) + bulge,
            normal: (from.normal + to.normal).normalize_or_zero(),
        }
    }
}
