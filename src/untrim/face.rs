//! A face in normalised parameters, with the bounds that its cutting needs.

use super::curve::Curve;
use super::derivatives;
use crate::axis::Axis;
use crate::bezier::{BezierModel, Patch, extract, power_of_two_below};
use crate::error::Result;
use crate::model::trim::{Trim, TrimPiece};
use crate::model::{Model, NurbsSurface, SurfaceArrays};
use crate::param_box::ParamBox;
use crate::rounding::gamma;
use glam::{DVec2, DVec3};

/// The parts of the allowed deviation that each kind of approximation may take; they sum to 1.
const SNAP_SHARE: f64 = 0.25;
const GRAPH_SHARE: f64 = 0.125;
const COMPOSITE_SHARE: f64 = 0.0625;
const CROSSING_SHARE: f64 = 0.25;
const FIT_SHARE: f64 = 0.3125;

/// The largest tolerance of crossings, in parts of the domain: validation accepts loops that
/// cross each other by up to 1e-6 of it.
const MAX_CROSSING: f64 = 1e-5;

/// The largest of the other tolerances: two sides that are moved three times each then cross by
/// at most 6 MAX_MOVE more, which is within half of [`MAX_CROSSING`] with those that validation
/// accepts.
const MAX_MOVE: f64 = MAX_CROSSING / 16.0;

/// The margin about the loops within which all moved boundaries stay.
const MARGIN: f64 = 1e-4;

/// The smallest tolerance in normalised parameters: a few units in the last place of 1.
const MIN_SNAP: f64 = 8.0 * f64::EPSILON;

/// The rounding of a parameter, in parts of the domain.
pub(super) const V_ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The tolerances of a face, in normalised parameters except `fit`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tolerances {
    /// The distance within which ends are one, in u and v.
    pub(super) snap: [f64; 2],
    /// The error in u of a boundary that is replaced by a graph.
    pub(super) graph: f64,
    /// The error in u of a graph that is composed with a height function.
    pub(super) composite: f64,
    /// The width by which the two sides of a cell may cross.
    pub(super) crossing: f64,
    /// The error of a fit, in model units.
    pub(super) fit: f64,
}

/// A face whose domain is mapped to [0, 1]².
pub(super) struct UnitFace {
    /// The surface's position in its model.
    pub(super) index: usize,
    /// The Bézier patches of the surface.
    pub(super) patches: BezierModel,
    /// The distinct knots in normalised parameters, from 0 to 1.
    pub(super) breaks: [Vec<f64>; 2],
    /// The surface's domain.
    pub(super) domain: ParamBox,
    /// The loops in normalised parameters.
    pub(super) loops: Vec<Vec<Curve>>,
    /// Whether the surface is an affine image of its domain up to [`UnitFace::twist`].
    pub(super) affine: bool,
    /// An upper bound on the distance between the surface and the affine map.
    pub(super) twist: f64,
    /// Upper bounds on the derivatives by the normalised parameters.
    pub(super) lipschitz: [f64; 2],
    /// The tolerances.
    pub(super) tolerances: Tolerances,
    /// An upper bound on the rounding of the parameters, in model units.
    pub(super) rounding: f64,
}

impl UnitFace {
    /// Prepares a face for cutting; with `transposed`, u and v change places.
    ///
    /// # Errors
    /// Those of the model's validation.
    pub(super) fn new(
        index: usize,
        surface: &NurbsSurface,
        trim: &Trim,
        max_deviation: f64,
        transposed: bool,
    ) -> Result<Self> {
        let surface = if transposed { transpose(index, surface)? } else { surface.clone() };
        let domain = surface.domain();
        let (affine, twist) = affinity(&surface);
        let loops = normalized_loops(domain, trim, transposed);
        let patches = extract(&Model::new(None, vec![surface])?);
        let breaks = Axis::BOTH.map(|axis| {
            let [start, end] = domain[axis];
            patches.grids[0].breaks[axis].iter().map(|knot| (knot - start) / (end - start)).collect()
        });
        let mut face = Self {
            index,
            patches,
            breaks,
            domain,
            loops,
            affine,
            twist,
            lipschitz: [0.0; 2],
            tolerances: Tolerances { snap: [0.0; 2], graph: 0.0, composite: 0.0, crossing: 0.0, fit: 0.0 },
            rounding: 0.0,
        };
        face.bound(max_deviation);
        Ok(face)
    }

