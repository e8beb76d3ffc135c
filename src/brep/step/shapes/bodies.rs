//! Solids, shells and sets of surfaces.

use super::{Shapes, used};
use crate::brep::report::FaceFault;
use crate::brep::topology::{ShapeKind, Use};

/// The deepest nesting of bodies.
const MAX_NESTING: usize = 8;

/// The endings of entities that describe bodies, and are not read.
const OTHER_BODIES: [&str; 9] = [
    "_SOLID",
    "_BREP",
    "_MODEL",
    "_SHELL",
    "_RESULT",
    "BLOCK",
    "RIGHT_ANGULAR_WEDGE",
    "_REPLICA",
    "SOLID_MODEL",
];

/// Entities with such endings that have no faces.
const WITHOUT_FACES: [&str; 2] = ["EDGE_BASED_WIREFRAME_MODEL", "SHELL_BASED_WIREFRAME_MODEL"];

/// Bodies of triangles, whose third attribute is the body that they are a picture of, if any.
const TRIANGULATED: [&str; 2] = ["TESSELLATED_SOLID", "TESSELLATED_SHELL"];

/// The name of a body and the shapes that it is made of.
type Body = (Option<String>, Vec<Use>);

impl Shapes<'_> {
    /// Returns the group of an item of a representation; `None` for an item that is no body, as
    /// points, curves and placements are. A body that cannot be read is a face with the reason.
    ///
    /// # Errors
    /// If the file has too many shapes.
    pub(in crate::brep::step) fn body(&mut self, instance: u64) -> Result<Option<Use>, FaceFault> {
        self.nested(instance, 0)
    }

    fn nested(&mut self, instance: u64, nesting: usize) -> Result<Option<Use>, FaceFault> {
        if let Some(&known) = self.reached.get(&instance) {
            return Ok(Some(used(known, true)));
        }
        let shape = match self.children(instance, nesting) {
            Ok(Some((name, children))) => self.push(ShapeKind::Group(name), children)?,
            Ok(None) => return Ok(None),
            Err(fault) => self.unreadable(instance, fault)?,
        };
        self.reach(instance, shape);
        Ok(Some(used(shape, true)))
    }

    /// Returns the name of a body and the shapes that it is made of.
    fn children(&mut self, instance: u64, nesting: usize) -> Result<Option<Body>, FaceFault> {
        let entity = self.file.entity(instance)?;
        if nesting == MAX_NESTING {
            return Err(entity.unknown("a body of fewer levels"));
        }
        let mut children = Vec::new();
        let parts = match entity.kind.as_str() {
            "CLOSED_SHELL" | "OPEN_SHELL" | "CONNECTED_FACE_SET" => {
                for face in entity.references(1)? {
                    children.push(self.face(face)?);
                }
                return Ok(Some((None, children)));
            }
            "ORIENTED_CLOSED_SHELL" | "ORIENTED_OPEN_SHELL" => {
                let shell = self.nested(entity.reference(2)?, nesting + 1)?;
                let forward = entity.flag(3)?;
                let turned = |shell: Use| used(shell.shape, forward);
                return Ok(Some((None, shell.map(turned).into_iter().collect())));
            }
            "GEOMETRIC_SET" => {
                for element in entity.references(1)? {
                    children.extend(self.loose_surface(element)?);
                }
                return Ok(Some((entity.name(), children)));
            }
            "MANIFOLD_SOLID_BREP" | "FACETED_BREP" => vec![entity.reference(1)?],
            "BREP_WITH_VOIDS" => std::iter::once(entity.reference(1)?).chain(entity.references(2)?).collect(),
            "SHELL_BASED_SURFACE_MODEL" | "FACE_BASED_SURFACE_MODEL" => entity.references(1)?,
            kind => {
                let is_body = OTHER_BODIES.iter().any(|ending| kind.ends_with(ending));
                let is_picture = TRIANGULATED.contains(&kind) && entity.reference(2).is_ok();
                let without = is_picture || WITHOUT_FACES.contains(&kind);
                return if is_body && !without { Err(entity.unknown("a body with faces")) } else { Ok(None) };
            }
        };
        for part in parts {
            match self.nested(part, nesting + 1)? {
                Some(part) => children.push(part),
                None => {
                    let fault = self.file.entity(part)?.unknown("a shell");
                    children.push(used(self.unreadable(part, fault)?, true));
                }
            }
        }
        Ok(Some((entity.name(), children)))
    }
}
