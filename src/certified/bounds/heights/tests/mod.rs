//! The bound is attained, no point is farther, and each term is that of its lemma.

mod allowances;
mod ends;
mod over_faces;
mod several_faces;
mod terms;
mod whole_cells;

use super::candidate::Candidate;
use super::cell_comparison::CellComparison;
use super::fit::{Fit, ORDERS, POINTS_ALONG};
use super::frame::{Frame, Image};
use super::piece::{Piece, Values};
use super::quadric::{Cubic, Quadric};
use super::{Heights, rim};
use crate::certified::bounds::UpperBound;
use crate::certified::cell_context::CellContext;
use crate::certified::nearest::{Foot, NearestPoint};
use crate::certified::rounding::gamma;
use crate::certified::sheets::Chart;
use crate::certified::{Cell, Operand, Pair};
use crate::model::RigidTransform;
use crate::rounding::{lower_min, upper_max};
use glam::{DVec3, Vec4Swizzles};

/// A function to compare a cell by.
fn of_cell(function: &Cubic, a: &Piece) -> Candidate {
    Candidate::new(*function, a)
}

/// The bound of A's first patch as a whole, from the nearest foot of its middle.
fn bound_of(a: Operand<'_>, b: Operand<'_>, threshold: f64) -> Option<f64> {
    let pair = Pair { a, b, transform: RigidTransform::IDENTITY };
    let nearest = NearestPoint::new(pair.b);
    let center = pair.a.patch(0).point([0.5; 2]);
    let foot = nearest.nearest(center, Foot::start(0, [0.5; 2]), 0.0);
    let mut context = CellContext::new(&pair, &nearest, Cell::whole(0), &foot);
    Heights.evaluate(&mut context, threshold)
}
