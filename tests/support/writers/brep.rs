//! A writer of BREP texts, as OpenCASCADE's `BRepTools_ShapeSet` lays them out.

use std::fmt::Write;

/// A shape as a child: its index, and whether it is used forward.
#[derive(Debug, Clone, Copy)]
pub struct Child {
    pub shape: usize,
    pub sign: char,
    pub location: usize,
}

/// The shape used forward, where it is.
pub fn plus(shape: usize) -> Child {
    Child { shape, sign: '+', location: 0 }
}

/// The shape used in reverse, where it is.
pub fn minus(shape: usize) -> Child {
    Child { shape, sign: '-', location: 0 }
}

/// A text under construction. Sections are lists of entries; indices of curves, surfaces
/// and locations are from 1, and those of shapes from 0 in order of writing.
#[derive(Debug, Clone, Default)]
pub struct BrepText {
    pub version: u8,
    pub locations: Vec<String>,
    pub p_curves: Vec<String>,
    pub curves: Vec<String>,
    pub surfaces: Vec<String>,
    pub shapes: Vec<(String, Vec<Child>)>,
}

fn add(list: &mut Vec<String>, entry: impl Into<String>) -> usize {
    list.push(entry.into());
    list.len()
}

impl BrepText {
    pub fn new() -> Self {
        Self { version: 1, ..Self::default() }
    }

    pub fn location(&mut self, entry: impl Into<String>) -> usize {
        add(&mut self.locations, entry)
    }

    pub fn p_curve(&mut self, entry: impl Into<String>) -> usize {
        add(&mut self.p_curves, entry)
    }

    pub fn curve(&mut self, entry: impl Into<String>) -> usize {
        add(&mut self.curves, entry)
    }

    pub fn surface(&mut self, entry: impl Into<String>) -> usize {
        add(&mut self.surfaces, entry)
    }

    pub fn shape(&mut self, head: impl Into<String>, children: &[Child]) -> usize {
        self.shapes.push((head.into(), children.to_vec()));
        self.shapes.len() - 1
    }

    pub fn vertex(&mut self, point: [f64; 3]) -> usize {
        self.loose_vertex(point, 1e-7)
    }

    /// A vertex of this tolerance.
    pub fn loose_vertex(&mut self, [x, y, z]: [f64; 3], tolerance: f64) -> usize {
        self.shape(format!("Ve\n{tolerance:?}\n{x:?} {y:?} {z:?}\n0 0\n"), &[])
    }

    /// An edge of these representations, such as `1 curve location first last`.
    pub fn edge(&mut self, entries: &[String], vertices: [usize; 2]) -> usize {
        self.edge_of("1e-07 1 1 0", entries, vertices)
    }

    /// An edge of a pole.
    pub fn degenerate(&mut self, entries: &[String], vertex: usize) -> usize {
        self.edge_of("1e-07 1 1 1", entries, [vertex, vertex])
    }

    fn edge_of(&mut self, head: &str, entries: &[String], [start, end]: [usize; 2]) -> usize {
        self.shape(format!("Ed\n {head}\n{}\n0\n", entries.join("\n")), &[plus(start), minus(end)])
    }

    pub fn wire(&mut self, edges: &[Child]) -> usize {
        self.shape("Wi\n", edges)
    }

    pub fn face(&mut self, surface: usize, wires: &[usize]) -> usize {
        self.placed_face(surface, 0, wires)
    }

    pub fn placed_face(&mut self, surface: usize, location: usize, wires: &[usize]) -> usize {
        let wires: Vec<Child> = wires.iter().map(|&wire| plus(wire)).collect();
        self.shape(format!("Fa\n0  1e-07 {surface} {location}\n"), &wires)
    }

    /// A face of one loop of parameter curves without edges in space. Each curve is an
    /// entry of the section with its range.
    pub fn region(&mut self, surface: usize, loops: &[Vec<(String, [f64; 2])>]) -> usize {
        let mut wires = Vec::new();
        for curves in loops {
            let mut edges = Vec::new();
            for (entry, [first, last]) in curves {
                let p_curve = self.p_curve(entry.clone());
                let vertices = [self.vertex([0.0; 3]), self.vertex([0.0; 3])];
                let entry = format!("2 {p_curve} {surface} 0 {first:?} {last:?}");
                edges.push(plus(self.edge(&[entry], vertices)));
            }
            wires.push(self.wire(&edges));
        }
        self.face(surface, &wires)
    }

    /// The text, with this shape as the root.
    pub fn text(&self, root: Child) -> String {
        let mut out = format!("\nCASCADE Topology V{}, (c) Matra-Datavision\n", self.version);
        let count = self.shapes.len();
        let mut section = |name: &str, entries: &[String]| {
            let _ = writeln!(out, "{name} {}", entries.len());
            for entry in entries {
                let _ = writeln!(out, "{entry}");
            }
        };
        section("Locations", &self.locations);
        section("Curve2ds", &self.p_curves);
        section("Curves", &self.curves);
        section("Polygon3D", &[]);
        section("PolygonOnTriangulations", &[]);
        section("Surfaces", &self.surfaces);
        section("Triangulations", &[]);
        let child = |child: &Child| format!("{}{} {} ", child.sign, count - child.shape, child.location);
        let shape = |(head, children): &(String, Vec<Child>)| {
            format!("{head}\n0101000\n{}*", children.iter().map(child).collect::<String>())
        };
        section("\nTShapes", &self.shapes.iter().map(shape).collect::<Vec<_>>());
        let _ = writeln!(out, "\n{}", child(&root));
        out
    }
}

/// The line through two points of the parameters, as an entry with its range.
pub fn line([u0, v0]: [f64; 2], [u1, v1]: [f64; 2]) -> (String, [f64; 2]) {
    let length = (u1 - u0).hypot(v1 - v0);
    let entry = format!("1 {u0:?} {v0:?} {:?} {:?}", (u1 - u0) / length, (v1 - v0) / length);
    (entry, [0.0, length])
}

/// The polygon through these points as lines.
pub fn polygon(points: &[[f64; 2]]) -> Vec<(String, [f64; 2])> {
    (0..points.len()).map(|index| line(points[index], points[(index + 1) % points.len()])).collect()
}

/// A rectangle, counter-clockwise.
pub fn rectangle([u0, v0]: [f64; 2], [u1, v1]: [f64; 2]) -> Vec<(String, [f64; 2])> {
    polygon(&[[u0, v0], [u1, v0], [u1, v1], [u0, v1]])
}

/// A circle in the parameters, counter-clockwise or clockwise.
pub fn circle([u, v]: [f64; 2], radius: f64, turn: f64) -> Vec<(String, [f64; 2])> {
    vec![(format!("2 {u:?} {v:?} 1 0 0 {turn:?} {radius:?}"), [0.0, std::f64::consts::TAU])]
}
