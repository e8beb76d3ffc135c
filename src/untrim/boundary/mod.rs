//! The boundary of a face as arcs of increasing v between vertices.
//!
//! A vertex is snapped once, and its floats are handed down: no stage infers them from the ends
//! of a curve, whose division by the weight rounds.

pub(super) mod graph;
mod polynomial;
mod run;
mod snapper;

use super::curve::Curve;
use super::face::UnitFace;
use glam::DVec2;
use graph::Graph;
use polynomial::polynomial_pieces;
use run::{Run, Runs, is_smooth, is_straight, split};
use snapper::Snapper;

/// One side of a cell.
#[derive(Debug, Clone)]
pub(super) enum Side {
    /// A polynomial graph over v.
    Graph(Graph),
    /// A curve in its own parameter, with v increasing.
    Own(Curve),
}

/// A part of the boundary on which v increases, or a line that cells meet in.
#[derive(Debug, Clone)]
pub(super) struct Arc {
    pub(super) side: Side,
    /// The values of v of its two vertices, the first smaller.
    pub(super) v: [f64; 2],
    /// The change of the winding number from its left to its right; 0 within the face.
    pub(super) change: i32,
}

/// A part of the boundary on which v is constant after snapping.
#[derive(Debug, Clone, Copy)]
pub(super) struct Flat {
    pub(super) v: f64,
    pub(super) u: [f64; 2],
}

/// The boundary of a face, ready for the sweep.
#[derive(Default)]
pub(super) struct Boundary {
    pub(super) arcs: Vec<Arc>,
    pub(super) flats: Vec<Flat>,
    /// The values of v at which an arc may cross a knot line of u.
    pub(super) crossings: Vec<f64>,
    /// The largest moves of boundary points in u and v, by snapping and by polynomial pieces.
    pub(super) moved: [f64; 2],
    /// The largest error in u of a graph.
    pub(super) graph_error: f64,
}

/// The degree up to which boundaries of affine faces stay as they are.
const MAX_EXACT_DEGREE: usize = 3;

/// The largest degree of a composition with a curve in its own parameter.
const MAX_COMPOSED_DEGREE: usize = 120;

/// Splits the loops where v is stationary and at knots, snaps the ends, and joins chains
/// to graphs. `Err` says in words what prevents it.
pub(super) fn boundary(face: &UnitFace) -> Result<Boundary, String> {
    let loops: Vec<Vec<Curve>> = face
        .loops
        .iter()
        .map(|curves| curves.iter().flat_map(|curve| split(face, curve)).collect())
        .collect();
    let mut snapper = Snapper::new(face, loops.iter().flatten());
    let mut boundary = Boundary::default();
    for curves in &loops {
        let Runs { runs, flats, crossings, moved } = Runs::of_loop(face, &snapper, curves)?;
        boundary.flats.extend(flats);
        boundary.crossings.extend(crossings);
        boundary.include(moved);
        let ends_chain = |index: usize| match (&runs[(index + runs.len() - 1) % runs.len()], &runs[index]) {
            (Some(before), Some(after)) => before.change != after.change || !is_smooth(face, before, after),
            _ => true,
        };
        let first = (0..runs.len()).find(|&index| ends_chain(index)).unwrap_or(0);
        let breaks: Vec<bool> = (0..runs.len()).map(|k| ends_chain((first + k) % runs.len())).collect();
        let mut runs = runs;
        runs.rotate_left(first);
        let mut chain: Vec<Run> = Vec::new();
        for (run, begins) in runs.into_iter().zip(breaks) {
            if begins {
                boundary.add_chain(face, &mut snapper, std::mem::take(&mut chain))?;
            }
            chain.extend(run);
        }
        boundary.add_chain(face, &mut snapper, chain)?;
    }
    Ok(boundary)
}

impl Boundary {
    /// Includes moves of boundary points.
    fn include(&mut self, moved: [f64; 2]) {
        self.moved = [0, 1].map(|axis| self.moved[axis].max(moved[axis]));
    }

