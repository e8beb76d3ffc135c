//! Bézier patches of NURBS surfaces, by blossoming in intervals.

use super::net::{Homogeneous, Net, blend};
use crate::proof::frame::{Frame, Motion, power_of_two};
use crate::proof::interval::Interval;
use crate::proof::surface::{Model, Surface};

/// A Bézier patch and where it comes from.
#[derive(Debug, Clone)]
pub(crate) struct Patch {
    pub(crate) net: Net,
    pub(crate) surface: usize,
    /// Its knot spans along u and v.
    pub(crate) ranges: [[f64; 2]; 2],
}

impl Patch {
    /// The surface's parameters u and v at the patch's own in [0, 1]², rounded.
    pub(crate) fn parameters(&self, at: [f64; 2]) -> [f64; 2] {
        std::array::from_fn(|axis| {
            let [start, end] = self.ranges[axis];
            (1.0 - at[axis]) * start + at[axis] * end
        })
    }

    /// Encloses the patch's own parameters over the intersection of its domain with a box
    /// `[low, high]` of the surface's parameters; `None` where they do not intersect.
    pub(crate) fn local(&self, parameters: [[f64; 2]; 2]) -> Option<[Interval; 2]> {
        let local = |axis: usize| {
            let [start, end] = self.ranges[axis];
            let [low, high] = [parameters[0][axis], parameters[1][axis]];
            if !(low <= end && start <= high) {
                return None;
            }
            let [start, end] = [start, end].map(Interval::point);
            let at = |value: f64| ((Interval::point(value) - start) / (end - start)).in_unit();
            Some(at(low).hull(at(high)))
        };
        Some([local(0)?, local(1)?])
    }
}

/// All Bézier patches of a model in the frame: one for each pair of non-empty knot spans.
pub(crate) fn patches(model: &Model, frame: &Frame, motion: &Motion) -> Vec<Patch> {
    (0..model.surfaces.len()).flat_map(|index| patches_of(model, index, frame, motion)).collect()
}

/// The Bézier patches of one surface of a model.
pub(crate) fn patches_of(model: &Model, index: usize, frame: &Frame, motion: &Motion) -> Vec<Patch> {
    let surface = &model.surfaces[index];
    let mut patches = Vec::new();
    let rows = homogeneous(surface, frame, motion);
    let [u_spans, v_spans] = [0, 1].map(|axis| surface.spans(axis));
    let [p, q] = surface.degree;
    for &u in &u_spans {
        // Control points of the strip, u fastest: one column of p + 1 for each column of the net.
        let strip: Vec<Vec<Homogeneous>> = (0..surface.count(1))
            .map(|j| {
                let line: Vec<Homogeneous> = (u - p..=u).map(|i| rows[i][j]).collect();
                bezier_points(&line, surface.knots(0), u)
            })
            .collect();
        for &v in &v_spans {
            let points = (0..=p)
                .flat_map(|i| {
                    let line: Vec<Homogeneous> = (v - q..=v).map(|j| strip[j][i]).collect();
                    bezier_points(&line, surface.knots(1), v)
                })
                .collect();
            let ranges = [(0, u), (1, v)].map(|(axis, span)| {
                let knots = surface.knots(axis);
                [knots[span], knots[span + 1]]
            });
            patches.push(Patch { net: Net { degree: surface.degree, points }, surface: index, ranges });
        }
    }
    patches
}

/// The control points in the frame, multiplied by weights, the largest near 1: one
/// factor for all weights of a surface changes no point.
fn homogeneous(surface: &Surface, frame: &Frame, motion: &Motion) -> Vec<Vec<Homogeneous>> {
    let heaviest = surface.ctrl.iter().flatten().map(|point| point[3]).fold(0.0, f64::max);
    let scale = Interval::point(1.0 / power_of_two(heaviest));
    let lift = |&[x, y, z, w]: &[f64; 4]| {
        let weight = Interval::point(w) * scale;
        let point = frame.place([x, y, z], motion);
        [point[0] * weight, point[1] * weight, point[2] * weight, weight]
    };
    surface.ctrl.iter().map(|row| row.iter().map(lift).collect()).collect()
}

/// The Bézier control points of the span `[knots[span], knots[span + 1]]`: point k is the blossom
/// at `degree - k` times the span's start and k times its end, by de Boor's algorithm. All
/// parameters lie in the span, hence all factors in [0, 1] and all sums are convex.
fn bezier_points(line: &[Homogeneous], knots: &[f64], span: usize) -> Vec<Homogeneous> {
    let degree = line.len() - 1;
    let knot = |index: usize| Interval::point(knots[index]);
    (0..=degree)
        .map(|k| {
            let mut points = line.to_vec();
            for round in 1..=degree {
                let parameter = knot(if round <= k { span + 1 } else { span });
                for i in (round..=degree).rev() {
                    let (start, end) = (knot(span - degree + i), knot(span + 1 + i - round));
                    let factor = ((parameter - start) / (end - start)).in_unit();
                    points[i] = blend(&points[i - 1], &points[i], factor);
                }
            }
            points[degree]
        })
        .collect()
}
