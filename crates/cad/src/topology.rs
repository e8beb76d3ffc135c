//! The plain description of a boundary representation that every reader of a format makes.

use super::nurbs::{Curve, Surface};
use super::report::{FaceFault, Remark};
use glam::{DAffine3, DVec3};
use std::collections::HashMap;

/// Red, green and blue of sRGB, each from 0 to 1.
pub(crate) type Color = [f64; 3];

/// Faces, their edges and what they stand in. Indices are from 0.
#[derive(Debug)]
pub(crate) struct Topology {
    /// Curves in parameter planes, as curves of the plane z = 0.
    pub(crate) p_curves: Vec<Curve>,
    pub(crate) curves: Vec<Curve>,
    pub(crate) surfaces: Vec<Surface>,
    /// Every shape follows its children.
    pub(crate) shapes: Vec<Shape>,
    pub(crate) root: Use,
    /// Metres per unit of length, if the file states it.
    pub(crate) unit: Option<f64>,
    /// The colours of shapes, which hold for what stands in them and has none of its own.
    pub(crate) colors: HashMap<usize, Color>,
    /// What the report says of the file, with its first face.
    pub(crate) remarks: Vec<Remark>,
}

/// A shape and its children.
#[derive(Debug)]
pub(crate) struct Shape {
    pub(crate) kind: ShapeKind,
    pub(crate) children: Vec<Use>,
}

#[derive(Debug)]
pub(crate) enum ShapeKind {
    /// A vertex with its tolerance.
    Vertex(f64),
    Edge(Edge),
    Wire,
    Face(Face),
    Mesh(Mesh),
    /// Any set of shapes, with the name of the part that it is.
    Group(Option<String>),
    /// A set of shapes that bounds a solid: an outer shell and its voids.
    Solid(Option<String>),
    /// A place of a part, with its name.
    Place {
        name: Option<String>,
        /// Whether it is a use of its own by the structure of products, so that another one at the same place is
        /// another part.
        is_occurrence: bool,
    },
}

/// A shape as the child of another.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Use {
    /// The index in [`Topology::shapes`].
    pub(crate) shape: usize,
    pub(crate) orientation: Orientation,
    pub(crate) location: DAffine3,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Orientation {
    Forward,
    Reversed,
    /// Within the shape that it belongs to, so that it bounds nothing.
    Internal,
    /// Outside of the shape that it belongs to, so that it bounds nothing.
    External,
}

impl Orientation {
    /// Returns the orientation of the shape turned round.
    pub(crate) fn opposite(self) -> Self {
        match self {
            Self::Forward => Self::Reversed,
            Self::Reversed => Self::Forward,
            other => other,
        }
    }
}

/// The curves of an edge.
#[derive(Debug)]
pub(crate) struct Edge {
    pub(crate) tolerance: f64,
    pub(crate) degenerate: bool,
    pub(crate) curve: Option<SpaceCurve>,
    pub(crate) p_curves: Vec<PCurve>,
}

/// A curve in space, restricted to a range of its parameter.
#[derive(Debug)]
pub(crate) struct SpaceCurve {
    /// The index in the file's list of curves.
    pub(crate) curve: usize,
    pub(crate) location: DAffine3,
    pub(crate) range: [f64; 2],
}

/// A curve, or the two curves of a seam, in the parameter plane of a surface.
#[derive(Debug)]
pub(crate) struct PCurve {
    /// The index of the curve of an edge used forward, then of one used reversed.
    pub(crate) curves: [usize; 2],
    pub(crate) surface: usize,
    pub(crate) location: DAffine3,
    pub(crate) range: [f64; 2],
}

#[derive(Debug)]
pub(crate) struct Face {
    /// The index in [`Topology::surfaces`], or the reason for which the face cannot be read.
    pub(crate) surface: Result<usize, FaceFault>,
    /// The surface that the face is on if its edges are not on the one stated: that of an offset to the other side.
    pub(crate) other_side: Option<usize>,
    pub(crate) location: DAffine3,
    pub(crate) label: FaceLabel,
    /// What the report says of the face.
    pub(crate) remarks: Vec<Remark>,
}

impl Face {
    /// The face of a surface where it is, without a label.
    pub(crate) fn on(surface: usize) -> Self {
        Self {
            surface: Ok(surface),
            other_side: None,
            location: DAffine3::IDENTITY,
            label: FaceLabel::default(),
            remarks: Vec::new(),
        }
    }
}

/// Triangles of a file.
#[derive(Debug, Default)]
pub(crate) struct Mesh {
    pub(crate) vertices: Vec<DVec3>,
    /// The indices of the vertices of each.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// The kind of entity that they are in the file.
    pub(crate) kind: String,
    pub(crate) label: FaceLabel,
    /// Whether faces that were read stand for all of it.
    pub(crate) is_picture: bool,
}

/// The identification of a face in its file.
#[derive(Debug, Clone, Default)]
pub(crate) struct FaceLabel {
    /// The number by which the file calls the face.
    pub(crate) entity: Option<u64>,
    pub(crate) name: Option<String>,
}
