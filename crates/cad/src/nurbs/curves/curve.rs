//! The curves of the file.

use crate::nurbs::basis::Basis;
use crate::nurbs::conic::Conic;
use crate::nurbs::conversion::{Unconvertible, check_range};
use crate::nurbs::curve_faults::lacks_side;
use crate::nurbs::frame::Frame;
use crate::nurbs::net::interpolated_curve;
use crate::nurbs::parameter_map::ParameterMap;
use crate::nurbs::spline::{self, CLOSED, Spline, project};
use glam::{DVec3, DVec4};
use std::f64::consts::TAU;

/// A curve in space, or in the parameter plane z = 0.
#[derive(Debug, Clone)]
pub(crate) enum Curve {
    /// `point + t direction`.
    Line {
        point: DVec3,
        direction: DVec3,
    },
    /// A conic with its lengths in x and y.
    Conic {
        conic: Conic,
        center: DVec3,
        x: DVec3,
        y: DVec3,
    },
    Spline(SplineCurve),
    /// The part of a curve between two parameters.
    Trimmed {
        range: [f64; 2],
        basis: Box<Self>,
    },
    /// `C + distance (C' × normal) / |C' × normal|`.
    Offset {
        distance: f64,
        normal: DVec3,
        basis: Box<Self>,
    },
}

/// A Bézier or B-spline curve.
#[derive(Debug, Clone)]
pub(crate) struct SplineCurve {
    basis: Basis,
    poles: Vec<DVec4>,
    /// The curve over [`Basis::domain`].
    one_period: Spline,
    /// A bound on the distance between a point of it and that of the file's curve at the same parameter.
    error: f64,
}

impl From<Spline> for SplineCurve {
    /// The clamped spline over its whole domain.
    fn from(spline: Spline) -> Self {
        let basis = Basis::with_knots(spline.degree, spline.knots.clone(), spline.controls.len());
        Self { basis, poles: spline.controls.clone(), one_period: spline, error: 0.0 }
    }
}

impl SplineCurve {
    pub(crate) fn new(basis: Basis, poles: Vec<DVec4>) -> Self {
        let (knots, indices) = basis.one_period();
        let controls = indices.iter().map(|&index| poles[index]).collect();
        let one_period = Spline { degree: basis.degree, knots: knots.to_vec(), controls };
        Self { basis, poles, one_period, error: 0.0 }
    }

    /// Returns the curve with this bound on its distance from the file's.
    pub(crate) fn with_error(self, error: f64) -> Self {
        Self { error, ..self }
    }

    /// Returns the curve over clamped knots of a range; `None` for one that no edge may have.
    pub(in crate::nurbs) fn over_valid(&self, range: [f64; 2]) -> Option<Spline> {
        self.basis.check_range(range).ok().map(|()| self.over(range))
    }

    /// Returns the curve over clamped knots of `range`.
    fn over(&self, range: [f64; 2]) -> Spline {
        let (knots, indices) = self.basis.unrolled(range);
        let controls = indices.iter().map(|&index| self.poles[index]).collect();
        let spline = Spline { degree: self.basis.degree, knots, controls };
        let clamped = self.basis.clamped(range);
        if clamped == spline.knots { spline } else { spline.with_knots(&clamped) }
    }
}

impl SplineCurve {
    /// Returns the homogeneous Taylor coefficients at `center` of the polynomial used around
    /// `inside`.
    pub(crate) fn taylor(&self, center: f64, inside: f64) -> Vec<DVec4> {
        let Spline { degree, knots, controls } = &self.one_period;
        let reduced = self.basis.reduced(inside);
        let span = spline::span(knots, *degree, controls.len(), reduced);
        let mut orders = controls[span - degree..=span].to_vec();
        spline::taylor(knots, *degree, span, &mut orders, center + (reduced - inside));
        orders
    }
}

