//! The trimming curves of a face, validated once.

mod beyond;
mod closing;
mod confinement;
mod crossing;
mod curve;
mod nesting;
mod orientation;
mod piece;
mod winding;

pub(super) use beyond::extended_surface;
pub use orientation::oriented;
pub use piece::TrimPiece;
pub use winding::{RESOLUTION, Rim, RimSide, Winding};

use crate::axis::Axis;
use crate::error::{Error, Result, TrimFault};
use crate::model::NurbsSurface;
use crate::param_box::ParamBox;
use confinement::Confined;
use curve::Place;
use serde::{Deserialize, Serialize};

/// A trimming curve as plain arrays, not validated: a rational B-spline curve in the
/// parameter plane (u, v) of its surface.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct TrimCurveArrays {
    /// The degree, 1 to 15.
    pub degree: usize,
    /// The knot vector, of length count + degree + 1.
    pub knots: Vec<f64>,
    /// The control points `[u, v, w]`; u and v are not multiplied by w > 0.
    pub control_points: Vec<[f64; 3]>,
    /// An upper bound, in model units, on the distance between the curve on the surface and the
    /// edge of the source that it represents. The reader of BREP text proves it; that of 3DM
    /// files takes the tolerance that the file states of the edge.
    pub gap: f64,
    /// The number of the source's edge; curves of equal numbers bound neighbours.
    pub edge: Option<u32>,
}

/// A face as plain arrays, not validated: a surface and the loops that trim it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FaceArrays {
    /// The surface.
    pub surface: crate::model::SurfaceArrays,
    /// Loops of curves head to tail, material on the left; `None` is the whole surface.
    pub trim: Option<Vec<Vec<TrimCurveArrays>>>,
    /// Whether the face's normal is opposite to the surface's.
    pub reversed: bool,
    /// The face's name in its source.
    pub face_name: Option<String>,
    /// The kind of surface in its source, for example `cylinder`.
    pub kind: Option<String>,
    /// An upper bound, in model units, on the deviation of the surface itself from the source.
    pub gap: f64,
    /// Whether this gap, or one of a curve's, was measured at points and is no upper bound.
    pub gap_measured: bool,
    /// Red, green and blue of sRGB, each from 0 to 1, if the source gives the face a colour.
    pub color: Option<[f64; 3]>,
    /// The number of the shell that the face belongs to in its source: edges of faces of one shell are joined
    /// with each other first, so that bodies that stand flush stay apart. Numbers are those of one model.
    pub shell: Option<u32>,
    /// The number of the solid that the face bounds in its source, if that has solids: a shell of one solid is no void
    /// of another one. Numbers are those of one model.
    pub solid: Option<u32>,
}

impl FaceArrays {
    /// Returns the face of a surface within these loops, or of all of it, that states nothing else.
    #[must_use]
    pub fn new(surface: crate::model::SurfaceArrays, trim: Option<Vec<Vec<TrimCurveArrays>>>) -> Self {
        Self {
            surface,
            trim,
            reversed: false,
            face_name: None,
            kind: None,
            gap: 0.0,
            gap_measured: false,
            color: None,
            shell: None,
            solid: None,
        }
    }
}

/// The largest distance between the end of a curve and the start of the next, as a
/// fraction of the domain's range in u and in v, that is always closed. A larger one is
/// closed only if it is within the gaps that the two curves state.
const MAX_SNAP: f64 = 1e-6;

/// The trimmed region of a surface's domain.
///
/// Guarantee: each loop is exactly closed (a piece ends in the floats that the next
/// begins with), weights are positive, all control points lie in the domain, every loop
/// encloses area, and the sum of the loops' winding numbers is 1 inside and 0 outside,
/// except for overlaps of at most 1e-6 of the domain.
#[derive(Debug, Clone, PartialEq)]
pub struct Trim {
    loops: Vec<Vec<TrimPiece>>,
    domain: ParamBox,
    gap: f64,
    rounding: f64,
}

/// Closed loops before their nesting is validated.
struct ClosedLoops {
    loops: Vec<Vec<TrimPiece>>,
    gap: f64,
    rounding: f64,
}

impl Trim {
    /// Validates the loops of surface number `index`.
    ///
    /// Curves are cut into rational Bézier pieces. Ends that miss each other by up to 1e-6
    /// of the domain, or by the curves' own gaps, are moved together, and control points
    /// up to 1e-9 of the domain outside it are moved to its edge; the moves, multiplied by
    /// [`NurbsSurface::lipschitz_bounds`], are added to the curve's gap.
    ///
    /// O(pieces²) at worst, for loops that all are near each other.
    ///
    /// # Errors
    /// [`Error::Trim`] with the first violation found of: invalid curves, curves outside
    /// the domain, open loops, loops without area, crossings, nesting.
    pub fn new(index: usize, surface: &NurbsSurface, loops: Vec<Vec<TrimCurveArrays>>) -> Result<Self> {
        Self::validated(surface, &loops).map_err(|fault| Error::Trim { surface: index, fault })
    }

