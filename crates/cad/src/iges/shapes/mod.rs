//! Edges, faces and bodies of the file as the shapes of a topology.

mod assembly;
mod boundaries;
mod colors;
mod edges;
mod faces;
mod pairing;
mod solids;

pub(super) use assembly::read;

use super::file::{Entry, File, Found};
use super::geometry::{Carrier, Scale, carrier};
use crate::nurbs::Surface;
use crate::report::{FaceFault, Remark};
use crate::topology::{Face, FaceLabel, Orientation, Shape, ShapeKind, Topology, Use};
use edges::Segment;
use glam::{DAffine2, DAffine3};
use std::collections::{HashMap, HashSet};

/// The most shapes of a topology. An entity may be used by many others, so that a short file
/// could describe more than memory holds.
const MAX_SHAPES: usize = 1 << 24;

/// The most control points of all curves, half a gibibyte: a curve may bound many faces.
const MAX_POLES: usize = 1 << 24;

/// The least tolerance of edges and vertices in millimetres: that of OpenCASCADE.
const TOLERANCE: f64 = 1e-7;

/// Metres per unit of the model, whatever the unit of the file: a millimetre.
const METRES: f64 = 1e-3;

/// A topology under construction. An entity becomes one shape, however often it is used.
struct Shapes<'a> {
    file: &'a File<'a>,
    topology: Topology,
    scale: Scale,
    /// The tolerance of edges and vertices in millimetres.
    tolerance: f64,
    /// The shapes of faces and bodies, by their numbers.
    reached: HashMap<u64, usize>,
    /// Groups under construction, in which they cannot stand again.
    open: HashSet<u64>,
    surfaces: HashMap<u64, Found<Sheet>>,
    /// The edges of lists, by the list and the place in it.
    edges: HashMap<(u64, usize), Found<Vec<Segment>>>,
    /// The vertices of lists, likewise.
    vertices: HashMap<(u64, usize), usize>,
    poles: usize,
}

/// A surface of the topology, with the place and the parameters that the file gives it.
#[derive(Debug, Clone, Copy)]
struct Sheet {
    surface: usize,
    location: DAffine3,
    parameters: Option<DAffine2>,
    /// The offset to the other side.
    other_side: Option<usize>,
}

impl<'a> Shapes<'a> {
    fn new(file: &'a File<'a>, millimetres: f64) -> Self {
        let topology = Topology {
            p_curves: Vec::new(),
            curves: Vec::new(),
            surfaces: Vec::new(),
            shapes: Vec::new(),
            root: used(0, true),
            unit: Some(METRES),
            colors: HashMap::new(),
            remarks: Vec::new(),
        };
        Self {
            file,
            topology,
            scale: Scale(millimetres),
            tolerance: (file.global.resolution * millimetres).max(TOLERANCE),
            reached: HashMap::new(),
            open: HashSet::new(),
            surfaces: HashMap::new(),
            edges: HashMap::new(),
            vertices: HashMap::new(),
            poles: 0,
        }
    }

    /// Appends a shape.
    fn push(&mut self, kind: ShapeKind, children: Vec<Use>) -> Found<usize> {
        if self.topology.shapes.len() >= MAX_SHAPES {
            return Err(FaceFault::new("IGES_TOO_LARGE", "the file has more than 16777216 shapes"));
        }
        self.topology.shapes.push(Shape { kind, children });
        Ok(self.topology.shapes.len() - 1)
    }

    /// Appends a face of an entity.
    fn push_face_of(
        &mut self,
        entry: &Entry,
        sheet: &Sheet,
        above: &DAffine3,
        wires: Vec<Use>,
        remarks: Vec<Remark>,
    ) -> Found<usize> {
        let label = FaceLabel { entity: Some(entry.number), name: entry.name() };
        let location = *above * sheet.location;
        let Sheet { surface, other_side, .. } = *sheet;
        self.push(ShapeKind::Face(Face { location, label, remarks, other_side, ..Face::on(surface) }), wires)
    }

    /// Appends a face that cannot be read.
    fn unreadable(&mut self, number: u64, fault: FaceFault) -> Found<usize> {
        let name = self.file.entry(number).ok().and_then(Entry::name);
        let label = FaceLabel { entity: Some(number), name };
        self.push(ShapeKind::Face(Face { surface: Err(fault), label, ..Face::on(0) }), Vec::new())
    }

    /// Returns the surface of an entity.
    fn sheet(&mut self, number: u64) -> Found<Sheet> {
        if let Some(known) = self.surfaces.get(&number) {
            return known.clone();
        }
        let found = carrier(self.file, number, self.scale);
        let found = found.map(|Carrier { surface, location, parameters, other_side }| {
            let mut index = |surface: Surface| {
                self.topology.surfaces.push(surface);
                self.topology.surfaces.len() - 1
            };
            Sheet { surface: index(surface), location, parameters, other_side: other_side.map(index) }
        });
        self.surfaces.insert(number, found.clone());
        found
    }

    /// Returns whether a surface is a plane, cylinder, cone or torus, on which curves in the
    /// parameters follow from those in space by formula, and writers differ in the parameters. On a
    /// sphere these say how a curve passes a pole.
    fn is_elementary(&self, sheet: &Sheet) -> bool {
        match self.topology.surfaces[sheet.surface] {
            Surface::Plane(_) => true,
            Surface::Revolution { kind, .. } => kind != "sphere",
            _ => false,
        }
    }

    /// Counts control points of curves.
    fn spend(&mut self, poles: usize) -> Found<()> {
        self.poles = self.poles.saturating_add(poles);
        if self.poles > MAX_POLES {
            let why = "the curves up to this face have more than 16777216 control points";
            return Err(FaceFault::new("IGES_TOO_LARGE", why));
        }
        Ok(())
    }
}

/// The use of a shape where it is.
fn used(shape: usize, forward: bool) -> Use {
    let orientation = if forward { Orientation::Forward } else { Orientation::Reversed };
    Use { shape, orientation, location: DAffine3::IDENTITY }
}
