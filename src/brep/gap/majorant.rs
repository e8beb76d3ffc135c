//! Bounds on curves and surfaces at complex parameters, by discs about a real one.

use crate::brep::nurbs::{Conic, Curve, Surface, project};
use glam::{DVec3, DVec4, Vec4Swizzles};

/// An upper bound on `|C(z) - C(c)|`, by coordinate, for complex z around a real centre c.
pub(super) enum CurveMajorant {
    /// From the Taylor coefficients of a polynomial or rational curve: those of order
    /// 1, 2, … of its numerator less those of its weight times C(c), and of its weight.
    Power { moves: Vec<DVec3>, weights: Vec<f64>, weight: f64 },
    /// `factor (e^r - 1)`, of ellipses and hyperbolas.
    Exponential(DVec3),
    /// No bound is known.
    Unbounded,
}

impl CurveMajorant {
    /// The majorant about `center`, of the polynomial used around `inside`.
    pub(super) fn new(curve: &Curve, center: f64, inside: f64) -> Self {
        match curve {
            Curve::Line { direction, .. } => Self::polynomial(vec![direction.abs()]),
            Curve::Conic { conic: Conic::Parabolic, x, y, .. } => {
                Self::polynomial(vec![(2.0 * center * *x + *y).abs(), x.abs()])
            }
            // |cos(c + z) - cos c| and |sin(c + z) - sin c| are at most cosh r - 1 + sinh r.
            Curve::Conic { conic: Conic::Elliptic, x, y, .. } => Self::Exponential(x.abs() + y.abs()),
            // The same with cosh c and |sinh c|, at most e^|c|, as factors.
            Curve::Conic { conic: Conic::Hyperbolic, x, y, .. } => {
                Self::Exponential(center.abs().exp() * (x.abs() + y.abs()))
            }
            Curve::Spline(spline) => Self::rational(&spline.taylor(center, inside)),
            Curve::Trimmed { basis, .. } => Self::new(basis, center, inside),
            Curve::Offset { distance, normal, basis } => match basis.offset(*distance, *normal) {
                Some(curve) => Self::new(&curve, center, inside),
                None => Self::Unbounded,
            },
        }
    }

    fn polynomial(moves: Vec<DVec3>) -> Self {
        Self::Power { weights: vec![0.0; moves.len()], moves, weight: 1.0 }
    }

    fn rational(taylor: &[DVec4]) -> Self {
        let at_center = project(taylor[0]);
        let moved = |order: &DVec4| (order.xyz() - order.w * at_center).abs();
        Self::Power {
            moves: taylor[1..].iter().map(moved).collect(),
            weights: taylor[1..].iter().map(|order| order.w.abs()).collect(),
            weight: taylor[0].w,
        }
    }

    /// Returns the bound for all z within `radius` of the centre.
    pub(super) fn radii(&self, radius: f64) -> DVec3 {
        match self {
            Self::Power { moves, weights, weight } => {
                let numerator = moves.iter().rev().fold(DVec3::ZERO, |sum, &order| radius * (sum + order));
                let lost = weights.iter().rev().fold(0.0, |sum, &order| radius * (sum + order));
                numerator / positive(weight - lost)
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
    /// As [`CurveMajorant::Power`], with the coefficients of order (i, j) in row i.
    Power {
        moves: Vec<Vec<f64>>,
        weights: Vec<Vec<f64>>,
        weight: f64,
    },
    Unbounded,
}

impl SurfaceMajorant {
    /// The majorant about `center`, of the polynomial used around `inside`.
    pub(super) fn new(surface: &Surface, center: [f64; 2], inside: [f64; 2]) -> Self {
        match surface {
            Surface::Plane(frame) => Self::Affine([frame.x.length(), frame.y.length()]),
            Surface::Revolution { profile, .. } => {
                let local = profile.point(center[1]);
                let profile = CurveMajorant::new(profile, center[1], inside[1]);
                Self::Revolution { distance: local.x.hypot(local.y), profile }
            }
            Surface::Extrusion { direction, profile } => Self::Extrusion {
                direction: direction.length(),
                profile: CurveMajorant::new(profile, center[0], inside[0]),
            },
            Surface::Spline(spline) => Self::rational(&spline.taylor(center, inside)),
            Surface::Trimmed { basis, .. } => Self::new(basis, center, inside),
            Surface::Offset { .. } => Self::Unbounded,
        }
    }

    fn rational(taylor: &[Vec<DVec4>]) -> Self {
        let at_center = project(taylor[0][0]);
        let grid = |value: &dyn Fn(&DVec4) -> f64| -> Vec<Vec<f64>> {
            let mut rows: Vec<Vec<f64>> = taylor.iter().map(|row| row.iter().map(value).collect()).collect();
            rows[0][0] = 0.0;
            rows
        };
        Self::Power {
            moves: grid(&|order| (order.xyz() - order.w * at_center).length()),
            weights: grid(&|order| order.w.abs()),
            weight: taylor[0][0].w,
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
            Self::Power { moves, weights, weight } => {
                let sum = |grid: &[Vec<f64>]| {
                    let row = |row: &Vec<f64>| row.iter().rev().fold(0.0, |sum, &order| v * sum + order);
                    grid.iter().rev().fold(0.0, |sum, orders| u * sum + row(orders))
                };
                sum(moves) / positive(weight - sum(weights))
            }
            Self::Unbounded => f64::INFINITY,
        }
    }
}

/// Returns a lower bound on a weight, or 0, by which division gives no bound.
fn positive(weight: f64) -> f64 {
    if weight > 0.0 { weight } else { 0.0 }
}
