//! A grid of points.

use crate::bvh::Aabb;
use crate::error::{Error, Result};
use crate::limits::is_in_range;
use crate::rounding::{gamma, upper_max};
use crate::tolerance::positive;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// The number of spacings along the longest side of the model's box where no spacing is given.
const DEFAULT_RESOLUTION: u32 = 64;

/// The largest number of spacings along the box: a cubic grid of more has too many points.
const MAX_RESOLUTION: u32 = 1024;

/// The largest number of points: as float64 they take 4 GiB, more than a module of WebAssembly has.
const MAX_POINTS: usize = 1 << 29;

/// The number of spacings about the model's box where no origin is given: points outside on all sides, and
/// a difference of two points beyond the last one within.
const MARGIN: f64 = 2.0;

/// The roundings of a coordinate of a point of a grid: the product with the index, and the sum.
const COORDINATE_ROUNDINGS: f64 = 2.0;

/// The grid that is asked for; names in camelCase when deserialized. What is left out follows from the box of
/// the model's control nets.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct GridOptions {
    /// The first point. If it is left out, the box is in the middle of the grid.
    pub origin: Option<[f64; 3]>,
    /// The distance of neighbours along each axis, positive. If it is left out, the longest side of the box is as
    /// long as `resolution` states.
    pub spacing: Option<f64>,
    /// The number of points along x, y and z. If it is left out, the grid reaches to the band's width and to two
    /// spacings at least beyond the box.
    pub counts: Option<[usize; 3]>,
    /// The number of spacings along the longest side of the box, 1 to 1,024; 64 if it is left out. Beside a spacing it is
    /// an error.
    pub resolution: Option<u32>,
}

/// The points `origin + spacing (i, j, k)`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct Grid {
    /// The first point.
    pub origin: [f64; 3],
    /// The distance of neighbours along each axis.
    pub spacing: f64,
    /// The number of points along x, y and z, at least 1 each.
    pub counts: [usize; 3],
}

impl Grid {
    /// Returns the grid that is asked for about a model with this box, with a margin of at least `margin`.
    ///
    /// # Errors
    /// [`Error::OptionOutOfRange`]; [`Error::OptionInvalid`] for both a spacing and a resolution.
    pub(super) fn new(options: &GridOptions, aabb: &Aabb, margin: f64) -> Result<Self> {
        let spacing = spacing(options, aabb)?;
        let margin = upper_max(margin, MARGIN * spacing);
        let (counts, origin) = match (options.counts, options.origin) {
            (Some(counts), Some(origin)) => (counts, DVec3::from_array(origin)),
            (Some(counts), None) => {
                let lengths = DVec3::from_array(counts.map(|count| (count as f64 - 1.0) * spacing));
                (counts, aabb.center() - 0.5 * lengths)
            }
            (None, Some(origin)) => {
                let origin = DVec3::from_array(origin);
                (counts_up_to(aabb.max + margin - origin, spacing), origin)
            }
            (None, None) => {
                let counts = counts_up_to(aabb.extent() + 2.0 * margin, spacing);
                let lengths = DVec3::from_array(counts.map(|count| (count as f64 - 1.0) * spacing));
                (counts, aabb.center() - 0.5 * lengths)
            }
        };
        let total = counts.into_iter().try_fold(1_usize, usize::checked_mul);
        if !total.is_some_and(|total| (1..=MAX_POINTS).contains(&total)) {
            return Err(Error::out_of_range(
                "counts",
                counts,
                "three numbers from 1, 2^29 points at most in all",
            ));
        }
        let grid = Self { origin: origin.to_array(), spacing, counts };
        let ends = [grid.point([0; 3]), grid.point(counts.map(|count| count - 1))];
        if !ends.iter().all(|end| end.to_array().into_iter().all(is_in_range)) {
            return Err(Error::out_of_range("origin", grid.origin, "points of at most 1e100 in size"));
        }
        Ok(grid)
    }

    /// Returns the number of points.
    #[must_use]
    pub fn len(&self) -> usize {
        self.counts.iter().product()
    }

    /// Returns whether there are no points, which is never so.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the point of an index along each axis.
    pub(super) fn point(&self, index: [usize; 3]) -> DVec3 {
        DVec3::from_array(self.origin) + self.spacing * DVec3::from_array(index.map(|index| index as f64))
    }