    /// Returns the trim of these loops, or the first fault, as [`Trim::new`] does.
    pub(super) fn validated(
        surface: &NurbsSurface,
        loops: &[Vec<TrimCurveArrays>],
    ) -> std::result::Result<Self, TrimFault> {
        let ClosedLoops { loops, gap, rounding } = closed_loops(surface, loops)?;
        let domain = surface.domain();
        let winding = Winding::new(&loops, domain);
        for loop_index in 0..loops.len() {
            nesting::turn(&winding, loop_index)?;
        }
        if let Some(fault) = crossing::find(&winding) {
            return Err(fault);
        }
        nesting::validate(&winding)?;
        Ok(Self { loops, domain, gap, rounding })
    }

    /// Returns the loops, each a cyclic list of pieces head to tail.
    #[must_use]
    pub fn loops(&self) -> &[Vec<TrimPiece>] {
        &self.loops
    }

    /// Returns the largest distance between a trimming curve on the surface and the source's
    /// edge, in model units, as [`TrimCurveArrays::gap`] states it, with the moves that closed
    /// the loops, which are bounded.
    #[must_use]
    pub fn gap(&self) -> f64 {
        self.gap
    }

    /// Returns an upper bound, in model units, on the distance between the loops on the
    /// surface and those that exact arithmetic would cut the curves into.
    #[must_use]
    pub fn rounding(&self) -> f64 {
        self.rounding
    }

    /// Returns the winding numbers of the loops.
    #[must_use]
    pub fn winding(&self) -> Winding {
        Winding::new(&self.loops, self.domain)
    }

    /// Returns the same loops on an image of the surface under a map that lengthens no
    /// distance by more than `factor`.
    pub(super) fn scaled(&self, factor: f64) -> Self {
        Self { gap: factor * self.gap, rounding: factor * self.rounding, ..self.clone() }
    }
}

/// Returns what moves of the parameters move points of the surface by, at most.
fn lifted([of_u, of_v]: [f64; 2], [u, v]: [f64; 2]) -> f64 {
    let product = |bound: f64, moved: f64| if moved == 0.0 { 0.0 } else { bound * moved };
    product(of_u, u) + product(of_v, v)
}

/// Returns the part of the domain that the loops' control points reach, which contains
/// all curves and whatever their points are moved to.
fn extent(loops: &[Vec<TrimCurveArrays>], domain: &ParamBox) -> ParamBox {
    let points = || loops.iter().flatten().flat_map(|curve| &curve.control_points);
    Axis::BOTH
        .map(|axis| {
            let [start, end] = domain[axis];
            let values = || points().map(|point| point[axis.index()].clamp(start, end));
            // NaN, which validation refuses later, bounds nothing: the whole domain.
            let (low, high) =
                values().fold((end, start), |(low, high), value| (low.min(value), high.max(value)));
            if low <= high { [low, high] } else { [start, end] }
        })
        .into()
}

/// Returns the loops as pieces that are head to tail in floats, with their gap.
fn closed_loops(
    surface: &NurbsSurface,
    loops: &[Vec<TrimCurveArrays>],
) -> std::result::Result<ClosedLoops, TrimFault> {
    let domain = surface.domain();
    let bounds = surface.lipschitz_bounds(extent(loops, &domain));
    let mut closed = ClosedLoops { loops: Vec::with_capacity(loops.len()), gap: 0.0, rounding: 0.0 };
    if loops.is_empty() {
        return Err(TrimFault::NoLoops);
    }
    for (loop_index, curves) in loops.iter().enumerate() {
        let (mut given, mut pieces) = (Vec::new(), Vec::new());
        for (curve, arrays) in curves.iter().enumerate() {
            arrays.validate(Place { loop_index, curve })?;
            for piece in arrays.pieces(curve as u32) {
                let confined = confinement::confined(piece, &domain).map_err(|found| {
                    let expected = confinement::MAX_CLAMPED;
                    TrimFault::OutsideDomain { loop_index, curve, found, expected }
                })?;
                for Confined { given: outside, piece } in confined {
                    given.push(outside);
                    pieces.push(piece);
                }
            }
            let error = arrays.extraction_error();
            closed.rounding = closed.rounding.max(lifted(bounds, [error, error]));
        }
        check_ends(&pieces, curves, &domain, bounds).map_err(|(curve, found)| TrimFault::LoopOpen {
            loop_index,
            curve,
            found,
            expected: MAX_SNAP,
        })?;
        closing::close(&mut pieces, &domain);
        for (given, piece) in given.iter().zip(&pieces) {
            let moved = lifted(bounds, closing::moves(given, piece));
            closed.gap = closed.gap.max(curves[piece.curve as usize].gap + moved);
        }
        closed.loops.push(pieces);
    }
    Ok(closed)
}

/// Returns the first curve that begins farther from the end of the piece before it than
/// [`MAX_SNAP`] of the domain and than both curves' gaps, and that distance.
fn check_ends(
    pieces: &[TrimPiece],
    curves: &[TrimCurveArrays],
    domain: &ParamBox,
    bounds: [f64; 2],
) -> std::result::Result<(), (usize, f64)> {
    for (index, piece) in pieces.iter().enumerate() {
        let previous = &pieces[(index + pieces.len() - 1) % pieces.len()];
        let apart: [f64; 2] = (piece.start() - previous.end()).abs().into();
        let found = (apart[0] / domain.lengths()[0]).max(apart[1] / domain.lengths()[1]);
        let gaps = curves[piece.curve as usize].gap + curves[previous.curve as usize].gap;
        if found > MAX_SNAP && lifted(bounds, apart) > gaps {
            return Err((piece.curve as usize, found));
        }
    }
    Ok(())
}
