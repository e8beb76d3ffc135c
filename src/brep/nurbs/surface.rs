//! The surfaces of the file.

use super::basis::Basis;
use super::curve::Curve;
use super::frame::Frame;
use super::spline::{self, project, tensor_point};
use glam::{DVec3, DVec4};
use std::f64::consts::{FRAC_PI_2, TAU};

/// A surface.
#[derive(Debug, Clone)]
pub(crate) enum Surface {
    /// `origin + u x + v y`.
    Plane(Frame),
    /// The profile, in the frame's coordinates, turned by the angle u about z; v is the
    /// profile's parameter. Cylinders, cones, spheres and tori are of this kind.
    Revolution {
        frame: Frame,
        profile: Curve,
        kind: &'static str,
    },
    /// `profile(u) + v direction`.
    Extrusion {
        direction: DVec3,
        profile: Curve,
    },
    Spline(SplineSurface),
    /// The part of a surface within bounds.
    Trimmed {
        bounds: [[f64; 2]; 2],
        basis: Box<Self>,
    },
    /// An offset that is not rational, which no NURBS equals.
    Offset {
        basis: Box<Self>,
    },
}

/// A Bézier or B-spline surface.
#[derive(Debug, Clone)]
pub(crate) struct SplineSurface {
    pub(crate) bases: [Basis; 2],
    /// Homogeneous control points, v fastest.
    pub(crate) poles: Vec<DVec4>,
    /// The number of control points along v.
    pub(crate) columns: usize,
}

impl SplineSurface {
    pub(crate) fn new(bases: [Basis; 2], poles: Vec<DVec4>) -> Self {
        let columns = bases[1].pole_count();
        Self { bases, poles, columns }
    }

    fn point(&self, u: f64, v: f64) -> DVec3 {
        let [(knots_u, rows), (knots_v, columns)] = self.bases.each_ref().map(Basis::one_period);
        let [u, v] = [self.bases[0].reduced(u), self.bases[1].reduced(v)];
        let control = |i: usize, j: usize| self.poles[rows[i] * self.columns + columns[j]];
        tensor_point(self.bases.each_ref().map(|basis| basis.degree), [knots_u, knots_v], [u, v], control)
    }

    /// Returns the homogeneous Taylor coefficients at `center`, of orders (i, j), of the
    /// polynomial used around `inside`.
    pub(crate) fn taylor(&self, center: [f64; 2], inside: [f64; 2]) -> Vec<Vec<DVec4>> {
        let [(knots_u, rows), (knots_v, columns)] = self.bases.each_ref().map(Basis::one_period);
        let [p, q] = self.bases.each_ref().map(|basis| basis.degree);
        let reduced = [0, 1].map(|axis| self.bases[axis].reduced(inside[axis]));
        let [u, v] = [0, 1].map(|axis| center[axis] + (reduced[axis] - inside[axis]));
        let row = spline::span(knots_u, p, rows.len(), reduced[0]);
        let column = spline::span(knots_v, q, columns.len(), reduced[1]);
        let along_v: Vec<Vec<DVec4>> = rows[row - p..=row]
            .iter()
            .map(|&i| {
                let active = columns[column - q..=column].iter().map(|&j| self.poles[i * self.columns + j]);
                spline::taylor(knots_v, q, column, &active.collect::<Vec<_>>(), v)
            })
            .collect();
        let mut grid = vec![vec![DVec4::ZERO; q + 1]; p + 1];
        for j in 0..=q {
            let active: Vec<DVec4> = along_v.iter().map(|orders| orders[j]).collect();
            for (i, order) in spline::taylor(knots_u, p, row, &active, u).into_iter().enumerate() {
                grid[i][j] = order;
            }
        }
        grid
    }

