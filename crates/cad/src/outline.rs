//! Edges of faces as they are drawn while a file is read.

use super::nurbs::Curve;
use super::placed::Placed;
use super::topology::{ShapeKind, Topology};
use glam::DVec3;

/// The number of segments of a whole conic: their middles are within a fiftieth of the radius.
const CONIC_SEGMENTS: usize = 16;
/// The segments of a span of a spline, and the most of an edge.
const SPAN_SEGMENTS: usize = 4;
const MAX_SEGMENTS: usize = 256;

/// Returns the ends of segments along the edges of a face where it is placed; edges that have no
/// curve in space are left out. For display only. O(segments).
pub(super) fn outline(file: &Topology, face: &Placed) -> Vec<DVec3> {
    let mut ends = Vec::new();
    for wire in &file.shapes[face.shape].children {
        for child in &file.shapes[wire.shape].children {
            let ShapeKind::Edge(edge) = &file.shapes[child.shape].kind else { continue };
            let Some(space) = &edge.curve else { continue };
            let location = face.location * wire.location * child.location * space.location;
            let curve = &file.curves[space.curve];
            let [start, end] = space.range;
            let count = segments(curve);
            let at = |step: usize| {
                let t = start + (end - start) * (step as f64 / count as f64);
                location.transform_point3(curve.point(t))
            };
            ends.extend((0..count).flat_map(|step| [at(step), at(step + 1)]));
        }
    }
    ends
}

fn segments(curve: &Curve) -> usize {
    match curve {
        Curve::Line { .. } => 1,
        Curve::Conic { .. } => CONIC_SEGMENTS,
        Curve::Spline(_) => (SPAN_SEGMENTS * curve.pole_count()).min(MAX_SEGMENTS),
        Curve::Trimmed { basis, .. } | Curve::Offset { basis, .. } => segments(basis),
    }
}
