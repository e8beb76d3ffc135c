//! The nesting of loops: material on the left of each, once.

use super::winding::Winding;
use crate::error::TrimFault;
use glam::DVec2;

/// The smallest mean width of a loop, twice its area over its length, in fractions of the
/// domain: 45 units in the last place of a coordinate, whose rounding gives a curve and its
/// reverse a width of a few.
const MIN_WIDTH: f64 = 1e-14;

/// The largest number of points of a loop at which the other loops are counted.
const MAX_POINTS: usize = 4;

/// Checks that every loop encloses area and that the winding numbers on its two sides
/// are 1 on the left and 0 on the right.
///
/// For loops that cross neither themselves nor each other this makes the sum of
/// winding numbers 0 or 1 everywhere: every region of the plane has a loop on its
/// boundary, or is the outer one. O(loops pieces).
pub(super) fn validate(winding: &Winding) -> Result<(), TrimFault> {
    for loop_index in 0..winding.loops() {
        let turn = turn(winding, loop_index)?;
        let Some((at, others)) = others(winding, loop_index, |number| number) else { continue };
        let (inside, outside) = (others + turn, others);
        if let Some(found) = [inside, outside].into_iter().find(|number| !(0..=1).contains(number)) {
            let turn = if turn > 0 { "counterclockwise" } else { "clockwise" };
            return Err(TrimFault::WrongNesting { loop_index, at, found, turn, others });
        }
    }
    region(winding)
}

/// Checks that the loops together enclose area, which those that cancel each other do not.
fn region(winding: &Winding) -> Result<(), TrimFault> {
    let sum =
        |of: fn(&Winding, usize) -> f64| -> f64 { (0..winding.loops()).map(|one| of(winding, one)).sum() };
    let found = 2.0 * sum(Winding::signed_area) / sum(Winding::length);
    if found >= MIN_WIDTH {
        return Ok(());
    }
    Err(TrimFault::RegionNoArea { found: if found.is_nan() { 0.0 } else { found }, expected: MIN_WIDTH })
}

/// Returns 1 for a loop that turns counterclockwise, else -1.
///
/// # Errors
/// [`TrimFault::LoopNoArea`].
pub(super) fn turn(winding: &Winding, loop_index: usize) -> Result<i32, TrimFault> {
    let (area, length) = (winding.signed_area(loop_index), winding.length(loop_index));
    let found = 2.0 * area.abs() / length;
    if found >= MIN_WIDTH {
        return Ok(if area > 0.0 { 1 } else { -1 });
    }
    Err(TrimFault::LoopNoArea {
        loop_index,
        found: if found.is_nan() { 0.0 } else { found },
        expected: MIN_WIDTH,
    })
}

/// Returns a point of a loop, with the sum over the other loops of a function of their
/// winding numbers around it: the most frequent one of a few points, as a loop may
/// touch others. `None` if all points tried are on other loops.
pub(super) fn others(
    winding: &Winding,
    loop_index: usize,
    count: impl Fn(i32) -> i32,
) -> Option<([f64; 2], i32)> {
    let pieces: Vec<_> = winding.scaled_pieces(loop_index).collect();
    let step = pieces.len().div_ceil(MAX_POINTS).max(1);
    let sums: Vec<([f64; 2], i32)> = pieces
        .iter()
        .step_by(step)
        .flat_map(|piece| [piece.halves()[0].end(), piece.start()])
        .filter_map(|point: DVec2| {
            let at = winding.parameters(point);
            let others = (0..winding.loops()).filter(|&other| other != loop_index);
            let sum: Option<i32> = others.map(|other| winding.of_loop(other, at).map(&count)).sum();
            sum.map(|sum| (at, sum))
        })
        .collect();
    let frequency = |sum: i32| sums.iter().filter(|(_, other)| *other == sum).count();
    sums.iter().copied().max_by_key(|&(_, sum)| frequency(sum))
}
