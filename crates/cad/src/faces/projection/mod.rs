//! Points of space projected on a surface of the file.

mod meridian;
mod tracing;

pub(super) use meridian::{angle, on_meridian};
pub(super) use tracing::{Traced, is_across_seam};

use crate::nurbs::{Conic, Curve, Frame, Surface};
use glam::{DAffine3, DMat3, DVec3};
use nurbs_hausdorff::workspace::{BezierModel, Target, closest, extract};
use nurbs_hausdorff::{Axis, Model, NurbsSurface};

/// Projects points on one surface.
///
/// The first point of a curve is found globally: in closed form on surfaces of revolution
/// and extrusion, up to a search along profiles that are splines, and by branch and bound on
/// B-splines. Its neighbours follow by Gauss-Newton steps, which converge where the point is
/// nearer to the surface than its radius of curvature.
pub(super) struct Projector<'a> {
    surface: &'a Surface,
    /// The size of the curve in space.
    size: f64,
    search: Option<(BezierModel, Target)>,
    /// The ranges of parameters that do not continue beyond their ends.
    bounds: [Option<[f64; 2]>; 2],
}

/// A projected point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Projection {
    /// The parameters (u, v, 0).
    pub(super) parameters: DVec3,
    /// The distance from the point to the surface.
    pub(super) distance: f64,
}

/// The most Gauss-Newton steps; about five suffice near the surface.
const MAX_STEPS: usize = 24;

/// The step in space, relative to the curve, below which the iteration has converged.
const CONVERGED: f64 = 1e-14;

/// The difference of parameters in difference quotients, relative to their range: with it
/// rounding and the third derivative move a tangent by about 1e-10 of it.
const DIFFERENCE: f64 = 1e-5;

/// The length of a tangent times the parameter's range, relative to the curve, below which
/// the surface is singular, as at a pole.
const SINGULAR: f64 = 1e-7;

/// The sine of the angle between tangents below which the surface is singular.
const PARALLEL: f64 = 1e-9;

/// The points of a profile among which the nearest is where the iteration starts.
const PROFILE_SAMPLES: usize = 512;

impl<'a> Projector<'a> {
    pub(super) fn new(surface: &'a Surface, size: f64) -> Self {
        let surface = surface.elementary();
        let (natural, periods) = (surface.natural_ranges(), surface.periods());
        let bounds = [0, 1].map(|axis| if periods[axis].is_some() { None } else { natural[axis] });
        Self { surface, size, search: None, bounds }
    }

    /// Returns the projection of a point: near the given parameters where there are any and
    /// it is as near to the surface as `expected`, else the globally nearest.
    pub(super) fn project(&mut self, point: DVec3, near: Option<DVec3>, expected: f64) -> Option<Projection> {
        // Near a pole small steps in space are large ones in u, which formulas do not mind.
        let followed = near.filter(|_| !self.has_formula());
        let local = followed.map(|near| self.polished(point, near));
        if let Some(found) = local
            && found.distance <= expected
        {
            return Some(found);
        }
        let start = self.global(point)?;
        let mut global = self.polished(point, start);
        if let Some(near) = near {
            let periods = self.surface.periods();
            for (axis, period) in periods.iter().enumerate() {
                let Some(period) = period else { continue };
                let turns = ((near[axis] - global.parameters[axis]) / period).round();
                global.parameters[axis] += turns * period;
            }
        }
        match local {
            Some(local) if local.distance <= global.distance => Some(local),
            _ => Some(global),
        }
    }

    /// Returns whether the nearest point has a formula.
    fn has_formula(&self) -> bool {
        match self.surface {
            Surface::Revolution { profile, .. } | Surface::Extrusion { profile, .. } => {
                profile.natural_range().is_none() || profile.is_conic()
            }
            _ => false,
        }
    }

    /// Returns the tangents in u and v by difference quotients.
    pub(super) fn tangents(&self, at: DVec3) -> [DVec3; 2] {
        [0, 1].map(|axis| {
            let step = DIFFERENCE * self.range(axis);
            let (mut low, mut high) = (at, at);
            low[axis] -= step;
            high[axis] += step;
            let [low, high] = [low, high].map(|at| self.clamped(at));
            let chord = self.surface.point(high.x, high.y) - self.surface.point(low.x, low.y);
            chord / (high[axis] - low[axis])
        })
    }

    /// Returns the derivative of the parameters of a curve with this tangent in space; `None`
    /// where the surface is singular.
    pub(super) fn velocity(&self, at: DVec3, tangent: DVec3) -> Option<DVec3> {
        let [a, b] = self.tangents(at);
        if self.vanishing(&[a, b]).is_some() { None } else { solved(a, b, tangent) }
    }

    /// The axis whose tangent vanishes at a singular point, as u at a pole.
    pub(super) fn vanishing_tangent(&self, at: DVec3) -> Option<usize> {
        self.vanishing(&self.tangents(at))
    }

    fn vanishing(&self, tangents: &[DVec3; 2]) -> Option<usize> {
        let tiny = SINGULAR * self.size;
        (0..2).find(|&axis| tangents[axis].length() * self.range(axis) <= tiny)
    }

    /// The unit in which steps of a parameter are small.
    fn range(&self, axis: usize) -> f64 {
        self.bounds[axis].map_or(1.0, |[start, end]| end - start)
    }

    fn clamped(&self, mut at: DVec3) -> DVec3 {
        for (axis, bounds) in self.bounds.iter().enumerate() {
            if let Some([start, end]) = *bounds {
                at[axis] = at[axis].clamp(start, end);
            }
        }
        at
    }

