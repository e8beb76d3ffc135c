//! Solids, shells and sets of surfaces.

use super::items::SETS;
use super::{Shapes, used};
use crate::report::FaceFault;
use crate::step::exchange::Entity;
use crate::topology::{ShapeKind, Use};

/// The shells.
pub(in crate::step) const SHELLS: [&str; 6] = [
    "CLOSED_SHELL",
    "OPEN_SHELL",
    "CONNECTED_FACE_SET",
    "CONNECTED_FACE_SUB_SET",
    "ORIENTED_CLOSED_SHELL",
    "ORIENTED_OPEN_SHELL",
];

/// The bodies that are made of shells.
pub(in crate::step) const BODIES: [&str; 5] = [
    "MANIFOLD_SOLID_BREP",
    "FACETED_BREP",
    "BREP_WITH_VOIDS",
    "SHELL_BASED_SURFACE_MODEL",
    "FACE_BASED_SURFACE_MODEL",
];

impl Shapes<'_> {
    /// Returns the group of a body, with all that stands in it.
    ///
    /// # Errors
    /// `STEP_ENTITY` for a body of another kind, `STEP_ATTRIBUTE` for one without parts; if the file has too many shapes.
    pub(super) fn body(&mut self, entity: &Entity<'_>, nesting: usize) -> Result<usize, FaceFault> {
        let kind = entity.kind.as_str();
        if matches!(kind, "ORIENTED_CLOSED_SHELL" | "ORIENTED_OPEN_SHELL") {
            let forward = entity.flag(3)?;
            let shell = self.part(entity.reference(2)?, nesting)?;
            return self.push(ShapeKind::Group(None), vec![used(shell.shape, forward)]);
        }
        if SHELLS.contains(&kind) {
            let faces = entity.references(1)?;
            let children: Result<Vec<Use>, FaceFault> =
                faces.into_iter().map(|face| self.face(face)).collect();
            return self.group(entity, ShapeKind::Group(None), children?);
        }
        if SETS.contains(&kind) {
            let mut children = Vec::new();
            for element in entity.references(1)? {
                children.extend(self.nested(element, nesting + 1)?);
            }
            return self.push(ShapeKind::Group(entity.name()), children);
        }
        let parts = match kind {
            "MANIFOLD_SOLID_BREP" | "FACETED_BREP" => vec![entity.reference(1)?],
            "BREP_WITH_VOIDS" => std::iter::once(entity.reference(1)?).chain(entity.references(2)?).collect(),
            "SHELL_BASED_SURFACE_MODEL" | "FACE_BASED_SURFACE_MODEL" => entity.references(1)?,
            _ => return self.primitive(entity),
        };
        let children: Result<Vec<Use>, FaceFault> =
            parts.into_iter().map(|part| self.part(part, nesting)).collect();
        match kind {
            "SHELL_BASED_SURFACE_MODEL" | "FACE_BASED_SURFACE_MODEL" => {
                self.group(entity, ShapeKind::Group(entity.name()), children?)
            }
            _ => self.group(entity, ShapeKind::Solid(entity.name()), children?),
        }
    }

    /// Returns the shape of a shell of a body.
    fn part(&mut self, instance: u64, nesting: usize) -> Result<Use, FaceFault> {
        match self.nested(instance, nesting + 1)? {
            Some(part) => Ok(part),
            None => {
                let fault = self.file.entity(instance)?.unknown("a shell");
                Ok(used(self.unreadable(instance, fault)?, true))
            }
        }
    }

    /// Appends the group of a body, which has parts.
    pub(super) fn group(
        &mut self,
        entity: &Entity<'_>,
        kind: ShapeKind,
        parts: Vec<Use>,
    ) -> Result<usize, FaceFault> {
        if parts.is_empty() {
            return Err(entity.fault(1, "a list of at least one part"));
        }
        self.push(kind, parts)
    }
}
