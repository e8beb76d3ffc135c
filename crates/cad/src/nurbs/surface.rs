//! The surfaces of the file.

use super::basis::Basis;
use super::curve::Curve;
use super::frame::Frame;
use super::spline::{self, CLOSED, Spline, project, span, tensor_point};
use glam::{DVec3, DVec4};
use nurbs_hausdorff::workspace::blossom;
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
    /// `S + distance N`, N the unit normal along `S_u × S_v`, which no NURBS equals.
    Offset {
        distance: f64,
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
    /// A bound on the distance between a point of it and that of the file's surface at the same parameters.
    pub(crate) error: f64,
}

impl SplineSurface {
    pub(crate) fn new(bases: [Basis; 2], poles: Vec<DVec4>) -> Self {
        let columns = bases[1].pole_count();
        Self { bases, poles, columns, error: 0.0 }
    }

    fn point(&self, u: f64, v: f64) -> DVec3 {
        let [(knots_u, rows), (knots_v, columns)] = self.bases.each_ref().map(Basis::one_period);
        let [u, v] = [self.bases[0].reduced(u), self.bases[1].reduced(v)];
        let control = |i: usize, j: usize| self.poles[rows[i] * self.columns + columns[j]];
        tensor_point(self.bases.each_ref().map(|basis| basis.degree), [knots_u, knots_v], [u, v], control)
    }

    /// Returns the tangents in u and v.
    fn tangents(&self, u: f64, v: f64) -> [DVec3; 2] {
        let [(knots_u, rows), (knots_v, columns)] = self.bases.each_ref().map(Basis::one_period);
        let [u, v] = [self.bases[0].reduced(u), self.bases[1].reduced(v)];
        let [p, q] = self.bases.each_ref().map(|basis| basis.degree);
        let row = span(knots_u, p, knots_u.len() - p - 1, u);
        let column = span(knots_v, q, knots_v.len() - q - 1, v);
        // The curve v = const as a spline in u, and u = const as one in v.
        let control = |i: usize, j: usize| self.poles[rows[i] * self.columns + columns[j]];
        let in_u = (row - p..=row).map(|i| {
            let along: Vec<DVec4> = (column - q..=column).map(|j| control(i, j)).collect();
            blossom(knots_v, q, column, &along, |_| v)
        });
        let in_v = (column - q..=column).map(|j| {
            let along: Vec<DVec4> = (row - p..=row).map(|i| control(i, j)).collect();
            blossom(knots_u, p, row, &along, |_| u)
        });
        let local =
            |knots: &[f64], span: usize, degree: usize| knots[span - degree..=span + degree + 1].to_vec();
        let curves = [
            Spline { degree: p, knots: local(knots_u, row, p), controls: in_u.collect() },
            Spline { degree: q, knots: local(knots_v, column, q), controls: in_v.collect() },
        ];
        [curves[0].tangent(u), curves[1].tangent(v)]
    }

    /// Returns the homogeneous Taylor coefficients at `center`, of orders (i, j) with j fastest,
    /// of the polynomial used around `inside`. O(p q (p + q)).
    pub(crate) fn taylor(&self, center: [f64; 2], inside: [f64; 2]) -> Vec<DVec4> {
        let [(knots_u, rows), (knots_v, columns)] = self.bases.each_ref().map(Basis::one_period);
        let [p, q] = self.bases.each_ref().map(|basis| basis.degree);
        let reduced = [0, 1].map(|axis| self.bases[axis].reduced(inside[axis]));
        let [u, v] = [0, 1].map(|axis| center[axis] + (reduced[axis] - inside[axis]));
        let row = span(knots_u, p, rows.len(), reduced[0]);
        let column = span(knots_v, q, columns.len(), reduced[1]);
        let mut grid = Vec::with_capacity((p + 1) * (q + 1));
        for &i in &rows[row - p..=row] {
            let start = grid.len();
            grid.extend(columns[column - q..=column].iter().map(|&j| self.poles[i * self.columns + j]));
            spline::taylor(knots_v, q, column, &mut grid[start..], v);
        }
        let mut along_u = Vec::with_capacity(p + 1);
        for j in 0..=q {
            along_u.clear();
            along_u.extend(grid[j..].iter().step_by(q + 1));
            spline::taylor(knots_u, p, row, &mut along_u, u);
            for (i, &order) in along_u.iter().enumerate() {
                grid[i * (q + 1) + j] = order;
            }
        }
        grid
    }