    /// Returns whether the first and last row of control points along an axis coincide.
    fn closed(&self, axis: usize) -> bool {
        let rows = self.poles.len() / self.columns;
        let scale = self.poles.iter().map(|&pole| project(pole).abs().max_element()).fold(0.0, f64::max);
        let near =
            |a: usize, b: usize| project(self.poles[a]).distance(project(self.poles[b])) <= CLOSED * scale;
        if axis == 0 {
            (0..self.columns).all(|j| near(j, (rows - 1) * self.columns + j))
        } else {
            (0..rows).all(|i| near(i * self.columns, (i + 1) * self.columns - 1))
        }
    }
}

/// The distance of the ends of a closed surface relative to its coordinates: the
/// tolerance of 1e-7 that OpenCASCADE allows, for parts of a few hundred units.
const CLOSED: f64 = 1e-9;

impl Surface {
    /// Returns the point at parameters; of an offset that is not rational, its basis's.
    pub(crate) fn point(&self, u: f64, v: f64) -> DVec3 {
        match self {
            Self::Plane(frame) => frame.point(DVec3::new(u, v, 0.0)),
            Self::Revolution { frame, profile, .. } => {
                let ((sin, cos), local) = (u.sin_cos(), profile.point(v));
                let turned =
                    DVec3::new(cos * local.x - sin * local.y, sin * local.x + cos * local.y, local.z);
                frame.point(turned)
            }
            Self::Extrusion { direction, profile } => profile.point(u) + v * *direction,
            Self::Spline(spline) => spline.point(u, v),
            Self::Trimmed { basis, .. } => basis.point(u, v),
            Self::Offset { basis, .. } => basis.point(u, v),
        }
    }

    /// Returns the surface `S + distance (S_u × S_v) / |S_u × S_v|`, of the same kind where
    /// that is exact.
    ///
    /// The normal `S_u × S_v` of a revolution is that of its profile in the plane through
    /// the axis, and of an extrusion `C' × direction`, so that the offset is made of the
    /// offset profile. A profile out of that plane turns its offset out of it too.
    pub(crate) fn offset(self, distance: f64) -> Self {
        match self {
            Self::Plane(frame) => {
                let normal = frame.x.cross(frame.y).normalize_or_zero();
                Self::Plane(Frame { origin: frame.origin + distance * normal, ..frame })
            }
            Self::Revolution { frame, ref profile, kind } => {
                // At u = 0 the normal is y × C' = C' × -y, in a plane that contains the axis.
                let local = profile.offset(frame.handedness() * distance, -DVec3::Y);
                match local.filter(|_| in_plane(profile)) {
                    Some(profile) => Self::Revolution { frame, profile, kind },
                    None => Self::Offset { basis: Box::new(self) },
                }
            }
            Self::Extrusion { direction, ref profile } => match profile.offset(distance, direction) {
                Some(profile) => Self::Extrusion { direction, profile },
                None => Self::Offset { basis: Box::new(self) },
            },
            Self::Trimmed { bounds, basis } => {
                Self::Trimmed { bounds, basis: Box::new(basis.offset(distance)) }
            }
            Self::Spline(_) | Self::Offset { .. } => Self::Offset { basis: Box::new(self) },
        }
    }

    /// Returns the intervals around parameters on which the surface is analytic.
    pub(crate) fn cells(&self, [u, v]: [f64; 2]) -> [[f64; 2]; 2] {
        let whole = [f64::NEG_INFINITY, f64::INFINITY];
        match self {
            Self::Plane(_) | Self::Offset { .. } => [whole; 2],
            Self::Revolution { profile, .. } => [whole, profile.cell(v)],
            Self::Extrusion { profile, .. } => [profile.cell(u), whole],
            Self::Spline(spline) => [spline.bases[0].cell(u), spline.bases[1].cell(v)],
            Self::Trimmed { basis, .. } => basis.cells([u, v]),
        }
    }

    /// Returns the sum of the degrees of the polynomials that the surface is evaluated by.
    pub(crate) fn total_degree(&self) -> usize {
        match self {
            Self::Plane(_) | Self::Offset { .. } => 2,
            Self::Revolution { profile, .. } | Self::Extrusion { profile, .. } => 2 + profile.degree(),
            Self::Spline(spline) => spline.bases.iter().map(|basis| basis.degree).sum(),
            Self::Trimmed { basis, .. } => basis.total_degree(),
        }
    }

