//! Pairs of surfaces whose control points lie on a point, on a line, in a plane or in parallel
//! rows, exactly or within rounding: what is computed from their directions may be rounding alone.

use super::attacks::Models;
use super::surfaces::{direction, magnitude, surface, surface_of_degree, weights};
use fastrand::Rng;
use glam::DVec3;
use nurbs_hausdorff::SurfaceArrays;

/// The largest number of surfaces of a model. A false bound on one shows only beside others.
const MAX_SURFACES: usize = 6;

/// The largest degree. The fewer control points, the more often all of them coincide.
const MAX_DEGREE: usize = 3;

/// The number of steps of the grid in a unit.
const STEPS: i32 = 16;

/// The exponents of the powers of two by which nets are scaled that are tiny. The square of 2^-537
/// is the smallest number of float64.
const EXPONENTS: std::ops::RangeInclusive<i32> = -541..=-534;

/// The factor by which A is larger than B in half of the pairs, so that many points of A are beyond
/// the ends of B's surfaces.
const STRETCH: f64 = 4.0;

/// What a pair's surfaces have in common, so that their ends are near each other and a false bound
/// on the nearest of them rules it out.
struct Frame {
    origin: DVec3,
    along: DVec3,
    across: DVec3,
    shape: Shape,
    /// Whether numbers are drawn from a coarse grid.
    on_grid: bool,
    noise: f64,
}

#[derive(Clone, Copy)]
enum Shape {
    Point,
    Line,
    Rows,
    Plane,
}

pub(super) fn collapsed_nets(rng: &mut Rng) -> Models {
    let common = Frame::new(rng);
    let stretch = if rng.bool() { STRETCH } else { 1.0 };
    let [a, b] = [stretch, 1.0].map(|size| {
        let mut model: Vec<_> = (0..rng.usize(1..=MAX_SURFACES))
            .map(|_| match rng.u8(0..8) {
                0 => Frame::new(rng).surface(rng, size),
                1 | 2 => {
                    let size = 2.0_f64.powi(rng.i32(EXPONENTS));
                    common.surface(rng, size)
                }
                _ => common.surface(rng, size),
            })
            .collect();
        if rng.u8(0..8) == 0 {
            let weights = weights(rng);
            model.push(surface(rng, weights));
        }
        model
    });
    Models { a, b, truth: None }
}

impl Frame {
    fn new(rng: &mut Rng) -> Self {
        let on_grid = rng.bool();
        let shapes = [Shape::Point, Shape::Line, Shape::Line, Shape::Line, Shape::Rows, Shape::Plane];
        Self {
            origin: if rng.bool() {
                DVec3::ZERO
            } else {
                DVec3::from_array([0; 3].map(|_| place(rng, on_grid)))
            },
            along: axis(rng),
            across: axis(rng),
            shape: shapes[rng.usize(0..shapes.len())],
            on_grid,
            noise: if rng.u8(0..4) != 0 { 0.0 } else { magnitude(rng, -18.0, -7.0) },
        }
    }

    /// Draws a surface of this size.
    fn surface(&self, rng: &mut Rng, size: f64) -> SurfaceArrays {
        let weights = weights(rng);
        let degree = [0, 1].map(|_| rng.usize(1..=MAX_DEGREE));
        let counts = degree.map(|degree| degree + 1 + rng.usize(0..=1));
        let mut arrays = surface_of_degree(rng, weights, degree, counts);
        let place = |rng: &mut Rng| place(rng, self.on_grid);
        let columns: Vec<f64> = (0..counts[1]).map(|_| place(rng)).collect();
        let mut row = 0.0;
        for (index, point) in arrays.control_points.iter_mut().enumerate() {
            if index % counts[1] == 0 {
                row = place(rng);
            }
            let at = match self.shape {
                Shape::Point => DVec3::ZERO,
                Shape::Line => place(rng) * self.along,
                Shape::Rows => row * self.across + columns[index % counts[1]] * self.along,
                Shape::Plane => place(rng) * self.across + place(rng) * self.along,
            };
            let at = self.origin + size * (at + self.noise * direction(rng));
            point[..3].copy_from_slice(&at.to_array());
        }
        arrays
    }
}

/// Returns a direction, as often as not one whose coordinates are equal or 0: then those of a
/// rounding error are too, and it is parallel to the direction itself.
fn axis(rng: &mut Rng) -> DVec3 {
    if rng.bool() { direction(rng) } else { DVec3::from_array([0; 3].map(|_| f64::from(rng.i32(-1..=1)))) }
}

/// Returns a number between -1 and 1, on a coarse grid or not.
fn place(rng: &mut Rng, on_grid: bool) -> f64 {
    if on_grid { f64::from(rng.i32(-STEPS..=STEPS)) / f64::from(STEPS) } else { 2.0 * rng.f64() - 1.0 }
}
