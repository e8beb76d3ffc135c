//! Loops of unknown direction, directed by area and nesting.

use super::nesting::{others, turn};
use super::winding::Winding;
use super::{TrimCurveArrays, closed_loops};
use crate::error::TrimFault;
use crate::model::NurbsSurface;

/// Returns the loops with material on the left: a loop inside an even number of others
/// turns counterclockwise, and one inside an odd number clockwise. For readers whose
/// source does not state the directions, or states them wrongly.
///
/// # Errors
/// A fault of the curves, of open loops, or a loop without area.
pub fn oriented(
    surface: &NurbsSurface,
    mut loops: Vec<Vec<TrimCurveArrays>>,
) -> Result<Vec<Vec<TrimCurveArrays>>, TrimFault> {
    let closed = closed_loops(surface, &loops)?;
    let winding = Winding::new(&closed.loops, surface.domain());
    for (index, curves) in loops.iter_mut().enumerate() {
        let depth = others(&winding, index, i32::abs).map_or(0, |(_, depth)| depth);
        let expected = if depth % 2 == 0 { 1 } else { -1 };
        if turn(&winding, index)? != expected {
            curves.reverse();
            curves.iter_mut().for_each(TrimCurveArrays::reverse);
        }
    }
    Ok(loops)
}

impl TrimCurveArrays {
    /// Reverses the curve's direction; its knots keep their range.
    pub fn reverse(&mut self) {
        self.control_points.reverse();
        let (Some(&first), Some(&last)) = (self.knots.first(), self.knots.last()) else { return };
        self.knots.reverse();
        for knot in &mut self.knots {
            *knot = if *knot == first {
                last
            } else if *knot == last {
                first
            } else {
                first + (last - *knot)
            };
        }
    }
}