    /// Adds a chain of runs of one direction, in the order of their loop.
    fn add_chain(
        &mut self,
        face: &UnitFace,
        snapper: &mut Snapper,
        mut chain: Vec<Run>,
    ) -> Result<(), String> {
        let Some(first) = chain.first() else { return Ok(()) };
        if first.change > 0 {
            chain.reverse();
        }
        self.add_runs(face, snapper, &chain)
    }

    /// Adds runs of increasing v head to tail as one graph, or as the graphs of their halves.
    fn add_runs(&mut self, face: &UnitFace, snapper: &mut Snapper, runs: &[Run]) -> Result<(), String> {
        let (first, last) = (&runs[0], &runs[runs.len() - 1]);
        let ends = [first.ends[0], last.ends[1]];
        let (v, change) = ([ends[0].y, ends[1].y], first.change);
        let is_exact = runs.len() == 1
            && face.affine
            && first.curve.degree() <= MAX_EXACT_DEGREE
            && !is_straight(&first.curve);
        if !is_exact && let Some((graph, error)) = graph::fit(runs, ends, face.tolerances.graph) {
            self.graph_error = self.graph_error.max(error);
            self.arcs.push(Arc { side: Side::Graph(graph), v, change });
            return Ok(());
        }
        if runs.len() > 1 {
            let (low, high) = runs.split_at(runs.len() / 2);
            self.add_runs(face, snapper, low)?;
            return self.add_runs(face, snapper, high);
        }
        let curve = &first.curve;
        let patch_degree: usize = face.patch([0, 0]).degree.iter().sum();
        let is_cheap = curve.is_polynomial() && curve.degree() * patch_degree <= MAX_COMPOSED_DEGREE;
        if face.affine || is_cheap {
            self.arcs.push(Arc { side: Side::Own(curve.clone()), v, change });
            return Ok(());
        }
        self.add_pieces(face, snapper, first)
    }

    /// Adds a run as polynomial curves, whose joints take a level that is near.
    fn add_pieces(&mut self, face: &UnitFace, snapper: &mut Snapper, run: &Run) -> Result<(), String> {
        let (pieces, error) = polynomial_pieces(&run.curve, face.tolerances.snap)?;
        let count = pieces.len();
        let [mut low, end] = run.ends;
        for (index, mut piece) in pieces.into_iter().enumerate() {
            let high = if index + 1 == count {
                end
            } else {
                let joint = piece.end();
                DVec2::new(joint.x, snapper.level(joint.y, [low.y, end.y]))
            };
            let moved = run::anchor(&mut piece, [low, high]);
            self.include([0, 1].map(|axis| run.moved[axis] + error[axis] + moved[axis]));
            self.arcs.push(Arc { side: Side::Own(piece), v: [low.y, high.y], change: run.change });
            low = high;
        }
        Ok(())
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::untrim::testing::{face_within, plane};

    /// Two corners of a pentagon are at levels that are one within the tolerance.
    #[test]
    fn vertices_that_are_moved_to_one_level_state_the_move() {
        let apart = 1e-11;
        let corners = [[0.5, 0.1], [0.9, 0.5], [0.6, 0.9], [0.2, 0.8], [0.1, 0.5 + apart]];
        let mut face = face_within(&plane(), &[&corners]);
        face.tolerances.snap = [1e-10; 2];
        let found = boundary(&face).unwrap();
        assert!((0.5 * apart..=2.0 * apart).contains(&found.moved[1]), "{:?}", found.moved);
        let levels = found.arcs.iter().flat_map(|arc| arc.v);
        let near: Vec<f64> = levels.filter(|v| (v - 0.5).abs() < 1e-9).collect();
        assert!(near.len() == 4 && near.iter().all(|v| *v == near[0]), "{near:?}");
        face.tolerances.snap = [1e-15; 2];
        assert_eq!(boundary(&face).unwrap().moved, [0.0; 2]);
    }
}
