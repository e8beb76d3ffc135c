//! Items of representations and of sets: whether each is a face, a body or nothing to measure.

use super::{Shapes, used};
use crate::report::FaceFault;
use crate::topology::Use;

/// The deepest nesting of bodies and sets.
pub(super) const MAX_NESTING: usize = 8;

/// Faces, which may stand in a representation by themselves.
pub(super) const FACES: [&str; 4] = ["ADVANCED_FACE", "FACE_SURFACE", "ORIENTED_FACE", "FACE"];

/// Sets of points, curves and surfaces. Writers put surfaces in those of curves too.
pub(super) const SETS: [&str; 2] = ["GEOMETRIC_SET", "GEOMETRIC_CURVE_SET"];

/// Words in the names of entities that say something of a shape in numbers, texts and symbols.
const REMARKS: [&str; 7] = ["OCCURRENCE", "ANNOTATION", "TEXT", "CALLOUT", "SYMBOL", "CAMERA", "STYLED"];

/// Words in the names of entities that have surfaces, unless they are curves or points of these.
const WITH_SURFACE: [&str; 7] = ["SURFACE", "SOLID", "VOLUME", "SHELL", "BREP", "FACE", "MODEL"];

/// Words in the names of points, curves, placements and what is made of them.
const WITHOUT_SURFACE: [&str; 21] = [
    "POINT",
    "CURVE",
    "PCURVE",
    "LINE",
    "POLYLINE",
    "CIRCLE",
    "ELLIPSE",
    "PARABOLA",
    "HYPERBOLA",
    "CLOTHOID",
    "PLACEMENT",
    "TRANSFORMATION",
    "DIRECTION",
    "VECTOR",
    "EDGE",
    "VERTEX",
    "PATH",
    "LOOP",
    "WIRE",
    "BOX",
    "COORDINATES",
];

/// The entities that every item is, as complex instances state them.
const GENERAL: [&str; 3] =
    ["REPRESENTATION_ITEM", "GEOMETRIC_REPRESENTATION_ITEM", "TOPOLOGICAL_REPRESENTATION_ITEM"];

/// Returns whether an entity has no surface, by its name, or by those of a complex instance: one says so and none
/// of the others has one. Of an entity that is not known it is not assumed.
pub(super) fn has_no_surface(kind: &str) -> bool {
    let mut found = false;
    for part in kind.split(' ').filter(|part| !GENERAL.contains(part)) {
        match has_surface(part) {
            Some(true) => return false,
            Some(false) => found = true,
            None => {}
        }
    }
    found
}

/// Returns whether an entity has a surface, by its name; `None` for one that is not known.
fn has_surface(kind: &str) -> Option<bool> {
    let has_word = |words: &[&str]| kind.split('_').any(|word| words.contains(&word));
    let is_remark = has_word(&REMARKS) || kind.ends_with("REPRESENTATION_ITEM");
    let is_wire = kind.ends_with("WIREFRAME_MODEL") || matches!(kind, "WIRE_SHELL" | "VERTEX_SHELL");
    let is_on_surface =
        ["SURFACE_CURVE", "CURVE_ON_SURFACE", "POINT_ON_SURFACE"].iter().any(|on| kind.ends_with(on));
    if is_remark || is_wire || is_on_surface || kind == "PLANAR_EXTENT" {
        Some(false)
    } else if has_word(&WITH_SURFACE) {
        Some(true)
    } else {
        has_word(&WITHOUT_SURFACE).then_some(false)
    }
}

/// Returns whether an entity is a surface, by its name.
pub(super) fn is_surface(kind: &str) -> bool {
    let is_more = |word: &str| ["MODEL", "SET", "FACE", "SOLID", "VOLUME"].contains(&word);
    let has_surface = kind == "PLANE" || kind.split(['_', ' ']).any(|word| word == "SURFACE");
    has_surface && !has_no_surface(kind) && !kind.split(['_', ' ']).any(is_more)
}

impl Shapes<'_> {
    /// Returns the shape of an item of a representation; `None` for an item that has no surface, as points,
    /// curves and placements. One that cannot be read, or of a kind that is not known, is a face with the reason.
    ///
    /// # Errors
    /// If the file has too many shapes.
    pub(in crate::step) fn item(&mut self, instance: u64) -> Result<Option<Use>, FaceFault> {
        self.nested(instance, 0)
    }

    /// Returns the shape of an item that stands in `nesting` others.
    pub(super) fn nested(&mut self, instance: u64, nesting: usize) -> Result<Option<Use>, FaceFault> {
        let entity = match self.file.entity(instance) {
            Ok(entity) => entity,
            Err(fault) => return Ok(Some(used(self.unreadable(instance, fault)?, true))),
        };
        let kind = entity.kind.as_str();
        if nesting == MAX_NESTING {
            return Ok(Some(used(
                self.unreadable(instance, entity.unknown("a body of fewer levels"))?,
                true,
            )));
        }
        if FACES.contains(&kind) {
            return self.face(instance).map(Some);
        }
        if let Some(&known) = self.reached.get(&instance) {
            return Ok(Some(used(known, true)));
        }
        if is_surface(kind) {
            return self.loose_surface(instance).map(Some);
        }
        if has_no_surface(kind) && !SETS.contains(&kind) {
            return Ok(None);
        }
        let made = match self.tessellated(&entity) {
            Ok(Some(shape)) => Ok(shape),
            Ok(None) => self.body(&entity, nesting),
            Err(fault) => Err(fault),
        };
        let shape = match made {
            Ok(shape) => shape,
            Err(fault) => self.unreadable(instance, fault)?,
        };
        self.reach(instance, shape);
        Ok(Some(used(shape, true)))
    }
}
