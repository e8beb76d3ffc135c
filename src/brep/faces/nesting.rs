//! Orientations of closed loops, and the outer loop that closed surfaces can lack.

use super::rings::reversed;
use super::uses::TrimUse;
use crate::brep::nurbs::Surface;
use crate::brep::report::FaceFault;
use glam::{DVec2, DVec3, Vec3Swizzles};

/// The points of a piece of a curve in the polygon that stands for it.
const POLYGON_POINTS: usize = 8;

/// A loop and its polygon.
struct Loop {
    uses: Vec<TrimUse>,
    polygon: Vec<DVec2>,
    area: f64,
}

impl Loop {
    fn new(uses: Vec<TrimUse>) -> Self {
        let polygon: Vec<DVec2> = uses.iter().flat_map(points).collect();
        let pairs = polygon.iter().zip(polygon.iter().cycle().skip(1));
        let origin = polygon[0];
        let area = pairs.map(|(&a, &b)| 0.5 * (a - origin).perp_dot(b - origin)).sum();
        Self { uses, polygon, area }
    }

    fn bounds(&self) -> [DVec2; 2] {
        let fold = |f: fn(DVec2, DVec2) -> DVec2, start| self.polygon.iter().copied().fold(start, f);
        [fold(DVec2::min, DVec2::INFINITY), fold(DVec2::max, DVec2::NEG_INFINITY)]
    }

    /// Returns whether a point lies inside, by the parity of crossings.
    fn contains(&self, point: DVec2) -> bool {
        let pairs = self.polygon.iter().zip(self.polygon.iter().cycle().skip(1));
        let crossings = pairs.filter(|&(&a, &b)| {
            (a.y > point.y) != (b.y > point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)
        });
        crossings.count() % 2 == 1
    }

    fn translate(&mut self, shift: DVec2) {
        for trim_use in &mut self.uses {
            trim_use.curve = trim_use.curve.clone().translated(shift.extend(0.0));
        }
        for point in &mut self.polygon {
            *point += shift;
        }
    }
}

/// Returns points of a curve without its end.
fn points(trim_use: &TrimUse) -> Vec<DVec2> {
    let pieces = trim_use.curve.pieces();
    let at = |piece: &crate::brep::nurbs::Spline| -> Vec<DVec2> {
        let [start, end] = piece.domain();
        let count = if piece.degree == 1 { 1 } else { POLYGON_POINTS };
        let point = |index: usize| piece.point(start + (end - start) * index as f64 / count as f64).xy();
        (0..count).map(point).collect()
    };
    pieces.iter().flat_map(at).collect()
}

/// Returns the loops with the material on the left: those inside of an even number of
/// others run counter-clockwise.
///
/// On a surface closed in both parameters a clockwise loop inside of no other is a hole
/// in the whole surface, whose rectangle becomes the outer loop; on other surfaces it is
/// a loop of the wrong orientation, which is reversed.
///
/// # Errors
/// `BREP_LOOP_NO_AREA` for a loop without area.
pub(super) fn orient(loops: Vec<Vec<TrimUse>>, surface: &Surface) -> Result<Vec<Vec<TrimUse>>, FaceFault> {
    let mut loops: Vec<Loop> = loops.into_iter().map(Loop::new).collect();
    if let Some(index) = loops.iter().position(|one| one.area == 0.0 || !one.area.is_finite()) {
        return Err(FaceFault::new("BREP_LOOP_NO_AREA", format!("loop {index} encloses no area")));
    }
    gather(&mut loops, surface);
    let depth = |loops: &[Loop], index: usize| {
        let point = loops[index].polygon[0];
        loops.iter().enumerate().filter(|(other, one)| *other != index && one.contains(point)).count()
    };
    let mut depths: Vec<usize> = (0..loops.len()).map(|index| depth(&loops, index)).collect();
    if is_closed(surface) && loops.iter().zip(&depths).any(|(one, &depth)| depth == 0 && one.area < 0.0) {
        loops.insert(0, whole(surface, &loops));
        depths = depths.into_iter().map(|depth| depth + 1).collect();
        depths.insert(0, 0);
    }
    for (one, depth) in loops.iter_mut().zip(depths) {
        if (one.area > 0.0) != (depth % 2 == 0) {
            one.uses = reversed(std::mem::take(&mut one.uses));
        }
    }
    Ok(loops.into_iter().map(|one| one.uses).collect())
}

/// Moves loops by whole periods into the box of the largest one.
fn gather(loops: &mut [Loop], surface: &Surface) {
    let largest = loops.iter().enumerate().max_by(|(_, a), (_, b)| a.area.abs().total_cmp(&b.area.abs()));
    let Some((largest, [low, high])) = largest.map(|(index, one)| (index, one.bounds())) else { return };
    let middle = 0.5 * (low + high);
    let periods = surface.periods();
    for (index, one) in loops.iter_mut().enumerate() {
        if index == largest {
            continue;
        }
        let [low, high] = one.bounds();
        let shift = [0, 1].map(|axis| match periods[axis] {
            Some(period) => period * ((middle[axis] - 0.5 * (low[axis] + high[axis])) / period).round(),
            None => 0.0,
        });
        if shift != [0.0, 0.0] {
            one.translate(DVec2::from_array(shift));
        }
    }
}

/// Returns whether the surface is closed in u, and in v closed or ended by poles.
fn is_closed(surface: &Surface) -> bool {
    let [u, v] = surface.closures();
    u.is_some() && (v.is_some() || surface.poles().len() == 2)
}

/// Returns the rectangle of a whole closed surface, cut where it does not cross the loops
/// if their box leaves room.
fn whole(surface: &Surface, loops: &[Loop]) -> Loop {
    let bounds = loops.iter().map(Loop::bounds);
    let [low, high] =
        bounds.fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], [a, b]| [low.min(a), high.max(b)]);
    let natural = surface.natural_ranges();
    let periods = surface.periods();
    let range = |axis: usize| match (periods[axis], natural[axis]) {
        (Some(period), _) => {
            let middle = 0.5 * (low[axis] + high[axis]);
            [middle - 0.5 * period, middle + 0.5 * period]
        }
        (None, Some(range)) => range,
        (None, None) => [low[axis], high[axis]],
    };
    let ([u0, u1], [v0, v1]) = (range(0), range(1));
    let corners = [[u0, v0], [u1, v0], [u1, v1], [u0, v1]].map(|[u, v]| DVec3::new(u, v, 0.0));
    let uses = (0..4).map(|index| TrimUse::segment(corners[index], corners[(index + 1) % 4])).collect();
    Loop::new(uses)
}
