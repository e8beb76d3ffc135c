//! The parts in which two assemblies differ: what moved, what changed, what was added or removed.

mod motions;
mod pairing;
mod part;
mod surface;
mod words;

use crate::model::RigidTransform;
use glam::DVec3;
use serde::Serialize;

/// What became of a part from A to B.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub enum PartState {
    /// Its Hausdorff distance in place is certainly at most the limit.
    Same,
    /// As [`Self::Same`], under another name.
    Renamed,
    /// Its Hausdorff distance is certainly at most the limit after its motion.
    Moved,
    /// Its Hausdorff distance is certainly at most the limit after the change of the sign of every x and its motion,
    /// and no motion alone was found that does the same.
    Mirrored,
    /// Faces certainly differ in place by more than the limit.
    Changed,
    /// Faces certainly differ by more than the limit after its motion, which lays at least half of them on B to
    /// the limit.
    MovedAndChanged,
    /// No part of A was paired with it.
    Added,
    /// No part of B was paired with it.
    Removed,
    /// Whether it changed by more than the limit is not decided.
    Undecided,
}

/// Why parts were not compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum PartsUnknown {
    /// The budget of seconds was spent before.
    Budget,
    /// A model has more than 2,000 bodies.
    TooMany,
}

/// A motion in the terms of `--rotate` and `--translate`: a turn about an axis through the origin, then a move.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct PartMotion {
    /// The move after the turn.
    pub translation: [f64; 3],
    /// The direction of the axis, of length 1; that of z where nothing is turned.
    pub axis: [f64; 3],
    /// The angle in degrees, 0 to 180.
    pub angle: f64,
    /// The displacement of the centre of the part's box.
    pub shift: [f64; 3],
}

impl PartMotion {
    /// Makes a motion from `before`, the middle of what it moves. The shift is measured from `middle`, that of the part. The
    /// two differ if the motion moves the mirror image of the part.
    fn new(motion: &RigidTransform, [middle, before]: [DVec3; 2]) -> Self {
        let (axis, angle) = motion.rotation().to_axis_angle();
        let is_long = angle > std::f64::consts::PI;
        let (axis, angle) = if is_long { (-axis, std::f64::consts::TAU - angle) } else { (axis, angle) };
        let axis = if angle == 0.0 { DVec3::Z } else { axis };
        Self {
            translation: motion.offset().to_array(),
            axis: axis.to_array(),
            angle: angle.to_degrees(),
            shift: (motion.apply(before) - middle).to_array(),
        }
    }
}

/// The faces of a changed part that certainly differ by more than the limit, by their indices in the models.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct PartFaces {
    /// Those of A.
    pub of_a: Vec<usize>,
    /// Those of B.
    pub of_b: Vec<usize>,
}

/// A part of A, of B or of both.
///
/// Guarantee: as [`PartState`] states; the Hausdorff distance after its motion is in `[lower, upper]`.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct PartDifference {
    /// Its name in A: the names of its levels, joined as those of a face are; `body 1` by its number without one.
    pub name_of_a: Option<String>,
    /// Its name in B.
    pub name_of_b: Option<String>,
    /// What became of it.
    pub state: PartState,
    /// The motion, of parts that moved or are mirrored, after that of the options.
    pub motion: Option<PartMotion>,
    /// A lower bound on the distance; none of parts that are in one model only.
    pub lower: Option<f64>,
    /// An upper bound on the distance.
    pub upper: Option<f64>,
    /// The faces that changed.
    pub faces: PartFaces,
}
