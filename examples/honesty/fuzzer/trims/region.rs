//! Trimmed regions by counts of crossings, without the library's code.
//!
//! A Bézier curve whose hull does not touch a box is replaced by its chord, which turns about the
//! box by the same angle: whether it crosses the ray from the box to the right follows from the
//! heights of its ends alone. A hull that touches the box is halved. Counts are thus exact for the
//! curves as halved in float64, and boxes are padded by more than their rounding.

use glam::{DVec2, DVec3, Vec3Swizzles};
use nurbs_hausdorff::ParamBox;
use nurbs_hausdorff::trim::TrimCurveArrays;

/// The padding of a box, relative to the domain's range and to its coordinates.
const RANGE_PADDING: f64 = 1e-14;
const COORDINATE_PADDING: f64 = 16.0 * f64::EPSILON;

/// The largest number of halvings of a curve, and the size of a hull, relative to the box, from
/// which on it counts as touching the box.
const MAX_HALVINGS: u32 = 60;
const SMALL: f64 = 0.125;

/// The samples of a curve in the search for near points on loops.
const SAMPLES: usize = 24;

/// The golden sections of that search.
const SECTIONS: usize = 76;

/// A rational Bézier curve by its homogeneous controls `(w u, w v, w)`.
type Controls = Vec<DVec3>;

/// The region of a surface's domain within loops.
pub(crate) struct Region {
    curves: Vec<Controls>,
    padding: DVec2,
}

/// A point of a loop: the number of the curve, and its parameter.
#[derive(Clone, Copy)]
pub(crate) struct Rim {
    pub(crate) curve: usize,
    pub(crate) t: f64,
}

impl Region {
    pub(crate) fn new(loops: &[Vec<TrimCurveArrays>], domain: ParamBox) -> Self {
        let curves = loops.iter().flatten().flat_map(bezier_curves).collect();
        let (low, high) = (DVec2::from(domain.low()), DVec2::from(domain.high()));
        let padding = RANGE_PADDING * (high - low) + COORDINATE_PADDING * low.abs().max(high.abs());
        Self { curves, padding }
    }

    /// Returns the number of curves.
    pub(crate) fn curves(&self) -> usize {
        self.curves.len()
    }

    /// Returns the point of a loop.
    pub(crate) fn at(&self, Rim { curve, t }: Rim) -> DVec2 {
        let mut controls = self.curves[curve].clone();
        for length in (1..controls.len()).rev() {
            for k in 0..length {
                controls[k] = controls[k].lerp(controls[k + 1], t);
            }
        }
        point_of(controls[0])
    }

    /// Returns the winding number of every point of a box, if no loop comes near the box.
    pub(crate) fn number(&self, low: DVec2, high: DVec2) -> Option<i32> {
        let (low, high) = (low - self.padding, high + self.padding);
        self.curves.iter().map(|curve| crossings(curve, low, high, 0)).sum()
    }

    /// Returns whether the point is inside, and not nearly on a loop.
    pub(crate) fn contains(&self, point: DVec2) -> bool {
        self.number(point, point) == Some(1)
    }

    /// Returns points of the loops, evenly spaced along each curve.
    pub(crate) fn rims(&self) -> impl Iterator<Item = Rim> {
        let at = |index: usize| Rim { curve: index / SAMPLES, t: (index % SAMPLES) as f64 / SAMPLES as f64 };
        (0..self.curves.len() * SAMPLES).map(at)
    }

    /// Returns the point of a curve of about the least value near another of [`Region::rims`].
    pub(crate) fn slide(&self, start: Rim, value: impl Fn(DVec2) -> f64) -> Rim {
        let rim = |t: f64| Rim { t, ..start };
        let evaluate = |t: f64| value(self.at(rim(t)));
        let ratio = 0.5 * (5.0_f64.sqrt() - 1.0);
        let width = 1.0 / SAMPLES as f64;
        let (mut low, mut high) = ((start.t - width).max(0.0), (start.t + width).min(1.0));
        let mut best = (evaluate(start.t), start.t);
        let mut inner = [high - ratio * (high - low), low + ratio * (high - low)];
        let mut values = inner.map(evaluate);
        for _ in 0..SECTIONS {
            let first = values[0] < values[1];
            let (found, t) = if first { (values[0], inner[0]) } else { (values[1], inner[1]) };
            if found < best.0 {
                best = (found, t);
            }
            if first {
                high = inner[1];
                inner = [high - ratio * (high - low), inner[0]];
                values = [evaluate(inner[0]), values[0]];
            } else {
                low = inner[0];
                inner = [inner[1], low + ratio * (high - low)];
                values = [values[1], evaluate(inner[1])];
            }
        }
        for end in [0.0, 1.0] {
            if (end - best.1).abs() <= width && evaluate(end) < best.0 {
                best = (evaluate(end), end);
            }
        }
        rim(best.1)
    }
}

fn point_of(control: DVec3) -> DVec2 {
    control.xy() / control.z
}

/// Returns the crossings of a curve with the ray from a box to the right, upwards ones counted
/// positive, or `None` if the curve may touch the box.
fn crossings(controls: &[DVec3], low: DVec2, high: DVec2, halvings: u32) -> Option<i32> {
    let points = controls.iter().map(|&control| point_of(control));
    let (least, greatest) = points
        .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(least, greatest), p| (least.min(p), greatest.max(p)));
    if greatest.cmplt(low).any() || least.y > high.y {
        return Some(0);
    }
    let [start, end] = [controls[0], controls[controls.len() - 1]].map(point_of);
    if least.x > high.x {
        let height = 0.5 * (low.y + high.y);
        return Some(match (start.y <= height, end.y <= height) {
            (true, false) => 1,
            (false, true) => -1,
            _ => 0,
        });
    }
    let inside = |point: DVec2| point.cmpge(low).all() && point.cmple(high).all();
    let small = (greatest - least).cmplt(SMALL * (high - low)).all();
    if halvings == MAX_HALVINGS || small || inside(start) || inside(end) {
        return None;
    }
    let (mut first, mut second) = (controls.to_vec(), controls.to_vec());
    for (level, control) in first.iter_mut().enumerate().skip(1) {
        for k in 0..controls.len() - level {
            second[k] = 0.5 * (second[k] + second[k + 1]);
        }
        *control = second[0];
    }
    Some(crossings(&first, low, high, halvings + 1)? + crossings(&second, low, high, halvings + 1)?)
}

/// Returns the Bézier curves of a B-spline curve: control k of a span is the blossom at `degree - k`
/// times its start and k times its end.
fn bezier_curves(curve: &TrimCurveArrays) -> Vec<Controls> {
    let TrimCurveArrays { degree, knots, control_points, .. } = curve;
    let degree = *degree;
    let homogeneous = |&[u, v, w]: &[f64; 3]| DVec3::new(w * u, w * v, w);
    let spans = (degree..control_points.len()).filter(|&span| knots[span] < knots[span + 1]);
    spans
        .map(|span| {
            let blossom = |k: usize| {
                let mut points: Controls =
                    control_points[span - degree..=span].iter().map(homogeneous).collect();
                for round in 1..=degree {
                    let parameter = knots[if round <= k { span + 1 } else { span }];
                    for i in (round..=degree).rev() {
                        let (start, end) = (knots[span - degree + i], knots[span + 1 + i - round]);
                        let factor = (parameter - start) / (end - start);
                        // Where the factor is 0 or 1, ends stay the floats that they are.
                        points[i] = points[i - 1] * (1.0 - factor) + points[i] * factor;
                    }
                }
                points[degree]
            };
            (0..=degree).map(blossom).collect()
        })
        .collect()
}