    /// Returns whether the first and last row of control points along an axis coincide, or rows repeat.
    fn closed(&self, axis: usize) -> bool {
        let rows = self.poles.len() / self.columns;
        let scale = self.poles.iter().map(|&pole| project(pole).abs().max_element()).fold(0.0, f64::max);
        let near =
            |a: usize, b: usize| project(self.poles[a]).distance(project(self.poles[b])) <= CLOSED * scale;
        let ends_meet = if axis == 0 {
            (0..self.columns).all(|j| near(j, (rows - 1) * self.columns + j))
        } else {
            (0..rows).all(|i| near(i * self.columns, (i + 1) * self.columns - 1))
        };
        ends_meet || self.repeats(axis).is_some()
    }

    /// Returns the periodic basis along an axis, and the index of its first control points, if those that follow
    /// its own are the first ones.
    fn repeats(&self, axis: usize) -> Option<(Basis, usize)> {
        let (basis, first) = self.bases[axis].continued()?;
        let counts = [self.poles.len() / self.columns, self.columns];
        let count = basis.pole_count();
        let same = |i: usize, other: usize| self.pole(axis, i, other) == self.pole(axis, i - count, other);
        let all = (count..counts[axis]).all(|i| (0..counts[1 - axis]).all(|other| same(i, other)));
        (all && first + count <= counts[axis]).then_some((basis, first))
    }

    /// Returns the control point of an index along an axis and one along the other.
    fn pole(&self, axis: usize, index: usize, other: usize) -> DVec4 {
        self.poles[if axis == 0 { index * self.columns + other } else { other * self.columns + index }]
    }

    /// Returns the surface with parameters that continue over the seams at which control points repeat; `None`
    /// if there are none.
    fn continued(&self) -> Option<Self> {
        let mut continued = self.clone();
        let mut is_new = false;
        for axis in [0, 1] {
            let Some((basis, first)) = continued.repeats(axis) else { continue };
            let others =
                0..if axis == 0 { continued.columns } else { continued.poles.len() / continued.columns };
            let own = first..first + basis.pole_count();
            let pole = |index, other| continued.pole(axis, index, other);
            continued.poles = if axis == 0 {
                own.flat_map(|index| others.clone().map(move |other| pole(index, other))).collect()
            } else {
                others.flat_map(|other| own.clone().map(move |index| pole(index, other))).collect()
            };
            continued.bases[axis] = basis;
            continued.columns = continued.bases[1].pole_count();
            is_new = true;
        }
        is_new.then_some(continued)
    }
}

/// The sine of the angle between the tangents, or the one of rounding, below which a normal
/// has no digits.
const SINGULAR: f64 = 1e-10;

/// The step from a singular point to those by whose normals its own is found, relative to
/// half the range: both the parabola's error and that of rounding are about 1e-12.
const BESIDE: f64 = 1e-4;

impl Surface {
    /// Returns the point at parameters.
    pub(crate) fn point(&self, u: f64, v: f64) -> DVec3 {
        match self {
            Self::Plane(frame) => frame.point(DVec3::new(u, v, 0.0)),
            Self::Revolution { frame, profile, .. } => frame.turned(profile.point(v), u),
            Self::Extrusion { direction, profile } => profile.point(u) + v * *direction,
            Self::Spline(spline) => spline.point(u, v),
            Self::Trimmed { basis, .. } => basis.point(u, v),
            Self::Offset { distance, basis } => {
                basis.point(u, v) + *distance * basis.normal(u, v).unwrap_or(DVec3::ZERO)
            }
        }
    }

