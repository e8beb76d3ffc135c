//! The parts of curves between two of their points.

use crate::nurbs::curve::{Curve, SplineCurve};
use crate::nurbs::spline::Spline;
use glam::DVec3;

/// Part of a range below which parameters are the same.
const SAME_PARAMETER: f64 = 1e-9;

impl Curve {
    /// Returns the diagonal of the box of some points of the curve over a range.
    pub(crate) fn size(&self, [start, end]: [f64; 2]) -> f64 {
        let points = [0.0, 0.25, 0.5, 0.75, 1.0].map(|part| self.point(start + part * (end - start)));
        let low = points.into_iter().fold(DVec3::INFINITY, DVec3::min);
        low.distance(points.into_iter().fold(DVec3::NEG_INFINITY, DVec3::max))
    }
}

/// The part of a curve that an edge is.
pub(crate) struct CurvePart {
    pub(crate) curve: Curve,
    pub(crate) range: [f64; 2],
    /// Whether it runs from the second end to the first one.
    pub(crate) turned: bool,
}

impl CurvePart {
    /// Returns the part of a curve from one parameter to another. Around a closed curve it runs
    /// over the curve's end, and it is the whole curve if the ends are one vertex; an open curve
    /// has one part between two points, whatever the direction stated.
    pub(crate) fn between(
        curve: Curve,
        [from, mut to]: [f64; 2],
        closed: bool,
    ) -> Result<Self, &'static str> {
        if let Some(period) = curve.period() {
            to += period * ((from - to) / period).ceil();
            if closed || to - from <= SAME_PARAMETER * period {
                to = from + period;
            }
            return Ok(Self { curve, range: [from, to], turned: false });
        }
        let Some([start, end]) = curve.natural_range() else {
            return match from.partial_cmp(&to) {
                Some(std::cmp::Ordering::Less) => Ok(Self { curve, range: [from, to], turned: false }),
                Some(std::cmp::Ordering::Greater) => Ok(Self { curve, range: [to, from], turned: true }),
                _ => Err("its vertices are one point of an open curve"),
            };
        };
        let margin = SAME_PARAMETER * (end - start);
        let is_loop =
            curve.point(start).distance(curve.point(end)) <= SAME_PARAMETER * curve.size([start, end]);
        if !is_loop {
            let whole = closed && (from - to).abs() <= margin;
            return match (from < to, whole) {
                (_, true) => Err("its vertices are one point of an open curve"),
                (true, _) => Ok(Self { curve, range: [from, to], turned: false }),
                (false, _) => Ok(Self { curve, range: [to, from], turned: true }),
            };
        }
        let from = if end - from <= margin { start } else { from };
        let to = if to - start <= margin || closed && from == start { end } else { to };
        if from < to && to - from > margin {
            return Ok(Self { curve, range: [from, to], turned: false });
        }
        let to = if closed { from } else { to };
        let error = curve.error();
        let curve =
            over_the_end(&curve, [from, to]).ok_or("it runs over the end of a curve that is no B-spline")?;
        let range = curve.domain();
        let curve = Curve::Spline(SplineCurve::from(curve).with_error(error));
        Ok(Self { curve, range, turned: false })
    }
}

/// Returns the B-spline from a parameter over the end of a closed curve to another one.
fn over_the_end(curve: &Curve, [from, to]: [f64; 2]) -> Option<Spline> {
    let Curve::Spline(_) = curve else { return None };
    let [start, end] = curve.natural_range()?;
    let (mut joined, _, _) = curve.spline([from, end]).ok()?;
    let (second, _, _) = curve.spline([start, to]).ok()?;
    let shift = end - start;
    // The homogeneous points of both sides of the joint are multiples of each other.
    let factor = joined.controls.last()?.w / second.controls.first()?.w;
    let degree = joined.degree;
    joined.knots.pop();
    joined.knots.extend(second.knots.iter().skip(degree + 1).map(|knot| knot + shift));
    joined.controls.extend(second.controls.iter().skip(1).map(|&control| factor * control));
    Some(joined)
}
