//! Cells as ruled maps of the unit square, which do not fold.

use super::Cell;
use super::sides::{ArcPart, follow, part};
use super::unfolded::folds;
use crate::approximation::bernstein::elevated;
use crate::rounding::upper_max;
use crate::untrim::boundary::graph::Graph;
use crate::untrim::boundary::{Arc, Side};
use crate::untrim::curve::{Curve, halves};
use crate::untrim::face::{UnitFace, V_ROUNDING};
use glam::{DVec2, DVec3};

/// The map `φ(s, t) = (1 - s) left(t) + s right(t)` of the unit square onto a cell.
#[derive(Debug, Clone)]
pub(in crate::untrim) struct Ruling {
    pub(in crate::untrim) left: Curve,
    pub(in crate::untrim) right: Curve,
    /// The degree of v in t where both sides have the same v and weight at equal t;
    /// `None` where they differ.
    pub(in crate::untrim) height: Option<usize>,
    pub(in crate::untrim) rectangle: [usize; 2],
    /// Upper bounds on the distances in u and v between the map's image and the cell.
    pub(in crate::untrim) moved: [f64; 2],
    /// An upper bound on the width in u by which the sides cross.
    pub(in crate::untrim) crossing: f64,
}

impl Ruling {
    /// Makes the map between two lines that run between the same levels.
    pub(in crate::untrim) fn between_lines([left, right]: [Curve; 2], rectangle: [usize; 2]) -> Self {
        Self { left, right, height: Some(1), rectangle, moved: [0.0; 2], crossing: 0.0 }
    }
}

/// A cell that is one ruled map, one to be divided by a line, or one to be halved.
pub(in crate::untrim) enum Mapped {
    One(Ruling),
    Divided(Arc),
    Halve,
}

/// The parts of the tolerance of crossings that the crossing of the sides, or the folds between
/// them, and each of the two shifts of a side may take.
const CROSSING_PART: f64 = 0.75;
const FOLD_PART: f64 = 0.75;
const SHIFT_PART: f64 = 0.125;

/// The highest degree in s of a patch over rulings that are no parameter lines.
const MAX_TILTED_DEGREE: usize = crate::limits::MAX_DEGREE;

/// The number of halvings in the proof that a difference has one sign.
const MAX_SIGN_DEPTH: usize = 30;

/// Maps a cell, or says how to cut it.
pub(in crate::untrim) fn mapped(face: &UnitFace, arcs: &[Arc], cell: &Cell) -> Mapped {
    let sides = cell.sides.map(|arc| &arcs[arc].side);
    if let [Side::Own(left), Side::Own(right)] = sides
        && let [Some(left_part), Some(right_part)] = sides.map(|side| part(side, cell.v))
    {
        if is_level(&left_part.curve, &right_part.curve) {
            let height = left_part.curve.degree();
            return matched(face, cell, [left_part, right_part], height).map_or(Mapped::Halve, Mapped::One);
        }
        return two_curves(face, cell, [left, right], [left_part, right_part]);
    }
    between(face, cell, sides).map_or(Mapped::Halve, Mapped::One)
}

/// Returns the map between two sides, at least one of them a graph.
fn between(face: &UnitFace, cell: &Cell, sides: [&Side; 2]) -> Option<Ruling> {
    let composed = |graph: &Graph, height: &Curve| follow(graph, height, face.tolerances.composite);
    match sides {
        [Side::Graph(_), Side::Graph(_)] => {
            matched(face, cell, [part(sides[0], cell.v)?, part(sides[1], cell.v)?], 1)
        }
        [Side::Own(_), Side::Graph(graph)] => {
            let left = part(sides[0], cell.v)?;
            let right = composed(graph, &left.curve)?;
            let height = left.curve.degree();
            matched(face, cell, [left, right], height)
        }
        [Side::Graph(graph), Side::Own(_)] => {
            let right = part(sides[1], cell.v)?;
            let left = composed(graph, &right.curve)?;
            let height = right.curve.degree();
            matched(face, cell, [left, right], height)
        }
        [Side::Own(_), Side::Own(_)] => None,
    }
}

