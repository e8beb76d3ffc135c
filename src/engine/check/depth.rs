//! How deep two bodies are in each other.

use super::parting::parting_distance;
use crate::clearance::Nearest;
use crate::closest::closest;
use crate::engine::PreparedModel;
use crate::flatness::Flatness;
use crate::interval::Interval;
use crate::solid::Side;
use glam::DVec3;

/// The number of balls tried.
const BALLS: usize = 24;

/// The distance from one ball's middle to the next, relative to the radius of the first: below 1, so that the next
/// middle is in the first ball and therefore inside both bodies.
const FIRST_STEP: f64 = 0.9;

/// The gap of distances, as a part of the larger body's diagonal.
const RELATIVE_GAP: f64 = 1e-9;

/// The places at which the search for a ball starts, on the segment from the point inside both bodies to the middle of
/// the intersection of their boxes: the point itself may lie on a boundary.
const STARTS: [f64; 4] = [0.0, 0.125, 0.5, 1.0];

/// A ball without points of either boundary.
struct Ball {
    middle: DVec3,
    radius: f64,
    /// Away from the nearest point of both boundaries.
    away: DVec3,
}

/// Returns the interval of the length of the shortest motion that leaves two bodies without a common inside, from a
/// point inside both: lemmas K1 and K2 of docs/assemblies.md.
///
/// The largest ball within both is looked for from points between that one and the middle of what their boxes have in
/// common, in small steps. O([`BALLS`] log patches).
pub(super) fn depth(models: [&PreparedModel; 2], inside_both: [f64; 3], nearest: &Nearest) -> Interval {
    let upper = parting_distance(models, nearest);
    let start = DVec3::from_array(inside_both);
    let [a, b] = models.map(PreparedModel::control_box);
    let middle = 0.5 * (a.min.max(b.min) + a.max.min(b.max));
    let points = STARTS.map(|way| start + way * (middle - start));
    let is_inside = |point: &DVec3| models.iter().all(|model| model.side_within(*point, 0.0) == Side::Inside);
    let balls = points.into_iter().filter(is_inside);
    let largest = balls.filter_map(|point| ball(models, point)).max_by(|a, b| a.radius.total_cmp(&b.radius));
    let Some(mut best) = largest else { return Interval { lower: 0.0, upper } };
    let mut step = FIRST_STEP;
    for _ in 1..BALLS {
        let next = ball(models, best.middle + step * best.radius * best.away);
        match next.filter(|next| next.radius > best.radius) {
            Some(larger) => best = larger,
            None => step *= 0.5,
        }
    }
    let lower = (2.0 * best.radius).next_down();
    Interval { lower: if lower < upper { lower } else { upper }, upper }
}

/// Returns a ball about a point that has no points of either boundary.
fn ball(models: [&PreparedModel; 2], middle: DVec3) -> Option<Ball> {
    let balls = models.map(|model| {
        let target = &model.target(Flatness::None).target;
        let found = closest(target, middle, RELATIVE_GAP * model.control_box().diagonal())?;
        let radius = model.boundary().clear_radius(found.lower);
        (radius > 0.0).then_some(Ball { middle, radius, away: (middle - found.point).try_normalize()? })
    });
    let [Some(a), Some(b)] = balls else { return None };
    Some(if a.radius < b.radius { a } else { b })
}
