//! Surfaces of sets and representations, which no topology bounds.

use super::edges::TOLERANCE;
use super::{Shapes, used};
use crate::nurbs::{Curve, Spline};
use crate::report::FaceFault;
use crate::step::exchange::Entity;
use crate::step::geometry::curve;
use crate::topology::{Edge, Face, FaceLabel, PCurve, ShapeKind, SpaceCurve, Use};
use glam::{DAffine3, DVec3};

impl Shapes<'_> {
    /// Returns the face that a surface of a set or a representation is, whole or within boundary curves.
    ///
    /// # Errors
    /// If the file has too many shapes.
    pub(super) fn loose_surface(&mut self, instance: u64) -> Result<Use, FaceFault> {
        let shape = match self.loose_face(instance) {
            Ok((surface, wires)) => {
                let name = self.file.entity(instance)?.name();
                let label = FaceLabel { entity: Some(instance), name };
                self.push(ShapeKind::Face(Face { label, ..Face::on(surface) }), wires)?
            }
            Err(fault) => self.unreadable(instance, fault)?,
        };
        self.reach(instance, shape);
        Ok(used(shape, true))
    }

    /// Returns the surface of a face and the wires that bound it.
    fn loose_face(&mut self, instance: u64) -> Result<(usize, Vec<Use>), FaceFault> {
        let entity = self.file.entity(instance)?;
        if entity.kind != "CURVE_BOUNDED_SURFACE" {
            return Ok((self.surface(instance)?, Vec::new()));
        }
        let surface = self.surface(entity.reference(1)?)?;
        let boundaries = entity.references(2)?;
        let mut wires = Vec::with_capacity(boundaries.len() + 1);
        if entity.flag(3)? && !boundaries.is_empty() {
            wires.push(self.whole_boundary(&entity, surface)?);
        }
        for boundary in boundaries {
            wires.push(self.boundary(boundary)?);
        }
        Ok((surface, wires))
    }

    /// Returns the wire around the whole of a surface, of its four sides.
    fn whole_boundary(&mut self, entity: &Entity<'_>, surface: usize) -> Result<Use, FaceFault> {
        let geometry = &self.topology.surfaces[surface];
        let [Some([u0, u1]), Some([v0, v1])] = geometry.natural_ranges() else {
            return Err(entity.fault(3, ".F.: the surface has no end"));
        };
        let corners = [[u0, v0], [u1, v0], [u1, v1], [u0, v1]].map(|[u, v]| DVec3::new(u, v, 0.0));
        let sides =
            [0, 1, 2, 3].map(|side| Spline::segment([0.0, 1.0], corners[side], corners[(side + 1) % 4]));
        // A side may be a point in space, as a pole is.
        let degenerate = sides.each_ref().map(|side| {
            let points =
                [0.0, 0.25, 0.5, 0.75, 1.0].map(|t| side.point(t)).map(|at| geometry.point(at.x, at.y));
            points.iter().all(|point| point.distance(points[0]) <= TOLERANCE)
        });
        let mut edges = Vec::with_capacity(sides.len());
        for (side, degenerate) in sides.into_iter().zip(degenerate) {
            self.topology.p_curves.push(Curve::Spline(side.into()));
            let curves = [self.topology.p_curves.len() - 1; 2];
            let p_curve = PCurve { curves, surface, location: DAffine3::IDENTITY, range: [0.0, 1.0] };
            let edge = Edge { tolerance: TOLERANCE, degenerate, curve: None, p_curves: vec![p_curve] };
            edges.push(used(self.push(ShapeKind::Edge(edge), Vec::new())?, true));
        }
        let wire = self.push(ShapeKind::Wire, edges)?;
        Ok(used(wire, true))
    }

    /// Returns the wire of a boundary, of an edge for each segment.
    fn boundary(&mut self, instance: u64) -> Result<Use, FaceFault> {
        let entity = self.file.entity(instance)?;
        if !matches!(
            entity.kind.as_str(),
            "BOUNDARY_CURVE" | "OUTER_BOUNDARY_CURVE" | "COMPOSITE_CURVE_ON_SURFACE" | "COMPOSITE_CURVE"
        ) {
            return Err(entity.unknown("a boundary of a surface"));
        }
        let mut edges = Vec::new();
        for segment in entity.references(1)? {
            let segment = self.file.entity(segment)?;
            let (parent, forward) = (segment.reference(2)?, segment.flag(1)?);
            let geometry = curve(self.file, parent, &self.scale())?;
            let range = geometry.natural_range();
            let range = range.ok_or_else(|| segment.fault(2, "a curve with ends"))?;
            self.topology.curves.push(geometry);
            let curve = self.topology.curves.len() - 1;
            let space = SpaceCurve { curve, location: DAffine3::IDENTITY, range };
            let edge = self.push_edge(space, Vec::new(), Vec::new())?;
            edges.push(used(edge, forward));
        }
        if edges.is_empty() {
            return Err(entity.fault(1, "a list of segments"));
        }
        let wire = self.push(ShapeKind::Wire, edges)?;
        Ok(used(wire, true))
    }
}
