//! Spheres whose edges pass their poles.

use super::Shapes;
use crate::nurbs::{Curve, Frame, Surface};
use crate::topology::{ShapeKind, Use};
use glam::DVec3;

/// The points of an edge by which its way is judged.
const SAMPLES: usize = 64;

/// The distance of a point from a pole, relative to the edge's length between samples, within
/// which the edge may pass it: any edge through the pole has such a point.
const NEAR_POLE: f64 = 2.0;

/// Directions from which the poles of a turned sphere are chosen, in the sphere's frame.
const DIRECTIONS: [[f64; 3]; 12] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [1.0, 1.0, 0.0],
    [1.0, -1.0, 0.0],
    [1.0, 0.0, 1.0],
    [1.0, 0.0, -1.0],
    [0.0, 1.0, 1.0],
    [0.0, 1.0, -1.0],
    [1.0, 1.0, 1.0],
    [1.0, 1.0, -1.0],
    [1.0, -1.0, 1.0],
    [-1.0, 1.0, 1.0],
];

impl Shapes<'_> {
    /// Returns the sphere turned so that its poles are far from a face's edges, if one of these
    /// passes a pole between its ends, where its parameters jump; `None` for others. Both
    /// spheres are the same set of points.
    pub(super) fn turned_sphere(&self, surface: usize, wires: &[Use]) -> Option<Surface> {
        let Surface::Revolution { frame, profile, kind: kind @ "sphere" } = &self.topology.surfaces[surface]
        else {
            return None;
        };
        let Curve::Conic { x, .. } = profile else { return None };
        let radius = x.length();
        let edges: Vec<Vec<DVec3>> = wires.iter().flat_map(|wire| self.edge_points(wire)).collect();
        let poles = |axis: DVec3| [1.0, -1.0].map(|side| frame.origin + side * radius * axis);
        let passes = |points: &Vec<DVec3>| {
            let length: f64 = points.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
            let near = NEAR_POLE * length / SAMPLES as f64;
            let ends = [points[0], points[SAMPLES]];
            poles(frame.z).into_iter().any(|pole| {
                points.iter().any(|point| point.distance(pole) < near)
                    && ends.iter().all(|end| end.distance(pole) >= near)
            })
        };
        if !edges.iter().any(passes) {
            return None;
        }
        let clearance = |axis: DVec3| {
            let distance = |point: &DVec3| {
                poles(axis).map(|pole| pole.distance(*point)).into_iter().fold(f64::INFINITY, f64::min)
            };
            edges.iter().flatten().map(distance).fold(f64::INFINITY, f64::min)
        };
        let axes =
            DIRECTIONS.iter().map(|&direction| frame.vector(DVec3::from(direction)).normalize_or_zero());
        let axis = axes.max_by(|&a, &b| clearance(a).total_cmp(&clearance(b)))?;
        let frame = Frame::about(frame.origin, axis)?;
        Some(Surface::Revolution { frame, profile: profile.clone(), kind })
    }

    /// Returns points of each edge of a wire.
    fn edge_points(&self, wire: &Use) -> Vec<Vec<DVec3>> {
        let edges = self.topology.shapes[wire.shape].children.iter();
        let points = edges.filter_map(|edge| {
            let ShapeKind::Edge(edge) = &self.topology.shapes[edge.shape].kind else { return None };
            let space = edge.curve.as_ref()?;
            let [start, end] = space.range;
            let at = |sample: usize| start + (end - start) * sample as f64 / SAMPLES as f64;
            Some((0..=SAMPLES).map(|sample| self.topology.curves[space.curve].point(at(sample))).collect())
        });
        points.collect()
    }
}
