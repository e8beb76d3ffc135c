//! A plate with two bores, as STEP.

use super::step::{Id, StepText, UnitsOf};

/// A plate's lengths in millimetres; a corner is the origin.
pub(super) struct Plate<const BORES: usize> {
    pub(super) size: [f64; 3],
    /// The places of the bores along the length; all are in the middle of the width.
    pub(super) bores: [(&'static str, f64); BORES],
    pub(super) radius: f64,
}

impl Plate<2> {
    /// The plate as it was.
    pub(super) const FIRST: Self =
        Self { size: [80.0, 50.0, 8.0], bores: [("bore left", 20.0), ("bore right", 60.0)], radius: 9.0 };

    /// Its revision: the right bore is 0.3 mm farther right.
    pub(super) const REVISED: Self =
        Self { bores: [("bore left", 20.0), ("bore right", 60.3)], ..Self::FIRST };
}

impl<const BORES: usize> Plate<BORES> {
    /// Returns the plate as the text of a STEP file: one solid of six faces and the bores' walls.
    pub(super) fn step(&self) -> String {
        let mut text = StepText::new();
        let [length, width, height] = self.size;
        let base = [[0.0, 0.0], [length, 0.0], [length, width], [0.0, width]];
        let corners = [0.0, height].map(|z| base.map(|[x, y]| [x, y, z]));
        let vertices = corners.map(|ring| ring.map(|corner| text.vertex(corner)));
        let rings = [0, 1].map(|end| ring(&mut text, corners[end], vertices[end]));
        let uprights = [0, 1, 2, 3].map(|i| {
            let curve = text.line(corners[0][i], [0.0, 0.0, 1.0]);
            text.edge(curve, [vertices[0][i], vertices[1][i]], true)
        });
        let bores = self.bores.map(|(name, x)| self.bore(&mut text, name, x));

        let mut faces = Vec::new();
        for (end, name) in [(0, "bottom"), (1, "top")] {
            let along = |i: usize| (rings[end][i], end == 1);
            let outer = if end == 1 { [0, 1, 2, 3].map(along) } else { [3, 2, 1, 0].map(along) };
            let mut loops = vec![text.edge_loop(&outer)];
            loops.extend(bores.iter().map(|bore| text.edge_loop(&[(bore.circles[end], end == 0)])));
            let normal = [0.0, 0.0, if end == 1 { 1.0 } else { -1.0 }];
            faces.push(plane(&mut text, name, corners[end][0], normal, &loops));
        }
        for (i, name) in ["front", "right end", "back", "left end"].into_iter().enumerate() {
            let next = (i + 1) % 4;
            let sides =
                [(rings[0][i], true), (uprights[next], true), (rings[1][i], false), (uprights[i], false)];
            let path = text.edge_loop(&sides);
            let normal = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]][i];
            faces.push(plane(&mut text, name, corners[0][i], normal, &[path]));
        }
        faces.extend(bores.map(|bore| bore.face));
        let solid = text.solid("plate", &faces);
        text.of(&[solid], UnitsOf::Millimetres)
    }

    /// Adds a bore through the plate: its wall with a seam, and the circles at its ends.
    fn bore(&self, text: &mut StepText, name: &str, x: f64) -> Bore {
        let [_, width, height] = self.size;
        let (center, seam) = (width / 2.0, x + self.radius);
        let ends = [0.0, height];
        let vertices = ends.map(|z| text.vertex([seam, center, z]));
        let circles = [0, 1].map(|end| {
            let placement = text.placement([x, center, ends[end]], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
            let curve = text.circle(placement, self.radius);
            text.edge(curve, [vertices[end]; 2], true)
        });
        let line = text.line([seam, center, 0.0], [0.0, 0.0, 1.0]);
        let upright = text.edge(line, vertices, true);
        let placement = text.placement([x, center, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
        let surface = text.add(format!("CYLINDRICAL_SURFACE('',#{placement},{:?})", self.radius));
        // The material is outside the cylinder, so that the face's normal points to its axis.
        let path =
            text.edge_loop(&[(upright, true), (circles[1], true), (upright, false), (circles[0], false)]);
        let face = face(text, name, &[path], surface, false);
        Bore { circles, face }
    }
}

struct Bore {
    circles: [Id; 2],
    face: Id,
}

/// The directions of a ring's edges.
const ALONG: [[f64; 3]; 4] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]];

/// Adds the edges of a ring of corners.
fn ring(text: &mut StepText, corners: [[f64; 3]; 4], vertices: [Id; 4]) -> [Id; 4] {
    [0, 1, 2, 3].map(|i| {
        let curve = text.line(corners[i], ALONG[i]);
        text.edge(curve, [vertices[i], vertices[(i + 1) % 4]], true)
    })
}

/// Adds a face in the plane through a point with an outward normal.
fn plane(text: &mut StepText, name: &str, point: [f64; 3], normal: [f64; 3], loops: &[Id]) -> Id {
    let placement = text.axis(point, normal);
    let surface = text.add(format!("PLANE('',#{placement})"));
    face(text, name, loops, surface, true)
}

fn face(text: &mut StepText, name: &str, loops: &[Id], surface: Id, same_sense: bool) -> Id {
    let bounds: Vec<String> = loops.iter().map(|&path| format!("#{}", text.bound(path, true))).collect();
    let sense = if same_sense { ".T." } else { ".F." };
    text.add(format!("ADVANCED_FACE('{name}',({}),#{surface},{sense})", bounds.join(",")))
}
