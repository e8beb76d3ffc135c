//! Spheres.

use super::axis::Line;
use crate::bezier::{Patch, length_bounds, relative};
use glam::DVec3;

/// A sphere that lies on a surface whole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sphere {
    pub(crate) center: DVec3,
    pub(crate) radius: f64,
    /// At least how far its points are from the surface.
    pub(crate) off: f64,
}

impl Sphere {
    /// The sphere that a half circle of these patches, from `ends[0]` to
    /// `ends[1]` on the axis, sweeps in a full turn: the half circle is
    /// covered, as the profile is continuous up to `off`.
    pub(super) fn swept<'a>(
        axis: &Line,
        ends: [DVec3; 2],
        profile: impl Iterator<Item = Patch<'a>>,
        mut off: f64,
    ) -> Self {
        off += axis.way_to(ends[0]).length().max(axis.way_to(ends[1]).length());
        let sphere = Self { center: ends[0].midpoint(ends[1]), radius: 0.5 * ends[0].distance(ends[1]), off };
        Self { off: profile.fold(off, |apart, patch| apart.max(sphere.farthest(&patch))), ..sphere }
    }

    /// At least the distance of every point of the patch to the surface:
    /// `| |a - c| - r |`, with `|a - c|` between the lengths that the controls
    /// relative to the centre allow. O(p^2 q^2).
    pub(crate) fn farthest(&self, patch: &Patch<'_>) -> f64 {
        let [least, largest] =
            length_bounds(patch.degree, &relative(patch.controls, self.center - patch.center));
        (largest - self.radius).max(self.radius - least) + self.off
    }
}
