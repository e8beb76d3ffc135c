//! The conversion of surfaces of each kind.

use super::super::conic::Conic;
use super::super::conversion::{Unconvertible, check_range};
use super::super::parameter_map::ParameterMap;
use super::super::spline::Spline;
use super::super::surface::{SplineSurface, Surface};
use super::{DOMAIN_MARGIN, SurfaceNet, interpolation, reknotted};
use glam::{DVec3, DVec4};
use std::f64::consts::TAU;

impl Surface {
    /// Returns the NURBS over these ranges of u and v, exact but for offsets. Where a B-spline
    /// is not periodic, it keeps its domain and is extended to the ranges.
    ///
    /// # Errors
    /// [`Unconvertible`].
    pub(crate) fn net(&self, ranges: [[f64; 2]; 2]) -> Result<SurfaceNet, Unconvertible> {
        match self {
            Self::Plane(frame) => {
                let edge = |v: f64| {
                    let [start, end] = ranges[0].map(|u| frame.point(DVec3::new(u, v, 0.0)));
                    Spline::segment(ranges[0], start, end)
                };
                let sides = ranges[1].map(edge);
                Ok(ruled(&sides, ranges[1], ParameterMap::Identity, 0.0))
            }
            Self::Revolution { frame, profile, .. } => {
                let error = profile.error();
                let (profile, map, deviation) = profile.spline(ranges[1])?;
                check_range(ranges[0], TAU)?;
                let breaks = Conic::Elliptic.breaks(ranges[0]);
                let circle = Conic::Elliptic.spline(&breaks, DVec3::ZERO, DVec3::X, DVec3::Y);
                let turned = |arc: &DVec4, local: &DVec4| {
                    frame.homogeneous(DVec4::new(
                        arc.x * local.x - arc.y * local.y,
                        arc.y * local.x + arc.x * local.y,
                        arc.w * local.z,
                        arc.w * local.w,
                    ))
                };
                let controls = circle
                    .controls
                    .iter()
                    .flat_map(|arc| profile.controls.iter().map(move |local| turned(arc, local)))
                    .collect();
                Ok(SurfaceNet {
                    degrees: [2, profile.degree],
                    knots: [circle.knots, profile.knots],
                    controls,
                    maps: [ParameterMap::Circular(breaks), map],
                    // No point of a profile moves farther as it is turned.
                    error: error + deviation,
                    is_measured: deviation > 0.0,
                })
            }
            Self::Extrusion { direction, profile } => {
                let (spline, map, deviation) = profile.spline(ranges[0])?;
                let sides = ranges[1].map(|v| spline.clone().translated(v * *direction));
                let mut net = ruled(&sides, ranges[1], map, deviation);
                net.error += profile.error();
                Ok(net)
            }
            Self::Spline(spline) => {
                for axis in [0, 1] {
                    spline.bases[axis].check_range(ranges[axis])?;
                }
                Ok(spline.net(ranges))
            }
            Self::Trimmed { basis, .. } => basis.net(ranges),
            Self::Offset { basis, .. } => {
                let exact = basis.net(ranges)?;
                let breaks = [0, 1].map(|axis| {
                    let [start, end] = ranges[axis];
                    let inner = exact.knots[axis].iter().copied().filter(|&knot| knot > start && knot < end);
                    let mut breaks: Vec<f64> = std::iter::once(start).chain(inner).chain([end]).collect();
                    breaks.dedup();
                    breaks
                });
                let mut net = interpolation::surface(&|u, v| self.point(u, v), breaks)?;
                net.error += exact.error;
                Ok(net)
            }
        }
    }
}

/// Returns the ruled surface between two splines over equal knots.
fn ruled([low, high]: &[Spline; 2], [start, end]: [f64; 2], map: ParameterMap, error: f64) -> SurfaceNet {
    SurfaceNet {
        degrees: [low.degree, 1],
        knots: [low.knots.clone(), vec![start, start, end, end]],
        controls: low.controls.iter().zip(&high.controls).flat_map(|(&a, &b)| [a, b]).collect(),
        maps: [map, ParameterMap::Identity],
        error,
        is_measured: error > 0.0,
    }
}

impl SplineSurface {
    /// Returns the surface over its domain extended to these ranges; where it is periodic,
    /// over the ranges alone.
    fn net(&self, ranges: [[f64; 2]; 2]) -> SurfaceNet {
        let unrolled = [0, 1].map(|axis| self.bases[axis].unrolled(ranges[axis]));
        let mut knots = unrolled.each_ref().map(|(knots, _)| knots.clone());
        let degrees = self.bases.each_ref().map(|basis| basis.degree);
        let [rows, columns] = unrolled.each_ref().map(|(_, poles)| poles);
        let mut controls: Vec<DVec4> = rows
            .iter()
            .flat_map(|&i| columns.iter().map(move |&j| self.poles[i * self.columns + j]))
            .collect();
        let mut counts = [rows.len(), columns.len()];
        for axis in [0, 1] {
            let [start, end] = self.bases[axis].domain();
            let [low, high] = ranges[axis];
            let margin = DOMAIN_MARGIN * (end - start);
            let range = match self.bases[axis].period() {
                Some(_) => [low, high],
                None => [
                    if low < start - margin { low } else { start },
                    if high > end + margin { high } else { end },
                ],
            };
            let clamped = self.bases[axis].clamped(range);
            if clamped != knots[axis] {
                controls = reknotted(&controls, counts, axis, degrees[axis], &knots[axis], &clamped);
                counts[axis] = clamped.len() - degrees[axis] - 1;
                knots[axis] = clamped;
            }
        }
        let maps = [ParameterMap::Identity, ParameterMap::Identity];
        SurfaceNet { degrees, knots, controls, maps, error: self.error, is_measured: false }
    }
}
