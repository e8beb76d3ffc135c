//! Plane sections of ruled surfaces, exact in the parameters of the NURBS.

use super::gap::Gap;
use crate::gap::Lifted;
use crate::nurbs::{Basis, Curve, Spline, SplineSurface, Surface, SurfaceNet};
use glam::{DVec3, DVec4, Vec4Swizzles};
use nurbs_hausdorff::workspace::MAX_DEGREE;

/// A plane `normal · x = distance` in the coordinates of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Section {
    normal: DVec3,
    distance: f64,
}

/// The deepest bisection of a piece whose weights are not all positive.
const MAX_DEPTH: usize = 4;

impl Section {
    /// Returns the plane of a conic on a surface whose parameter lines u = const are straight
    /// and linear in v: a cylinder, a cone, another line turned in the plane of its axis, or
    /// an extrusion. `None` for other curves and surfaces.
    ///
    /// The plane meets each of those lines at one point, `v = N(u) / D(u)`, unless it
    /// contains the line's direction.
    pub(super) fn new(curve: &Curve, to_face: &glam::DAffine3, surface: &Surface) -> Option<Self> {
        let is_ruled = match surface.elementary() {
            Surface::Revolution { profile, .. } => matches!(profile, Curve::Line { .. }),
            Surface::Extrusion { .. } => true,
            _ => false,
        };
        let mut curve = curve;
        while let Curve::Trimmed { basis, .. } = curve {
            curve = basis;
        }
        let Curve::Conic { center, x, y, .. } = curve else { return None };
        let [x, y] = [*x, *y].map(|axis| to_face.transform_vector3(axis));
        let normal = x.cross(y).try_normalize().filter(|_| is_ruled)?;
        Some(Self { normal, distance: normal.dot(to_face.transform_point3(*center)) })
    }

    /// Returns the distance between the edge and the section over the u of a curve beside it,
    /// which is proven for the exact NURBS of both. `None` if there is no section there, or it
    /// is farther than `most` at points.
    pub(super) fn gap(&self, curve: &Spline, lifted: &Lifted<'_>, most: f64) -> Option<Gap> {
        let low = curve.points().fold(DVec3::INFINITY, DVec3::min);
        let high = curve.points().fold(DVec3::NEG_INFINITY, DVec3::max);
        // The lines are straight, so that any part of them has the same continuation.
        let net = lifted.surface.net([[low.x, high.x], [low.y - 1.0, high.y + 1.0]]).ok()?;
        let section = self.on_net(&net, [curve.start(), curve.end()].map(|end| net.maps[0].apply(end.x)))?;
        let range = section.domain();
        let counts = [0, 1].map(|axis| net.knots[axis].len() - net.degrees[axis] - 1);
        let [u, v] = net.knots;
        let bases = [
            Basis::with_knots(net.degrees[0], u, counts[0]),
            Basis::with_knots(net.degrees[1], v, counts[1]),
        ];
        let surface = Surface::Spline(SplineSurface::new(bases, net.controls));
        let curve = Curve::Spline(section.into());
        let section = Lifted { surface: &surface, curve: &curve, range, ..*lifted };
        let measured = section.measured();
        let gap = || section.gap_of_exact().map_or(Gap::measured(measured), Gap::proven);
        (measured <= most).then(|| gap().plus(Gap::proven(lifted.edge_error())))
    }

    /// Returns the section between two values of u of the net, exact.
    ///
    /// With rows A(t), B(t) of homogeneous points at v0, v1 and α = n·A, β = n·B for the
    /// plane's homogeneous n, the point of the line at λ = (v - v0) / (v1 - v0) lies in the
    /// plane if (1 - λ)α + λβ = 0. So v = v0 + (v1 - v0) α / (α - β), and the curve
    /// `(t (α - β), v0 (α - β) + (v1 - v0) α, α - β)` of one degree more than the net's
    /// in u is rational with positive weights where α - β, or its negative, is positive.
    ///
    /// `None` where the net is not linear in v, or the weights are not positive.
    pub(super) fn on_net(&self, net: &SurfaceNet, [from, to]: [f64; 2]) -> Option<Spline> {
        let degree = net.degrees[0];
        let ruled = net.degrees[1] == 1 && net.knots[1].len() == 4;
        if !ruled || degree + 1 > MAX_DEGREE || from == to {
            return None;
        }
        let plane = |control: DVec4| self.normal.dot(control.xyz()) - self.distance * control.w;
        let rows =
            net.controls.chunks_exact(2).map(|pair| DVec4::new(plane(pair[0]), plane(pair[1]), 0.0, 1.0));
        let values = Spline { degree, knots: net.knots[0].clone(), controls: rows.collect() };
        let ends = [net.knots[1][1], net.knots[1][2]];
        let (low, high) = (from.min(to), from.max(to));
        let mut section = Spline { degree: degree + 1, knots: vec![low; degree + 2], controls: Vec::new() };
        for piece in values.pieces() {
            let [start, end] = piece.domain();
            let [start, end] = [start.max(low), end.min(high)];
            if start < end {
                append(&mut section, &piece.sub_piece([start, end]), ends, 0)?;
            }
        }
        let sign = section.controls.first()?.w.signum();
        section.controls.iter_mut().for_each(|control| *control *= sign);
        if !section.controls.iter().all(|control| control.w > 0.0 && control.is_finite()) {
            return None;
        }
        section.knots.push(high);
        Some(if from < to { section } else { section.reversed() })
    }
}

/// Appends the section over a piece of the values (α, β), or over halves of it if its weights
/// have both signs.
fn append(section: &mut Spline, piece: &Spline, [v0, v1]: [f64; 2], depth: usize) -> Option<()> {
    let degree = piece.degree;
    let [start, end] = piece.domain();
    let weights: Vec<f64> = piece.controls.iter().map(|value| value.x - value.y).collect();
    let across: Vec<f64> = (piece.controls.iter().zip(&weights))
        .map(|(value, weight)| v0 * weight + (v1 - v0) * value.x)
        .collect();
    // The products with (1 - s) a + s b, in Bernstein form.
    let times = |values: &[f64], [a, b]: [f64; 2]| -> Vec<f64> {
        (0..=degree + 1)
            .map(|k| {
                let low = if k <= degree { (degree + 1 - k) as f64 * a * values[k] } else { 0.0 };
                let high = if k > 0 { k as f64 * b * values[k - 1] } else { 0.0 };
                (low + high) / (degree + 1) as f64
            })
            .collect()
    };
    let [along, across, weights] =
        [times(&weights, [start, end]), times(&across, [1.0, 1.0]), times(&weights, [1.0, 1.0])];
    let one_sign = weights.iter().all(|&weight| weight > 0.0) || weights.iter().all(|&weight| weight < 0.0);
    if !one_sign {
        if depth == MAX_DEPTH {
            return None;
        }
        let middle = 0.5 * (start + end);
        append(section, &piece.sub_piece([start, middle]), [v0, v1], depth + 1)?;
        return append(section, &piece.sub_piece([middle, end]), [v0, v1], depth + 1);
    }
    let skipped = usize::from(!section.controls.is_empty());
    let controls = (0..=degree + 1).skip(skipped).map(|k| DVec4::new(along[k], across[k], 0.0, weights[k]));
    section.controls.extend(controls);
    section.knots.extend(vec![end; degree + 1]);
    Some(())
}
