//! Wavy B-spline sheets with control nets of any size.

use crate::error::{Error, Result};
use crate::model::Model;
use crate::refine::net_surface;
use crate::shapes::curves::clamped_knots;
use crate::shapes::{named, positive};
use std::f64::consts::TAU;

/// The degree of a sheet along both axes.
const DEGREE: usize = 3;

/// The parameters of a wavy sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WavySheet {
    /// The numbers of control points along x and y, at least 4 each.
    pub counts: [usize; 2],
    /// The lengths along x and y.
    pub size: [f64; 2],
    /// The height of the control net's waves.
    pub amplitude: f64,
    /// The numbers of waves along x and y.
    pub waves: [f64; 2],
    /// The phase of the waves along x, in radians.
    pub phase: f64,
}

/// The side of a sheet from [`WavySheet::of_counts`], the size of most shapes.
const SIDE: f64 = 5.0;

/// The number of control points per wave, enough for it to be smooth.
const POINTS_PER_WAVE: f64 = 5.0;

/// The largest number of waves along a side, few enough to be seen.
const MAX_WAVES: f64 = 4.0;

impl WavySheet {
    /// Returns a square sheet of side 5 with as many waves as `counts` control
    /// points represent smoothly, at most 4 along a side. `variant` changes the
    /// waves, so that sheets of different variants differ whatever their counts.
    #[must_use]
    pub fn of_counts(counts: [usize; 2], variant: u8) -> Self {
        let variant = f64::from(variant);
        let stretch = 1.0 + 0.3 * variant;
        let waves = counts.map(|count| (count as f64 / POINTS_PER_WAVE).min(MAX_WAVES) / stretch);
        let amplitude = SIDE / (8.0 * waves[0].max(waves[1]));
        Self { counts, size: [SIDE; 2], amplitude, waves, phase: 0.7 * variant }
    }
}

/// Returns the bicubic B-spline sheet about the origin whose control points are
/// evenly spaced over the (x, y) rectangle, with heights
/// `amplitude sin(2π waves_x i/(nx-1) + phase) cos(2π waves_y j/(ny-1))`.
///
/// # Errors
/// `OPTION_OUT_OF_RANGE` unless the sizes are finite and above 0 and amplitude,
/// waves and phase are finite; `TOO_FEW_CONTROL_POINTS` below 4 along x or y.
pub fn wavy_sheet(sheet: &WavySheet) -> Result<Model> {
    let WavySheet { counts, size, amplitude, waves, phase } = *sheet;
    positive("size", size[0])?;
    positive("size", size[1])?;
    for (option, value) in
        [("amplitude", amplitude), ("waves", waves[0]), ("waves", waves[1]), ("phase", phase)]
    {
        if !value.is_finite() {
            return Err(Error::out_of_range(option, value, "a finite number"));
        }
    }
    let fraction = |index: usize, axis: usize| index as f64 / (counts[axis].max(2) - 1) as f64;
    let [along_x, along_y] = counts.map(|count| clamped_knots(DEGREE, count));
    let sheet = net_surface([DEGREE; 2], [&along_x, &along_y], counts, &|i, j| {
        let (x, y) = (fraction(i, 0), fraction(j, 1));
        let height = amplitude * (TAU * waves[0] * x + phase).sin() * (TAU * waves[1] * y).cos();
        [size[0] * (x - 0.5), size[1] * (y - 0.5), height, 1.0]
    })?;
    named("wavy sheet", vec![sheet])
}

/// Returns a sheet of 1 by 2 that is a single bicubic patch, for tests.
#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
pub(crate) fn bicubic_patch() -> Model {
    let sheet = WavySheet { counts: [4, 4], size: [1.0, 2.0], amplitude: 0.5, waves: [0.5, 0.5], phase: 0.1 };
    wavy_sheet(&sheet).unwrap()
}
