//! The plane across a cylinder of the 2012 paper's Fig. 5, the case with the
//! largest sampling error.
//!
//! I. Hanniel, A. Krishnamurthy and S. McMains (*Computing the Hausdorff distance
//! between NURBS surfaces using numerical iteration on the GPU*, Graphical Models
//! 74 (2012), 255–264) sample a plane across a cylinder of radius 320 with a
//! spacing of 16. The directed distance is 320, attained at the cylinder's axis; a
//! sample at distance r from the axis is only 320 - r from the cylinder. The paper
//! computes 310.42, so its nearest sample was 9.58 from the axis, less than the
//! half diagonal of a cell, 11.31, which is the paper's bound K_A. The position of
//! the axis in the cell is not published; here it is on the cell's diagonal.

use super::{lateral, named, net_surface};
use crate::error::Result;
use crate::model::Model;
use std::f64::consts::FRAC_1_SQRT_2;

/// The radius of [`figure5_cylinder`], which is the true distance.
pub const FIGURE5_RADIUS: f64 = 320.0;

/// The number of samples along each axis of [`figure5_plane`] with a spacing of 16.
pub const FIGURE5_SAMPLES: usize = 41;

/// The distance of the nearest of those samples from the cylinder's axis.
pub const FIGURE5_NEAREST_SAMPLE: f64 = 9.58;

/// The side of the plane: 40 cells of 16. Its corners are 132 outside the cylinder,
/// so that the distance is attained at the axis.
const SIDE: f64 = 640.0;

/// Returns the square of side 640 in the plane z = 0, of degrees 1 × 1, shifted so
/// that the nearest of [`FIGURE5_SAMPLES`] × [`FIGURE5_SAMPLES`] samples to the z
/// axis is [`FIGURE5_NEAREST_SAMPLE`] from it.
///
/// # Errors
/// None: the numbers are valid.
pub fn figure5_plane() -> Result<Model> {
    let low = -0.5 * SIDE + FIGURE5_NEAREST_SAMPLE * FRAC_1_SQRT_2;
    let ends = [low, low + SIDE];
    let knots = [0.0, 0.0, 1.0, 1.0];
    let plane = net_surface([1, 1], [&knots, &knots], [2, 2], &|i, j| [ends[i], ends[j], 0.0, 1.0])?;
    named("Fig. 5 plane", vec![plane])
}

/// Returns the open cylinder of radius [`FIGURE5_RADIUS`] about the z axis, from
/// z = -320 to 320: its lateral surface only.
///
/// # Errors
/// None: the numbers are valid.
pub fn figure5_cylinder() -> Result<Model> {
    named(
        "Fig. 5 cylinder",
        vec![lateral([FIGURE5_RADIUS, FIGURE5_RADIUS], [-FIGURE5_RADIUS, FIGURE5_RADIUS])?],
    )
}
