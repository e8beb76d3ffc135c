//! Loops that run around a period and so do not close in the parameters.

use super::chain::Chain;
use super::nesting::points;
use super::periods::{is_inside, widest_gap};
use crate::faces::uses::TrimUse;
use crate::nurbs::{Spline, Surface};
use crate::report::FaceFault;
use glam::DVec3;

/// Returns closed loops: closed chains as they are, rings joined in pairs by cuts along a
/// parameter line, and a lone ring around a pole closed along the pole.
///
/// # Errors
/// `BREP_RING` if a ring bounds no region of the surface.
pub(super) fn close(chains: Vec<Chain>, surface: &Surface) -> Result<Vec<Vec<TrimUse>>, FaceFault> {
    let (closed, mut rings): (Vec<_>, Vec<_>) = chains.into_iter().partition(|chain| chain.turns == [0, 0]);
    let mut loops: Vec<Vec<TrimUse>> = closed.into_iter().map(|chain| chain.uses).collect();
    begin_beside(&mut rings, &loops, surface)?;
    match <[Chain; 2]>::try_from(rings) {
        Ok(pair) => loops.push(join(pair, surface)?),
        Err(rings) => match <[Chain; 1]>::try_from(rings) {
            Ok([ring]) => loops.push(cap(ring, surface)?),
            Err(rings) if rings.is_empty() => {}
            Err(rings) => {
                let why = format!("{} loops run around a period, expected at most 2", rings.len());
                return Err(FaceFault::new("BREP_RING", why));
            }
        },
    }
    Ok(loops)
}

/// Equally spaced places around a period that are tried for a cut.
const PLACES: u32 = 32;

/// Begins the rings, where there is such a place, at one whose parameter line neither passes a closed loop nor
/// any ring twice: the holes of a face may lie anywhere around the period, and rings may run back and forth.
fn begin_beside(rings: &mut [Chain], loops: &[Vec<TrimUse>], surface: &Surface) -> Result<(), FaceFault> {
    let Some(first) = rings.first() else { return Ok(()) };
    let (along, _) = axis(first)?;
    let period = surface.closures()[along].unwrap_or_default();
    let values = |uses: &[TrimUse]| -> Vec<f64> {
        let inner = uses.iter().flat_map(points).map(|point| point[along]);
        inner.chain(uses.last().map(|last| last.curve.end()[along])).collect()
    };
    let around: Vec<Vec<f64>> = rings.iter().map(|ring| values(&ring.uses)).collect();
    let extent = |uses: &Vec<TrimUse>| {
        let values = values(uses);
        [
            values.iter().copied().fold(f64::INFINITY, f64::min),
            values.into_iter().fold(f64::NEG_INFINITY, f64::max),
        ]
    };
    let holes: Vec<[f64; 2]> = loops.iter().map(extent).collect();
    let is_free = |place: f64| {
        !holes.iter().any(|&hole| is_inside(place, hole, period))
            && around.iter().all(|ring| passes(ring, place, period) <= 1)
    };
    let start = first.uses[0].curve.start()[along];
    let between = if holes.is_empty() { start } else { widest_gap(&holes, period) };
    let spaced = (0..PLACES).map(|place| start + period * (f64::from(place) + 0.5) / f64::from(PLACES));
    let place = [start, between].into_iter().chain(spaced).find(|&place| is_free(place));
    if let Some(place) = place.filter(|&place| place != start) {
        for ring in rings {
            ring.uses = begun_at(std::mem::take(&mut ring.uses), along, place, period)?;
        }
    }
    Ok(())
}

/// Returns how often a polygon around a period passes a place.
fn passes(values: &[f64], place: f64, period: f64) -> u64 {
    let turn = |value: f64| ((value - place) / period).floor();
    values.windows(2).map(|pair| (turn(pair[1]) - turn(pair[0])).abs() as u64).sum()
}

/// Returns the axis along which a ring runs once, and its direction.
fn axis(ring: &Chain) -> Result<(usize, i32), FaceFault> {
    match ring.turns {
        [turn @ (1 | -1), 0] => Ok((0, turn)),
        [0, turn @ (1 | -1)] => Ok((1, turn)),
        turns => Err(FaceFault::new("BREP_RING", format!("a loop turns {turns:?} times around the periods"))),
    }
}

/// Joins two rings along one axis into the loop around the region between them.
fn join([first, second]: [Chain; 2], surface: &Surface) -> Result<Vec<TrimUse>, FaceFault> {
    let ((along, first_turn), (other, second_turn)) = (axis(&first)?, axis(&second)?);
    if along != other || first_turn == second_turn {
        let why = "two loops run around a period in the same direction, expected opposite directions";
        return Err(FaceFault::new("BREP_RING", why));
    }
    let period = surface.closures()[along].unwrap_or_default();
    let across_period = surface.closures()[1 - along];
    // The ring in the positive direction, which has the material above it in v; along v
    // the material is on the left of the negative one, below it in u.
    let (mut forward, mut backward) = if first_turn > 0 { (first, second) } else { (second, first) };
    let start = forward.uses[0].curve.start();
    let start_along = start[along];
    backward.uses = begun_at(backward.uses, along, start_along, period)?;
    // The ring backward begins where the forward one ends.
    let shift = start_along + period - backward.uses[0].curve.start()[along];
    translate(&mut backward, along, shift);
    let across = 1 - along;
    let difference = backward.uses[0].curve.start()[across] - start[across];
    let above = if along == 0 { 1.0 } else { -1.0 };
    match across_period {
        // The material lies on the left: the other ring is the next one on that side.
        Some(length) if above * difference <= 0.0 => translate(&mut backward, across, above * length),
        Some(length) if above * difference > length => translate(&mut backward, across, -above * length),
        // Both rings run the wrong way round.
        None if above * difference < 0.0 => {
            for ring in [&mut forward, &mut backward] {
                ring.uses = reversed(std::mem::take(&mut ring.uses));
            }
            std::mem::swap(&mut forward, &mut backward);
        }
        _ => {}
    }
    Ok(connected(forward.uses, backward.uses))
}

