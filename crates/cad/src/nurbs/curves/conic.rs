//! Arcs of conics as rational quadratic curves.

use crate::nurbs::parameter_map::ParameterMap;
use crate::nurbs::spline::Spline;
use glam::{DVec3, DVec4};
use std::f64::consts::{FRAC_PI_2, TAU};

/// The parametrization of a conic with centre c and axes x, y.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Conic {
    /// `c + cos t x + sin t y`.
    Elliptic,
    /// `c + t² x + t y`.
    Parabolic,
    /// `c + cosh t x + sinh t y`.
    Hyperbolic,
}

/// The largest range of a piece of an ellipse: the weight of its middle control point
/// is at least cos(π / 4).
const MAX_ANGLE: f64 = FRAC_PI_2;

/// The largest range of a piece of a hyperbola: the weight of its middle control point
/// is at most cosh 1/2.
const MAX_HYPERBOLIC_RANGE: f64 = 1.0;

/// Part of the largest range by which a range may exceed it: files state parameters to
/// 15 digits, and a full turn is four quarters.
const RANGE_MARGIN: f64 = 1e-9;

impl Conic {
    /// Returns the coefficients of x and y at a parameter.
    pub(crate) fn point(self, t: f64) -> [f64; 2] {
        self.jet(t)[0]
    }

    /// Returns the derivatives of [`Conic::point`].
    pub(crate) fn tangent(self, t: f64) -> [f64; 2] {
        self.jet(t)[1]
    }

    /// Returns the coefficients of x and y at a parameter, and their derivatives.
    pub(crate) fn jet(self, t: f64) -> [[f64; 2]; 2] {
        match self {
            Self::Elliptic => {
                let (sin, cos) = t.sin_cos();
                [[cos, sin], [-sin, cos]]
            }
            Self::Parabolic => [[t * t, t], [2.0 * t, 1.0]],
            Self::Hyperbolic => {
                let (sinh, cosh) = (t.sinh(), t.cosh());
                [[cosh, sinh], [sinh, cosh]]
            }
        }
    }

    /// Returns the period, or for a curve without period the range that stands for it: a
    /// hyperbola reaches e^8 of its axes within 8 of the parameter.
    pub(crate) fn longest_range(self) -> f64 {
        match self {
            Self::Elliptic => TAU,
            Self::Parabolic => f64::MAX.sqrt(),
            Self::Hyperbolic => 8.0,
        }
    }

    /// Returns the ends of the pieces into which a range is cut.
    pub(crate) fn breaks(self, [start, end]: [f64; 2]) -> Vec<f64> {
        let longest = match self {
            Self::Elliptic => MAX_ANGLE,
            Self::Parabolic => f64::INFINITY,
            Self::Hyperbolic => MAX_HYPERBOLIC_RANGE,
        };
        let pieces = ((end - start) / longest - RANGE_MARGIN).ceil().max(1.0) as usize;
        let at = |index: usize| {
            let fraction = index as f64 / pieces as f64;
            if index == pieces { end } else { start + fraction * (end - start) }
        };
        (0..=pieces).map(at).collect()
    }

    /// Returns the map from the conic's parameter to that of [`Conic::spline`].
    pub(crate) fn map(self, breaks: Vec<f64>) -> ParameterMap {
        match self {
            Self::Elliptic => ParameterMap::Circular(breaks),
            Self::Parabolic => ParameterMap::Identity,
            Self::Hyperbolic => ParameterMap::Hyperbolic(breaks),
        }
    }

    /// Returns the arc over these breaks, which are its knots.
    ///
    /// The middle control point of a piece is where the end tangents meet: for half
    /// range a and middle m that of the ellipse has the coefficients `(cos m, sin m) /
    /// cos a` and weight cos a; of the hyperbola with cosh in the place of cos
    /// (Piegl and Tiller, *The NURBS Book*, chapter 7).
    pub(crate) fn spline(self, breaks: &[f64], center: DVec3, x: DVec3, y: DVec3) -> Spline {
        let control =
            |[a, b]: [f64; 2], weight: f64| -> DVec4 { (weight * center + a * x + b * y).extend(weight) };
        let mut controls = vec![control(self.point(breaks[0]), 1.0)];
        let mut knots = vec![breaks[0]; 3];
        for pair in breaks.windows(2) {
            let (middle, half) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
            controls.push(match self {
                Self::Elliptic => control(self.point(middle), half.cos()),
                Self::Parabolic => control([pair[0] * pair[1], middle], 1.0),
                Self::Hyperbolic => control(self.point(middle), half.cosh()),
            });
            controls.push(control(self.point(pair[1]), 1.0));
            knots.extend([pair[1]; 2]);
        }
        knots.push(breaks[breaks.len() - 1]);
        Spline { degree: 2, knots, controls }
    }
}
