//! Primitives of constructive solid geometry, as the faces that they are (ISO 10303-42, 6.4).

use super::edges::Vertex;
use super::{Shapes, used};
use crate::nurbs::{Conic, Curve, Frame, Surface};
use crate::report::{FaceFault, Remark};
use crate::step::exchange::Entity;
use crate::step::geometry::{circle, cylinder, length, line, placement, plane_through, point};
use crate::topology::{Face, FaceLabel, ShapeKind, SpaceCurve, Use};
use glam::{DAffine3, DVec3};
use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_2, TAU};

/// The corners of each face of a block or wedge, in the order in which they are seen from outside; bit 0 of a corner
/// is whether it lies at the end of x, bits 1 and 2 the same of y and z.
const SIDES: [[usize; 4]; 6] =
    [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];

impl Shapes<'_> {
    /// Returns the group of a primitive's faces: of a block, a wedge, a sphere, a torus, a cylinder and a cone, also as
    /// the root of a solid. What booleans make of primitives is not read.
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
            "RIGHT_ANGULAR_WEDGE" => self.wedge(entity)?,
            "RIGHT_CIRCULAR_CYLINDER" => self.cylinder(entity)?,
            "RIGHT_CIRCULAR_CONE" => self.cone(entity)?,
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
        self.group(entity, ShapeKind::Solid(entity.name()), faces)
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
        let [x, y, z] = self.lengths(entity)?;
        self.hexahedron(entity, x, [x, y, z])
    }

    /// A block cut off by a plane along its z axis, which leaves of the side at the end of y a part, or an edge.
    fn wedge(&mut self, entity: &Entity<'_>) -> Result<Vec<Use>, FaceFault> {
        let [x, y, z] = self.lengths(entity)?;
        let top = entity.number(5)? * self.scale().length();
        if !(top >= 0.0 && top < x) {
            return Err(entity.fault(5, "a length from 0 to below that of the other side"));
        }
        self.hexahedron(entity, top, [x, y, z])
    }

    /// Returns the lengths along the axes of a placement.
    fn lengths(&self, entity: &Entity<'_>) -> Result<[f64; 3], FaceFault> {
        let scale = self.scale();
        Ok([length(entity, 2, &scale)?, length(entity, 3, &scale)?, length(entity, 4, &scale)?])
    }

    /// Appends the faces of a block of these lengths whose length in x is `top` at the end of y; without those that
    /// are edges where that is 0.
    fn hexahedron(
        &mut self,
        entity: &Entity<'_>,
        top: f64,
        [x, y, z]: [f64; 3],
    ) -> Result<Vec<Use>, FaceFault> {
        let frame = placement(self.file, entity.reference(1)?, &self.scale())?;
        let mut corners: Vec<Vertex> = Vec::with_capacity(8);
        for corner in 0..8 {
            let [is_x, is_y, is_z] = [0, 1, 2].map(|axis| corner >> axis & 1 == 1);
            let along = if is_y { top } else { x };
            let at = DVec3::new(
                if is_x { along } else { 0.0 },
                if is_y { y } else { 0.0 },
                if is_z { z } else { 0.0 },
            );
            corners.push(match corners.last() {
                Some(last) if is_x && is_y && top == 0.0 => *last,
                _ => self.new_vertex(frame.point(at))?,
            });
        }
        let mut edges: HashMap<[usize; 2], usize> = HashMap::new();
        let mut faces = Vec::with_capacity(SIDES.len());
        for side in SIDES {
            let mut side = side.map(|corner| corners[corner]).to_vec();
            side.dedup_by_key(|corner| corner.shape);
            if side.first().map(|corner| corner.shape) == side.last().map(|corner| corner.shape) {
                side.pop();
            }
            if side.len() > 2 {
                faces.push(self.polygonal_side(entity, &side, &mut edges)?);
            }
        }
        Ok(faces)
    }

    /// Appends the plane face of these corners, with one edge for each pair of vertices.
    fn polygonal_side(
        &mut self,
        entity: &Entity<'_>,
        side: &[Vertex],
        edges: &mut HashMap<[usize; 2], usize>,
    ) -> Result<Use, FaceFault> {
        let mut uses = Vec::with_capacity(side.len());
        for (index, &from) in side.iter().enumerate() {
            let to = side[(index + 1) % side.len()];
            let forward = from.shape < to.shape;
            let ends = if forward { [from, to] } else { [to, from] };
            let key = ends.map(|end| end.shape);
            let edge = match edges.get(&key) {
                Some(&known) => known,
                None => {
                    let made = self.segment(ends)?;
                    edges.insert(key, made);
                    made
                }
            };
            uses.push(used(edge, forward));
        }
        let points: Vec<DVec3> = side.iter().map(|corner| corner.point).collect();
        let plane = plane_through(&points);
        let plane = plane.ok_or_else(|| entity.fault(2, "lengths of a block with an area"))?;
        let wire = self.push(ShapeKind::Wire, uses)?;
        self.side(entity, Surface::Plane(plane), vec![used(wire, true)])
    }

    fn cylinder(&mut self, entity: &Entity<'_>) -> Result<Vec<Use>, FaceFault> {
        let scale = self.scale();
        let base = placement(self.file, entity.reference(1)?, &scale)?;
        let [height, radius] = [length(entity, 2, &scale)?, length(entity, 3, &scale)?];
        let top = Frame { origin: base.origin + height * base.z, ..base };
        self.between_circles(entity, cylinder(base, radius), (base, radius), (top, radius))
    }

    /// A cone whose smaller end, or apex, is at its placement, and whose base lies in the negative direction of the
    /// axis, as the standard has it. Some systems write the base on the other side, which is remarked.
    fn cone(&mut self, entity: &Entity<'_>) -> Result<Vec<Use>, FaceFault> {
        let scale = self.scale();
        let top = placement(self.file, entity.reference(1)?, &scale)?;
        let height = length(entity, 2, &scale)?;
        let radius = entity.number(3)? * scale.length();
        if !(radius >= 0.0 && radius.is_finite()) {
            return Err(entity.fault(3, "a length, or 0"));
        }
        let half_angle = entity.number(4)? * scale.angle;
        if !(half_angle > 0.0 && half_angle < FRAC_PI_2) {
            return Err(entity.fault(4, "the half angle of a cone, between 0 and a right angle"));
        }
        let slope = half_angle.tan();
        let base = Frame { origin: top.origin - height * top.z, ..top };
        let side = Surface::Revolution { frame: top, profile: line(radius, -slope), kind: "cone" };
        let why = format!(
            "#{}, RIGHT_CIRCULAR_CONE, widens against its axis, as ISO 10303-42 says; some systems write it the other way",
            entity.number
        );
        self.topology.remarks.push(Remark::new("STEP_CONE", why));
        self.between_circles(entity, side, (base, radius + height * slope), (top, radius))
    }

    /// Appends a surface of revolution and the discs that close it at the circles of two frames, the second of which
    /// lies in the positive direction of the axis; no disc of radius 0.
    fn between_circles(
        &mut self,
        entity: &Entity<'_>,
        surface: Surface,
        (base, base_radius): (Frame, f64),
        (top, top_radius): (Frame, f64),
    ) -> Result<Vec<Use>, FaceFault> {
        let base_circle = self.circle(&base, base_radius)?;
        let downwards = Frame { y: -base.y, z: -base.z, ..base };
        let mut around = vec![(base_circle, true)];
        let mut discs = vec![(Surface::Plane(downwards), vec![(base_circle, false)])];
        if top_radius > 0.0 {
            let top_circle = self.circle(&top, top_radius)?;
            around.push((top_circle, false));
            discs.push((Surface::Plane(top), vec![(top_circle, true)]));
        }
        let mut faces = Vec::with_capacity(3);
        for (surface, circles) in std::iter::once((surface, around)).chain(discs) {
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
