//! Moments of a solid by Gauss's rule on its surfaces' spans, by the divergence theorem: a second rule.

use super::super::sheet::sheets;
use crate::support::quadrature::gauss;
use glam::{DMat3, DVec2, DVec3};
use nurbs_hausdorff::{Axis, Model, NurbsSurface};

/// Nodes along each direction of a part, and the parts of a span in the passes.
const NODES: usize = 10;
const PARTS: [usize; 3] = [1, 2, 4];

/// The error of the finest pass, in the differences of the passes.
const DIFFERENCES: f64 = 16.0;

/// Roundings of the rule, relative to the sum of sizes.
const ROUNDING: f64 = 1e-12;

/// A number with an estimate of its error.
#[derive(Debug, Clone, Copy)]
pub(super) struct Estimate {
    pub(super) value: f64,
    pub(super) error: f64,
}

/// Area, volume, first and second moments about the middle of the model's box.
pub(super) struct Moments {
    pub(super) area: Estimate,
    pub(super) volume: Estimate,
    pub(super) first: [Estimate; 3],
    /// By rows.
    pub(super) second: [[Estimate; 3]; 3],
    pub(super) origin: DVec3,
}

/// The sums of a pass, and the sums of the sizes of their terms.
#[derive(Default, Clone, Copy)]
struct Sums {
    area: f64,
    volume: f64,
    first: DVec3,
    second: DMat3,
}

impl Moments {
    /// The moments of the solid that surfaces bound whose normals are all outwards or all inwards.
    pub(super) fn of(model: &Model) -> Self {
        let origin = model.bounding_box().center();
        let size = model.bounding_box().diagonal();
        let passes = PARTS.map(|parts| pass(model, origin, parts));
        let sign = passes[2].volume.signum();
        let rounding = ROUNDING * (passes[2].area * size);
        let estimate = |of: &dyn Fn(&Sums) -> f64, rounding: f64, sign: f64| {
            let [coarse, middle, fine] = [0, 1, 2].map(|pass| of(&passes[pass]));
            let error = DIFFERENCES * ((fine - middle).abs() + (middle - coarse).abs() / 16.0) + rounding;
            Estimate { value: sign * fine, error }
        };
        Self {
            area: estimate(&|sums| sums.area, rounding / size, 1.0),
            volume: estimate(&|sums| sums.volume, rounding, sign),
            first: [0, 1, 2].map(|i| estimate(&|sums| sums.first[i], rounding * size, sign)),
            second: [0, 1, 2].map(|i| {
                [0, 1, 2].map(|j| estimate(&|sums| sums.second.col(j)[i], rounding * size * size, sign))
            }),
            origin,
        }
    }
}

fn pass(model: &Model, origin: DVec3, parts: usize) -> Sums {
    let rule = gauss(NODES);
    // The default of a matrix is the identity.
    let mut sums = Sums { second: DMat3::ZERO, ..Sums::default() };
    for (sheet, surface) in sheets(model, origin).iter().zip(model.surfaces()) {
        let [u, v] = Axis::BOTH.map(|axis| steps(surface, axis, parts));
        for (u_start, u_step) in &u {
            for (v_start, v_step) in &v {
                for [s, weight_s] in &rule {
                    for [t, weight_t] in &rule {
                        let at = sheet.tangents(DVec2::new(u_start + s * u_step, v_start + t * v_step));
                        let normal = at.u.cross(at.v) * (weight_s * weight_t * u_step * v_step);
                        let flux = at.point.dot(normal);
                        sums.area += normal.length();
                        sums.volume += flux / 3.0;
                        sums.first += at.point * (flux / 4.0);
                        sums.second += DMat3::from_cols(
                            at.point.x * at.point,
                            at.point.y * at.point,
                            at.point.z * at.point,
                        ) * (flux / 5.0);
                    }
                }
            }
        }
    }
    sums
}

/// The spans of the domain that are not empty, each in equal parts, by their starts and lengths.
fn steps(surface: &NurbsSurface, axis: Axis, parts: usize) -> Vec<(f64, f64)> {
    let knots = surface.knots(axis);
    let spans = (surface.degree()[axis]..surface.counts()[axis]).map(|span| [knots[span], knots[span + 1]]);
    let of_span = |[start, end]: [f64; 2]| {
        let step = (end - start) / parts as f64;
        (0..parts).map(move |part| (start + step * part as f64, step))
    };
    spans.filter(|[start, end]| start < end).flat_map(of_span).collect()
}
