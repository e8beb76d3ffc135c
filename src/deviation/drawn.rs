//! Maps of pictures, which are made to the end and placed.

use super::builder::NOT_MEASURED;
use super::{FLOOR, Fineness, Map, MapBuilder, Placing, Vertex};
use glam::DVec3;

impl Fineness {
    /// For a printed picture, which has some hundred thousand pixels: edges of some of them.
    pub(crate) const PICTURE: Self = Self { step: 1.0 / 40.0, min_edge: 1.0 / 160.0, max_tried: 24_000 };
}

impl MapBuilder {
    /// Returns whether a known bound allows deviations that the map resolves.
    pub(crate) fn may_have_colors(&self) -> bool {
        self.upper > FLOOR * self.diagonal
    }

    /// Ends the map: what was not measured has no deviation.
    pub(crate) fn finish(mut self) -> Map {
        if self.map.values.is_empty() {
            let count = self.map.vertices.len();
            self.map.values = vec![NOT_MEASURED; count];
            self.map.feet =
                self.map.vertices.iter().map(|vertex| self.placing.placed(vertex.point)).collect();
            self.complete_base();
        }
        self.map
    }
}

impl Placing {
    /// Returns a normal of the map's model in the coordinates of the result.
    fn turned(&self, normal: DVec3) -> DVec3 {
        if self.is_of_a { self.transform.rotate(normal) } else { normal }
    }
}

impl Map {
    /// Returns the map with its vertices in the coordinates of the result.
    pub(crate) fn placed(mut self, placing: &Placing) -> Self {
        for Vertex { position, point, normal, slack } in &mut self.vertices {
            *position = placing.placed(*position);
            *point = placing.placed(*point);
            *normal = placing.turned(*normal);
            *slack = placing.length(*slack);
        }
        self.origin = placing.placed(self.origin);
        self.flatness = placing.length(self.flatness);
        self
    }
}