    /// Returns an upper bound on the error of a computed point.
    pub(super) fn rounding(&self) -> f64 {
        let last = self.spacing * DVec3::from_array(self.counts.map(|count| count as f64));
        gamma(COORDINATE_ROUNDINGS) * (DVec3::from_array(self.origin).length() + last.length())
    }
}

/// # Errors
/// As [`Grid::new`].
fn spacing(options: &GridOptions, aabb: &Aabb) -> Result<f64> {
    if let (Some(spacing), Some(resolution)) = (options.spacing, options.resolution) {
        let found =
            format!("both a spacing, {spacing:?}, and a resolution, {resolution}, expected one of them");
        return Err(Error::OptionInvalid { found });
    }
    let resolution = options.resolution.unwrap_or(DEFAULT_RESOLUTION);
    if !(1..=MAX_RESOLUTION).contains(&resolution) {
        return Err(Error::out_of_range("resolution", resolution, "a whole number from 1 to 1024"));
    }
    let spacing = options.spacing.unwrap_or_else(|| aabb.extent().max_element() / f64::from(resolution));
    positive("spacing", spacing)?;
    Ok(spacing)
}

/// Returns the numbers of points from 0 to these lengths at least, 1 where a length is negative.
fn counts_up_to(lengths: DVec3, spacing: f64) -> [usize; 3] {
    // A conversion saturates, and of NaN it gives 0; too many points are refused after it.
    lengths.to_array().map(|length| ((length / spacing).ceil() as usize).saturating_add(1))
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    fn unit_box() -> Aabb {
        Aabb { min: DVec3::new(-1.0, -0.5, 0.0), max: DVec3::new(1.0, 0.5, 0.25) }
    }

    #[test]
    fn what_is_left_out_follows_from_the_box() {
        let grid = |options: GridOptions, margin: f64| Grid::new(&options, &unit_box(), margin);
        let eighth = GridOptions { resolution: Some(16), ..GridOptions::default() };
        let Ok(found) = grid(eighth, 0.0) else { unreachable!() };
        // 16, 8 and 2 spacings of an eighth, and two more at each end.
        assert_eq!(found, Grid { origin: [-1.25, -0.75, -0.25], spacing: 0.125, counts: [21, 13, 7] });
        let Ok(found) = grid(eighth, 0.5) else { unreachable!() };
        assert_eq!(found, Grid { origin: [-1.5, -1.0, -0.5], spacing: 0.125, counts: [25, 17, 11] });
        let from = GridOptions { origin: Some([0.0; 3]), spacing: Some(0.5), ..GridOptions::default() };
        let Ok(found) = grid(from, 0.0) else { unreachable!() };
        assert_eq!(found.counts, [5, 4, 4]);
        let about = GridOptions { spacing: Some(0.5), counts: Some([3, 1, 2]), ..GridOptions::default() };
        let Ok(found) = grid(about, 0.0) else { unreachable!() };
        assert_eq!(found.origin, [-0.5, 0.0, -0.125]);
        let Ok(found) = grid(GridOptions::default(), 0.0) else { unreachable!() };
        assert_eq!(found.spacing, 2.0 / 64.0);
    }

    #[test]
    fn grids_out_of_range_are_refused() {
        let code = |options: GridOptions| match Grid::new(&options, &unit_box(), 0.0) {
            Ok(_) => "",
            Err(error) => error.code(),
        };
        let spacing = |spacing: f64| GridOptions { spacing: Some(spacing), ..GridOptions::default() };
        for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-300] {
            assert_eq!(code(spacing(wrong)), "OPTION_OUT_OF_RANGE", "{wrong}");
        }
        for counts in [[0, 4, 4], [usize::MAX, 2, 2], [1 << 10, 1 << 10, 1 << 10]] {
            assert_eq!(code(GridOptions { counts: Some(counts), ..spacing(1.0) }), "OPTION_OUT_OF_RANGE");
        }
        for origin in [[f64::NAN, 0.0, 0.0], [2e100, 0.0, 0.0]] {
            let counts = Some([2; 3]);
            assert_eq!(
                code(GridOptions { origin: Some(origin), counts, ..spacing(1.0) }),
                "OPTION_OUT_OF_RANGE"
            );
        }
        assert_eq!(
            code(GridOptions { resolution: Some(0), ..GridOptions::default() }),
            "OPTION_OUT_OF_RANGE"
        );
        assert_eq!(code(GridOptions { resolution: Some(8), ..spacing(1.0) }), "OPTION_INVALID");
    }
}
