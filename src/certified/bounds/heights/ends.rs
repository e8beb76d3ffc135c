//! Functions of 3.17 that vanish where a surface ends in a plane.
//!
//! The functions g of 3.17 follow B's parameters to second order, so that they bound the overshoot of a cell beyond an
//! end of the surface to third order. An end in a plane, such as a circle of latitude or a meridian, has a better
//! function: the signed distance from the plane, less a multiple of a function that vanishes on the cell. The multiple
//! makes the gradient tangential to the surface. On a cell that lies on B this function is the signed distance from the
//! plane, and those of two surfaces that end in one plane are opposite to each other.

use super::fit::{Fit, ORDERS, POINTS, POINTS_ALONG};
use super::frame::{Frame, Image, Placement};
use super::piece::{Piece, samples_along};
use super::quadric::Quadric;
use crate::axis::Axis;
use crate::rounding::{unit, upper_max};
use glam::DVec3;

/// The part of the threshold by which the end may be off its plane, and by which the function that vanishes on the cell
/// may vary.
const SUFFICIENT_SPREAD: f64 = 1.0 / 64.0;

/// The least part of the plane's function that rises along the surface.
const MIN_RISE: f64 = 0.25;

/// The largest turn of the function relative to that of the parameter.
const MAX_TURN: f64 = 0.25;

impl Frame<'_> {
    /// The placement with functions that vanish at the open ends, where these are in planes; `None` where none is.
    pub(super) fn placement_at_ends(
        &self,
        a: &Piece,
        image: &Image,
        is_open: [[bool; 2]; 2],
        threshold: f64,
    ) -> Option<Placement> {
        let mut functions = self.inverse.map(|row| self.osculating(row));
        let mut surface = None;
        let mut is_found = false;
        for axis in Axis::BOTH {
            let index = axis.index();
            let end = match is_open[index] {
                [true, false] => 0,
                [false, true] => 1,
                _ => continue,
            };
            let Some(plane) = plane_of(image, axis, end, a, threshold) else { continue };
            let surface = surface.get_or_insert_with(|| self.constant_on(a, threshold));
            if let Some(function) = self.along_surface(plane, surface, axis) {
                functions[index] = function;
                is_found = true;
            }
        }
        is_found.then(|| self.placement(a, image, functions))
    }

    /// A function with about the normal for its gradient that is nearly constant on the cell.
    fn constant_on(&self, a: &Piece, threshold: f64) -> Quadric {
        // A cell in the tangent plane has no heights to fit.
        let Some(mut fit) = Fit::new(self.normal, self.tangents[0], &a.samples([POINTS_ALONG; 2])) else {
            return Quadric::of_plane(self.normal);
        };
        for terms in &ORDERS[..2] {
            fit.add(terms, SUFFICIENT_SPREAD * threshold);
        }
        fit.function().quadric
    }

    /// The plane's function less that of the surface, as much of both as follows the parameter.
    fn along_surface(&self, plane: DVec3, surface: &Quadric, axis: Axis) -> Option<Quadric> {
        let row = self.inverse[axis.index()];
        let share = self.normal.dot(plane) / self.normal.dot(surface.linear);
        let linear = plane - share * surface.linear;
        if !(linear.length() >= MIN_RISE) {
            return None;
        }
        let factor = row.dot(linear) / linear.length_squared();
        let function = Quadric { linear: factor * linear, form: surface.form * (-share * factor) };
        ((function.linear - row).length() <= MAX_TURN * row.length()).then_some(function)
    }
}

/// The normal of the plane in which an end of the box lies; for straight ends that of a plane which contains the
/// cell's normal.
fn plane_of(image: &Image, axis: Axis, end: usize, a: &Piece, threshold: f64) -> Option<DVec3> {
    let curves: Vec<Piece> = image.end(axis, end).collect();
    let points = samples_along(&curves, POINTS);
    let (start, last) = (*points.first()?, *points.last()?);
    let chord = unit(last - start);
    let heights = points.iter().map(|point| (*point - start) - chord * chord.dot(*point - start));
    let farthest = heights.fold(DVec3::ZERO, |farthest, height| {
        if height.length_squared() > farthest.length_squared() { height } else { farthest }
    });
    let sufficient = SUFFICIENT_SPREAD * threshold;
    let across = if farthest.length() <= sufficient {
        let [p, q, r, s] = a.corners();
        (s - p).cross(r - q)
    } else {
        farthest
    };
    let normal = unit(chord.cross(across));
    let spread = points.iter().fold(0.0, |spread, point| upper_max(spread, normal.dot(*point - start).abs()));
    (normal != DVec3::ZERO && spread <= sufficient).then_some(normal)
}
