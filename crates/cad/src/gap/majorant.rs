//! Bounds on curves and surfaces at complex parameters, by discs about a real one.

use super::local::{LocalCurve, LocalSurface};
use crate::nurbs::{Conic, Curve, Surface, project};
use glam::{DVec2, DVec3, DVec4, Vec4Swizzles};

/// An upper bound on `|C(z) - C(c)|`, by coordinate, for complex z around a real centre c.
pub(super) enum CurveMajorant {
    /// From the Taylor coefficients of a polynomial or rational curve, the sizes of those of
    /// order 1, 2, …: of its numerator less C(c) times its weight, and of its weight.
    Power { orders: Vec<DVec4>, weight: f64 },
    /// `factor (e^r - 1)`, of ellipses and hyperbolas.
    Exponential(DVec3),
    /// No bound is known.
    Unbounded,
}

impl CurveMajorant {
    /// The majorant about a parameter, which is the centre of the local curve.
    pub(super) fn new(local: &LocalCurve<'_>, center: f64) -> Self {
        match local {
            LocalCurve::Taylor { orders, .. } => {
                let at_center = project(orders[0]);
                let size = |order: &DVec4| (order.xyz() - order.w * at_center).extend(order.w).abs();
                Self::Power { orders: orders[1..].iter().map(size).collect(), weight: orders[0].w }
            }
            LocalCurve::Other(curve) => Self::of(curve, center),
        }
    }

    fn of(curve: &Curve, center: f64) -> Self {
        match curve {
            Curve::Line { direction, .. } => Self::polynomial(vec![*direction]),
            Curve::Conic { conic: Conic::Parabolic, x, y, .. } => {
                Self::polynomial(vec![2.0 * center * *x + *y, *x])
            }
            // |cos(c + z) - cos c| and |sin(c + z) - sin c| are at most cosh r - 1 + sinh r.
            Curve::Conic { conic: Conic::Elliptic, x, y, .. } => Self::Exponential(x.abs() + y.abs()),
            // The same with cosh c and |sinh c|, at most e^|c|, as factors.
            Curve::Conic { conic: Conic::Hyperbolic, x, y, .. } => {
                Self::Exponential(center.abs().exp() * (x.abs() + y.abs()))
            }
            Curve::Spline(_) | Curve::Trimmed { .. } => {
                Self::new(&LocalCurve::new(curve, center, center), center)
            }
            Curve::Offset { distance, normal, basis } => match basis.offset(*distance, *normal) {
                Some(curve) => Self::of(&curve, center),
                None => Self::Unbounded,
            },
        }
    }

    fn polynomial(orders: Vec<DVec3>) -> Self {
        Self::Power { orders: orders.into_iter().map(|order| order.abs().extend(0.0)).collect(), weight: 1.0 }
    }

    /// Returns the bound for all z within `radius` of the centre.
    pub(super) fn radii(&self, radius: f64) -> DVec3 {
        match self {
            Self::Power { orders, weight } => {
                let sum = orders.iter().rev().fold(DVec4::ZERO, |sum, &order| radius * (sum + order));
                sum.xyz() / positive(weight - sum.w)
            }
            Self::Exponential(factor) => radius.exp_m1() * *factor,
            Self::Unbounded => DVec3::INFINITY,
        }
    }
}

/// An upper bound on `|S(z) - S(c)|` for complex z around real parameters c.
pub(super) enum SurfaceMajorant {
    /// The lengths of the derivatives of an affine surface.
    Affine([f64; 2]),
    /// A profile, by its distance from the axis at the centre.
    Revolution {
        distance: f64,
        profile: CurveMajorant,
    },
    Extrusion {
        direction: f64,
        profile: CurveMajorant,
    },
    /// As [`CurveMajorant::Power`], with the lengths of the coefficients of orders (i, j), j
    /// fastest, of the numerator and the weight.
    Power {
        columns: usize,
        orders: Vec<DVec2>,
        weight: f64,
    },
    Unbounded,
}

impl SurfaceMajorant {
    /// The majorant about parameters, which are the centre of the local surface.
    pub(super) fn new(local: &LocalSurface<'_>, center: [f64; 2]) -> Self {
        match local {
            LocalSurface::Taylor { columns, orders, .. } => {
                let at_center = project(orders[0]);
                let size =
                    |order: &DVec4| DVec2::new((order.xyz() - order.w * at_center).length(), order.w.abs());
                let mut sizes: Vec<DVec2> = orders.iter().map(size).collect();
                sizes[0] = DVec2::ZERO;
                Self::Power { columns: *columns, orders: sizes, weight: orders[0].w }
            }
            LocalSurface::Revolution { profile, .. } => {
                let at_center = profile.point(center[1]);
                let distance = at_center.x.hypot(at_center.y);
                Self::Revolution { distance, profile: CurveMajorant::new(profile, center[1]) }
            }
            LocalSurface::Extrusion { direction, profile } => Self::Extrusion {
                direction: direction.length(),
                profile: CurveMajorant::new(profile, center[0]),
            },
            LocalSurface::Other(Surface::Plane(frame)) => Self::Affine([frame.x.length(), frame.y.length()]),
            LocalSurface::Other(_) => Self::Unbounded,
        }
    }

    /// Returns the bound for all (u, v) within these radii of the centre.
    ///
    /// The turn by a complex angle is a normal matrix with the eigenvalues 1 and e^(±iu), so
    /// that turns by c and c + z differ by at most e^r - 1, and the norm of each is at most e^r.
    pub(super) fn radius(&self, [u, v]: [f64; 2]) -> f64 {
        match self {
            Self::Affine([x, y]) => u * x + v * y,
            Self::Revolution { distance, profile } => {
                u.exp() * profile.radii(v).length() + u.exp_m1() * distance
            }
            Self::Extrusion { direction, profile } => profile.radii(u).length() + v * direction,
            Self::Power { columns, orders, weight } => {
                let row = |row: &[DVec2]| row.iter().rev().fold(DVec2::ZERO, |sum, &order| v * sum + order);
                let rows = orders.chunks_exact(*columns).rev();
                let sum = rows.fold(DVec2::ZERO, |sum, orders| u * sum + row(orders));
                sum.x / positive(weight - sum.y)
            }
            Self::Unbounded => f64::INFINITY,
        }
    }
}

/// Returns a lower bound on a weight, or 0, by which division gives no bound.
fn positive(weight: f64) -> f64 {
    if weight > 0.0 { weight } else { 0.0 }
}