impl Curve {
    /// Returns the point at a parameter.
    pub(crate) fn point(&self, t: f64) -> DVec3 {
        match self {
            Self::Line { point, direction } => *point + t * *direction,
            Self::Conic { conic, center, x, y } => {
                let [a, b] = conic.point(t);
                *center + a * *x + b * *y
            }
            Self::Spline(spline) => spline.one_period.point(spline.basis.reduced(t)),
            Self::Trimmed { basis, .. } => basis.point(t),
            Self::Offset { distance, normal, basis } => {
                let side = basis.tangent(t).cross(*normal);
                basis.point(t) + *distance * side.normalize_or_zero()
            }
        }
    }

    /// Returns the derivative at a parameter.
    pub(crate) fn tangent(&self, t: f64) -> DVec3 {
        match self {
            Self::Line { direction, .. } => *direction,
            Self::Conic { conic, x, y, .. } => {
                let [a, b] = conic.tangent(t);
                a * *x + b * *y
            }
            Self::Spline(spline) => spline.one_period.tangent(spline.basis.reduced(t)),
            Self::Trimmed { basis, .. } => basis.tangent(t),
            // The direction is the basis curve's; the length serves normals only.
            Self::Offset { basis, .. } => basis.tangent(t),
        }
    }

    /// Returns the point and the derivative at a parameter.
    pub(crate) fn jet(&self, t: f64) -> [DVec3; 2] {
        match self {
            Self::Conic { conic, center, x, y } => {
                let [[a, b], [c, d]] = conic.jet(t);
                [*center + a * *x + b * *y, c * *x + d * *y]
            }
            Self::Trimmed { basis, .. } => basis.jet(t),
            _ => [self.point(t), self.tangent(t)],
        }
    }

    /// Returns the offset as a curve of the same kind if it is one, else as [`Curve::Offset`].
    pub(crate) fn any_offset(&self, distance: f64, normal: DVec3) -> Self {
        let inexact = || Self::Offset { distance, normal, basis: Box::new(self.clone()) };
        self.offset(distance, normal).unwrap_or_else(inexact)
    }

    /// Returns whether the curve lies in the plane y = 0.
    pub(crate) fn is_in_plane(&self) -> bool {
        match self {
            Self::Line { point, direction } => point.y == 0.0 && direction.y == 0.0,
            Self::Conic { center, x, y, .. } => center.y == 0.0 && x.y == 0.0 && y.y == 0.0,
            Self::Trimmed { basis, .. } | Self::Offset { basis, .. } => basis.is_in_plane(),
            Self::Spline(spline) => spline.poles.iter().all(|pole| pole.y == 0.0),
        }
    }

    /// Returns whether the curve is part of a conic.
    pub(crate) fn is_conic(&self) -> bool {
        match self {
            Self::Conic { .. } => true,
            Self::Trimmed { basis, .. } => basis.is_conic(),
            _ => false,
        }
    }

    /// Returns the period of a closed periodic curve.
    pub(crate) fn period(&self) -> Option<f64> {
        match self {
            Self::Conic { conic: Conic::Elliptic, .. } => Some(TAU),
            Self::Spline(spline) => spline.basis.period(),
            Self::Offset { basis, .. } => basis.period(),
            _ => None,
        }
    }

    /// Returns a closed B-spline with a parameter that continues over its end; `None` for other curves.
    pub(crate) fn continued(&self) -> Option<Self> {
        let Self::Spline(SplineCurve { basis, poles, error, .. }) = self else { return None };
        let (basis, first) = basis.continued()?;
        let count = basis.pole_count();
        let repeats = poles.iter().zip(poles.get(count..)?).all(|(pole, later)| pole == later);
        let own = poles.get(first..first + count).filter(|_| repeats)?;
        Some(Self::Spline(SplineCurve::new(basis, own.to_vec()).with_error(*error)))
    }

