//! Wing sections of the NACA four-digit series.

use crate::error::{Error, Result};

/// A section of the NACA four-digit series, with lengths in fractions of the chord.
///
/// NACA 2412 has camber 0.02 at position 0.4 and thickness 0.12.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Naca4 {
    /// The largest ordinate of the mean line, in [0, 0.1).
    pub camber: f64,
    /// The abscissa of that ordinate, in (0, 1); it has no effect without camber.
    pub position: f64,
    /// The largest thickness, in (0, 1).
    pub thickness: f64,
}

impl Naca4 {
    /// Returns the point of the section at `angle` in [-π, π]: the trailing edge of
    /// the lower side at -π, the leading edge at 0, the trailing edge of the upper
    /// side at π, with abscissa (1 - cos angle)/2 along the chord.
    ///
    /// The formulas are those of Abbott and von Doenhoff, *Theory of Wing Sections* (1959),
    /// chapter 6, with the thickness orthogonal to the mean line. The trailing edge
    /// is blunt, as published: 0.0021 thickness/0.2 of the chord.
    #[must_use]
    pub fn point(&self, angle: f64) -> [f64; 2] {
        let x = 0.5 * (1.0 - angle.cos());
        let polynomial = x * (-0.1260 + x * (-0.3516 + x * (0.2843 - x * 0.1015)));
        // sqrt(x) = |sin(angle/2)|; the sign of the angle selects the side.
        let side = if angle < 0.0 { -1.0 } else { 1.0 };
        let half_thickness = 5.0 * self.thickness * (0.2969 * (0.5 * angle).sin() + side * polynomial);
        let (mean, slope) = self.mean_line(x);
        let cosine = 1.0 / (1.0 + slope * slope).sqrt();
        [x - half_thickness * slope * cosine, mean + half_thickness * cosine]
    }

    /// Returns ordinate and slope of the mean line, two parabolas joined at `position`.
    fn mean_line(&self, x: f64) -> (f64, f64) {
        let Self { camber, position, .. } = *self;
        if camber == 0.0 {
            return (0.0, 0.0);
        }
        if x < position {
            let scale = camber / (position * position);
            (scale * x * (2.0 * position - x), 2.0 * scale * (position - x))
        } else {
            let scale = camber / ((1.0 - position) * (1.0 - position));
            (scale * (1.0 - 2.0 * position + x * (2.0 * position - x)), 2.0 * scale * (position - x))
        }
    }

    /// Returns `OPTION_OUT_OF_RANGE` for a parameter outside its range.
    pub(in crate::shapes) fn validate(&self) -> Result<()> {
        let out_of_range = |option, value: f64, expected| Err(Error::out_of_range(option, value, expected));
        if !(0.0..0.1).contains(&self.camber) {
            return out_of_range("camber", self.camber, "0 or more and below 0.1");
        }
        if !(self.position > 0.0 && self.position < 1.0) {
            return out_of_range("position", self.position, "above 0 and below 1");
        }
        if !(self.thickness > 0.0 && self.thickness < 1.0) {
            return out_of_range("thickness", self.thickness, "above 0 and below 1");
        }
        Ok(())
    }
}
