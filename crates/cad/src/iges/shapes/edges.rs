//! Edges: curves of boundaries, and those of edge lists between their vertices.

use super::pairing::{Pair, Piece};
use super::{Shapes, Sheet, used};
use crate::digits::three_digits;
use crate::iges::file::{Entity, Found};
use crate::iges::geometry::{Leaf, leaves};
use crate::nurbs::{Curve, CurvePart, nearest_parameter};
use crate::report::FaceFault;
use crate::topology::{Edge, PCurve, ShapeKind, SpaceCurve, Use};
use glam::{DAffine3, DVec3};

/// The shape of an edge, and whether the edge of the file runs along its curve.
#[derive(Debug, Clone, Copy)]
pub(super) struct Segment {
    pub(super) shape: usize,
    pub(super) forward: bool,
}

/// The largest distance of a vertex from the curve of its edge, relative to the edge's size, or
/// in tolerances if that is more. The file states no tolerance of edges, and some are known to
/// half of this part only.
const NEAR: f64 = 1e-2;
const TOLERANCES: f64 = 10.0;

/// The precision of coordinates relative to their size: OpenCASCADE writes ten digits.
const DIGITS: f64 = 1e-9;

/// A vertex: its shape and its point.
#[derive(Debug, Clone, Copy)]
struct Vertex {
    shape: usize,
    point: DVec3,
}

