//! Directions of closed loops, and the outer loop that closed surfaces can lack.

use super::area::{self, AREA_TOLERANCE};
use super::periods::widest_gap;
use super::rings::reversed;
use crate::faces::uses::TrimUse;
use crate::nurbs::Surface;
use crate::report::{FaceFault, Remark};
use glam::{DVec2, DVec3, Vec3Swizzles};

/// The points of a piece of a curve, for each degree, in the polygon that stands for it: one piece of a
/// high degree may be a whole loop.
const POINTS_PER_DEGREE: usize = 8;

/// The most periods that a loop's box is searched for places of a hole.
const MAX_PLACES: f64 = 64.0;

/// The most points of a loop that are compared with another loop.
const MAX_COMPARED: usize = 15;

/// A loop and its polygon.
struct Loop {
    uses: Vec<TrimUse>,
    polygon: Vec<DVec2>,
    area: f64,
}

impl Loop {
    fn new(uses: Vec<TrimUse>) -> Self {
        let polygon: Vec<DVec2> = uses.iter().flat_map(points).collect();
        let area = area::of_loop(&uses);
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

    /// Returns whether another loop, moved by `shift`, lies inside, by most of its points: loops may
    /// touch in some.
    fn surrounds(&self, other: &Self, shift: DVec2) -> bool {
        let step = other.polygon.len().div_ceil(MAX_COMPARED);
        let points = || other.polygon.iter().step_by(step);
        2 * points().filter(|&&point| self.contains(point + shift)).count() > points().count()
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
pub(super) fn points(trim_use: &TrimUse) -> Vec<DVec2> {
    let pieces = trim_use.curve.pieces();
    let at = |piece: &crate::nurbs::Spline| -> Vec<DVec2> {
        let [start, end] = piece.domain();
        let count = if piece.degree == 1 { 1 } else { POINTS_PER_DEGREE * piece.degree };
        let point = |index: usize| piece.point(start + (end - start) * index as f64 / count as f64).xy();
        (0..count).map(point).collect()
    };
    pieces.iter().flat_map(at).collect()
}

/// Returns the loops with the material on the left: those inside of an even number of
/// others run counter-clockwise.
///
/// On a surface closed in both parameters a clockwise loop inside of no other is a hole
/// in the whole surface, whose rectangle becomes the outer loop; on other surfaces, where no
/// face covers the rest, it is a loop of the wrong direction, which is reversed if it is the only one there.
/// Loops beside each other bound several regions, which is remarked: a face is connected (ISO 10303-42, 5.4).
/// Where they turn in opposite directions there, one is a hole outside of the face, and the face is refused.
///
/// # Errors
/// `BREP_LOOP_NO_AREA` for a loop without area, `BREP_LOOP_SHIFTS` if a hole fits its outer loop
/// at several periods, `BREP_LOOP_DIRECTIONS` if loops beside each other state opposite sides,
/// `BREP_COVERED_TWICE` if the region is larger than the surface.
pub(super) fn directed(loops: Vec<Vec<TrimUse>>, surface: &Surface) -> Result<Directed, FaceFault> {
    let mut loops: Vec<Loop> = loops.into_iter().map(Loop::new).collect();
    if let Some(index) = loops.iter().position(|one| one.area == 0.0 || !one.area.is_finite()) {
        return Err(FaceFault::new("BREP_LOOP_NO_AREA", format!("loop {index} encloses no area")));
    }
    gather(&mut loops, surface)?;
    let depth = |loops: &[Loop], index: usize| {
        let others = loops.iter().enumerate().filter(|(other, _)| *other != index);
        others.filter(|(_, one)| one.surrounds(&loops[index], DVec2::ZERO)).count()
    };
    let mut depths: Vec<usize> = (0..loops.len()).map(|index| depth(&loops, index)).collect();
    let closed = area::of_closed(surface);
    let outer = |positive: bool| {
        loops.iter().zip(&depths).any(|(one, &depth)| depth == 0 && (one.area > 0.0) == positive)
    };
    if outer(false) && outer(true) {
        let why = "loops beside each other turn in opposite directions: one is a hole outside of the face";
        return Err(FaceFault::new("BREP_LOOP_DIRECTIONS", why));
    }
    let are_holes = closed.is_some() && outer(false);
    let remark = several_regions(&depths).filter(|_| !are_holes);
    if are_holes {
        let outer = whole(surface, &mut loops);
        loops.insert(0, outer);
        depths = depths.into_iter().map(|depth| depth + 1).collect();
        depths.insert(0, 0);
    }
    for (one, depth) in loops.iter_mut().zip(depths) {
        if (one.area > 0.0) != (depth % 2 == 0) {
            one.uses = reversed(std::mem::take(&mut one.uses));
            one.area = -one.area;
        }
    }
    let covered: f64 = loops.iter().map(|one| one.area).sum();
    match closed.map(|whole| covered / whole).filter(|&part| part > 1.0 + AREA_TOLERANCE) {
        Some(part) => {
            let why = format!("the loops cover {part:?} of the surface, expected at most all of it");
            Err(FaceFault::new("BREP_COVERED_TWICE", why))
        }
        None => Ok(Directed { loops: loops.into_iter().map(|one| one.uses).collect(), remark }),
    }
}

/// Loops with the material on their left, and what the report says of them.
pub(super) struct Directed {
    pub(super) loops: Vec<Vec<TrimUse>>,
    pub(super) remark: Option<Remark>,
}

/// Returns the remark on loops of which several lie inside of no other.
fn several_regions(depths: &[usize]) -> Option<Remark> {
    let outside: Vec<String> = depths
        .iter()
        .enumerate()
        .filter(|(_, depth)| **depth == 0)
        .map(|(index, _)| index.to_string())
        .collect();
    let why = || {
        let loops = outside.join(", ");
        format!("of its loops {loops} none lies within another: they are read as regions beside each other")
    };
    (outside.len() > 1).then(|| Remark::new("BREP_SEVERAL_REGIONS", why()))
}

/// Moves loops by whole periods into the box of the largest one, and holes into that one itself.
fn gather(loops: &mut [Loop], surface: &Surface) -> Result<(), FaceFault> {
    let largest = loops.iter().enumerate().max_by(|(_, a), (_, b)| a.area.abs().total_cmp(&b.area.abs()));
    let Some((largest, _)) = largest else { return Ok(()) };
    let periods = surface.periods();
    for index in (0..loops.len()).filter(|&index| index != largest) {
        let shift = shift(&loops[largest], &loops[index], periods).map_err(|count| {
            let why = format!("loop {index} lies in the outer one at {count} periods, expected one");
            FaceFault::new("BREP_LOOP_SHIFTS", why)
        })?;
        if shift != DVec2::ZERO {
            loops[index].translate(shift);
        }
    }
    Ok(())
}

/// Returns the whole periods by which one loop comes to the middle of another one's box, or, if
/// it is a hole in that, into that.
///
/// # Errors
/// The number of places in which the hole lies in the other loop, if there are several.
fn shift(outer: &Loop, one: &Loop, periods: [Option<f64>; 2]) -> Result<DVec2, usize> {
    let ([low, high], [one_low, one_high]) = (outer.bounds(), one.bounds());
    let difference = 0.5 * (low + high - one_low - one_high);
    // The places at which both boxes meet, and the one at which their middles are nearest.
    let places = [0, 1].map(|axis| match periods[axis] {
        Some(period) => {
            let ends = [low[axis] - one_high[axis], high[axis] - one_low[axis]];
            let [first, last] = [(ends[0] / period).ceil(), (ends[1] / period).floor()];
            let count = (last - first + 1.0).clamp(0.0, MAX_PLACES) as u32;
            let all = (0..count).map(|place| period * (first + f64::from(place))).collect();
            (period * (difference[axis] / period).round(), all)
        }
        None => (0.0, vec![0.0]),
    });
    let [(u, us), (v, vs)] = places;
    let nearest = DVec2::new(u, v);
    if outer.area < 0.0 || one.area > 0.0 {
        return Ok(nearest);
    }
    let all = us.iter().flat_map(|&u| vs.iter().map(move |&v| DVec2::new(u, v)));
    let inside: Vec<DVec2> = all.filter(|&shift| outer.surrounds(one, shift)).collect();
    match inside.as_slice() {
        [] => Ok(nearest),
        [only] => Ok(*only),
        several => Err(several.len()),
    }
}

/// Returns the rectangle of a whole closed surface, cut where it does not cross the loops
/// if these leave room, and moves the loops by whole periods into it.
fn whole(surface: &Surface, loops: &mut [Loop]) -> Loop {
    let natural = surface.natural_ranges();
    let periods = surface.periods();
    let mut range = |axis: usize| {
        let extents = || loops.iter().map(|one| one.bounds().map(|corner| corner[axis]));
        let Some(period) = periods[axis] else {
            let ends = |[low, high]: [f64; 2], [a, b]: [f64; 2]| [low.min(a), high.max(b)];
            return natural[axis].unwrap_or_else(|| extents().fold([f64::INFINITY, f64::NEG_INFINITY], ends));
        };
        let cut = widest_gap(&extents().collect::<Vec<_>>(), period);
        for one in loops.iter_mut() {
            let [low, high] = one.bounds().map(|corner| corner[axis]);
            let shift = -period * ((0.5 * (low + high) - cut) / period).floor();
            if shift != 0.0 {
                one.translate(DVec2::from_array([0, 1].map(|other| if other == axis { shift } else { 0.0 })));
            }
        }
        [cut, cut + period]
    };
    let ([u0, u1], [v0, v1]) = (range(0), range(1));
    let corners = [[u0, v0], [u1, v0], [u1, v1], [u0, v1]].map(|[u, v]| DVec3::new(u, v, 0.0));
    let uses = (0..4).map(|index| TrimUse::segment(corners[index], corners[(index + 1) % 4])).collect();
    Loop::new(uses)
}
