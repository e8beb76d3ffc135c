//! The catalogue of named shapes.

use super::{
    Naca4, WavySheet, Wing, bottle, cone, cylinder, figure5_cylinder, figure5_plane, glass, sphere, torus,
    wavy_sheet, wigley_hull, wing,
};
use crate::error::{Error, Result};
use crate::model::Model;
use glam::DVec3;
use serde::Serialize;

/// A shape's name and title.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct ShapeInfo {
    /// The name that [`shape`] takes.
    pub name: &'static str,
    /// The title shown to users.
    pub title: &'static str,
}

type Make = fn() -> Result<Model>;

/// All shapes. Their sizes are near 5, so that any two can be seen together, except
/// for the small sphere, which fits into others, and Fig. 5 in its published size.
const CATALOGUE: [(&str, &str, Make); 21] = [
    ("sphere", "Sphere, radius 2", || centered(2.0)),
    ("sphere-larger", "Sphere, radius 2.2", || centered(2.2)),
    ("torus", "Torus, tube 0.8", || torus(2.0, 0.8)),
    ("torus-fatter", "Torus, tube 0.9", || torus(2.0, 0.9)),
    ("cylinder", "Cylinder", || cylinder(1.5, 4.0)),
    ("cone", "Cone", || cone(1.8, 4.0)),
    ("glass", "Wine glass", || glass(5.0)),
    ("bottle", "Bottle", || bottle(6.0)),
    ("naca-wing", "Wing, NACA 2412", || wing(&WING)),
    ("naca-wing-thicker", "Wing, NACA 2415", || {
        wing(&Wing { section: Naca4 { thickness: 0.15, ..WING.section }, ..WING })
    }),
    ("wigley-hull", "Wigley hull", || wigley_hull(8.0, 0.8, 0.5)),
    ("wigley-hull-wider", "Wigley hull, wider", || wigley_hull(8.0, 1.2, 0.5)),
    ("wavy-sheet", "Wavy sheet, 14 x 13 control points", || wavy_sheet(&SHEET)),
    ("wavy-sheet-b", "Wavy sheet, other waves", || {
        wavy_sheet(&WavySheet { counts: [13, 14], waves: [1.5, 2.0], phase: 0.8, amplitude: 0.6, ..SHEET })
    }),
    ("net-6x6", "Net of 6 x 6", || net([6, 6], 0)),
    ("net-6x6-b", "Net of 6 x 6, other waves", || net([6, 6], 1)),
    ("net-298x313", "Net of 298 x 313", || net([298, 313], 0)),
    ("net-595x97", "Net of 595 x 97", || net([595, 97], 1)),
    ("sphere-small", "Sphere, radius 0.2", || centered(0.2)),
    ("fig5-plane", "Plane of the 2012 paper's Fig. 5", figure5_plane),
    ("fig5-cylinder", "Cylinder of the 2012 paper's Fig. 5", figure5_cylinder),
];

/// The wing of the catalogue, with section NACA 2412.
const WING: Wing = Wing {
    section: Naca4 { camber: 0.02, position: 0.4, thickness: 0.12 },
    span: 8.0,
    root_chord: 2.0,
    taper: 0.5,
    sweep: 0.35,
};

/// The first wavy sheet of the catalogue.
const SHEET: WavySheet =
    WavySheet { counts: [14, 13], size: [5.0, 5.0], amplitude: 0.8, waves: [2.0, 1.5], phase: 0.0 };

/// Returns a sphere about the origin.
fn centered(radius: f64) -> Result<Model> {
    sphere(DVec3::ZERO, radius)
}

/// Returns a sheet whose net is of a size in the 2012 paper's Table 1.
fn net(counts: [usize; 2], variant: u8) -> Result<Model> {
    wavy_sheet(&WavySheet::of_counts(counts, variant))
}

/// Iterates over the names that [`shape`] takes, with their titles.
pub fn list() -> impl Iterator<Item = ShapeInfo> {
    CATALOGUE.iter().map(|&(name, title, _)| ShapeInfo { name, title })
}

/// Returns the shape of this name, one of [`list`].
///
/// # Errors
/// `UNKNOWN_SHAPE`, with the names in the catalogue.
///
/// ```
/// let torus = nurbs_hausdorff::shapes::shape("torus")?;
/// assert_eq!(torus.surfaces().len(), 1);
/// # Ok::<(), nurbs_hausdorff::Error>(())
/// ```
pub fn shape(name: &str) -> Result<Model> {
    let Some((_, _, make)) = CATALOGUE.iter().find(|(known, ..)| *known == name) else {
        let mut expected = String::new();
        for (known, ..) in CATALOGUE {
            expected.push_str(if expected.is_empty() { "" } else { ", " });
            expected.push_str(known);
        }
        return Err(Error::UnknownShape { found: name.to_owned(), expected });
    };
    make()
}
