//! Knot insertion.

use super::control_net::map_lines;
use crate::axis::Axis;
use crate::error::{Error, Result};
use crate::model::NurbsSurface;
use glam::DVec4;

/// Returns the same surface with `knot` inserted `times` times along `axis`.
///
/// Boehm's algorithm (Piegl and Tiller, *The NURBS Book*, section 5.2) uses convex
/// combinations only, so points and parameters are unchanged up to rounding. It
/// applies to clamped and unclamped knots. O(times × control points).
///
/// # Errors
/// `OPTION_OUT_OF_RANGE` if `knot` is outside the domain, or if its multiplicity
/// would exceed the degree.
pub fn insert_knot(surface: &NurbsSurface, axis: Axis, knot: f64, times: usize) -> Result<NurbsSurface> {
    let [start, end] = surface.domain()[axis];
    if !(start..=end).contains(&knot) {
        return Err(Error::out_of_range("knot", knot, "a parameter in the domain"));
    }
    let degree = surface.degree()[axis];
    let knots = surface.knots(axis);
    let multiplicity = knots.iter().filter(|&&other| other == knot).count();
    if times > degree.saturating_sub(multiplicity) {
        let expected = "at most the degree less the knot's multiplicity";
        return Err(Error::out_of_range("times", times as f64, expected));
    }
    if times == 0 {
        return Ok(surface.clone());
    }
    let after = knots.partition_point(|&other| other <= knot);
    let mut refined = knots.to_vec();
    refined.splice(after..after, std::iter::repeat_n(knot, times));
    map_lines(surface, axis, degree, &refined, &|line| {
        let mut knots = knots.to_vec();
        let mut line = line.to_vec();
        for inserted in 0..times {
            line = insert_once(&knots, degree, knot, multiplicity + inserted, &line);
            knots.insert(after, knot);
        }
        line
    })
}

/// Returns a line of control points after one insertion.
fn insert_once(knots: &[f64], degree: usize, knot: f64, multiplicity: usize, line: &[DVec4]) -> Vec<DVec4> {
    let span = knots.partition_point(|&other| other <= knot) - 1;
    (0..=line.len())
        .map(|index| {
            if index + degree <= span {
                line[index]
            } else if index + multiplicity > span {
                line[index - 1]
            } else {
                let (low, high) = (knots[index], knots[index + degree]);
                let fraction = (knot - low) / (high - low);
                (1.0 - fraction) * line[index - 1] + fraction * line[index]
            }
        })
        .collect()
}
