//! Pictures of deviations, for reports that are printed or sent: each model in the colours of its
//! deviations from the other one, seen from fixed directions and at the worst place; and of clashes.
//!
//! The colours, the legend and the texts are those of the page. Between measured points they are
//! estimates; the farthest point that a search found is one of them, so that the pictures show its
//! distance, and is marked.
//!
//! ```
//! use nurbs_hausdorff::{KnownDeviation, PreparedModel, shapes};
//! use nurbs_hausdorff_pictures::{PictureOptions, pictures};
//!
//! let [a, b] = [shapes::shape("sphere")?, shapes::shape("torus")?].map(|model| PreparedModel::new(&model));
//! let options = PictureOptions { a: Some(KnownDeviation::default()), ..PictureOptions::default() };
//! // The caller compresses: here nothing does.
//! let shown = pictures(&a?, &b?, &options, |bytes| nurbs_hausdorff::Result::Ok(bytes.to_vec()))?;
//! assert_eq!(shown.figures[0].pictures.len(), 2);
//! # nurbs_hausdorff::Result::Ok(())
//! ```

// Prepared models hold types of wgpu, nested deeper than 128.
#![recursion_limit = "256"]

mod camera;
mod clash;
mod draw;
mod legend;
mod mark;
mod models;
mod numbers;
mod png;
mod raster;
mod views;

pub use clash::{Clash, clash_pictures};
pub use models::pictures;
use nurbs_hausdorff::RigidTransform;
pub use nurbs_hausdorff::{FarthestPoint, KnownDeviation};

/// What pictures show of two models.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PictureOptions {
    /// The deviation that is allowed, which has a colour and a tick of its own.
    pub allowed: Option<f64>,
    /// Whether A is shown, in the colours of its deviations from B.
    pub a: Option<KnownDeviation>,
    /// The same of B.
    pub b: Option<KnownDeviation>,
    /// Whether B is scaled to the unit of A where both state different ones; else they are an error.
    pub scale_units: bool,
    /// Moves A before it is measured.
    pub transform: RigidTransform,
}

/// The pictures of a comparison.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Pictures {
    /// The pictures in groups that belong together.
    pub figures: Vec<Figure>,
    /// The legend of the colours of all: an element of SVG.
    pub legend: String,
}

/// Pictures that belong together.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Figure {
    /// What is shown.
    pub caption: String,
    /// The pictures.
    pub pictures: Vec<Picture>,
}

/// A picture.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Picture {
    /// What is seen, for those who do not see it.
    pub alt: String,
    /// Width and height in pixels.
    pub size: [usize; 2],
    /// Where the ring around the worst place is, in pixels from the left and from above, if it is there.
    pub mark: Option<[f64; 2]>,
    /// The file, PNG.
    pub png: Vec<u8>,
}
