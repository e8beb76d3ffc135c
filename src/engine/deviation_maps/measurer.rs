//! Who measures the points of maps.

use crate::engine::computation::Running;
use crate::engine::points::closest_points_of;
use crate::engine::{ClosestPointOptions, ClosestPoints, PreparedModel};
use crate::progress::{MaybeSend, Monitor};

/// The points that a map needs next.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MapPoints<'a> {
    /// The model that they are measured from.
    pub(crate) other: &'a PreparedModel,
    /// x, y, z each.
    pub(crate) points: &'a [f64],
    pub(crate) options: &'a ClosestPointOptions,
}

/// Measures the points of maps: this thread and its pool, or workers beside it.
pub(crate) trait Measurer: MaybeSend {
    /// Returns the closest points, those of [`crate::Engine::closest_points`] bit for bit.
    fn measure<'a>(
        &'a mut self,
        asked: MapPoints<'a>,
        monitor: &'a mut dyn Monitor,
    ) -> Running<'a, ClosestPoints>;
}

/// Measures them here.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Here;

impl Measurer for Here {
    fn measure<'a>(
        &'a mut self,
        MapPoints { other, points, options, .. }: MapPoints<'a>,
        monitor: &'a mut dyn Monitor,
    ) -> Running<'a, ClosestPoints> {
        Box::pin(closest_points_of(other, points, options, monitor))
    }
}