    /// Returns the length after which the curve meets itself, whether or not its parameter
    /// continues.
    pub(crate) fn closure(&self) -> Option<f64> {
        self.period().or_else(|| {
            let [start, end] = self.natural_range()?;
            let [first, last, middle] = [start, end, 0.5 * (start + end)].map(|t| self.point(t));
            let scale = first.abs().max(middle.abs()).max_element();
            (first.distance(last) <= CLOSED * scale).then_some(end - start)
        })
    }

    /// Returns the interval around a parameter on which the curve is analytic.
    pub(crate) fn cell(&self, t: f64) -> [f64; 2] {
        match self {
            Self::Line { .. } | Self::Conic { .. } => [f64::NEG_INFINITY, f64::INFINITY],
            Self::Spline(spline) => spline.basis.cell(t),
            Self::Trimmed { basis, .. } | Self::Offset { basis, .. } => basis.cell(t),
        }
    }

    /// Returns the number of control points in the file.
    pub(crate) fn pole_count(&self) -> usize {
        match self {
            Self::Line { .. } | Self::Conic { .. } => 0,
            Self::Spline(spline) => spline.poles.len(),
            Self::Trimmed { basis, .. } | Self::Offset { basis, .. } => basis.pole_count(),
        }
    }

    /// Returns the degree of the polynomials that the curve is evaluated by.
    pub(crate) fn degree(&self) -> usize {
        match self {
            Self::Line { .. } | Self::Conic { .. } => 2,
            Self::Spline(spline) => spline.basis.degree,
            Self::Trimmed { basis, .. } | Self::Offset { basis, .. } => basis.degree(),
        }
    }

    /// Returns the range of the whole curve, if it is bounded.
    pub(crate) fn natural_range(&self) -> Option<[f64; 2]> {
        match self {
            Self::Conic { conic: Conic::Elliptic, .. } => Some([0.0, TAU]),
            Self::Line { .. } | Self::Conic { .. } => None,
            Self::Spline(spline) => Some(spline.basis.domain()),
            Self::Trimmed { range, .. } => Some(*range),
            Self::Offset { basis, .. } => basis.natural_range(),
        }
    }

    /// Returns the rational curve over `range`, a clamped spline, the map from this curve's
    /// parameter to the spline's, and the deviation: 0 unless the curve is an offset that is
    /// not rational; [`interpolated_curve`] approximates them.
    ///
    /// # Errors
    /// [`Unconvertible`], also for a range that is empty.
    pub(crate) fn spline(&self, range: [f64; 2]) -> Result<(Spline, ParameterMap, f64), Unconvertible> {
        match self {
            Self::Line { .. } => {
                let [start, end] = range.map(|t| self.point(t));
                if range[0] >= range[1] {
                    return Err(Unconvertible::Range);
                }
                Ok((Spline::segment(range, start, end), ParameterMap::Identity, 0.0))
            }
            Self::Conic { conic, center, x, y } => {
                check_range(range, conic.longest_range())?;
                let breaks = conic.breaks(range);
                Ok((conic.spline(&breaks, *center, *x, *y), conic.map(breaks), 0.0))
            }
            Self::Spline(spline) => {
                spline.basis.check_range(range)?;
                Ok((spline.over(range), ParameterMap::Identity, 0.0))
            }
            Self::Trimmed { basis, .. } => basis.spline(range),
            Self::Offset { distance, normal, basis } => {
                let (spline, _, _) = basis.spline(range)?;
                let mut breaks = spline.knots;
                breaks.dedup();
                if *distance != 0.0 && lacks_side(basis, *normal, &breaks) {
                    return Err(Unconvertible::OffsetSide);
                }
                if let Some(exact) = basis.offset(*distance, *normal) {
                    return exact.spline(range);
                }
                interpolated_curve(&|t| self.point(t), &breaks)
            }
        }
    }

