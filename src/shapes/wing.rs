//! A swept, tapered wing.

use super::interpolation::interpolate;
use super::operations::cut_surface;
use super::{Naca4, PlaneCurve, named, positive};
use crate::elementary::tan;
use crate::error::{Error, Result};
use crate::model::{Model, NurbsSurface, SurfaceArrays};
use crate::shown::Shown;
use std::f64::consts::{FRAC_PI_2, PI};

/// Points that the section's cubic spline passes: its largest error is then
/// below 1e-4 of the chord. Odd, so that the leading edge is one of them.
const SECTION_POINTS: usize = 41;

/// What a wing is made from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wing {
    /// The section along the whole span.
    pub section: Naca4,
    /// From tip to tip.
    pub span: f64,
    /// Chord at the middle.
    pub root_chord: f64,
    /// Chord at the tips as a fraction of the root's.
    pub taper: f64,
    /// How far the line of quarter chords is swept back, in radians.
    pub sweep: f64,
}

/// A whole wing, nose towards -x, span along y: its skin, trailing edge, right
/// tip (y > 0) and left tip, with outward normals.
///
/// The skin interpolates [`Naca4::point`] at 41 cosine-spaced points with a
/// cubic spline along u and is ruled along v from tip to root to tip.
///
/// # Errors
/// `OPTION_OUT_OF_RANGE` for a section outside its ranges, unless span, root
/// chord and taper are finite and above 0, and sweep within 90 degrees.
pub fn wing(wing: &Wing) -> Result<Model> {
    wing.section.validate()?;
    let half_span = 0.5 * positive("span", wing.span)?;
    let root = positive("root_chord", wing.root_chord)?;
    let tip = root * positive("taper", wing.taper)?;
    if !(-FRAC_PI_2..=FRAC_PI_2).contains(&wing.sweep) {
        let found = Shown(wing.sweep).to_string();
        return Err(Error::OptionOutOfRange {
            option: "sweep",
            found,
            expected: "an angle within 90 degrees",
        });
    }
    let section = interpolate(SECTION_POINTS, |fraction| wing.section.point(PI * (2.0 * fraction - 1.0)));
    let back = 0.25 * (root - tip) + half_span * tan(wing.sweep);
    let ribs = [(-half_span, tip, back), (0.0, root, 0.0), (half_span, tip, back)];
    let skin = skin(&section, &ribs)?;
    let (right, left) = (rib_cap(&skin, 2, true)?, rib_cap(&skin, 0, false)?);
    named("wing", vec![skin.clone(), trailing_edge(&skin)?, right, left])
}

/// The section scaled to every rib `(y, chord, x)`, ruled between them.
fn skin(section: &PlaneCurve, ribs: &[(f64, f64, f64); 3]) -> Result<NurbsSurface> {
    let place = |&[x, z, w]: &[f64; 3]| ribs.map(|(y, chord, back)| [back + chord * x, y, chord * z, w]);
    NurbsSurface::new(
        0,
        SurfaceArrays {
            degree: [section.degree, 1],
            knots: [section.knots.clone(), vec![0.0, 0.0, 0.5, 1.0, 1.0]],
            counts: [section.control_points.len(), ribs.len()],
            control_points: section.control_points.iter().flat_map(place).collect(),
        },
    )
}

/// The strip between the skin's two edges along the span.
fn trailing_edge(skin: &NurbsSurface) -> Result<NurbsSurface> {
    let ribs = skin.counts()[1];
    let net = skin.control_points();
    let control_points = (0..ribs).flat_map(|rib| [net[rib], net[net.len() - ribs + rib]]).collect();
    NurbsSurface::new(
        0,
        SurfaceArrays {
            degree: [1, 1],
            knots: [skin.knots(1).to_vec(), vec![0.0, 0.0, 1.0, 1.0]],
            counts: [ribs, 2],
            control_points,
        },
    )
}

/// The flat cap of rib `rib`, ruled between the lower and the upper side.
fn rib_cap(skin: &NurbsSurface, rib: usize, downward: bool) -> Result<NurbsSurface> {
    let middle = 0.5 * (skin.domain()[0][0] + skin.domain()[0][1]);
    let [lower, upper] = cut_surface(skin, 0, middle)?;
    let column = |side: &NurbsSurface| -> Vec<[f64; 4]> {
        side.control_points().chunks(side.counts()[1]).map(|row| row[rib]).collect()
    };
    // The knots are symmetric about the leading edge, so the upper side's serve both.
    let (from_nose, upper_points) = (column(&lower).into_iter().rev(), column(&upper));
    let control_points = from_nose
        .zip(upper_points)
        .flat_map(|(low, high)| if downward { [high, low] } else { [low, high] })
        .collect();
    NurbsSurface::new(
        0,
        SurfaceArrays {
            degree: [upper.degree()[0], 1],
            knots: [upper.knots(0).to_vec(), vec![0.0, 0.0, 1.0, 1.0]],
            counts: [upper.counts()[0], 2],
            control_points,
        },
    )
}
