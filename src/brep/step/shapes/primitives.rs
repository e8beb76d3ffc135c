//! Primitives of constructive solid geometry, as the faces that they are (ISO 10303-42, 6.4).

use super::edges::Vertex;
use super::{Shapes, used};
use crate::brep::nurbs::{Conic, Curve, Frame, Surface};
use crate::brep::report::FaceFault;
use crate::brep::step::exchange::Entity;
use crate::brep::step::geometry::{circle, cylinder, length, placement, point};
use crate::brep::topology::{Face, FaceLabel, ShapeKind, SpaceCurve, Use};
use glam::{DAffine3, DVec3};
use std::collections::HashMap;
use std::f64::consts::TAU;

/// The corners of each face of a block, in the order in which they are seen from outside; bit 0 of a corner is
/// whether it lies at the end of x, bits 1 and 2 the same of y and z.
const SIDES: [[usize; 4]; 6] =
    [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];

impl Shapes<'_> {
    /// Returns the group of a primitive's faces: of a block, a sphere, a torus and a cylinder, also as the root of a
    /// solid. What booleans make of primitives is not read, and neither are cones, whose side of their
    /// placement systems do not agree on.
    ///
    /// # Errors
    /// `STEP_ENTITY` for an entity that is no such primitive, and those of attributes.
    pub(super) fn primitive(&mut self, entity: &Entity<'_>) -> Result<usize, FaceFault> {
        let faces = match entity.kind.as_str() {
            "CSG_SOLID" => {
                let root = self.file.entity(entity.reference(1)?)?;
                if root.kind == "CSG_SOLID" {
                    return Err(root.unknown("a primitive"));
                }
                return self.primitive(&root);
            }
            "BLOCK" => self.block(entity)?,
            "RIGHT_CIRCULAR_CYLINDER" => self.cylinder(entity)?,
            "SPHERE" => {
                let radius = length(entity, 1, &self.scale())?;
                let origin = point(self.file, entity.reference(2)?, &self.scale())?;
                let frame = Frame { origin, x: DVec3::X, y: DVec3::Y, z: DVec3::Z };
                vec![self.whole(entity, frame, circle(0.0, radius), "sphere")?]
            }
            "TORUS" => {
                let frame = placement(self.file, entity.reference(1)?, &self.scale())?;
                let [major, minor] = [length(entity, 2, &self.scale())?, length(entity, 3, &self.scale())?];
                if major <= minor {
                    return Err(entity.fault(2, "a length above the minor radius"));
                }
                vec![self.whole(entity, frame, circle(major, minor), "torus")?]
            }
            _ => return Err(entity.unknown("a body with faces, a set of surfaces or a primitive")),
        };
        self.group(entity, entity.name(), faces)
    }

    /// Appends a face of a primitive.
    fn side(&mut self, entity: &Entity<'_>, surface: Surface, wires: Vec<Use>) -> Result<Use, FaceFault> {
        self.topology.surfaces.push(surface);
        let label = FaceLabel { entity: Some(entity.number), name: None };
        let face = Face { label, ..Face::on(self.topology.surfaces.len() - 1) };
        Ok(used(self.push(ShapeKind::Face(face), wires)?, true))
    }

    fn whole(
        &mut self,
        entity: &Entity<'_>,
        frame: Frame,
        profile: Curve,
        kind: &'static str,
    ) -> Result<Use, FaceFault> {
        self.side(entity, Surface::Revolution { frame, profile, kind }, Vec::new())
    }

    fn block(&mut self, entity: &Entity<'_>) -> Result<Vec<Use>, FaceFault> {
        let scale = self.scale();
        let frame = placement(self.file, entity.reference(1)?, &scale)?;
        let mut lengths = [0.0; 3];
        for (axis, found) in lengths.iter_mut().enumerate() {
            *found = length(entity, 2 + axis, &scale)?;
        }
        let mut corners = Vec::with_capacity(8);
        for corner in 0..8 {
            let at = [0, 1, 2].map(|axis| if corner >> axis & 1 == 1 { lengths[axis] } else { 0.0 });
            corners.push(self.new_vertex(frame.point(DVec3::from(at)))?);
        }
        let mut edges: HashMap<[usize; 2], usize> = HashMap::new();
        let mut faces = Vec::with_capacity(SIDES.len());
        for side in SIDES {
            let mut uses = Vec::with_capacity(side.len());
            for (index, &from) in side.iter().enumerate() {
                let to = side[(index + 1) % side.len()];
                let ends = [from.min(to), from.max(to)];
                let edge = match edges.get(&ends) {
                    Some(&known) => known,
                    None => {
                        let made = self.segment(ends.map(|end| corners[end]))?;
                        edges.insert(ends, made);
                        made
                    }
                };
                uses.push(used(edge, from < to));
            }
            let [a, b, .., d] = side.map(|corner| corners[corner].point);
            let plane = Frame::about(a, (b - a).cross(d - a));
            let plane = plane.ok_or_else(|| entity.fault(2, "lengths of a block with an area"))?;
            let wire = self.push(ShapeKind::Wire, uses)?;
            faces.push(self.side(entity, Surface::Plane(plane), vec![used(wire, true)])?);
        }
        Ok(faces)
    }

    fn cylinder(&mut self, entity: &Entity<'_>) -> Result<Vec<Use>, FaceFault> {
        let scale = self.scale();
        let base = placement(self.file, entity.reference(1)?, &scale)?;
        let [height, radius] = [length(entity, 2, &scale)?, length(entity, 3, &scale)?];
        let top = Frame { origin: base.origin + height * base.z, ..base };
        let base_circle = self.circle(&base, radius)?;
        let top_circle = self.circle(&top, radius)?;
        let downwards = Frame { y: -base.y, z: -base.z, ..base };
        let mut faces = Vec::with_capacity(3);
        for (surface, circles) in [
            (cylinder(base, radius), vec![(base_circle, true), (top_circle, false)]),
            (Surface::Plane(top), vec![(top_circle, true)]),
            (Surface::Plane(downwards), vec![(base_circle, false)]),
        ] {
            let mut wires = Vec::with_capacity(circles.len());
            for (circle, forward) in circles {
                wires.push(used(self.push(ShapeKind::Wire, vec![used(circle, true)])?, forward));
            }
            faces.push(self.side(entity, surface, wires)?);
        }
        Ok(faces)
    }

    /// Appends the edge of a circle in the plane z = 0 of a frame.
    fn circle(&mut self, frame: &Frame, radius: f64) -> Result<usize, FaceFault> {
        let Vertex { shape, .. } = self.new_vertex(frame.point(DVec3::new(radius, 0.0, 0.0)))?;
        let (x, y) = (radius * frame.x, radius * frame.y);
        self.topology.curves.push(Curve::Conic { conic: Conic::Elliptic, center: frame.origin, x, y });
        let curve = self.topology.curves.len() - 1;
        let space = SpaceCurve { curve, location: DAffine3::IDENTITY, range: [0.0, TAU] };
        self.push_edge(space, Vec::new(), vec![used(shape, true), used(shape, false)])
    }
}
