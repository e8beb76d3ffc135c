//! Vertices, edges, faces and bodies of the file as the shapes of a topology.

mod bodies;
mod edges;
mod faces;
mod items;
mod loops;
mod loose;
mod p_curves;
mod primitives;
mod spheres;
mod triangles;

use super::exchange::Exchange;
use super::geometry::{Scale, surface};
use super::styles::colors;
use super::units::Units;
use crate::report::FaceFault;
use crate::topology::{Color, Orientation, Shape, ShapeKind, Topology, Use};
use bodies::{BODIES, SHELLS};
use edges::Segment;
use glam::DAffine3;
use items::{FACES, SETS, is_surface};
use std::collections::{HashMap, HashSet};
use triangles::{Coordinates, TESSELLATED, TRIANGULATED};

/// The most shapes of a topology. An entity may be used by many others, so that a short file
/// could describe more than memory holds.
const MAX_SHAPES: usize = 1 << 24;

/// A topology under construction. An entity becomes one shape, however often it is used.
pub(super) struct Shapes<'a> {
    pub(super) file: &'a Exchange<'a>,
    pub(super) topology: Topology,
    units: Units,
    /// The colours of faces, bodies and mapped items, by their instances.
    colors: HashMap<u64, Color>,
    /// The shapes of faces and bodies, by their instances.
    reached: HashMap<u64, usize>,
    /// The faces and bodies of representations in other units.
    elsewhere: HashSet<u64>,
    vertices: HashMap<u64, Result<usize, FaceFault>>,
    edges: HashMap<u64, Result<Vec<Segment>, FaceFault>>,
    surfaces: HashMap<u64, Result<usize, FaceFault>>,
    coordinates: HashMap<u64, Coordinates>,
    /// Meshes, each with what its parts are pictures of.
    pictures: Vec<(usize, Vec<Option<u64>>)>,
    /// The instances that could not be read, whose parts are named with them.
    refused: HashSet<u64>,
}

impl<'a> Shapes<'a> {
    pub(super) fn new(file: &'a Exchange<'a>) -> Self {
        let root = Use { shape: 0, orientation: Orientation::Forward, location: DAffine3::IDENTITY };
        let topology = Topology {
            p_curves: Vec::new(),
            curves: Vec::new(),
            surfaces: Vec::new(),
            shapes: Vec::new(),
            root,
            unit: None,
            colors: HashMap::new(),
            remarks: Vec::new(),
        };
        Self {
            file,
            topology,
            units: Units::NONE,
            colors: colors(file),
            reached: HashMap::new(),
            elsewhere: HashSet::new(),
            vertices: HashMap::new(),
            edges: HashMap::new(),
            surfaces: HashMap::new(),
            coordinates: HashMap::new(),
            pictures: Vec::new(),
            refused: HashSet::new(),
        }
    }

    /// Sets the units of the entities that are read from now on. Entities that representations
    /// of several units share are read once for each.
    pub(super) fn set_units(&mut self, units: Units) {
        if units != self.units {
            self.units = units;
            self.elsewhere.extend(self.reached.drain().map(|(instance, _)| instance));
            self.vertices.clear();
            self.edges.clear();
            self.surfaces.clear();
            self.coordinates.clear();
        }
    }

    /// Returns whether a face or body stands in a representation.
    pub(super) fn was_reached(&self, instance: u64) -> bool {
        self.reached.contains_key(&instance) || self.elsewhere.contains(&instance)
    }

    /// Returns whether any face or mesh was read.
    pub(super) fn has_shapes(&self) -> bool {
        let is_read = |shape: &Shape| match &shape.kind {
            ShapeKind::Face(face) => face.surface.is_ok(),
            kind => matches!(kind, ShapeKind::Mesh(_)),
        };
        self.topology.shapes.iter().any(is_read)
    }

    /// Returns whether an instance was named as one that cannot be read.
    pub(super) fn was_refused(&self, instance: u64) -> bool {
        self.refused.contains(&instance)
    }

    /// States the shape of a face or body.
    fn reach(&mut self, instance: u64, shape: usize) {
        self.reached.insert(instance, shape);
        if let Some(&color) = self.colors.get(&instance) {
            self.topology.colors.insert(shape, color);
        }
    }

    /// Returns the use of a part at a place that may have a name and a colour, and may be an occurrence of its own.
    pub(super) fn place(
        &mut self,
        instance: u64,
        name: Option<String>,
        part: Use,
        (location, is_occurrence): (DAffine3, bool),
    ) -> Result<Use, FaceFault> {
        let mut part = part;
        let is_named = name.is_some();
        if is_named || is_occurrence {
            part = used(self.push(ShapeKind::Place { name, is_occurrence }, vec![part])?, true);
        }
        if let Some(&color) = self.colors.get(&instance) {
            if !is_named {
                part = used(self.push(ShapeKind::Group(None), vec![part])?, true);
            }
            self.topology.colors.insert(part.shape, color);
        }
        Ok(Use { location, ..part })
    }

    fn scale(&self) -> Scale {
        Scale::of_space(&self.units)
    }

    /// Appends a shape.
    pub(super) fn push(&mut self, kind: ShapeKind, children: Vec<Use>) -> Result<usize, FaceFault> {
        if self.topology.shapes.len() >= MAX_SHAPES {
            return Err(FaceFault::new("STEP_TOO_MANY_SHAPES", "the file has more than 16777216 shapes"));
        }
        self.topology.shapes.push(Shape { kind, children });
        Ok(self.topology.shapes.len() - 1)
    }

    /// Returns the index of a surface.
    fn surface(&mut self, instance: u64) -> Result<usize, FaceFault> {
        if let Some(known) = self.surfaces.get(&instance) {
            return known.clone();
        }
        let found = surface(self.file, instance, &self.scale()).map(|surface| {
            self.topology.surfaces.push(surface);
            self.topology.surfaces.len() - 1
        });
        self.surfaces.insert(instance, found.clone());
        found
    }
}

/// Other solids of constructive geometry, which a representation may hold by themselves.
const SOLIDS: [&str; 9] = [
    "CSG_SOLID",
    "BLOCK",
    "SPHERE",
    "TORUS",
    "RIGHT_CIRCULAR_CYLINDER",
    "RIGHT_CIRCULAR_CONE",
    "RIGHT_ANGULAR_WEDGE",
    "ELLIPSOID",
    "BOOLEAN_RESULT",
];

/// Returns whether an entity is a face, and no use of one.
pub(super) fn is_face(kind: &str) -> bool {
    FACES.contains(&kind) && kind != "ORIENTED_FACE"
}

/// Returns whether an instance is a body, a mesh, or a set with a surface.
pub(super) fn is_body(file: &Exchange<'_>, instance: u64) -> bool {
    let kind = file.keyword(instance);
    if SETS.contains(&kind) {
        let elements = file.entity(instance).and_then(|set| set.references(1));
        return elements
            .is_ok_and(|elements| elements.iter().any(|&element| is_surface(file.keyword(element))));
    }
    [&SHELLS[..], &BODIES, &SOLIDS].iter().any(|kinds| kinds.contains(&kind)) || is_triangles(kind)
}

/// Returns whether an entity is made of triangles.
pub(super) fn is_triangles(kind: &str) -> bool {
    TESSELLATED.contains(&kind) || TRIANGULATED.iter().any(|(known, ..)| *known == kind)
}

/// The use of a shape where it is.
pub(super) fn used(shape: usize, forward: bool) -> Use {
    let orientation = if forward { Orientation::Forward } else { Orientation::Reversed };
    Use { shape, orientation, location: DAffine3::IDENTITY }
}
