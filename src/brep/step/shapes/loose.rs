//! Surfaces of sets, which no topology bounds.

use super::{Shapes, used};
use crate::brep::report::FaceFault;
use crate::brep::step::exchange::{Value, reference};
use crate::brep::step::geometry::curve;
use crate::brep::topology::{Face, FaceLabel, ShapeKind, SpaceCurve, Use};
use glam::DAffine3;

impl Shapes<'_> {
    /// Returns the face that a surface of a set is, whole or within boundary curves; `None` for
    /// points and curves.
    ///
    /// # Errors
    /// If the file has too many shapes.
    pub(super) fn loose_surface(&mut self, instance: u64) -> Result<Option<Use>, FaceFault> {
        let keyword = self.file.keyword(instance);
        // A reference to nothing may have been one to a surface.
        if !keyword.is_empty() && (!keyword.contains("SURFACE") || keyword.ends_with("_CURVE")) {
            return Ok(None);
        }
        let shape = match self.loose_face(instance) {
            Ok((surface, wires)) => {
                let name = self.file.entity(instance)?.name();
                let label = FaceLabel { entity: Some(instance), name };
                self.push(ShapeKind::Face(Face { label, ..Face::on(surface) }), wires)?
            }
            Err(fault) => self.unreadable(instance, fault)?,
        };
        Ok(Some(used(shape, true)))
    }

    /// Returns the surface of a face and the wires that bound it.
    fn loose_face(&mut self, instance: u64) -> Result<(usize, Vec<Use>), FaceFault> {
        let entity = self.file.entity(instance)?;
        if entity.kind != "CURVE_BOUNDED_SURFACE" {
            return Ok((self.surface(instance)?, Vec::new()));
        }
        let surface = self.surface(entity.reference(1)?)?;
        let boundaries = entity.references(2)?;
        if entity.flag(3)? && !boundaries.is_empty() {
            return Err(entity.fault(3, ".F.: holes in a whole surface are not read"));
        }
        let mut wires = Vec::with_capacity(boundaries.len());
        for boundary in boundaries {
            wires.push(self.boundary(boundary)?);
        }
        Ok((surface, wires))
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
            let (Some(parent), Value::Enumeration(sense)) = (reference(segment.value(2)), segment.value(1))
            else {
                return Err(segment.unknown("a segment with a sense and a curve"));
            };
            let geometry = curve(self.file, parent, &self.scale())?;
            let range = geometry.natural_range();
            let range = range.ok_or_else(|| segment.fault(2, "a curve with ends"))?;
            self.topology.curves.push(geometry);
            let curve = self.topology.curves.len() - 1;
            let space = SpaceCurve { curve, location: DAffine3::IDENTITY, range };
            let edge = self.push_edge(space, Vec::new(), Vec::new())?;
            edges.push(used(edge, *sense != "F"));
        }
        if edges.is_empty() {
            return Err(entity.fault(1, "a list of segments"));
        }
        let wire = self.push(ShapeKind::Wire, edges)?;
        Ok(used(wire, true))
    }
}
