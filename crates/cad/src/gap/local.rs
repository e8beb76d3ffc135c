//! Curves and surfaces about the middle of a part.

use super::Lifted;
use crate::nurbs::{Curve, Frame, Surface, project};
use glam::{DVec3, DVec4};

/// The parameters of corresponding points of the curve and the edge, at both ends.
pub(super) type Ends = [(f64, f64); 2];

/// A curve on the cell around a parameter.
pub(super) enum LocalCurve<'a> {
    /// The homogeneous Taylor coefficients of a spline at its centre, by which it is evaluated
    /// in fewer operations than by its control points.
    Taylor { center: f64, orders: Vec<DVec4> },
    /// A curve of another kind, as it is.
    Other(&'a Curve),
}

impl<'a> LocalCurve<'a> {
    /// The curve about `center`, of the cell around `inside`.
    pub(super) fn new(curve: &'a Curve, center: f64, inside: f64) -> Self {
        match curve {
            Curve::Spline(spline) => Self::Taylor { center, orders: spline.taylor(center, inside) },
            Curve::Trimmed { basis, .. } => Self::new(basis, center, inside),
            _ => Self::Other(curve),
        }
    }

    pub(super) fn point(&self, t: f64) -> DVec3 {
        match self {
            Self::Taylor { center, orders } => project(horner(orders, t - center)),
            Self::Other(curve) => curve.point(t),
        }
    }

    /// Returns the point and the derivative.
    pub(super) fn jet(&self, t: f64) -> [DVec3; 2] {
        match self {
            Self::Taylor { center, orders } => {
                let (mut value, mut slope) = (DVec4::ZERO, DVec4::ZERO);
                for &order in orders.iter().rev() {
                    slope = (t - center) * slope + value;
                    value = (t - center) * value + order;
                }
                let point = project(value);
                [point, (slope.truncate() - slope.w * point) / value.w]
            }
            Self::Other(curve) => curve.jet(t),
        }
    }
}

/// A surface on the cell around parameters, as [`LocalCurve`].
pub(super) enum LocalSurface<'a> {
    /// The coefficients of orders (i, j), j fastest, and the number of columns.
    Taylor {
        center: [f64; 2],
        columns: usize,
        orders: Vec<DVec4>,
    },
    Revolution {
        frame: &'a Frame,
        profile: LocalCurve<'a>,
    },
    Extrusion {
        direction: DVec3,
        profile: LocalCurve<'a>,
    },
    Other(&'a Surface),
}

impl<'a> LocalSurface<'a> {
    /// The surface about `center`, of the cell around `inside`.
    pub(super) fn new(surface: &'a Surface, center: [f64; 2], inside: [f64; 2]) -> Self {
        match surface {
            Surface::Spline(spline) => {
                let columns = spline.bases[1].degree + 1;
                Self::Taylor { center, columns, orders: spline.taylor(center, inside) }
            }
            Surface::Revolution { frame, profile, .. } => {
                Self::Revolution { frame, profile: LocalCurve::new(profile, center[1], inside[1]) }
            }
            Surface::Extrusion { direction, profile } => Self::Extrusion {
                direction: *direction,
                profile: LocalCurve::new(profile, center[0], inside[0]),
            },
            Surface::Trimmed { basis, .. } => Self::new(basis, center, inside),
            _ => Self::Other(surface),
        }
    }

    fn point(&self, [u, v]: [f64; 2]) -> DVec3 {
        match self {
            Self::Taylor { center, columns, orders } => {
                let rows = orders.chunks_exact(*columns).rev();
                let value =
                    rows.fold(DVec4::ZERO, |sum, row| (u - center[0]) * sum + horner(row, v - center[1]));
                project(value)
            }
            Self::Revolution { frame, profile } => frame.turned(profile.point(v), u),
            Self::Extrusion { direction, profile } => profile.point(u) + v * *direction,
            Self::Other(surface) => surface.point(u, v),
        }
    }
}

/// Returns the value of a polynomial of these coefficients, the constant one first.
fn horner(orders: &[DVec4], x: f64) -> DVec4 {
    orders.iter().rev().fold(DVec4::ZERO, |sum, &order| x * sum + order)
}

/// A curve on a surface and its edge about the middle of a part.
pub(super) struct Local<'a> {
    pub(super) lifted: &'a Lifted<'a>,
    pub(super) curve: LocalCurve<'a>,
    pub(super) surface: LocalSurface<'a>,
    pub(super) edge: LocalCurve<'a>,
}

impl Local<'_> {
    /// Returns the point on the surface less the point of the edge, in space.
    pub(super) fn difference(&self, t: f64, s: f64) -> DVec3 {
        self.on_surface(t) - self.lifted.edge_location.transform_point3(self.edge.point(s))
    }

    pub(super) fn on_surface(&self, t: f64) -> DVec3 {
        let at = self.curve.point(t);
        self.lifted.surface_location.transform_point3(self.surface.point([at.x, at.y]))
    }

    /// Returns the point of the edge and its derivative, in space.
    pub(super) fn edge_jet(&self, s: f64) -> [DVec3; 2] {
        let [point, slope] = self.edge.jet(s);
        let location = self.lifted.edge_location;
        [location.transform_point3(point), location.transform_vector3(slope)]
    }
}
