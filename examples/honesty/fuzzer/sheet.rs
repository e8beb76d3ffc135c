//! An independent evaluator, fast enough for millions of points: it computes the
//! basis functions of a span in one triangle (Piegl and Tiller, *The NURBS Book*,
//! algorithm A2.2), and first derivatives by the quotient rule. The library extracts
//! Bézier patches instead.

use super::trims::Region;
use glam::{DVec2, DVec3, DVec4, Vec4Swizzles};
use nurbs_hausdorff::{Axis, Face, Model, ParamBox};

/// The number of basis functions of degree 15, and one more for derivatives.
const CAPACITY: usize = 17;

/// A surface relative to an origin near it, so that no digits of points far from the
/// model's origin are lost.
pub(crate) struct Sheet {
    degree: [usize; 2],
    knots: [Vec<f64>; 2],
    columns: usize,
    net: Vec<DVec4>,
    pub(crate) domain: ParamBox,
    /// The trimmed region, if it is not the whole domain.
    pub(crate) region: Option<Region>,
}

/// A point with its first derivatives by u and v.
pub(crate) struct Tangents {
    pub(crate) point: DVec3,
    pub(crate) u: DVec3,
    pub(crate) v: DVec3,
}

struct Basis {
    first: usize,
    values: [f64; CAPACITY],
    derivatives: [f64; CAPACITY],
}

/// Returns the faces of a model relative to `origin`.
pub(crate) fn sheets(model: &Model, origin: DVec3) -> Vec<Sheet> {
    model.faces().map(|face| Sheet::new(&face, origin)).collect()
}

impl Sheet {
    fn new(face: &Face<'_>, origin: DVec3) -> Self {
        let surface = face.surface();
        let loops = face.to_arrays().trim;
        let homogeneous = |&[x, y, z, w]: &[f64; 4]| (w * (DVec3::new(x, y, z) - origin)).extend(w);
        Self {
            degree: surface.degree(),
            knots: Axis::BOTH.map(|axis| surface.knots(axis).to_vec()),
            columns: surface.counts()[1],
            net: surface.control_points().iter().map(homogeneous).collect(),
            domain: surface.domain(),
            region: loops.map(|loops| Region::new(&loops, surface.domain())),
        }
    }

    /// Returns the parameters at fractions of the domain in [0, 1]².
    pub(crate) fn at(&self, fractions: [f64; 2]) -> DVec2 {
        self.domain.at(fractions).into()
    }

    /// Returns whether the face contains the surface's point, and not nearly on a loop.
    pub(crate) fn contains(&self, parameters: DVec2) -> bool {
        self.region.as_ref().is_none_or(|region| region.contains(parameters))
    }

    pub(crate) fn clamp(&self, parameters: DVec2) -> DVec2 {
        parameters.clamp(self.domain.low().into(), self.domain.high().into())
    }

    pub(crate) fn extent(&self) -> DVec2 {
        self.domain.lengths().into()
    }

    pub(crate) fn point(&self, parameters: DVec2) -> DVec3 {
        let [u, v] = [self.basis(Axis::U, parameters.x), self.basis(Axis::V, parameters.y)];
        let sum = self.sum(&u, &u.values, &v, &v.values);
        sum.xyz() / sum.w
    }

    pub(crate) fn tangents(&self, parameters: DVec2) -> Tangents {
        let [u, v] = [self.basis(Axis::U, parameters.x), self.basis(Axis::V, parameters.y)];
        let sum = self.sum(&u, &u.values, &v, &v.values);
        let by_u = self.sum(&u, &u.derivatives, &v, &v.values);
        let by_v = self.sum(&u, &u.values, &v, &v.derivatives);
        let point = sum.xyz() / sum.w;
        let quotient = |by: DVec4| (by.xyz() - by.w * point) / sum.w;
        Tangents { point, u: quotient(by_u), v: quotient(by_v) }
    }

    fn sum(&self, u: &Basis, in_u: &[f64; CAPACITY], v: &Basis, in_v: &[f64; CAPACITY]) -> DVec4 {
        let mut sum = DVec4::ZERO;
        for (i, n) in in_u[..=self.degree[0]].iter().enumerate() {
            let row = (u.first + i) * self.columns + v.first;
            let line: DVec4 =
                in_v[..=self.degree[1]].iter().zip(&self.net[row..]).map(|(m, x)| *m * *x).sum();
            sum += *n * line;
        }
        sum
    }

    fn basis(&self, axis: Axis, t: f64) -> Basis {
        let (p, knots) = (self.degree[axis], &self.knots[axis]);
        let [start, end] = self.domain[axis];
        let clamped = if t < end { t.max(start) } else { end };
        // The span begins at the last knot up to t, at the end of the domain at the last
        // knot before it.
        let above = if clamped < end {
            knots.partition_point(|&knot| knot <= clamped)
        } else {
            knots.partition_point(|&knot| knot < end)
        };
        let span = above - 1;
        let (mut values, mut derivatives) = ([0.0; CAPACITY], [0.0; CAPACITY]);
        values[0] = 1.0;
        for level in 1..=p {
            let mut saved = 0.0;
            for r in 0..level {
                let (low, high) = (knots[span + 1 + r - level], knots[span + 1 + r]);
                let part = values[r] / (high - low);
                if level == p {
                    derivatives[r] -= p as f64 * part;
                    derivatives[r + 1] += p as f64 * part;
                }
                values[r] = saved + (high - t) * part;
                saved = (t - low) * part;
            }
            values[level] = saved;
        }
        Basis { first: span - p, values, derivatives }
    }
}
