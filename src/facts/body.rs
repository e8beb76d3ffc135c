//! What is known of a body, or of a model.

use super::{AboutCentroid, Mass, Matrix};
use crate::interval::Interval;
use serde::Serialize;

/// How the faces of a body are oriented in its source: by their normals, or the order of corners.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub enum Orientation {
    /// Out of the body; of a sheet, all to one side.
    Consistent,
    /// Into the body, all of them.
    InsideOut,
    /// Some against others: sides that agree were found for them. Stated of meshes and of untrimmed faces alone.
    Mixed,
    /// There are no sides that agree, as on a strip of Möbius.
    NotOrientable,
    /// Not known: all are to one side, but the volume is too small to tell which, or some pieces of trimmed faces
    /// are against others, which slivers are also where they join the wrong way round.
    Undecided,
}

/// Why a volume is not known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub enum VolumeUnknown {
    /// Edges of faces have no partner.
    Open,
    /// There are no sides of the faces that agree.
    NotOrientable,
    /// It is not known which of its shells are voids.
    Nesting,
    /// Points have no volume.
    Points,
}

/// Facts of a body or of a model, each in an interval that contains it, in model units and at density 1.
///
/// They are those of the patches that are measured: the trimmed faces are within `deviation` of these. The
/// extents hold for the faces themselves.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct Facts {
    /// The volume: of a model, the sum over its bodies, whether or not these overlap.
    pub volume: Option<Interval>,
    /// Why there is no volume.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub volume_unknown: Option<VolumeUnknown>,
    /// About the volume of the layer between the faces and their source: the gap and the deviation times the
    /// area. It is an estimate, and no part of the interval of the volume.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub volume_of_gap: Option<f64>,
    /// The area of all faces; none of points.
    pub area: Option<Interval>,
    /// The lengths along x, y and z.
    pub extents: [Interval; 3],
    /// The least coordinates along x, y and z.
    pub min: [Interval; 3],
    /// The largest coordinates along x, y and z.
    pub max: [Interval; 3],
    /// The centroid of the volume.
    pub centroid: Option<[Interval; 3]>,
    /// The tensor of inertia about the centroid.
    pub inertia: Option<Matrix>,
    /// The moments about the principal axes, ascending.
    pub principal_moments: Option<[Interval; 3]>,
    /// Unit vectors along the principal axes.
    pub principal_axes: Option<[[f64; 3]; 3]>,
    /// Upper bounds on the angles, in radians, between these and the principal axes; π / 2 where the moments are
    /// not told apart.
    pub principal_angles: Option<[f64; 3]>,
    /// The lengths along `principal_axes`.
    pub principal_extents: Option<[Interval; 3]>,
}

impl Facts {
    /// Makes the facts of a set of points within these coordinates, without a volume.
    pub(crate) fn within(min: [Interval; 3], max: [Interval; 3], why: VolumeUnknown) -> Self {
        Self {
            volume: None,
            volume_unknown: Some(why),
            volume_of_gap: None,
            area: None,
            extents: [0, 1, 2].map(|axis| (max[axis] - min[axis]).not_negative()),
            min,
            max,
            centroid: None,
            inertia: None,
            principal_moments: None,
            principal_axes: None,
            principal_angles: None,
            principal_extents: None,
        }
    }

    /// Returns the facts with those of a mass; `extent` returns the length along a direction.
    pub(crate) fn with_mass(self, mass: Mass, extent: impl Fn(glam::DVec3) -> Interval) -> Self {
        let facts = Self { volume: Some(mass.volume.not_negative()), volume_unknown: None, ..self };
        let Some(AboutCentroid { centroid, inertia, principal }) = mass.about else { return facts };
        Self {
            centroid: Some(centroid),
            inertia: Some(inertia),
            principal_moments: Some(principal.moments.map(Interval::not_negative)),
            principal_axes: Some(principal.axes.map(|axis| axis.to_array())),
            principal_angles: Some(principal.angles),
            principal_extents: Some(principal.axes.map(|axis| extent(axis).not_negative())),
            ..facts
        }
    }
}

impl Facts {
    /// Returns the facts in another unit, of which `factor` is the number in one unit of these.
    #[must_use]
    pub fn scaled(&self, factor: Interval) -> Self {
        let square = factor * factor;
        let (cube, fifth) = (square * factor, square * factor * square);
        let lengths = |of: [Interval; 3]| of.map(|one| one * factor);
        Self {
            volume: self.volume.map(|volume| volume * cube),
            volume_unknown: self.volume_unknown,
            volume_of_gap: self.volume_of_gap.map(|volume| volume * cube.upper),
            area: self.area.map(|area| area * square),
            extents: lengths(self.extents),
            min: lengths(self.min),
            max: lengths(self.max),
            centroid: self.centroid.map(lengths),
            inertia: self.inertia.map(|rows| rows.map(|row| row.map(|entry| entry * fifth))),
            principal_moments: self.principal_moments.map(|moments| moments.map(|moment| moment * fifth)),
            principal_axes: self.principal_axes,
            principal_angles: self.principal_angles,
            principal_extents: self.principal_extents.map(lengths),
        }
    }
}