    /// Returns the offset of a line or circle, which is of the same kind with equal
    /// parameters; `None` for other curves.
    pub(crate) fn offset(&self, distance: f64, normal: DVec3) -> Option<Self> {
        match self {
            Self::Line { point, direction } => {
                let side = direction.cross(normal).try_normalize()?;
                Some(Self::Line { point: *point + distance * side, direction: *direction })
            }
            Self::Conic { conic: Conic::Elliptic, center, x, y } => {
                let radius = x.length();
                let along = x.cross(*y).try_normalize()?.dot(normal.try_normalize()?);
                let circle = (y.length() - radius).abs() <= SAME_DIRECTION * radius
                    && x.dot(*y).abs() <= SAME_DIRECTION * radius * radius;
                if !circle || 1.0 - along.abs() > SAME_DIRECTION {
                    return None;
                }
                // Outward is C' × (x × y).
                let scale = 1.0 + distance * along.signum() / radius;
                Some(Self::Conic { conic: Conic::Elliptic, center: *center, x: scale * *x, y: scale * *y })
            }
            Self::Trimmed { range, basis } => {
                let basis = Box::new(basis.offset(distance, normal)?);
                Some(Self::Trimmed { range: *range, basis })
            }
            Self::Offset { distance: inner, normal: direction, basis } => {
                basis.offset(*inner, *direction)?.offset(distance, normal)
            }
            _ => None,
        }
    }

    /// Returns the curve whose point at -t is this one's at t.
    pub(crate) fn reversed(self) -> Self {
        match self {
            Self::Line { point, direction } => Self::Line { point, direction: -direction },
            Self::Conic { conic, center, x, y } => Self::Conic { conic, center, x, y: -y },
            Self::Spline(spline) => {
                let SplineCurve { one_period: Spline { degree, knots, mut controls }, error, .. } = spline;
                controls.reverse();
                let knots = knots.iter().rev().map(|knot| -knot).collect();
                Self::Spline(SplineCurve::from(Spline { degree, knots, controls }).with_error(error))
            }
            Self::Trimmed { range: [start, end], basis } => {
                Self::Trimmed { range: [-end, -start], basis: Box::new(basis.reversed()) }
            }
            // The tangent turns round, and with it the side.
            Self::Offset { distance, normal, basis } => {
                Self::Offset { distance: -distance, normal, basis: Box::new(basis.reversed()) }
            }
        }
    }

    /// Returns a bound on the distance between a point of the curve and that of the file's at the same
    /// parameter; of an offset, that of its basis.
    pub(crate) fn error(&self) -> f64 {
        match self {
            Self::Line { .. } | Self::Conic { .. } => 0.0,
            Self::Spline(spline) => spline.error,
            Self::Trimmed { basis, .. } | Self::Offset { basis, .. } => basis.error(),
        }
    }

    /// Returns the curve in the coordinates of a frame.
    pub(crate) fn in_frame(self, frame: &Frame) -> Self {
        match self {
            Self::Line { point, direction } => {
                Self::Line { point: frame.local_point(point), direction: frame.local_vector(direction) }
            }
            Self::Conic { conic, center, x, y } => Self::Conic {
                conic,
                center: frame.local_point(center),
                x: frame.local_vector(x),
                y: frame.local_vector(y),
            },
            Self::Spline(spline) => {
                let local = |&pole: &DVec4| (pole.w * frame.local_point(project(pole))).extend(pole.w);
                let poles = spline.poles.iter().map(local).collect();
                Self::Spline(SplineCurve::new(spline.basis, poles).with_error(spline.error))
            }
            Self::Trimmed { range, basis } => Self::Trimmed { range, basis: Box::new(basis.in_frame(frame)) },
            Self::Offset { distance, normal, basis } => Self::Offset {
                // A cross product turns round in a left-handed frame.
                distance: distance * frame.handedness(),
                normal: frame.local_vector(normal),
                basis: Box::new(basis.in_frame(frame)),
            },
        }
    }
}

/// The difference of unit vectors, or of lengths relative to them, below which they are
/// equal: files state directions to 15 digits.
const SAME_DIRECTION: f64 = 1e-12;