/// Returns the map between two sides with equal v and weight at equal parameters.
fn matched(face: &UnitFace, cell: &Cell, [left, right]: [ArcPart; 2], height: usize) -> Option<Ruling> {
    let degree = left.curve.degree().max(right.curve.degree());
    let moved = largest(left.moved, right.moved);
    let [left, right] = [left, right].map(|part| elevated(part.curve.controls.clone(), degree));
    let difference: Vec<DVec2> = left.iter().zip(&right).map(|(l, r)| DVec2::new(r.x - l.x, l.z)).collect();
    let tolerance = CROSSING_PART * face.tolerances.crossing;
    let crossing = negative_part(&difference, tolerance)?;
    let curves = [left, right].map(|controls| Curve { controls });
    confined(face, cell, curves, Some(height), moved, crossing)
}

/// Returns the map between two curves, with the sides moved into the cell's rectangle of knots,
/// if that is within the tolerance of crossings: only there the patch is the surface (lemma T3).
fn confined(
    face: &UnitFace,
    cell: &Cell,
    curves: [Curve; 2],
    height: Option<usize>,
    moved: [f64; 2],
    crossing: f64,
) -> Option<Ruling> {
    let [low, high] = face.rectangle(cell.rectangle)[0];
    let mut shift = 0.0_f64;
    let mut inwards = |curve: Curve, edge: f64, sign: f64| {
        let room: Vec<DVec2> =
            curve.controls.iter().map(|c| DVec2::new(sign * (c.x - edge * c.z), c.z)).collect();
        let outside = negative_part(&room, SHIFT_PART * face.tolerances.crossing)?;
        shift = shift.max(outside);
        let shifted = |c: &DVec3| DVec3::new(c.x + sign * outside * c.z, c.y, c.z);
        Some(if outside > 0.0 {
            Curve { controls: curve.controls.iter().map(shifted).collect() }
        } else {
            curve
        })
    };
    let [left, right] = curves;
    let (left, right) = (inwards(left, low, 1.0)?, inwards(right, low, 1.0)?);
    let (left, right) = (inwards(left, high, -1.0)?, inwards(right, high, -1.0)?);
    let moved = [moved[0] + 2.0 * shift, moved[1]];
    let is_near = moved[0] <= face.tolerances.crossing && moved[1] <= face.tolerances.snap[1];
    is_near.then_some(Ruling { left, right, height, rectangle: cell.rectangle, moved, crossing })
}

/// Returns the larger of bounds in u and of bounds in v.
fn largest(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [upper_max(a[0], b[0]), upper_max(a[1], b[1])]
}

/// Returns an upper bound on the negative part of a rational function with these Bernstein
/// coefficients, if it is at most `tolerance`: the sharpest of a few that can be proven.
fn negative_part(coefficients: &[DVec2], tolerance: f64) -> Option<f64> {
    let sharp = [V_ROUNDING, tolerance / 256.0, tolerance / 16.0, tolerance];
    sharp.into_iter().find_map(|bound| reversal(coefficients, bound.min(tolerance), MAX_SIGN_DEPTH))
}

/// Returns an upper bound on the negative part of a rational function with these
/// Bernstein coefficients of numerator and denominator, if it is at most `tolerance`.
fn reversal(coefficients: &[DVec2], tolerance: f64, depth: usize) -> Option<f64> {
    let negative = |c: &DVec2| upper_max(-c.x / c.y, 0.0);
    let bound = coefficients.iter().map(negative).fold(0.0, upper_max);
    if bound <= tolerance {
        return Some(bound);
    }
    let ends = [coefficients[0], coefficients[coefficients.len() - 1]];
    if depth == 0 || ends.iter().map(negative).any(|value| value > tolerance) {
        return None;
    }
    let [low, high] = halves(coefficients);
    Some(reversal(&low, tolerance, depth - 1)?.max(reversal(&high, tolerance, depth - 1)?))
}

/// Maps a cell between two curves in their own parameters: directly if the map does not fold,
/// else on both sides of a straight line, if their boxes leave room for one.
fn two_curves(face: &UnitFace, cell: &Cell, curves: [&Curve; 2], parts: [ArcPart; 2]) -> Mapped {
    let degree: usize = face.patch(cell.rectangle).degree.iter().sum();
    let ends = [0, 1].map(|end| {
        let at = |part: &ArcPart| if end == 0 { part.curve.start().x } else { part.curve.end().x };
        0.5 * (at(&parts[0]) + at(&parts[1]))
    });
    if (face.affine || degree <= MAX_TILTED_DEGREE)
        && let Some(ruling) = tilted(face, cell, parts)
    {
        return Mapped::One(ruling);
    }
    let line = Side::Graph(Graph::line(ends, cell.v));
    let [left, right] = curves.map(|curve| Side::Own(curve.clone()));
    if between(face, cell, [&left, &line]).is_some() && between(face, cell, [&line, &right]).is_some() {
        return Mapped::Divided(Arc { side: line, v: cell.v, change: 0 });
    }
    Mapped::Halve
}

