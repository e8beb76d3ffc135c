//! Spheres among surfaces of revolution.

use super::axis::RotationAxis;
use crate::bezier::{Patch, length_bounds, relative};
use crate::rounding::upper_max;
use glam::DVec3;

/// A sphere all of whose points lie on a surface, up to `deviation`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sphere {
    pub(crate) center: DVec3,
    pub(crate) radius: f64,
    /// An upper bound on the distance of its points from the surface.
    pub(crate) deviation: f64,
}

impl Sphere {
    /// Returns the sphere that a half circle, the profile of these patches from
    /// `ends[0]` to `ends[1]` on the axis, sweeps in a full turn.
    ///
    /// The profile covers the half circle, as it is continuous up to `deviation`.
    pub(super) fn swept<'a>(
        axis: &RotationAxis,
        ends: [DVec3; 2],
        profile: impl Iterator<Item = Patch<'a>>,
        mut deviation: f64,
    ) -> Self {
        deviation += ends.map(|end| axis.radial(end).length()).into_iter().fold(0.0, upper_max);
        let sphere =
            Self { center: ends[0].midpoint(ends[1]), radius: 0.5 * ends[0].distance(ends[1]), deviation };
        let deviation =
            profile.fold(deviation, |largest, patch| upper_max(largest, sphere.distance_bound(&patch)));
        Self { deviation, ..sphere }
    }

    /// Returns an upper bound on the distance from any point a of the patch to the
    /// surface: the largest `| |a - c| - r |`, with bounds on `|a - c|` from the
    /// controls relative to the centre c, and the deviation. O(p² q²).
    pub(crate) fn distance_bound(&self, patch: &Patch<'_>) -> f64 {
        let [least, largest] =
            length_bounds(patch.degree, &relative(patch.controls, self.center - patch.center));
        upper_max(largest - self.radius, self.radius - least) + self.deviation
    }
}
