//! Vertices, edges, faces and bodies of the file as the shapes of a topology.

mod bodies;
mod edges;
mod faces;
mod loops;
mod loose;
mod p_curves;
mod spheres;

use super::exchange::Exchange;
use super::geometry::{Scale, surface};
use super::styles::colors;
use super::units::Units;
use crate::brep::report::FaceFault;
use crate::brep::topology::{Color, Orientation, Shape, ShapeKind, Topology, Use};
use edges::Segment;
use glam::DAffine3;
use std::collections::{HashMap, HashSet};

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
        }
    }

    /// Returns whether a face or body stands in a representation.
    pub(super) fn was_reached(&self, instance: u64) -> bool {
        self.reached.contains_key(&instance) || self.elsewhere.contains(&instance)
    }

    /// States the shape of a face or body.
    fn reach(&mut self, instance: u64, shape: usize) {
        self.reached.insert(instance, shape);
        if let Some(&color) = self.colors.get(&instance) {
            self.topology.colors.insert(shape, color);
        }
    }

    /// Returns the use of a part at a place that may have a name and a colour.
    pub(super) fn place(
        &mut self,
        instance: u64,
        name: Option<String>,
        part: Use,
        location: DAffine3,
    ) -> Result<Use, FaceFault> {
        let color = self.colors.get(&instance).copied();
        if name.is_none() && color.is_none() {
            return Ok(Use { location, ..part });
        }
        let kind = name.map_or(ShapeKind::Group(None), ShapeKind::Place);
        let shape = self.push(kind, vec![part])?;
        self.topology.colors.extend(color.map(|color| (shape, color)));
        Ok(Use { location, ..used(shape, true) })
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

/// The use of a shape where it is.
pub(super) fn used(shape: usize, forward: bool) -> Use {
    let orientation = if forward { Orientation::Forward } else { Orientation::Reversed };
    Use { shape, orientation, location: DAffine3::IDENTITY }
}