/// Returns the map between two curves whose v differ at equal parameters, if it does not fold.
fn tilted(face: &UnitFace, cell: &Cell, [left, right]: [ArcPart; 2]) -> Option<Ruling> {
    let allowed = [FOLD_PART * face.tolerances.crossing, 0.5 * face.tolerances.snap[1]];
    let folds = folds(&left.curve, &right.curve, allowed)?;
    let moved = largest(left.moved, right.moved);
    let moved = [0, 1].map(|axis| moved[axis] + folds[axis]);
    confined(face, cell, [left.curve, right.curve], None, moved, 0.0)
}

/// Returns whether two curves have the same v and weight at equal parameters, up to rounding.
fn is_level(left: &Curve, right: &Curve) -> bool {
    left.degree() == right.degree()
        && left.controls.iter().zip(&right.controls).all(|(l, r)| {
            (l.y - r.y).abs() <= 4.0 * f64::EPSILON && (l.z - r.z).abs() <= 4.0 * f64::EPSILON * l.z
        })
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::untrim::testing::{face_within, plane};

    /// A trimmed plane, whose domain is one rectangle of knots.
    fn face() -> UnitFace {
        let mut face = face_within(&plane(), &[&[[0.1, 0.1], [0.9, 0.2], [0.5, 0.9]]]);
        face.tolerances.crossing = 1e-9;
        face.tolerances.composite = 1e-9;
        face
    }

    fn graph(coefficients: &[f64]) -> Side {
        Side::Graph(Graph { v: [0.25, 0.75], coefficients: coefficients.to_vec() })
    }

    /// Maps the cell between two sides over their whole height.
    fn map(sides: [Side; 2]) -> Mapped {
        let arcs = sides.map(|side| Arc { side, v: [0.25, 0.75], change: 1 });
        mapped(&face(), &arcs, &Cell { sides: [0, 1], v: [0.25, 0.75], rectangle: [0, 0], winding: 1 })
    }

    fn one(mapped: Mapped) -> Ruling {
        match mapped {
            Mapped::One(ruling) => ruling,
            Mapped::Divided(_) | Mapped::Halve => panic!("the cell is cut"),
        }
    }

    #[test]
    fn sides_that_cross_state_the_width_and_wide_crossings_are_cut() {
        let ruling = one(map([graph(&[0.5, 0.3]), graph(&[0.5 - 1e-10, 0.6])]));
        assert!((1e-10..=5e-10).contains(&ruling.crossing), "{}", ruling.crossing);
        assert!(matches!(map([graph(&[0.5, 0.3]), graph(&[0.499, 0.6])]), Mapped::Halve));
    }

    #[test]
    fn a_side_beyond_the_knots_is_moved_onto_them_and_says_by_what() {
        let ruling = one(map([graph(&[-5e-11, 0.3]), graph(&[0.5, 0.6])]));
        assert!(ruling.left.start().x >= 0.0 && ruling.moved[0] >= 5e-11, "{:?}", ruling.moved);
        assert!(matches!(map([graph(&[-1e-3, 0.3]), graph(&[0.5, 0.6])]), Mapped::Halve));
    }

    #[test]
    fn a_side_that_follows_a_graph_states_its_distance_from_it() {
        let own = Side::Own(Curve {
            controls: vec![
                DVec3::new(0.1, 0.25, 1.0),
                DVec3::new(0.2 * 0.8, 0.4 * 0.8, 0.8),
                DVec3::new(0.1, 0.75, 1.0),
            ],
        });
        let side = graph(&[0.5, 0.8, 0.6, 0.9]);
        let Side::Graph(target) = side.clone() else { panic!("a graph") };
        let ruling = one(map([own, side]));
        let distances = (0..=64).map(|k| {
            let point = ruling.right.point(f64::from(k) / 64.0);
            (point.x - target.at(point.y)).abs()
        });
        let largest = distances.fold(0.0, f64::max);
        assert!(largest > 1e-14 && largest <= ruling.moved[0], "{largest} {:?}", ruling.moved);
        assert!(ruling.moved[0] <= 1e-9, "{:?}", ruling.moved);
    }
}