    /// Minimises the distance by Gauss-Newton steps, halved until it falls.
    fn polished(&self, point: DVec3, start: DVec3) -> Projection {
        let mut at = self.clamped(start);
        let mut residual = point - self.surface.point(at.x, at.y);
        for _ in 0..MAX_STEPS {
            let [a, b] = self.tangents(at);
            let step = solved(a, b, residual).unwrap_or_else(|| {
                let along = |tangent: DVec3| residual.dot(tangent) / tangent.length_squared();
                if a.length() > b.length() {
                    DVec3::new(along(a), 0.0, 0.0)
                } else {
                    DVec3::new(0.0, along(b), 0.0)
                }
            });
            if !step.is_finite() || (step.x * a + step.y * b).length() <= CONVERGED * self.size {
                break;
            }
            let mut factor = 1.0;
            let better = (0..8).find_map(|_| {
                let next = self.clamped(at + factor * step);
                factor *= 0.5;
                let moved = point - self.surface.point(next.x, next.y);
                (moved.length_squared() < residual.length_squared()).then_some((next, moved))
            });
            let Some((next, moved)) = better else { break };
            (at, residual) = (next, moved);
        }
        Projection { parameters: at, distance: residual.length() }
    }

    /// Returns parameters of a point that is about the nearest; `None` where no search exists.
    pub(super) fn global(&mut self, point: DVec3) -> Option<DVec3> {
        let mut surface = self.surface;
        loop {
            match surface {
                Surface::Trimmed { basis, .. } | Surface::Offset { basis, .. } => surface = basis,
                Surface::Plane(frame) => return Some(frame.local_point(point).with_z(0.0)),
                Surface::Revolution { frame, profile, .. } => return on_revolution(frame, profile, point),
                Surface::Extrusion { direction, profile } => return on_extrusion(*direction, profile, point),
                Surface::Spline(_) => return self.on_spline(surface, point),
            }
        }
    }

    fn on_spline(&mut self, surface: &Surface, point: DVec3) -> Option<DVec3> {
        if self.search.is_none() {
            let [Some(u), Some(v)] = surface.natural_ranges() else { return None };
            let net = surface.net([u, v]).ok()?.of_accepted_degree().ok()?;
            let arrays = net.into_arrays(&DAffine3::IDENTITY);
            let model = Model::new(None, vec![NurbsSurface::new(0, arrays).ok()?]).ok()?;
            let patches = extract(&model);
            let target = Target::new(patches.patches.clone());
            self.search = Some((patches, target));
        }
        let (patches, target) = self.search.as_ref()?;
        let found = closest(target, point, CONVERGED * self.size)?;
        let columns = patches.grids[0].breaks[Axis::V].len() - 1;
        let at = |axis: Axis, span: usize, local: f64| {
            let breaks = &patches.grids[0].breaks[axis];
            breaks[span] + local * (breaks[span + 1] - breaks[span])
        };
        let [s, t] = found.parameters;
        Some(DVec3::new(at(Axis::U, found.patch / columns, s), at(Axis::V, found.patch % columns, t), 0.0))
    }
}

/// Returns the least squares solution (x, y, 0) of x a + y b = r; `None` if a and b are
/// nearly parallel.
fn solved(a: DVec3, b: DVec3, r: DVec3) -> Option<DVec3> {
    let (aa, ab, bb) = (a.dot(a), a.dot(b), b.dot(b));
    let determinant = aa * bb - ab * ab;
    if determinant.is_nan() || determinant <= PARALLEL * PARALLEL * aa * bb {
        return None;
    }
    let (ra, rb) = (r.dot(a), r.dot(b));
    Some(DVec3::new((bb * ra - ab * rb) / determinant, (aa * rb - ab * ra) / determinant, 0.0))
}

fn on_revolution(frame: &Frame, profile: &Curve, point: DVec3) -> Option<DVec3> {
    let local = frame.local_point(point);
    let meridian = |point: DVec3| DVec3::new(point.x.hypot(point.y), 0.0, point.z);
    let v = on_meridian(profile, local.x.hypot(local.y), local.z)
        .or_else(|| nearest(profile, |on_profile| meridian(on_profile).distance_squared(meridian(local))))?;
    Some(DVec3::new(angle(local, profile.point(v)), v, 0.0))
}

fn on_extrusion(direction: DVec3, profile: &Curve, point: DVec3) -> Option<DVec3> {
    let mut basis = profile;
    while let Curve::Trimmed { basis: inner, .. } = basis {
        basis = inner;
    }
    let coordinates = |origin: DVec3, x: DVec3, y: DVec3| {
        let matrix = DMat3::from_cols(x, y, direction);
        (matrix.determinant() != 0.0).then(|| matrix.inverse() * (point - origin))
    };
    let u = match basis {
        Curve::Line { point: origin, direction: along } => {
            coordinates(*origin, *along, along.cross(direction))?.x
        }
        Curve::Conic { conic, center, x, y } => {
            let local = coordinates(*center, *x, *y)?;
            match conic {
                Conic::Elliptic => local.y.atan2(local.x),
                Conic::Parabolic => local.y,
                Conic::Hyperbolic => local.y.asinh(),
            }
        }
        _ => nearest(profile, |on_profile| (point - on_profile).cross(direction).length_squared())?,
    };
    let v = (point - profile.point(u)).dot(direction) / direction.length_squared();
    Some(DVec3::new(u, v, 0.0))
}

/// Returns the parameter of a bounded curve at which a function of its points is least among
/// samples.
fn nearest(curve: &Curve, value: impl Fn(DVec3) -> f64) -> Option<f64> {
    let [start, end] = curve.natural_range()?;
    let at = |sample: usize| start + (end - start) * sample as f64 / PROFILE_SAMPLES as f64;
    let value = |&t: &f64| value(curve.point(t));
    (0..=PROFILE_SAMPLES).map(at).min_by(|a, b| value(a).total_cmp(&value(b)))
}
