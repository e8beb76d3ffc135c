//! Trimmed faces as NURBS patches: untrimming.
//!
//! A face is the part of a surface within loops of curves in its parameter plane. It is cut
//! into patches once, so that every later stage sees patches only. Parameter rectangles
//! are cut by knot insertion. Other faces are swept: between two neighbouring boundary
//! curves lie cells, each the image of the unit square under a ruled map φ, and the surface
//! composed with φ is a Bézier patch, exact or fitted with a proven error (Massarwi, van
//! Sosin, Elber, *Untrimming: Precise conversion of trimmed-surfaces to tensor-product
//! surfaces*, Computers & Graphics 70 (2018)). Lemmas and proofs are in docs/trimming.md.

mod area;
mod boundary;
mod cells;
mod curve;
mod derivatives;
mod face;
mod patch;
mod rectangle;
mod sweep;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod testing;

use crate::error::{Error, Result};
use crate::model::NurbsSurface;
use crate::model::trim::Trim;
use crate::param_box::ParamBox;
use curve::Curve;
use face::UnitFace;
use glam::DVec2;
#[cfg(feature = "internals")]
use glam::DVec3;
use sweep::Sweep;

/// A part of a trimmed face.
#[derive(Debug, Clone)]
pub struct Piece {
    /// A surface that is a part of the face: a Bézier patch over [0, 1]², or a rectangular
    /// part of the face's surface with its own knots.
    pub surface: NurbsSurface,
    /// The map from the piece's parameters to the face's.
    pub map: ParameterMap,
}

/// The map from the parameters of a piece to those of its face.
#[derive(Debug, Clone)]
pub enum ParameterMap {
    /// The piece's parameters are the face's.
    Identity,
    /// The piece is ruled between two curves.
    Ruled(Ruled),
}

/// The map `(s, t) -> (1 - s) left(t) + s right(t)` between two curves in the parameter
/// plane of a face.
#[derive(Debug, Clone)]
pub struct Ruled {
    left: Curve,
    right: Curve,
    /// The domain that the curves' parameters are normalised to.
    domain: ParamBox,
    /// Whether u and v, and s and t, have changed places.
    transposed: bool,
}

#[cfg(feature = "internals")]
impl Ruled {
    /// Returns the homogeneous controls `(w u, w v, w)` of the left and the right curve, in
    /// the domain mapped to [0, 1]²; where [`Self::is_transposed`], v comes before u.
    #[must_use]
    pub fn sides(&self) -> [&[DVec3]; 2] {
        [&self.left.controls, &self.right.controls]
    }

    /// Returns whether u and v, and s and t, have changed places.
    #[must_use]
    pub fn is_transposed(&self) -> bool {
        self.transposed
    }
}

/// The shortest part of a side, in its own parameter, whose controls are computed.
const MIN_PART: f64 = 1e-9;

/// The rounding of control points of the sides, in the domain mapped to [0, 1]²: some tens of operations.
const IMAGE_ROUNDING: f64 = 1e-13;

impl ParameterMap {
    /// Returns the face's (u, v) for the piece's parameters. The surface there is within
    /// [`Untrimmed::deviation`] of the piece's point. O(degree²).
    #[must_use]
    pub fn face_parameters(&self, piece_parameters: [f64; 2]) -> [f64; 2] {
        let Self::Ruled(ruled) = self else { return piece_parameters };
        let exchange = |[a, b]: [f64; 2]| if ruled.transposed { [b, a] } else { [a, b] };
        let [s, t] = exchange(piece_parameters);
        let point = (1.0 - s) * ruled.left.point(t) + s * ruled.right.point(t);
        exchange(ruled.domain.at(point.clamp(DVec2::ZERO, DVec2::ONE).to_array()))
    }

    /// Returns a rectangle that contains the face's (u, v) for all parameters of the piece in a rectangle: those of the
    /// control points of both curves, at either end of the lines between them. O(degree²).
    pub(crate) fn image(&self, parameters: &ParamBox) -> ParamBox {
        let Self::Ruled(ruled) = self else { return *parameters };
        let [across, along] = if ruled.transposed { [1, 0] } else { [0, 1] };
        let [from, to] = parameters[along];
        // A part of no length has no controls of its own.
        let from = if to - from < MIN_PART { from.min(1.0 - MIN_PART) } else { from };
        let to = if to - from < MIN_PART { from + MIN_PART } else { to };
        let sides = [&ruled.left, &ruled.right].map(|side| side.restricted(from, to).hull());
        let ends = parameters[across]
            .map(|s| [0, 1].map(|end: usize| (1.0 - s) * sides[0][end] + s * sides[1][end]));
        let low = (ends[0][0].min(ends[1][0]) - IMAGE_ROUNDING).clamp(DVec2::ZERO, DVec2::ONE);
        let high = (ends[0][1].max(ends[1][1]) + IMAGE_ROUNDING).clamp(DVec2::ZERO, DVec2::ONE);
        let [low, high] = [low, high].map(|end| ruled.domain.at(end.to_array()));
        let [first, second] = [0, 1].map(|axis| [low[axis].next_down(), high[axis].next_up()]);
        if ruled.transposed { ParamBox::new(second, first) } else { ParamBox::new(first, second) }
    }
}

/// A trimmed face as pieces.
#[derive(Debug, Clone)]
pub struct Untrimmed {
    /// The pieces. They overlap in their edges only, up to the deviation.
    pub pieces: Vec<Piece>,
    /// A proven upper bound, in model units, on the Hausdorff distance between the union of
    /// the pieces and the trimmed face; the bound on rounding alone where the cut is exact.
    pub deviation: f64,
}

