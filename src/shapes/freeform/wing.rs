//! Swept, tapered wings.

use crate::axis::Axis;
use crate::error::{Error, Result};
use crate::model::{Model, NurbsSurface};
use crate::refine::net_surface;
use crate::shapes::curves::interpolate;
use crate::shapes::operations::cut_surface;
use crate::shapes::{Naca4, PlaneCurve, named, positive};
use std::f64::consts::{FRAC_PI_2, PI};

/// The number of points that the section's cubic spline interpolates: its error is
/// then below 1e-4 of the chord. It is odd, so that the leading edge is a point.
const SECTION_POINTS: usize = 41;

/// The knots of a ruled surface between two lines.
const RULED: [f64; 4] = [0.0, 0.0, 1.0, 1.0];

/// The parameters of a wing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wing {
    /// The section along the whole span.
    pub section: Naca4,
    /// The distance from tip to tip.
    pub span: f64,
    /// The chord at the middle.
    pub root_chord: f64,
    /// The chord at the tips as a fraction of the root's.
    pub taper: f64,
    /// The sweep angle of the quarter-chord line, in radians.
    pub sweep: f64,
}

/// Returns a whole wing, nose towards -x, span along y: its skin, trailing edge, right
/// tip (y > 0) and left tip, with outward normals.
///
/// The skin interpolates [`Naca4::point`] at 41 cosine-spaced points by a cubic
/// spline along u, and is ruled along v from tip to root to tip.
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
        return Err(Error::out_of_range("sweep", wing.sweep, "an angle within 90 degrees"));
    }
    let section = interpolate(SECTION_POINTS, |fraction| wing.section.point(PI * (2.0 * fraction - 1.0)));
    let back = 0.25 * (root - tip) + half_span * wing.sweep.tan();
    let ribs = [(-half_span, tip, back), (0.0, root, 0.0), (half_span, tip, back)];
    let skin = skin(&section, &ribs)?;
    let (right, left) = (rib_cap(&skin, 2, true)?, rib_cap(&skin, 0, false)?);
    named("wing", vec![skin.clone(), trailing_edge(&skin)?, right, left])
}

/// Returns the section scaled to every rib `(y, chord, x)`, ruled between them.
fn skin(section: &PlaneCurve, ribs: &[(f64, f64, f64); 3]) -> Result<NurbsSurface> {
    let counts = [section.control_points.len(), ribs.len()];
    net_surface([section.degree, 1], [&section.knots, &[0.0, 0.0, 0.5, 1.0, 1.0]], counts, &|i, j| {
        let ([x, z, w], (y, chord, back)) = (section.control_points[i], ribs[j]);
        [back + chord * x, y, chord * z, w]
    })
}

/// Returns the strip between the skin's two edges along the span.
fn trailing_edge(skin: &NurbsSurface) -> Result<NurbsSurface> {
    let ribs = skin.counts()[1];
    let net = skin.control_points();
    let edges = [0, net.len() - ribs];
    net_surface([1, 1], [skin.knots(Axis::V), &RULED], [ribs, 2], &|rib, edge| net[edges[edge] + rib])
}

/// Returns the flat cap of rib `rib`, ruled between the lower and the upper side.
fn rib_cap(skin: &NurbsSurface, rib: usize, downward: bool) -> Result<NurbsSurface> {
    let middle = skin.domain().middle()[Axis::U];
    let [lower, upper] = cut_surface(skin, Axis::U, middle)?;
    let [rows, columns] = upper.counts();
    // The knots are symmetric about the leading edge, so the upper side's serve both.
    net_surface([upper.degree()[0], 1], [upper.knots(Axis::U), &RULED], [rows, 2], &|i, j| {
        let (side, row) = if (j == 0) == downward { (&upper, i) } else { (&lower, rows - 1 - i) };
        side.control_points()[row * columns + rib]
    })
}