    /// Returns the periods in u and v.
    pub(crate) fn periods(&self) -> [Option<f64>; 2] {
        match self {
            Self::Plane(_) => [None, None],
            // The profile of a sphere is half of its circle.
            Self::Revolution { kind: "sphere", .. } => [Some(TAU), None],
            Self::Revolution { profile, .. } => [Some(TAU), profile.period()],
            Self::Extrusion { profile, .. } => [profile.period(), None],
            Self::Spline(spline) => [spline.bases[0].period(), spline.bases[1].period()],
            Self::Trimmed { basis, .. } | Self::Offset { basis, .. } => basis.periods(),
        }
    }

    /// Returns the lengths in u and v after which the surface meets itself, whether or
    /// not its parameters continue.
    pub(crate) fn closures(&self) -> [Option<f64>; 2] {
        match self {
            Self::Spline(spline) => [0, 1].map(|axis| {
                let [start, end] = spline.bases[axis].domain();
                spline.bases[axis].period().or_else(|| spline.closed(axis).then_some(end - start))
            }),
            Self::Trimmed { basis, .. } | Self::Offset { basis, .. } => basis.closures(),
            _ => self.periods(),
        }
    }

    /// Returns the ranges of the whole surface, `None` where it is unbounded.
    pub(crate) fn natural_ranges(&self) -> [Option<[f64; 2]>; 2] {
        match self {
            Self::Plane(_) => [None, None],
            Self::Revolution { kind: "sphere", .. } => [Some([0.0, TAU]), Some([-FRAC_PI_2, FRAC_PI_2])],
            Self::Revolution { profile, .. } => [Some([0.0, TAU]), profile.natural_range()],
            Self::Extrusion { profile, .. } => [profile.natural_range(), None],
            Self::Spline(spline) => [0, 1].map(|axis| Some(spline.bases[axis].domain())),
            Self::Trimmed { bounds, .. } => bounds.map(Some),
            Self::Offset { basis, .. } => basis.natural_ranges(),
        }
    }

    /// Returns the values of v at which all u are one point: the poles of a sphere and
    /// the apex of a cone.
    pub(crate) fn poles(&self) -> Vec<f64> {
        match self {
            Self::Revolution { kind: "sphere", .. } => vec![-FRAC_PI_2, FRAC_PI_2],
            Self::Revolution { profile, .. } if !in_plane(profile) => Vec::new(),
            Self::Revolution { profile: Curve::Line { point, direction }, .. } if direction.x != 0.0 => {
                vec![-point.x / direction.x]
            }
            Self::Trimmed { basis, .. } => basis.poles(),
            _ => Vec::new(),
        }
    }

    /// Returns the name of the kind of surface.
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Self::Plane(_) => "plane",
            Self::Revolution { kind, .. } => kind,
            Self::Extrusion { .. } => "extrusion",
            Self::Spline(_) => "spline",
            Self::Trimmed { basis, .. } => basis.kind(),
            Self::Offset { .. } => "offset",
        }
    }

    /// Returns the surface without the bounds of trimmed ones.
    pub(crate) fn elementary(&self) -> &Self {
        match self {
            Self::Trimmed { basis, .. } => basis.elementary(),
            other => other,
        }
    }
}

/// Returns whether a profile lies in the plane y = 0.
fn in_plane(profile: &Curve) -> bool {
    match profile {
        Curve::Line { point, direction } => point.y == 0.0 && direction.y == 0.0,
        Curve::Conic { center, x, y, .. } => center.y == 0.0 && x.y == 0.0 && y.y == 0.0,
        Curve::Trimmed { basis, .. } | Curve::Offset { basis, .. } => in_plane(basis),
        Curve::Spline(_) => false,
    }
}
