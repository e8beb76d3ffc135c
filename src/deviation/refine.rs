//! Edges of a map that are split, because the deviation in their middle is not the mean of those at their ends.

use super::builder::MapBuilder;
use super::triangles::Edge;
use super::{FLOOR, Map};
use crate::sorting::sort_by_number;
use std::collections::HashMap;

/// Rounds of splitting.
const MAX_ROUNDS: usize = 8;

/// The part of the edges tried at most that are tried in a round, those that may be farthest off first: later rounds
/// know more.
const AT_ONCE: usize = 6;

/// The number of vertices after which a map is fine enough for any screen.
const MAX_VERTICES: usize = 150_000;

/// Edges shorter than this, in diagonals, whose ends differ by less than this part of a step are taken as even.
const EVEN_EDGE: f64 = 1.0 / 100.0;
const EVEN_PART: f64 = 1.0 / 8.0;

impl MapBuilder {
    /// Splits the pending edges whose middles are off; the others are settled.
    pub(super) fn split(&mut self, edges: Vec<Edge>, values: &[[f64; 2]]) {
        let mut added = HashMap::new();
        for (place, (edge, &value)) in edges.into_iter().zip(values).enumerate() {
            if self.map.is_off(edge, value, self.step) {
                added.insert(edge, self.map.vertices.len() as u32);
                self.map.vertices.push(self.map.middle(edge));
                self.map.values.push(value);
                self.map.feet.push(self.feet[place]);
            } else {
                self.settled.insert(edge);
            }
        }
        self.map.triangles.split(&added);
    }

    /// Chooses the edges that are tried next: those along which the deviation may be off by more than a step. A
    /// distance changes by at most the way gone, so that it is within half of what an edge is longer than its ends
    /// differ.
    pub(super) fn choose(&mut self) {
        self.rounds += 1;
        let (map, fineness) = (&self.map, self.fineness);
        if self.rounds > MAX_ROUNDS || self.tried >= fineness.max_tried || map.vertices.len() > MAX_VERTICES {
            return;
        }
        let mut tried: Vec<(f64, Edge)> = Vec::new();
        for edge in map.triangles.edges() {
            if let Some(slack) = self.slack(edge).filter(|_| !self.settled.contains(&edge)) {
                tried.push((slack, edge));
            }
        }
        // Equal ones stay in the order of their vertices.
        sort_by_number(&mut tried, |&(slack, _)| -slack);
        tried.truncate((fineness.max_tried / AT_ONCE).min(fineness.max_tried - self.tried));
        self.tried += tried.len();
        let edges: Vec<Edge> = tried.into_iter().map(|(_, edge)| edge).collect();
        let middles: Vec<_> = edges.iter().map(|&edge| map.middle(edge).point).collect();
        self.ask(middles, edges);
    }

    /// Returns the most that the deviation in the middle of an edge may be off, if that is more than a step.
    fn slack(&self, edge: Edge) -> Option<f64> {
        let (map, step) = (&self.map, self.step);
        let length = self.placing.length(map.length(edge));
        let [one, other] = edge.map(|end| map.values[end as usize]);
        let is_even = (one[0] - other[0]).abs() < EVEN_PART * step && length < EVEN_EDGE * self.diagonal;
        if is_even || length < self.fineness.min_edge * self.diagonal {
            return None;
        }
        let slack = 0.5 * (length - (one[1] - other[1]).abs());
        // The sign changes where the distance is not 0.
        let turns = one[0] * other[0] < 0.0 && one[1].max(other[1]) > step && length > step;
        (slack > step || turns).then_some(slack)
    }

    /// Returns the deviation by which the colours may be off.
    pub(super) fn step_of(&self) -> f64 {
        let largest = self.map.worst().map_or(0.0, |worst| self.map.values[worst][1]);
        (self.fineness.step * largest).max(FLOOR * self.diagonal)
    }
}

impl Map {
    /// Whether the mean of an edge's ends is not the deviation of its middle, to a step.
    fn is_off(&self, edge: Edge, [signed, distance]: [f64; 2], step: f64) -> bool {
        let [from, to] = edge.map(|end| self.values[end as usize]);
        let by_sign = (0.5 * (from[0] + to[0]) - signed).abs();
        let by_distance = (0.5 * (from[1] + to[1]) - distance).abs();
        (if by_sign.is_nan() { by_distance } else { by_sign }) > step
    }
}
