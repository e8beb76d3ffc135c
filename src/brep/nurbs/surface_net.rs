//! Surfaces of the file as exact NURBS over a rectangle of parameters.

use super::conic::Conic;
use super::conversion::{Unconvertible, check_range};
use super::interpolation;
use super::parameter_map::ParameterMap;
use super::spline::{Spline, blossom, project, support_spans, tensor_point};
use super::surface::{SplineSurface, Surface};
use crate::model::SurfaceArrays;
use glam::{DAffine3, DVec3, DVec4, Vec4Swizzles};
use std::f64::consts::TAU;

/// An exact NURBS and the maps from the parameters of the file to its own.
#[derive(Debug, Clone)]
pub(crate) struct SurfaceNet {
    pub(crate) degrees: [usize; 2],
    pub(crate) knots: [Vec<f64>; 2],
    /// Homogeneous control points, v fastest.
    pub(crate) controls: Vec<DVec4>,
    pub(crate) maps: [ParameterMap; 2],
    /// The deviation from the surface of the file: 0 unless that is an offset or of a degree above
    /// the model's.
    pub(crate) error: f64,
    /// Whether the deviation was found at points, and is no upper bound.
    pub(crate) is_measured: bool,
}

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
                let (profile, map, error) = profile.spline(ranges[1])?;
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
                    error,
                    is_measured: error > 0.0,
                })
            }
            Self::Extrusion { direction, profile } => {
                let (profile, map, error) = profile.spline(ranges[0])?;
                let sides = ranges[1].map(|v| profile.clone().translated(v * *direction));
                Ok(ruled(&sides, ranges[1], map, error))
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
                interpolation::surface(&|u, v| self.point(u, v), breaks)
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

/// Part of a domain by which loops may leave it without an extension of the surface: it
/// would add less to the surface than the loops' joints are moved by.
const DOMAIN_MARGIN: f64 = 1e-9;

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
        SurfaceNet { degrees, knots, controls, maps, error: 0.0, is_measured: false }
    }
}

/// Returns the control points over new clamped knots along an axis, as
/// [`Spline::with_knots`] does for curves.
fn reknotted(
    controls: &[DVec4],
    [rows, columns]: [usize; 2],
    axis: usize,
    degree: usize,
    old: &[f64],
    new: &[f64],
) -> Vec<DVec4> {
    let count = if axis == 0 { rows } else { columns };
    let spans = support_spans(old, degree, count, new);
    let line = |fixed: usize, span: usize| -> Vec<DVec4> {
        let index = |i| if axis == 0 { i * columns + fixed } else { fixed * columns + i };
        (span - degree..=span).map(|i| controls[index(i)]).collect()
    };
    let control = |index: usize, fixed: usize| {
        blossom(old, degree, spans[index], &line(fixed, spans[index]), |argument| new[index + 1 + argument])
    };
    if axis == 0 {
        (0..spans.len()).flat_map(|i| (0..columns).map(move |j| (i, j))).map(|(i, j)| control(i, j)).collect()
    } else {
        (0..rows).flat_map(|i| (0..spans.len()).map(move |j| (i, j))).map(|(i, j)| control(j, i)).collect()
    }
}

impl SurfaceNet {
    /// Returns the domain.
    pub(crate) fn domain(&self) -> [[f64; 2]; 2] {
        [0, 1].map(|axis| {
            let knots = &self.knots[axis];
            [knots[self.degrees[axis]], knots[knots.len() - 1 - self.degrees[axis]]]
        })
    }

    /// Returns the part of the surface over ranges inside of its domain.
    pub(crate) fn within(mut self, ranges: [[f64; 2]; 2]) -> Self {
        for (axis, [low, high]) in ranges.into_iter().enumerate() {
            let [start, end] = self.domain()[axis];
            if low <= start && high >= end {
                continue;
            }
            let counts = [0, 1].map(|axis| self.knots[axis].len() - self.degrees[axis] - 1);
            let (degree, knots) = (self.degrees[axis], &self.knots[axis]);
            let margin = DOMAIN_MARGIN * (end - start);
            let inside = knots.iter().filter(|&&knot| knot > low + margin && knot < high - margin);
            let ends = [low, high].map(|end| vec![end; degree + 1]);
            let clamped: Vec<f64> = ends[0].iter().chain(inside).chain(&ends[1]).copied().collect();
            self.controls = reknotted(&self.controls, counts, axis, degree, knots, &clamped);
            self.knots[axis] = clamped;
        }
        self
    }

    /// Returns the point at parameters of this net.
    pub(crate) fn point(&self, u: f64, v: f64) -> DVec3 {
        let columns = self.knots[1].len() - self.degrees[1] - 1;
        let knots = self.knots.each_ref().map(Vec::as_slice);
        tensor_point(self.degrees, knots, [u, v], |i, j| self.controls[i * columns + j])
    }

    /// Returns the surface moved by an affine map, as plain arrays.
    pub(crate) fn into_arrays(self, location: &DAffine3) -> SurfaceArrays {
        let counts = [0, 1].map(|axis| self.knots[axis].len() - self.degrees[axis] - 1);
        let point = |&control: &DVec4| {
            let point = location.transform_point3(project(control));
            point.extend(control.w).to_array()
        };
        SurfaceArrays {
            degree: self.degrees,
            counts,
            control_points: self.controls.iter().map(point).collect(),
            knots: self.knots,
        }
    }

    /// Returns whether all weights are positive, which extension may violate.
    pub(crate) fn has_positive_weights(&self) -> bool {
        self.controls.iter().all(|control| control.w > 0.0 && control.xyz().is_finite())
    }
}
