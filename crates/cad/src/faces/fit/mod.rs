//! Quintic curves fitted to images of curves under the parameter maps, with a proven bound.

mod jet;

use super::loops::crossing;
use super::metric::Metric;
use crate::nurbs::{ParameterMap, Spline};
use glam::{DVec3, DVec4};
use jet::{Interval, Jet, ORDER};

/// The degree of the fit: values and two derivatives at both ends. A cubic would take
/// about six times the pieces at the tolerance used.
const DEGREE: usize = 5;

/// The deepest bisection of a piece. The bound falls by 64 a level, and the limit keeps
/// bogus curves from taking long.
const MAX_DEPTH: usize = 8;

/// The roundings of the interval arithmetic, relative to the bound.
const ROUNDING: f64 = 1.0 + 1e-9;

/// Part of a piece of a parameter map by which rounding may place a curve beyond it.
const BREAK_MARGIN: f64 = 1e-9;

/// A fitted curve.
pub(super) struct Fit {
    pub(super) curve: Spline,
    /// An upper bound, in space, on the distance between the fit and the image of the
    /// curve at equal parameters.
    pub(super) error: f64,
}

/// Fits the image of a clamped curve under both maps to a tolerance in space.
pub(super) fn fit(curve: &Spline, maps: &[ParameterMap; 2], metric: &Metric, tolerance: f64) -> Fit {
    let mut fitter = Fitter { maps, metric, tolerance, knots: Vec::new(), controls: Vec::new(), error: 0.0 };
    for piece in curve.pieces() {
        fitter.piece(&piece, 0);
    }
    let [start, end] = curve.domain();
    let mut knots = vec![start; DEGREE + 1];
    knots.extend(fitter.knots.iter().filter(|&&knot| knot < end).flat_map(|&knot| [knot; DEGREE]));
    knots.extend([end; DEGREE + 1]);
    let controls = fitter.controls.iter().map(|point| point.extend(1.0)).collect();
    Fit { curve: Spline { degree: DEGREE, knots, controls }, error: fitter.error }
}

struct Fitter<'a> {
    maps: &'a [ParameterMap; 2],
    metric: &'a Metric,
    tolerance: f64,
    /// The ends of the pieces.
    knots: Vec<f64>,
    controls: Vec<DVec3>,
    error: f64,
}

impl Fitter<'_> {
    /// Fits a Bézier piece, or halves of it.
    fn piece(&mut self, piece: &Spline, depth: usize) {
        let [start, end] = piece.domain();
        if depth < MAX_DEPTH
            && let Some(cut) = self.break_inside(piece)
        {
            self.halves(piece, cut, depth);
            return;
        }
        let length = end - start;
        let over = self.images(piece, None);
        // |f - H| ≤ |f⁽⁶⁾| / 6! · |t³ (h - t)³| ≤ |f⁽⁶⁾| / 6! · (h / 2)⁶.
        let half = (0.5 * length).powi(DEGREE as i32 + 1);
        let [u, v] = over.map(|jet| jet.0[ORDER - 1].size() * half * ROUNDING);
        let error = self.metric.length(DVec3::new(u, v, 0.0));
        if depth < MAX_DEPTH && (error.is_nan() || error > self.tolerance) {
            self.halves(piece, 0.5 * (start + end), depth);
            return;
        }
        self.error = self.error.max(error);
        self.append(piece, length);
    }

    fn halves(&mut self, piece: &Spline, cut: f64, depth: usize) {
        let [start, end] = piece.domain();
        self.piece(&piece.sub_piece([start, cut]), depth + 1);
        self.piece(&piece.sub_piece([cut, end]), depth + 1);
    }

    /// Returns where to cut a piece whose control points are on both sides of a break of
    /// a map: where it crosses the break, if its ends are on both sides too.
    fn break_inside(&self, piece: &Spline) -> Option<f64> {
        let [start, end] = piece.domain();
        for axis in [0, 1] {
            let breaks = self.maps[axis].breaks();
            let Some(inner) = breaks.get(1..breaks.len().max(1) - 1) else { continue };
            let range = piece.points().fold(Interval::EMPTY, |range, point| range.with(point[axis]));
            let margin = BREAK_MARGIN * (breaks[1] - breaks[0]);
            for &at in inner {
                if range.low < at - margin && range.high > at + margin {
                    let (first, last) = (piece.start()[axis], piece.end()[axis]);
                    let crosses = (first - at) * (last - at) < 0.0
                        && (first - at).abs().min((last - at).abs()) > margin;
                    return Some(if crosses { crossing(piece, axis, at) } else { 0.5 * (start + end) });
                }
            }
        }
        None
    }

    /// Returns the Taylor coefficients of the image of u and of v: over the whole piece, or
    /// at one end.
    fn images(&self, piece: &Spline, at_end: Option<bool>) -> [Jet; 2] {
        let middle = piece.point(0.5 * (piece.domain()[0] + piece.domain()[1]));
        let weight = coefficients(piece, 3, at_end);
        [0, 1].map(|axis| {
            let jet = coefficients(piece, axis, at_end).quotient(&weight);
            let map = &self.maps[axis];
            match map.piece(middle[axis]) {
                None => jet,
                Some([middle, half]) => {
                    let hyperbolic = matches!(map, ParameterMap::Hyperbolic(_));
                    let tangent = if hyperbolic { (0.5 * half).tanh() } else { (0.5 * half).tan() };
                    jet.half_tangent(middle, half / tangent, hyperbolic)
                }
            }
        })
    }

    /// Appends the quintic with the image's values and two derivatives at both ends.
    fn append(&mut self, piece: &Spline, length: f64) {
        let end = |at_end: bool| {
            let [u, v] = self.images(piece, Some(at_end));
            [0, 1, 2].map(|order| DVec3::new(u.0[order].low, v.0[order].low, 0.0))
        };
        let inner = |[value, slope, bend]: [DVec3; 3], length: f64| {
            let first = value + length / 5.0 * slope;
            [value, first, 2.0 * first - value + length * length / 10.0 * bend]
        };
        let [a0, a1, a2] = inner(end(false), length);
        let [b0, b1, b2] = inner(end(true), -length);
        if self.controls.is_empty() {
            self.controls.push(a0);
        }
        self.controls.extend([a1, a2, b2, b1, b0]);
        self.knots.push(piece.domain()[1]);
    }
}

/// Returns the Taylor coefficients of a homogeneous coordinate of a Bézier piece, over
/// the whole piece or at one end. Over the piece the k-th derivative lies in the hull of
/// its control points, `n! / (n-k)! Δᵏ / hᵏ`.
fn coefficients(piece: &Spline, coordinate: usize, at_end: Option<bool>) -> Jet {
    let [start, end] = piece.domain();
    let mut differences: Vec<f64> =
        piece.controls.iter().map(|control: &DVec4| control[coordinate]).collect();
    let mut jet = [Interval::point(0.0); ORDER];
    let mut factor = 1.0;
    for (order, coefficient) in jet.iter_mut().enumerate() {
        *coefficient = match at_end {
            None => differences.iter().fold(Interval::EMPTY, |hull, &value| hull.with(factor * value)),
            Some(false) => Interval::point(factor * differences[0]),
            Some(true) => Interval::point(factor * differences[differences.len() - 1]),
        };
        if differences.len() == 1 {
            break;
        }
        factor *= (differences.len() - 1) as f64 / ((order + 1) as f64 * (end - start));
        differences = differences.windows(2).map(|pair| pair[1] - pair[0]).collect();
    }
    Jet(jet)
}
