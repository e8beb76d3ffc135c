//! The difference of patches as a rational function, over one patch of B or over its knot lines: for cells
//! that keep their distance to B under a change of parameters, as on copies and
//! offsets with other knots, degrees or pieces.
//!
//! Where the feet's linearization runs along B's parameter lines, `B∘φ` has the
//! control net of B restricted to the image of the cell, as A has that of the
//! cell. With `A = X/w` and `B∘φ = Y/v`,
//!
//! `|A - B∘φ|² = |X v - Y w|² / (w v)²`,
//!
//! a quotient of Bernstein polynomials of twice the degrees' sums. It is at most
//! the largest quotient of coefficients, as those of the denominator are
//! positive. Up to rounding that is exact where the distance is the same
//! everywhere: zero where A and B are the same polynomials or rational functions.

mod aligned_map;
mod net;
mod one_patch;
mod over_knot_lines;
mod piece;
mod projective;
mod strip;

pub(in crate::certified) use one_patch::PolynomialDifference;
pub(in crate::certified) use over_knot_lines::DifferenceOverKnotLines;
pub(super) use piece::SpanPart;
pub(in crate::certified) use projective::ProjectiveDifference;
pub(super) use strip::{Comparison, RestrictedPart};
