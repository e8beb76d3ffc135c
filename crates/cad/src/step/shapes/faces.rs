//! Faces.

use super::loops::ORIENTED_FACE;
use super::{Shapes, used};
use crate::nurbs::Surface;
use crate::report::FaceFault;
use crate::step::exchange::Entity;
use crate::step::geometry::plane_through;
use crate::topology::{Face, FaceLabel, ShapeKind, Use};

impl Shapes<'_> {
    /// Returns the use of a face in its shell: a face that cannot be read stands there too, with
    /// the reason.
    ///
    /// # Errors
    /// If the file has too many shapes.
    pub(super) fn face(&mut self, instance: u64) -> Result<Use, FaceFault> {
        let (face, forward) = match self.oriented(instance, ORIENTED_FACE) {
            Ok(oriented) => oriented,
            Err(fault) => return Ok(used(self.unreadable(instance, fault)?, true)),
        };
        let shape = match self.reached.get(&face) {
            Some(&shape) => shape,
            None => {
                let read = self.new_face(face);
                let shape = match read {
                    Ok(shape) => shape,
                    Err(fault) => self.unreadable(face, fault)?,
                };
                self.reach(face, shape);
                shape
            }
        };
        Ok(used(shape, forward == self.same_sense(face)))
    }

    /// Returns whether a face has the normal of its surface.
    fn same_sense(&self, face: u64) -> bool {
        let entity = self.file.entity(face);
        entity.is_ok_and(|entity| entity.flag(3).unwrap_or(true))
    }

    /// Appends a face that cannot be read.
    pub(in crate::step) fn unreadable(
        &mut self,
        instance: u64,
        fault: FaceFault,
    ) -> Result<usize, FaceFault> {
        let name = self.file.entity(instance).ok().and_then(|entity| entity.name());
        let label = FaceLabel { entity: Some(instance), name };
        self.refused.insert(instance);
        self.push(ShapeKind::Face(Face { surface: Err(fault), label, ..Face::on(0) }), Vec::new())
    }

    fn new_face(&mut self, instance: u64) -> Result<usize, FaceFault> {
        let entity = self.file.entity(instance)?;
        let bounds = entity.references(1)?;
        let (surface, same_sense) = match entity.kind.as_str() {
            "ADVANCED_FACE" | "FACE_SURFACE" => (self.surface(entity.reference(2)?)?, entity.flag(3)?),
            // A face of a faceted body states its polygons only.
            "FACE" => (self.plane_of(&entity, &bounds)?, true),
            _ => return Err(entity.unknown("a face")),
        };
        let mut wires = Vec::with_capacity(bounds.len());
        for bound in bounds {
            let Some(mut wire) = self.bound(bound)? else { continue };
            // Seen along the normal of the surface the material is on the left.
            if !same_sense {
                wire.orientation = wire.orientation.opposite();
            }
            wires.push(wire);
        }
        let surface = match self.turned_sphere(surface, &wires) {
            Some(turned) => {
                self.topology.surfaces.push(turned);
                self.topology.surfaces.len() - 1
            }
            None => surface,
        };
        let label = FaceLabel { entity: Some(instance), name: entity.name() };
        self.push(ShapeKind::Face(Face { label, ..Face::on(surface) }), wires)
    }

    /// Returns the plane of a face's polygon.
    fn plane_of(&mut self, face: &Entity<'_>, bounds: &[u64]) -> Result<usize, FaceFault> {
        let plane = plane_through(&self.corners(bounds)?);
        let plane =
            plane.ok_or_else(|| face.unknown("a face with a surface, or of a polygon with an area"))?;
        self.topology.surfaces.push(Surface::Plane(plane));
        Ok(self.topology.surfaces.len() - 1)
    }
}