    /// Returns the surface `S + distance (S_u × S_v) / |S_u × S_v|`, of the same kind where
    /// that is exact, and a surface of revolution or extrusion of the offset profile.
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
                if profile.is_in_plane() {
                    let profile = profile.any_offset(frame.handedness() * distance, -DVec3::Y);
                    return Self::Revolution { frame, profile, kind };
                }
                Self::Offset { distance, basis: Box::new(self) }
            }
            Self::Extrusion { direction, profile } => {
                let profile = profile.any_offset(distance, direction);
                Self::Extrusion { direction, profile }
            }
            Self::Trimmed { bounds, basis } => {
                Self::Trimmed { bounds, basis: Box::new(basis.offset(distance)) }
            }
            Self::Spline(_) => Self::Offset { distance, basis: Box::new(self) },
            // Both normals are equal unless the inner offset folds.
            Self::Offset { distance: inner, basis } => basis.offset(inner + distance),
        }
    }

    /// Returns the tangents in u and v.
    fn tangents(&self, u: f64, v: f64) -> [DVec3; 2] {
        match self {
            Self::Plane(frame) => [frame.x, frame.y],
            Self::Revolution { frame, profile, .. } => {
                let ((sin, cos), point, along) = (u.sin_cos(), profile.point(v), profile.tangent(v));
                let turned = |x: f64, y: f64| DVec3::new(cos * x - sin * y, sin * x + cos * y, 0.0);
                let across = turned(-point.y, point.x);
                [across, turned(along.x, along.y).with_z(along.z)].map(|tangent| frame.vector(tangent))
            }
            Self::Extrusion { direction, profile } => [profile.tangent(u), *direction],
            Self::Spline(spline) => spline.tangents(u, v),
            Self::Trimmed { basis, .. } | Self::Offset { basis, .. } => basis.tangents(u, v),
        }
    }

    /// Returns the unit normal along `S_u × S_v`; where a tangent vanishes, as at a pole, the
    /// limit along the diagonal into the surface, by the parabola through three points of it.
    /// `None` if that limit does not exist either.
    fn normal(&self, u: f64, v: f64) -> Option<DVec3> {
        let at = |u: f64, v: f64| {
            let [a, b] = self.tangents(u, v);
            let normal = a.cross(b);
            (normal.length() > SINGULAR * a.length() * b.length()).then(|| normal.normalize_or_zero())
        };
        let beside = |steps: f64| {
            let inside = [(0, u), (1, v)].map(|(axis, value)| match self.natural_ranges()[axis] {
                Some([start, end]) => value + steps * BESIDE * (0.5 * (start + end) - value),
                None => value + steps * BESIDE,
            });
            at(inside[0], inside[1])
        };
        at(u, v).or_else(|| (3.0 * beside(1.0)? - 3.0 * beside(2.0)? + beside(3.0)?).try_normalize())
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

    /// Returns the surface with parameters that continue over the seams of closed B-splines; `None` if
    /// there are none.
    pub(crate) fn continued(&self) -> Option<Self> {
        match self {
            Self::Spline(spline) => spline.continued().map(Self::Spline),
            Self::Extrusion { direction, profile } => {
                Some(Self::Extrusion { direction: *direction, profile: profile.continued()? })
            }
            Self::Revolution { frame, profile, kind } => {
                Some(Self::Revolution { frame: *frame, profile: profile.continued()?, kind })
            }
            _ => None,
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
            Self::Revolution { kind, profile, .. } if *kind != "sphere" => [Some(TAU), profile.closure()],
            Self::Extrusion { profile, .. } => [profile.closure(), None],
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

    /// Returns the values of v at which all u are one point: the poles of a sphere and of a
    /// degenerate torus, and the apex of a cone.
    pub(crate) fn poles(&self) -> Vec<f64> {
        match self {
            Self::Revolution { kind: "sphere", .. } => vec![-FRAC_PI_2, FRAC_PI_2],
            Self::Revolution { profile, .. } if !profile.is_in_plane() => Vec::new(),
            Self::Revolution { profile: Curve::Line { point, direction }, .. } if direction.x != 0.0 => {
                vec![-point.x / direction.x]
            }
            Self::Revolution { profile: Curve::Trimmed { range, .. }, kind: "torus", .. } => range.to_vec(),
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

    /// Returns whether the lines u = const are straight and u is an angle or another parameter
    /// of a conic, in which curves of the file have no exact image.
    pub(crate) fn is_ruled_by_angles(&self) -> bool {
        match self {
            Self::Revolution { profile, .. } => matches!(profile, Curve::Line { .. }),
            Self::Extrusion { profile, .. } => profile.is_conic(),
            Self::Trimmed { basis, .. } => basis.is_ruled_by_angles(),
            _ => false,
        }
    }

    /// Returns the number of control points in the file.
    pub(crate) fn pole_count(&self) -> usize {
        match self {
            Self::Spline(spline) => spline.poles.len(),
            Self::Trimmed { basis, .. } | Self::Offset { basis, .. } => basis.pole_count(),
            Self::Plane(_) => 0,
            Self::Revolution { profile, .. } | Self::Extrusion { profile, .. } => profile.pole_count(),
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