impl Shapes<'_> {
    /// Appends the edge of a part of a face's boundary.
    pub(super) fn piece(&mut self, piece: Piece, sheet: &Sheet, location: DAffine3) -> Found<Use> {
        let alone = Pair { along: true, distance: 0.0 };
        let (leaf, curve, degenerate, Pair { along, distance }) = match piece {
            Piece::Both { leaf, curve, pair } => (Some(leaf), Some(curve), false, pair),
            Piece::Space(leaf) => (Some(leaf), None, false, alone),
            Piece::Parameters(curve, is_point) => (None, Some(curve), is_point, alone),
        };
        let mut p_curves = Vec::new();
        if let Some(curve) = curve {
            self.spend(curve.controls.len())?;
            self.topology.p_curves.push(Curve::Spline(curve.into()));
            let index = self.topology.p_curves.len() - 1;
            p_curves.push(PCurve { curves: [index; 2], surface: sheet.surface, location, range: [0.0, 1.0] });
        }
        let curve = leaf.map(|leaf| self.space_curve(leaf)).transpose()?;
        // The file states no tolerance: its curves are known to within their distance.
        let tolerance = self.tolerance_of(curve.as_ref()).max(distance);
        let edge = Edge { tolerance, degenerate, curve, p_curves };
        Ok(used(self.push(ShapeKind::Edge(edge), Vec::new())?, along))
    }

    /// Adds to the edge of a seam the curve in the parameters of its other side. `same` is whether
    /// the curves in space of both sides have one direction.
    pub(super) fn other_side(&mut self, edge: Use, piece: Piece, same: bool) -> Found<Use> {
        let Piece::Both { curve, pair, .. } = piece else { return Ok(edge) };
        let curve = if same { curve } else { curve.reversed() };
        let along = pair.along == same;
        self.spend(curve.controls.len())?;
        self.topology.p_curves.push(Curve::Spline(curve.into()));
        let index = self.topology.p_curves.len() - 1;
        if let ShapeKind::Edge(Edge { tolerance, p_curves, .. }) = &mut self.topology.shapes[edge.shape].kind
        {
            *tolerance = tolerance.max(pair.distance);
            for p_curve in p_curves {
                p_curve.curves[usize::from(!along)] = index;
            }
        }
        Ok(used(edge.shape, along))
    }

    /// Returns the tolerance of the file, or that of the digits of a curve's coordinates.
    fn tolerance_of(&self, curve: Option<&SpaceCurve>) -> f64 {
        let coordinates = curve.map_or(0.0, |SpaceCurve { curve, location, range }| {
            let ends = range.map(|t| location.transform_point3(self.topology.curves[*curve].point(t)));
            ends[0].abs().max(ends[1].abs()).max_element()
        });
        self.tolerance.max(DIGITS * coordinates)
    }

    fn space_curve(&mut self, leaf: Leaf) -> Found<SpaceCurve> {
        self.spend(leaf.curve.pole_count())?;
        self.topology.curves.push(leaf.curve);
        let curve = self.topology.curves.len() - 1;
        Ok(SpaceCurve { curve, location: leaf.location, range: leaf.range })
    }

    /// Returns the segments of an edge of a list, type 504, in its direction.
    ///
    /// # Errors
    /// `IGES_EDGE` if the vertices bound no part of the curve, and those of entities.
    pub(super) fn listed_edge(&mut self, list: u64, index: usize) -> Found<Vec<Segment>> {
        if let Some(known) = self.edges.get(&(list, index)) {
            return known.clone();
        }
        let found = self.new_edge(list, index);
        self.edges.insert((list, index), found.clone());
        found
    }

    fn new_edge(&mut self, list: u64, index: usize) -> Found<Vec<Segment>> {
        let entity = self.listed(list, index, 504, 5, "a list of edges, type 504")?;
        let first = 2 + 5 * (index - 1);
        let ends = [1, 3].map(|at| -> Found<Vertex> {
            self.listed_vertex(
                entity.reference(first + at)?,
                entity.count(first + at + 1, u32::MAX as usize)?,
            )
        });
        let [start, end] = ends;
        let ends = [start?, end?];
        let mut parts = leaves(self.file, entity.reference(first)?, self.scale)?;
        let fault = |why: &str| FaceFault::new("IGES_EDGE", format!("edge {index} of {list}: {why}"));
        if let [leaf] = parts.as_slice() {
            let (leaf, turned, distance) = self.between(leaf, ends).map_err(|why| fault(&why))?;
            let curve = self.space_curve(leaf)?;
            let ends = if turned { [ends[1], ends[0]] } else { ends };
            let shape = self.push_edge(curve, [Some(ends[0].shape), Some(ends[1].shape)], distance)?;
            return Ok(vec![Segment { shape, forward: !turned }]);
        }
        let point =
            |leaf: &Leaf, end: usize| leaf.location.transform_point3(leaf.curve.point(leaf.range[end]));
        let (Some(first), Some(last)) = (parts.first(), parts.last()) else {
            return Err(fault("its curve has no parts"));
        };
        let forward = point(first, 0).distance(ends[0].point) + point(last, 1).distance(ends[1].point)
            <= point(first, 0).distance(ends[1].point) + point(last, 1).distance(ends[0].point);
        let outer = if forward { ends } else { [ends[1], ends[0]] };
        let count = parts.len();
        let mut segments = Vec::with_capacity(count);
        for (place, leaf) in parts.drain(..).enumerate() {
            let vertices =
                [(place == 0).then_some(outer[0].shape), (place + 1 == count).then_some(outer[1].shape)];
            let curve = self.space_curve(leaf)?;
            segments.push(Segment { shape: self.push_edge(curve, vertices, 0.0)?, forward });
        }
        if !forward {
            segments.reverse();
        }
        Ok(segments)
    }

    /// Appends an edge whose curve ends at some distance from its vertices.
    fn push_edge(&mut self, curve: SpaceCurve, vertices: [Option<usize>; 2], distance: f64) -> Found<usize> {
        let tolerance = self.tolerance_of(Some(&curve)).max(distance);
        let edge = Edge { tolerance, degenerate: false, curve: Some(curve), p_curves: Vec::new() };
        let children = vertices.into_iter().zip([true, false]);
        let children = children.filter_map(|(vertex, start)| Some(used(vertex?, start))).collect();
        self.push(ShapeKind::Edge(edge), children)
    }

    /// Returns the part of a curve between two vertices, whether it runs from the second to the
    /// first, and the distance of its ends from them: the whole curve if they are its ends.
    fn between(&mut self, leaf: &Leaf, ends: [Vertex; 2]) -> Result<(Leaf, bool, f64), String> {
        let Leaf { curve, range, location } = leaf;
        let to_curve = location.inverse();
        let points = ends.map(|end| to_curve.transform_point3(end.point));
        let allowed = |curve: &Curve, range| (NEAR * curve.size(range)).max(TOLERANCES * self.tolerance);
        let distances = |curve: &Curve, range: [f64; 2], turned: bool| {
            [0, 1].map(|end: usize| {
                curve.point(range[end]).distance(points[if turned { 1 - end } else { end }])
            })
        };
        let whole = [false, true].into_iter().find(|&turned| {
            distances(curve, *range, turned).iter().all(|&distance| distance <= allowed(curve, *range))
        });
        let (curve, range, turned) = match whole {
            Some(turned) => (curve.clone(), *range, turned),
            None => {
                let parameters = points.map(|point| nearest_parameter(curve, point));
                let [Some(from), Some(to)] = parameters else {
                    return Err("its curve has no range".to_owned());
                };
                let closed = ends[0].shape == ends[1].shape;
                let CurvePart { curve, range, turned } =
                    CurvePart::between(curve.clone(), [from, to], closed)?;
                (curve, range, turned)
            }
        };
        let allowed = allowed(&curve, range);
        let found = distances(&curve, range, turned);
        for (end, distance) in found.into_iter().enumerate() {
            if !(distance <= allowed) {
                let distance = three_digits(distance);
                return Err(format!("its curve ends {distance} from its vertex"));
            }
            let vertex = ends[if turned { 1 - end } else { end }].shape;
            if let ShapeKind::Vertex(tolerance) = &mut self.topology.shapes[vertex].kind {
                *tolerance = tolerance.max(distance);
            }
        }
        Ok((Leaf { curve, range, location: *location }, turned, found[0].max(found[1])))
    }

    /// Returns the vertex of a list, type 502.
    fn listed_vertex(&mut self, list: u64, index: usize) -> Found<Vertex> {
        let entity = self.listed(list, index, 502, 3, "a list of vertices, type 502")?;
        let point = self.scale.0 * entity.point(2 + 3 * (index - 1))?;
        let shape = match self.vertices.get(&(list, index)) {
            Some(&shape) => shape,
            None => {
                let shape = self.push(ShapeKind::Vertex(self.tolerance), Vec::new())?;
                self.vertices.insert((list, index), shape);
                shape
            }
        };
        Ok(Vertex { shape, point })
    }

    /// Returns a list that has an item of this index, from 1.
    fn listed(&self, list: u64, index: usize, kind: u32, size: usize, expected: &str) -> Found<Entity> {
        let entity = self.file.entity(list)?;
        if entity.entry.kind != kind {
            return Err(entity.unknown(expected));
        }
        if index == 0 || index > entity.items(1, size)? {
            return Err(entity.fault(1, &format!("the number of a list with an item {index}")));
        }
        Ok(entity)
    }
}