    /// Returns the patch over the rectangle of knots with these numbers in u and v.
    pub(super) fn patch(&self, [iu, iv]: [usize; 2]) -> Patch<'_> {
        self.patches.patches.patch(iu * (self.breaks[1].len() - 1) + iv)
    }

    /// Returns the number of the knot span along `axis` that contains the parameter.
    pub(super) fn span(&self, axis: Axis, parameter: f64) -> usize {
        let breaks = &self.breaks[axis];
        breaks.partition_point(|&knot| knot <= parameter).clamp(1, breaks.len() - 1) - 1
    }

    /// Returns the rectangle of knots with these numbers.
    pub(super) fn rectangle(&self, [iu, iv]: [usize; 2]) -> ParamBox {
        let of = |axis: Axis, span: usize| [self.breaks[axis][span], self.breaks[axis][span + 1]];
        ParamBox::new(of(Axis::U, iu), of(Axis::V, iv))
    }

    /// Computes derivative bounds over the trimmed rectangles, and the tolerances.
    fn bound(&mut self, max_deviation: f64) {
        let hulls = self.loops.iter().flatten().map(Curve::hull);
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for [from, to] in hulls {
            (low, high) = (low.min(from), high.max(to));
        }
        let spans = |axis: Axis| self.span(axis, low[axis.index()])..=self.span(axis, high[axis.index()]);
        let touched = spans(Axis::U).flat_map(|iu| spans(Axis::V).map(move |iv| [iu, iv]));
        let rectangles = touched.map(|indices| (self.patch(indices), self.rectangle(indices)));
        let around = [0, 1].map(|axis| [low[axis] - MARGIN, high[axis] + MARGIN]);
        self.lipschitz = derivatives::bounds(rectangles, ParamBox::new(around[0], around[1]));
        let tolerance = |axis: usize, share: f64, largest: f64| {
            let allowed = share * max_deviation / self.lipschitz[axis];
            // A surface that is a point moves by nothing: 0 / 0.
            if allowed.is_nan() { largest } else { allowed.clamp(MIN_SNAP, largest) }
        };
        // Lemma T2 counts each axis, and each move twice.
        let snap = |axis: usize| tolerance(axis, 0.25 * SNAP_SHARE, MAX_MOVE);
        self.tolerances = Tolerances {
            snap: [snap(0), snap(1)],
            graph: tolerance(0, GRAPH_SHARE, MAX_MOVE),
            composite: tolerance(0, COMPOSITE_SHARE, MAX_MOVE),
            crossing: tolerance(0, CROSSING_SHARE, MAX_CROSSING),
            fit: FIT_SHARE * max_deviation,
        };
        // Normalisation takes three roundings of a parameter and the evaluation of a curve
        // of degree up to 15, four a level, at weights whose sum is that of the point's.
        self.rounding = (0..2)
            .map(|axis| {
                let [start, end] = self.domain[axis];
                let size = 1.0 + start.abs().max(end.abs()) / (end - start);
                gamma(PARAMETER_ROUNDINGS) * size * self.lipschitz[axis]
            })
            .sum();
    }

    /// Returns the distance in model units that these moves in u and v may cause.
    pub(super) fn moved(&self, [u, v]: [f64; 2]) -> f64 {
        let part = |amount: f64, axis: usize| if amount > 0.0 { amount * self.lipschitz[axis] } else { 0.0 };
        part(u, 0) + part(v, 1)
    }
}

