//! The Wigley hull, a standard test hull of naval architecture.

use crate::error::Result;
use crate::model::Model;
use crate::refine::net_surface;
use crate::shapes::{named, positive};

/// The Bézier knots of degrees 1 and 2.
const LINEAR: [f64; 4] = [0.0, 0.0, 1.0, 1.0];
const QUADRATIC: [f64; 6] = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0];

/// The Bernstein coefficients of `1 - (2x/L)²` from stern to bow, x = L (s - 1/2).
const WATERLINE: [f64; 3] = [0.0, 2.0, 0.0];
/// The Bernstein coefficients of `1 - (z/T)²` from keel to deck, z = T (t - 1).
const FRAME: [f64; 3] = [0.0, 1.0, 1.0];

/// Returns the Wigley hull `y = ±(beam/2) (1 - (2x/length)²) (1 - (z/draft)²)`,
/// `-draft <= z <= 0` (Wigley 1942): port side, starboard side, and the flat
/// deck at z = 0, with outward normals.
///
/// It is exact: the formula is polynomial, so each side is one biquadratic Bézier patch.
///
/// # Errors
/// `OPTION_OUT_OF_RANGE` unless the sizes are finite and above 0.
pub fn wigley_hull(length: f64, beam: f64, draft: f64) -> Result<Model> {
    let half_beam = 0.5 * positive("beam", beam)?;
    let draft = positive("draft", draft)?;
    let half_length = 0.5 * positive("length", length)?;
    let station = [-half_length, 0.0, half_length];
    let height = [-draft, -0.5 * draft, 0.0];
    // Reversing v flips the normal of the other side outwards.
    let side = |sign: f64, rows: [usize; 3]| {
        net_surface([2, 2], [&QUADRATIC, &QUADRATIC], [3, 3], &|i, j| {
            let frame = FRAME[rows[j]];
            [station[i], sign * half_beam * WATERLINE[i] * frame, height[rows[j]], 1.0]
        })
    };
    let deck = net_surface([2, 1], [&QUADRATIC, &LINEAR], [3, 2], &|i, j| {
        [station[i], [-half_beam, half_beam][j] * WATERLINE[i], 0.0, 1.0]
    })?;
    named("Wigley hull", vec![side(1.0, [2, 1, 0])?, side(-1.0, [0, 1, 2])?, deck])
}