/// Returns the loop of two open chains and the segments between their ends.
fn connected(first: Vec<TrimUse>, second: Vec<TrimUse>) -> Vec<TrimUse> {
    let ends = |uses: &[TrimUse]| [uses[0].curve.start(), uses[uses.len() - 1].curve.end()];
    let ([first_start, first_end], [second_start, second_end]) = (ends(&first), ends(&second));
    let mut joined = first;
    joined.push(TrimUse::segment(first_end, second_start));
    joined.extend(second);
    joined.push(TrimUse::segment(second_end, first_start));
    joined
}

/// Closes a ring around a pole: along the pole, which is one point in space, and back.
fn cap(ring: Chain, surface: &Surface) -> Result<Vec<TrimUse>, FaceFault> {
    let (along, turn) = axis(&ring)?;
    let v = ring.uses[0].curve.start().y;
    let poles = surface.poles();
    // The material is on the left: above a ring in the positive direction.
    let left = poles.iter().copied().find(|&pole| if turn > 0 { pole > v } else { pole < v });
    let (uses, pole) = match (left, poles.first()) {
        _ if along != 0 => return Err(lone_ring(surface)),
        (Some(pole), _) => (ring.uses, pole),
        // The apex is on the other side of the ring: the loop runs the wrong way round.
        (None, Some(&pole)) if poles.len() == 1 => (reversed(ring.uses), pole),
        _ => return Err(lone_ring(surface)),
    };
    let (start, end) = (uses[0].curve.start(), uses[uses.len() - 1].curve.end());
    let along_pole = TrimUse::segment(DVec3::new(end.x, pole, 0.0), DVec3::new(start.x, pole, 0.0));
    Ok(connected(uses, vec![along_pole]))
}

fn lone_ring(surface: &Surface) -> FaceFault {
    let why = format!("one loop runs around the {} and does not bound it", surface.kind());
    FaceFault::new("BREP_RING", why)
}

fn translate(ring: &mut Chain, axis: usize, length: f64) {
    let mut shift = DVec3::ZERO;
    shift[axis] = length;
    for trim_use in &mut ring.uses {
        trim_use.curve = std::mem::replace(&mut trim_use.curve, Spline::segment([0.0, 1.0], shift, shift))
            .translated(shift);
    }
}

/// Returns the curves in the opposite direction.
pub(super) fn reversed(uses: Vec<TrimUse>) -> Vec<TrimUse> {
    let turned = |trim_use: TrimUse| TrimUse {
        vertices: [trim_use.vertices[1], trim_use.vertices[0]],
        curve: trim_use.curve.reversed(),
        ..trim_use
    };
    uses.into_iter().rev().map(turned).collect()
}

/// Returns the curves of a ring begun where it passes `parameter`, up to periods, with
/// the curves before that point moved behind the others.
fn begun_at(
    mut uses: Vec<TrimUse>,
    axis: usize,
    parameter: f64,
    period: f64,
) -> Result<Vec<TrimUse>, FaceFault> {
    let (start, end) = (uses[0].curve.start()[axis], uses[uses.len() - 1].curve.end()[axis]);
    // The value to pass, between both ends.
    let target = parameter + period * ((start.max(end) - parameter) / period).floor();
    let resolution = SAME_PARAMETER * period;
    let turn = end - start;
    let mut at = None;
    for (index, trim_use) in uses.iter().enumerate() {
        let (from, to) = (trim_use.curve.start()[axis], trim_use.curve.end()[axis]);
        if (from - target).abs() <= resolution {
            at = Some((index, None));
            break;
        }
        if (from < target) != (to < target) && (to - target).abs() > resolution {
            at = Some((index, Some(crossing(&trim_use.curve, axis, target))));
            break;
        }
    }
    let Some((index, cut)) = at else {
        // The target is an end of the ring.
        return Ok(uses);
    };
    if let Some(cut) = cut {
        let whole = uses.remove(index);
        let [low, high] = whole.curve.domain();
        let part = |range: [f64; 2]| TrimUse { curve: restricted(&whole.curve, range), ..whole.clone() };
        uses.splice(index..index, [part([low, cut]), part([cut, high])]);
    }
    let begin = if cut.is_some() { index + 1 } else { index };
    let mut rotated = uses.split_off(begin);
    for mut trim_use in uses {
        let mut shift = DVec3::ZERO;
        shift[axis] = turn;
        trim_use.curve = trim_use.curve.translated(shift);
        rotated.push(trim_use);
    }
    Ok(rotated)
}

/// Part of a period below which two parameters are the same.
const SAME_PARAMETER: f64 = 1e-9;

/// Returns the parameter at which a coordinate of a curve passes `target`, by bisection.
pub(in crate::faces) fn crossing(curve: &Spline, axis: usize, target: f64) -> f64 {
    let [mut low, mut high] = curve.domain();
    let rising = curve.start()[axis] < target;
    // 60 halvings exhaust the digits of float64.
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (curve.point(middle)[axis] < target) == rising {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// Returns the part of a clamped curve over a range inside its domain.
fn restricted(curve: &Spline, [start, end]: [f64; 2]) -> Spline {
    let mut knots = vec![start; curve.degree + 1];
    knots.extend(curve.knots.iter().filter(|&&knot| knot > start && knot < end));
    knots.extend(vec![end; curve.degree + 1]);
    curve.with_knots(&knots)
}