/// The roundings of a point of a cell's boundary in normalised parameters (lemma T7).
const PARAMETER_ROUNDINGS: f64 = 160.0;

/// Returns the surface with u and v exchanged.
pub(super) fn transpose(index: usize, surface: &NurbsSurface) -> Result<NurbsSurface> {
    let [rows, columns] = surface.counts();
    let points = surface.control_points();
    let [p, q] = surface.degree();
    NurbsSurface::new(
        index,
        SurfaceArrays {
            degree: [q, p],
            knots: [surface.knots(Axis::V).to_vec(), surface.knots(Axis::U).to_vec()],
            counts: [columns, rows],
            control_points: (0..columns)
                .flat_map(|j| (0..rows).map(move |i| points[i * columns + j]))
                .collect(),
        },
    )
}

/// Returns whether the surface is a parallelogram up to rounding, and how far it may be from one.
///
/// The bilinear patch with corners P differs from the affine map with three of them by
/// s t (P00 - P10 - P01 + P11).
fn affinity(surface: &NurbsSurface) -> (bool, f64) {
    let points = surface.control_points();
    if surface.degree() != [1, 1] || points.len() != 4 || points.iter().any(|p| p[3] != points[0][3]) {
        return (false, 0.0);
    }
    let corner = |k: usize| DVec3::new(points[k][0], points[k][1], points[k][2]);
    let twist = (corner(0) - corner(1) - corner(2) + corner(3)).length();
    let size = (0..4).map(|k| corner(k).length()).fold(0.0, f64::max);
    let allowed = TWIST_ROUNDINGS * f64::EPSILON * size;
    (twist <= allowed, twist + gamma(3.0) * size)
}

/// The roundings of a parallelogram's fourth corner, in units in the last place of its size.
const TWIST_ROUNDINGS: f64 = 64.0;

/// Returns the loops with the domain mapped to [0, 1]², traversed so that the material
/// stays on the left.
fn normalized_loops(domain: ParamBox, trim: &Trim, transposed: bool) -> Vec<Vec<Curve>> {
    let [[u0, u1], [v0, v1]] = domain.intervals();
    let normalized = |control: &DVec3| {
        let [x, y] = if transposed { [control.y, control.x] } else { [control.x, control.y] };
        DVec3::new((x - u0 * control.z) / (u1 - u0), (y - v0 * control.z) / (v1 - v0), control.z)
    };
    let curves = |pieces: &Vec<TrimPiece>| {
        let curve = |piece: &TrimPiece| {
            let largest = piece.controls.iter().map(|control| control.z).fold(0.0, f64::max);
            let is_polynomial = piece.controls.iter().all(|control| control.z == largest);
            let scale = if is_polynomial { largest } else { power_of_two_below(largest) };
            Curve { controls: piece.controls.iter().map(|&control| normalized(&(control / scale))).collect() }
        };
        let mut curves: Vec<Curve> = pieces.iter().map(curve).collect();
        // The exchange of the axes reverses the sense of rotation.
        if transposed {
            curves = curves.iter().rev().map(Curve::reversed).collect();
        }
        curves
    };
    trim.loops().iter().map(curves).collect()
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::untrim::testing::{face_within, plane};

    /// γ₁₆₀ of lemma T7, of parameters in units of their range.
    #[test]
    fn the_rounding_of_parameters_is_that_of_the_lemma() {
        let mut face = face_within(&plane(), &[&[[0.1, 0.1], [0.9, 0.2], [0.5, 0.9]]]);
        face.domain = ParamBox::new([-3.0, 1.0], [100.0, 101.0]);
        face.bound(1e-9);
        let [in_u, in_v] = face.lipschitz;
        let expected = 160.0 * 0.5 * f64::EPSILON * ((1.0 + 0.75) * in_u + (1.0 + 101.0) * in_v);
        // Gamma allows a hundredth for the terms of higher order.
        assert!((expected..=1.02 * expected).contains(&face.rounding), "{} {expected}", face.rounding);
    }
}