/// Cuts a trimmed face, surface number `index` of its model, into pieces within
/// `max_deviation` of it, in model units.
///
/// `max_deviation` bounds the approximations; a bound on the rounding adds to it in
/// [`Untrimmed::deviation`]. A face that it does not suffice for, whose loops touch or cross
/// each other by more, is cut with a larger one, which the result states. O(arcs × slabs) for the
/// sweep and O(D²) for a patch of composed degree D.
///
/// The cut proves itself: the cells' sides are balanced against the arcs, their areas against the
/// loops, and each patch is compared with the surface (`sweep.rs`). A cut that fails a proof is
/// made again in the other direction and with larger deviations.
///
/// # Errors
/// `FACE_NOT_CUT` where no cut is proven: the loops cross each other by more than the deviation,
/// or a cell does not converge.
pub fn untrim(index: usize, surface: &NurbsSurface, trim: &Trim, max_deviation: f64) -> Result<Untrimmed> {
    let (mut allowed, mut reason) = (max_deviation, None);
    for _ in 0..=MAX_ATTEMPTS {
        match attempt(index, surface, trim, allowed) {
            Ok(untrimmed) => return Ok(untrimmed),
            Err(Failure::Input(error)) => return Err(error),
            Err(Failure::Unproven(found)) => reason = reason.or(Some(found)),
        }
        allowed *= COARSENING;
    }
    Err(Error::FaceNotCut { surface: index, found: reason.unwrap_or_default() })
}

/// The failure of one attempt.
enum Failure {
    /// The cut is not proven, in words; one with a larger deviation may be.
    Unproven(String),
    /// No deviation helps.
    Input(Error),
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self::Input(error)
    }
}

/// The number of attempts with a larger deviation, and the factor from one to the next: from
/// 1e-9 of the diagonal they reach the crossings that validation accepts.
const MAX_ATTEMPTS: usize = 4;
const COARSENING: f64 = 32.0;

/// Cuts a face with this deviation.
fn attempt(
    index: usize,
    surface: &NurbsSurface,
    trim: &Trim,
    max_deviation: f64,
) -> std::result::Result<Untrimmed, Failure> {
    let face = UnitFace::new(index, surface, trim, max_deviation, false)?;
    if let Some((part, moved)) = rectangle::rectangle(&face) {
        let cut = rectangle::cut(surface, part)?;
        let deviation = if &cut == surface {
            0.0
        } else {
            patch::rectangle_deviation(&face, surface, &cut, part)? + face.rounding
        };
        let piece = Piece { surface: cut, map: ParameterMap::Identity };
        return Ok(Untrimmed { pieces: vec![piece], deviation: face.moved(moved) + deviation });
    }
    let across = UnitFace::new(index, surface, trim, max_deviation, true)?;
    let sweeps = [Sweep::new(&face, false), Sweep::new(&across, true)];
    let mut reason = sweeps.iter().find_map(|sweep| sweep.as_ref().err().cloned());
    let mut choices: Vec<&Sweep<'_>> = sweeps.iter().flatten().collect();
    if let [first, second] = choices[..]
        && second.cost() < first.cost()
    {
        choices.reverse();
    }
    for sweep in choices {
        match sweep.untrimmed() {
            Ok(untrimmed) => return Ok(untrimmed),
            Err(found) => reason = reason.or(Some(found)),
        }
    }
    Err(Failure::Unproven(reason.unwrap_or_default()))
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod image_tests {
    use super::*;

    /// Two curves that are not straight, in a domain that is not the unit square: images of points are in those of
    /// rectangles about them, and corners of rectangles whose sides are straight on the rim of theirs.
    #[test]
    fn the_image_of_a_rectangle_contains_those_of_its_points() {
        let random = &mut fastrand::Rng::with_seed(5);
        let domain = ParamBox::new([-2.0, 5.0], [10.0, 11.0]);
        for round in 0..200 {
            let transposed = round % 2 == 0;
            let side = |random: &mut fastrand::Rng, at: f64| {
                let control = |k: usize| {
                    let weight = 0.5 + random.f64();
                    DVec3::new(weight * (at + 0.2 * random.f64()), weight * 0.25 * k as f64, weight)
                };
                Curve { controls: (0..4).map(control).collect() }
            };
            let (left, right) = (side(random, 0.1), side(random, 0.6));
            let map = ParameterMap::Ruled(Ruled { left, right, domain, transposed });
            let interval = |random: &mut fastrand::Rng| {
                let [a, b] = [random.f64(), random.f64()];
                if round % 5 == 0 { [a, a] } else { [a.min(b), a.max(b)] }
            };
            let part = ParamBox::new(interval(random), interval(random));
            let image = map.image(&part);
            for _ in 0..20 {
                let at = part.at([random.f64(), random.f64()]);
                let point = map.face_parameters(at);
                assert!(image.contains(point), "{point:?} in {image:?}");
            }
            if round % 5 == 0 {
                assert!(image.lengths().iter().all(|&length| length < 1e-7), "{image:?}");
            }
        }
    }

    #[test]
    fn the_image_of_a_rectangle_between_straight_sides_is_tight() {
        let line = |u: f64| Curve::line(DVec2::new(u, 0.0), DVec2::new(u, 1.0));
        let domain = ParamBox::new([0.0, 4.0], [0.0, 2.0]);
        let map =
            ParameterMap::Ruled(Ruled { left: line(0.25), right: line(0.75), domain, transposed: false });
        let image = map.image(&ParamBox::new([0.5, 1.0], [0.25, 0.5]));
        let expected = [[2.0, 3.0], [0.5, 1.0]];
        for axis in 0..2 {
            for end in 0..2 {
                assert!((image[axis][end] - expected[axis][end]).abs() < 1e-11, "{image:?}");
            }
        }
    }
}
