//! Clouds of points.

use crate::error::{Error, Result};
use crate::limits::is_in_range;
use glam::DVec3;

/// The largest number of points, and of triangles: indices have 32 bits, and trees twice as many nodes.
pub(super) const MAX_FACETS: usize = 1 << 30;

/// A valid list of points: at least one, at most 2^30, all of them finite and at most 1e100 in size.
#[derive(Debug, Clone, PartialEq)]
pub struct PointCloud {
    points: Vec<DVec3>,
}

impl PointCloud {
    /// Makes the cloud of these points. O(n).
    ///
    /// # Errors
    /// [`Error::PointOutOfRange`] for a coordinate that is not finite or above 1e100 in size;
    /// [`Error::NoFacets`] without points; [`Error::TooManyFacets`] for more than 2^30.
    pub fn new(points: Vec<DVec3>) -> Result<Self> {
        validate(&points)?;
        Ok(Self { points })
    }

    /// Returns the points.
    #[must_use]
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }
}

/// Checks the number and the coordinates of points.
///
/// # Errors
/// Those of [`PointCloud::new`].
pub(super) fn validate(points: &[DVec3]) -> Result<()> {
    if points.is_empty() {
        return Err(Error::NoFacets { expected: "points" });
    }
    if points.len() > MAX_FACETS {
        return Err(Error::TooManyFacets { found: points.len(), expected: MAX_FACETS });
    }
    for (index, point) in points.iter().enumerate() {
        if let Some(found) = point.to_array().into_iter().find(|&coordinate| !is_in_range(coordinate)) {
            return Err(Error::PointOutOfRange { index, found });
        }
    }
    Ok(())
}
