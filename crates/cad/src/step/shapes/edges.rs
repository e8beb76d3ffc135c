//! Edges: the parts of curves between vertices.

use super::{Shapes, used};
use crate::digits::three_digits;
use crate::nurbs::{Curve, CurvePart, nearest_parameter};
use crate::report::FaceFault;
use crate::step::geometry::{Scale, curve, point, trimmed};
use crate::topology::{Edge, PCurve, ShapeKind, SpaceCurve, Use};
use glam::{DAffine3, DVec3};

/// The shape of an edge, and whether the edge of the file runs along its curve.
#[derive(Debug, Clone, Copy)]
pub(super) struct Segment {
    pub(super) shape: usize,
    pub(super) forward: bool,
}

/// The least tolerance of edges and vertices in millimetres: that of OpenCASCADE.
pub(super) const TOLERANCE: f64 = 1e-7;

/// The largest distance of a vertex from the curve of its edge, relative to the edge's size, or
/// in uncertainties of the file if that is more.
const NEAR: f64 = 1e-3;
const UNCERTAINTIES: f64 = 10.0;

/// A vertex: its shape and its point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Vertex {
    pub(super) shape: usize,
    pub(super) point: DVec3,
}

impl Shapes<'_> {
    /// Returns the segments of an edge in its direction.
    ///
    /// # Errors
    /// `STEP_EDGE` if the vertices bound no part of the curve, and those of entities.
    pub(super) fn edge(&mut self, instance: u64) -> Result<Vec<Segment>, FaceFault> {
        if let Some(known) = self.edges.get(&instance) {
            return known.clone();
        }
        let found = self.new_edge(instance);
        self.edges.insert(instance, found.clone());
        found
    }

    fn new_edge(&mut self, instance: u64) -> Result<Vec<Segment>, FaceFault> {
        let entity = self.file.entity(instance)?;
        if entity.kind != "EDGE_CURVE" {
            return Err(entity.unknown("an edge with a curve"));
        }
        let [start, end] = [self.vertex(entity.reference(1)?)?, self.vertex(entity.reference(2)?)?];
        let geometry = trimmed(self.edge_geometry(entity.reference(3)?)?);
        let forward = entity.flag(4)?;
        let ends = if forward { [start, end] } else { [end, start] };
        let fault = |why: &str| FaceFault::new("STEP_EDGE", format!("edge #{instance}: {why}"));
        let parameters = ends.map(|end| nearest_parameter(&geometry, end.point));
        let [Some(from), Some(to)] = parameters else { return Err(fault("its curve has no range")) };
        let closed = start.shape == end.shape;
        let CurvePart { curve, range, turned } =
            CurvePart::between(geometry, [from, to], closed).map_err(fault)?;
        let ends = if turned { [ends[1], ends[0]] } else { ends };
        let distances = [0, 1].map(|end| curve.point(range[end]).distance(ends[end].point));
        let size = curve.size(range);
        let allowed = (NEAR * size).max(UNCERTAINTIES * self.units.uncertainty);
        for end in [0, 1] {
            let distance = distances[end];
            if !(distance <= allowed) {
                let distance = three_digits(distance);
                return Err(fault(&format!("its curve ends {distance} from its vertex")));
            }
            if let ShapeKind::Vertex(tolerance) = &mut self.topology.shapes[ends[end].shape].kind {
                *tolerance = tolerance.max(distance);
            }
        }
        self.topology.curves.push(curve);
        let curve = self.topology.curves.len() - 1;
        let space = SpaceCurve { curve, location: DAffine3::IDENTITY, range };
        let children = vec![used(ends[0].shape, true), used(ends[1].shape, false)];
        let p_curves = self.p_curves(entity.reference(3)?, &space);
        let shape = self.push_edge(space, p_curves, children)?;
        Ok(vec![Segment { shape, forward: forward != turned }])
    }

    /// Returns the curve of an edge. The standard asks for one in space; of a curve in the parameters of a surface
    /// alone, as some writers have, it is the exact image.
    fn edge_geometry(&mut self, instance: u64) -> Result<Curve, FaceFault> {
        let entity = self.file.entity(instance)?;
        if entity.kind != "PCURVE" {
            return curve(self.file, instance, &self.scale());
        }
        let (surface, drawing) = self.p_curve(&entity)?;
        let surface = self.surface(surface)?;
        let scale = Scale::of_parameters(&self.topology.surfaces[surface], &self.units);
        let drawn = curve(self.file, drawing, &scale)?;
        let image = self.topology.surfaces[surface].image(&drawn);
        image.ok_or_else(|| {
            entity.unknown("a curve in space, or one along a parameter of an elementary surface")
        })
    }

    /// Appends an edge of this curve.
    pub(super) fn push_edge(
        &mut self,
        curve: SpaceCurve,
        p_curves: Vec<PCurve>,
        vertices: Vec<Use>,
    ) -> Result<usize, FaceFault> {
        let tolerance = self.units.uncertainty.max(TOLERANCE);
        let edge = Edge { tolerance, degenerate: false, curve: Some(curve), p_curves };
        self.push(ShapeKind::Edge(edge), vertices)
    }

    /// Appends the straight edge between two points, each the instance of a point, which
    /// stands for a vertex; none between equal points.
    pub(super) fn straight(&mut self, points: [u64; 2]) -> Result<Option<Segment>, FaceFault> {
        let ends = [self.vertex_at(points[0])?, self.vertex_at(points[1])?];
        if ends[0].point == ends[1].point {
            return Ok(None);
        }
        Ok(Some(Segment { shape: self.segment(ends)?, forward: true }))
    }

    /// Appends the straight edge between two vertices at different points.
    pub(super) fn segment(&mut self, [start, end]: [Vertex; 2]) -> Result<usize, FaceFault> {
        self.topology.curves.push(Curve::Line { point: start.point, direction: end.point - start.point });
        let curve = self.topology.curves.len() - 1;
        let space = SpaceCurve { curve, location: DAffine3::IDENTITY, range: [0.0, 1.0] };
        self.push_edge(space, Vec::new(), vec![used(start.shape, true), used(end.shape, false)])
    }

    /// Appends a vertex at a point.
    pub(super) fn new_vertex(&mut self, point: DVec3) -> Result<Vertex, FaceFault> {
        let tolerance = self.units.uncertainty.max(TOLERANCE);
        Ok(Vertex { shape: self.push(ShapeKind::Vertex(tolerance), Vec::new())?, point })
    }

    fn vertex(&mut self, instance: u64) -> Result<Vertex, FaceFault> {
        let entity = self.file.entity(instance)?;
        if entity.kind != "VERTEX_POINT" {
            return Err(entity.unknown("a vertex with a point"));
        }
        self.vertex_of(instance, entity.reference(1)?)
    }

    fn vertex_at(&mut self, at: u64) -> Result<Vertex, FaceFault> {
        self.vertex_of(at, at)
    }

    /// Returns the vertex of an instance that has its point at another.
    fn vertex_of(&mut self, instance: u64, at: u64) -> Result<Vertex, FaceFault> {
        let point = point(self.file, at, &self.scale())?;
        let shape = match self.vertices.get(&instance) {
            Some(known) => known.clone()?,
            None => {
                let made = self.new_vertex(point).map(|vertex| vertex.shape);
                self.vertices.insert(instance, made.clone());
                made?
            }
        };
        Ok(Vertex { shape, point })
    }
}
