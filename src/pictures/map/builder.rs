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

/// The difference of distances, in diagonals, up to which they count as the same: twice the precision of a
/// search by default, to whose upper end distances are limited.
const SAME: f64 = 2e-6;

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
            self.map.add_farthest(farthest, SAME * self.diagonal);
        }
        self.map
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::model::RigidTransform;

    /// Two triangles over the square of this side in z = 0, and what is known.
    fn builder(side: f32, shown: &Shown) -> MapBuilder {
        let positions =
            [[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]].map(|[x, y]| [x, y, 0.0]).concat();
        let surface = Surface {
            positions: &positions,
            normals: &[0.0, 0.0, 1.0].repeat(4),
            indices: &[0, 1, 2, 0, 2, 3],
            counts: &[3, 3],
            origin: DVec3::ZERO,
            is_mesh: false,
        };
        let placing = Placing { transform: RigidTransform::IDENTITY, scale: 1.0, is_of_a: true };
        MapBuilder::new(&surface, shown, placing, f64::from(side) * 2.0_f64.sqrt())
    }

    /// Makes the map of a function of x and y.
    fn map(mut builder: MapBuilder, of: impl Fn(f64, f64) -> f64) -> Map {
        loop {
            let points = builder.pending();
            if points.is_empty() {
                return builder.finish(Signs::Faces);
            }
            let signed: Vec<f64> = points.chunks(3).map(|at| of(at[0], at[1])).collect();
            let distances: Vec<f64> = signed.iter().map(|value| value.abs()).collect();
            builder.measured(&signed, &distances);
        }
    }

    #[test]
    fn the_map_is_within_a_step_of_a_bump_between_its_first_vertices() {
        let bump = |x: f64, y: f64| 0.05 * (-((x - 0.3).powi(2) + (y - 0.62).powi(2)) / 0.004).exp();
        let map = map(builder(1.0, &Shown::default()), bump);
        let mut area = 0.0;
        for corners in &map.triangles.corners {
            let [a, b, c] = corners.map(|corner| map.vertices[corner as usize].position);
            area += 0.5 * (b - a).cross(c - a).z;
            let middle = (a + b + c) / 3.0;
            let linear = corners.iter().map(|&corner| map.values[corner as usize][0]).sum::<f64>() / 3.0;
            // Twice the fortieth of the largest, for the middle of a triangle rather than of its edges.
            let off = (linear - bump(middle.x, middle.y)).abs();
            assert!(off < 2.0 * 0.05 / 40.0, "{off} at {middle}");
        }
        // The triangles still cover the square once.
        assert!((area - 1.0).abs() < 1e-9, "{area}");
        assert_eq!(map.triangles.faces.len(), map.triangles.corners.len());
    }

    #[test]
    fn the_farthest_point_is_a_vertex_and_bounds_hold() {
        let farthest = Some(Place { face: 1, point: [0.2, 0.7, 0.0], foot: [0.2, 0.7, -0.5] });
        let shown = Shown { uppers: vec![0.25, 0.5], farthest };
        let map = map(builder(1.0, &shown), |x, _| 0.3 + 0.001 * x);
        let worst = map.worst().unwrap();
        assert_eq!(map.vertices[worst].position, DVec3::new(0.2, 0.7, 0.0));
        assert_eq!(map.values[worst], [0.5; 2]);
        // Vertices of the first face alone are limited to its bound.
        for (vertex, &[signed, distance]) in map.vertices.iter().zip(&map.values) {
            let of_first = vertex.position.x > vertex.position.y;
            assert_eq!(signed, distance);
            assert!(if of_first { distance == 0.25 } else { distance > 0.29 }, "{vertex:?} {distance}");
        }
    }

    #[test]
    fn a_point_that_ended_a_search_early_is_not_the_worst() {
        let farthest = Some(Place { face: 0, point: [0.5, 0.1, 0.0], foot: [0.5, 0.1, 0.2] });
        let map = map(builder(1.0, &Shown { uppers: vec![9.0], farthest }), |x, _| x);
        assert_eq!(map.vertices[map.worst().unwrap()].position.x, 1.0);
    }

    #[test]
    fn nothing_is_measured_where_rounding_is_all_and_lists_that_are_too_short_end_the_map() {
        let even = builder(1.0, &Shown { uppers: vec![1e-9], farthest: None });
        assert!(even.pending().is_empty());
        assert!(even.finish(Signs::Solid).values.iter().all(|&value| value == [0.0; 2]));
        let mut short = builder(1.0, &Shown::default());
        short.measured(&[1.0], &[]);
        assert_eq!(short.finish(Signs::Faces).worst().map(|_| ()), Some(()));
    }
}
