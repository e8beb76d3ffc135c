//! NACA wing sections of four digits.

use crate::error::{Error, Result};

/// A section of the NACA four-digit series, in fractions of the chord.
///
/// NACA 2412: camber 0.02 at position 0.4, thickness 0.12.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Naca4 {
    /// Largest ordinate of the mean line, in [0, 0.1).
    pub camber: f64,
    /// Where along the chord it lies, in (0, 1); of no effect without camber.
    pub position: f64,
    /// Largest thickness, in (0, 1).
    pub thickness: f64,
}

impl Naca4 {
    /// The point of the section at `angle` in [-pi, pi]: the lower side's
    /// trailing edge at -pi, the leading edge at 0, the upper side's trailing
    /// edge at pi, with abscissa (1 - cos angle)/2 along the chord.
    ///
    /// Formulas of Abbott and von Doenhoff, *Theory of Wing Sections* (1959),
    /// chapter 6, thickness laid off at right angles to the mean line. The
    /// trailing edge is blunt, as published: 0.0021 thickness/0.2 of the chord.
    #[must_use]
    pub fn point(&self, angle: f64) -> [f64; 2] {
        let x = 0.5 * (1.0 - angle.cos());
        let polynomial = x * (-0.1260 + x * (-0.3516 + x * (0.2843 - x * 0.1015)));
        // sqrt(x) = |sin(angle/2)|; the sign of the angle is the side.
        let side = if angle < 0.0 { -1.0 } else { 1.0 };
        let half_thickness = 5.0 * self.thickness * (0.2969 * (0.5 * angle).sin() + side * polynomial);
        let (mean, slope) = self.mean_line(x);
        let cosine = 1.0 / (1.0 + slope * slope).sqrt();
        [x - half_thickness * slope * cosine, mean + half_thickness * cosine]
    }

    /// Ordinate and slope of the mean line: two parabolas that meet at `position`.
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

    /// Refuses what the formulas are not for.
    pub(super) fn validate(&self) -> Result<()> {
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
