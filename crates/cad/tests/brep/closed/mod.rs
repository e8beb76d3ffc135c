//! Faces on surfaces that are closed in one or both directions.

mod holes;
mod notes;
mod poles;
mod solids;
mod wires;

use crate::support::writers::brep::{BrepText, Child};

/// The torus about z of the radii 15 and 4, and its area 4π² R r.
const TORUS: &str = "5 0 0 0 0 0 1 1 0 0 0 1 0 15 4";
const TORUS_AREA: f64 = 4.0 * std::f64::consts::PI * std::f64::consts::PI * 15.0 * 4.0;

/// The part of that torus within these parameters.
fn torus_area([u0, v0]: [f64; 2], [u1, v1]: [f64; 2]) -> f64 {
    4.0 * (u1 - u0) * (15.0 * (v1 - v0) + 4.0 * (v1.sin() - v0.sin()))
}

/// The two seams of a surface closed both ways, each with its curves in the parameters, its edge in
/// space or both.
struct Seams {
    /// The curves of the surface along its two seams.
    along: [String; 2],
    /// The place of the seams.
    start: [f64; 2],
    periods: [f64; 2],
}

impl Seams {
    /// The edges of both seams: along u at the start of v, and along v at the start of u.
    fn edges(&self, text: &mut BrepText, surface: usize, curves: bool, space: bool) -> [usize; 2] {
        let ([u, v], [du, dv]) = (self.start, self.periods);
        let vertex = text.vertex([0.0; 3]);
        let ends = [[0.0, du], [0.0, dv]];
        let lines = [
            [format!("1 {u:?} {v:?} 1 0"), format!("1 {u:?} {:?} 1 0", v + dv)],
            [format!("1 {:?} {v:?} 0 1", u + du), format!("1 {u:?} {v:?} 0 1")],
        ];
        [0, 1].map(|axis| {
            let [_, last] = ends[axis];
            let mut entries = Vec::new();
            if space {
                let curve = text.curve(&self.along[axis]);
                entries.push(format!("1 {curve} 0 0 {last:?}"));
            }
            if curves {
                let [forward, backward] = lines[axis].each_ref().map(|line| text.p_curve(line));
                entries.push(format!("3 {forward} {backward}CN {surface} 0 0 {last:?}"));
            }
            text.edge(&entries, [vertex, vertex])
        })
    }
}

/// All orders of a list.
fn orders(items: &[Child]) -> Vec<Vec<Child>> {
    if items.len() < 2 {
        return vec![items.to_vec()];
    }
    let mut all = Vec::new();
    for first in 0..items.len() {
        let mut rest = items.to_vec();
        let item = rest.remove(first);
        all.extend(orders(&rest).into_iter().map(|order| [vec![item], order].concat()));
    }
    all
}
