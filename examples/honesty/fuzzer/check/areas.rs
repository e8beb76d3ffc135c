//! Areas of faces by a second rule, which shares no code with the library's: Gauss's rule on halved knot spans,
//! with the surface by the definition of its basis functions.

use super::super::pairs::Pair;
use crate::support::evaluator::evaluate_on_span;
use crate::support::quadrature::gauss;
use nurbs_hausdorff::internals::engine::PreparedModel;
use nurbs_hausdorff::{Axis, NurbsSurface};

/// The number of pairs of which one is checked: the rule takes longer than most searches.
const ONE_IN: u64 = 32;

/// Nodes of the rule along each direction of a part, and the parts of a span in the three passes.
const NODES: usize = 8;
const PARTS: [usize; 3] = [1, 2, 4];

/// The error of the finest pass, in the differences of the passes: on smooth spans it is far smaller; where
/// a surface folds, the density has kinks at which the passes converge by chance.
const DIFFERENCES: f64 = 16.0;

/// Roundings of the rule, relative to the sum.
const ROUNDING: f64 = 1e-11;

/// Returns in words which area is not what the second rule gives.
pub(super) fn violations(seed: u64, pair: &Pair) -> Vec<String> {
    if !seed.is_multiple_of(ONE_IN) || pair.exponent != 0 {
        return Vec::new();
    }
    let models = [("A", &pair.a), ("B", &pair.b)];
    let of_model = |(name, model): (&str, &_)| {
        let Ok(prepared) = PreparedModel::new(model) else { return Vec::new() };
        let faces = model.faces().zip(prepared.face_areas()).enumerate();
        let untrimmed = faces.filter(|(_, (face, _))| face.trim().is_none());
        let wrong = untrimmed.filter_map(|(index, (face, area))| {
            let [coarse, middle, fine] = PARTS.map(|parts| area_by_rule(face.surface(), parts));
            let difference = (fine - middle).abs() + (middle - coarse).abs();
            let error = DIFFERENCES * difference + ROUNDING * fine;
            // Sums that overflow or are NaN state nothing.
            let holds = !error.is_finite() || (area.lower - error <= fine && fine <= area.upper + error);
            (!holds).then(|| {
                format!(
                    "area of face {index} of {name}: [{}, {}], by the second rule {fine} ± {error}",
                    area.lower, area.upper
                )
            })
        });
        wrong.collect()
    };
    models.into_iter().flat_map(of_model).collect()
}

/// The area by Gauss's rule on the spans, each divided into `parts` along both directions.
fn area_by_rule(surface: &NurbsSurface, parts: usize) -> f64 {
    let rule = gauss(NODES);
    let [u, v] = Axis::BOTH.map(|axis| spans(surface, axis));
    let [x, y, z, _] = surface.control_points()[0];
    let mut sum = 0.0;
    for &(span_u, [u_start, u_end]) in &u {
        for &(span_v, [v_start, v_end]) in &v {
            let steps = [(u_end - u_start) / parts as f64, (v_end - v_start) / parts as f64];
            for part in 0..parts * parts {
                let starts =
                    [u_start + steps[0] * (part / parts) as f64, v_start + steps[1] * (part % parts) as f64];
                for [s, weight_s] in &rule {
                    for [t, weight_t] in &rule {
                        let (u, v) = (starts[0] + s * steps[0], starts[1] + t * steps[1]);
                        let at = evaluate_on_span(surface, [span_u, span_v], u, v, [x, y, z]);
                        let normal = glam::DVec3::from(at.u).cross(at.v.into());
                        sum += weight_s * weight_t * steps[0] * steps[1] * normal.length();
                    }
                }
            }
        }
    }
    sum
}

/// The spans of the domain that are not empty: the index of the first knot, and both ends.
fn spans(surface: &NurbsSurface, axis: Axis) -> Vec<(usize, [f64; 2])> {
    let knots = surface.knots(axis);
    let spans = surface.degree()[axis]..surface.counts()[axis];
    spans.map(|span| (span, [knots[span], knots[span + 1]])).filter(|(_, [start, end])| start < end).collect()
}
