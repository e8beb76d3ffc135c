//! Spheres.

use super::line::Line;
use crate::bezier::{Patch, lengths};
use glam::{DVec3, DVec4, Vec4Swizzles};

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
        let (center, radius) = (ends[0].midpoint(ends[1]), 0.5 * ends[0].distance(ends[1]));
        off += axis.way_to(ends[0]).length().max(axis.way_to(ends[1]).length());
        let mut apart = 0.0_f64;
        for patch in profile {
            let [least, largest] = lengths(&controls_from(center, &patch), patch.degree);
            apart = apart.max(largest - radius).max(radius - least);
        }
        Self { center, radius, off: off + apart }
    }
}

/// The patch's controls relative to another point.
fn controls_from(point: DVec3, patch: &Patch<'_>) -> Vec<DVec4> {
    let shift = patch.center - point;
    let mut controls = patch.controls.to_vec();
    for control in &mut controls {
        *control = (control.xyz() + control.w * shift).extend(control.w);
    }
    controls
}
