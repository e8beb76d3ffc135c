//! The bound is attained, no point is farther, and each term is that of its lemma.

mod allowances;
mod around;
mod ends;
mod over_faces;
mod several_faces;
mod terms;
mod whole_cells;

use super::comparison::Candidate;
use super::fit::{Fit, ORDERS, POINTS_ALONG};
use super::frame::{Frame, Image};
use super::over::Over;
use super::piece::{Piece, Values};
use super::quadric::{Cubic, Quadric};
use super::{Heights, rim};
use crate::certified::bounds::UpperBound;
use crate::certified::cell_context::CellContext;
use crate::certified::rounding::gamma;
use crate::certified::sheets::Chart;
use crate::rounding::{lower_min, upper_max};
use glam::{DVec3, Vec4Swizzles};

/// A function to compare a cell by.
fn of_cell(function: &Cubic, a: &Piece) -> Candidate {
    Candidate::new(*function, a)
}
