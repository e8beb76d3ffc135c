//! Signed distances of a solid on a grid.

use super::bricks::{Brick, SIDE, bricks};
use super::grid::{Grid, GridOptions};
use super::query::Measured;
use crate::bvh::Aabb;
use crate::engine::{Computation, Engine, PreparedModel, Signs};
use crate::error::{Error, Result};
use crate::progress::{Monitor, Progress};
use crate::threads::parallel::map_items;
use crate::tolerance::{PermittedWidth, positive};
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// The number of bricks between two checkpoints, as that of closest points.
const BRICKS_AT_ONCE: usize = if cfg!(target_arch = "wasm32") { 2 } else { 64 };

/// The excess of a distance, as a fraction of the diagonal, unless the options state one.
const DEFAULT_RELATIVE_TOLERANCE: f64 = 1e-6;

/// Half the distance of neighbouring numbers of float32, relative to the number.
const FLOAT32_ROUNDING: f64 = 0.5 * f32::EPSILON as f64;

/// The same of numbers near 0.
const FLOAT32_UNDERFLOW: f64 = f32::MIN_POSITIVE as f64 * FLOAT32_ROUNDING;

/// The precision to which values are rounded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Precision {
    /// Numbers of 32 bits.
    Float32,
    /// Numbers of 64 bits.
    #[default]
    Float64,
}

/// Options of [`Engine::signed_distances`]; names in camelCase when deserialized, with those of the grid among them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SignedDistanceOptions {
    /// The points.
    pub grid: GridOptions,
    /// Distances above it, in model units, are not measured: their values are its width, with their sign. Positive.
    pub band: Option<f64>,
    /// The permitted excess of a distance over the least one, in model units, positive.
    pub tolerance: Option<f64>,
    /// The same as a fraction of the diagonal of the model's control-net box; 1e-6 if neither is given. Both at once are
    /// an error.
    pub relative_tolerance: Option<f64>,
    /// The precision of the values.
    pub precision: Precision,
}

/// The options with those of the grid among them.
#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
struct Flat {
    origin: Option<[f64; 3]>,
    spacing: Option<f64>,
    counts: Option<[usize; 3]>,
    resolution: Option<u32>,
    band: Option<f64>,
    tolerance: Option<f64>,
    relative_tolerance: Option<f64>,
    precision: Precision,
}

impl<'de> Deserialize<'de> for SignedDistanceOptions {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        let Flat { origin, spacing, counts, resolution, band, tolerance, relative_tolerance, precision } =
            Flat::deserialize(deserializer)?;
        let grid = GridOptions { origin, spacing, counts, resolution };
        Ok(Self { grid, band, tolerance, relative_tolerance, precision })
    }
}

/// The signed distances of a solid on a grid.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct SignedDistances {
    /// The points.
    pub grid: Grid,
    /// The signed distances, negative inside, x fastest; none is NaN. Where they are rounded to float32, each is a number of
    /// float32.
    pub values: Vec<f64>,
    /// A value of a size below the band's is within it of the true distance. Of a value of the band's size, the true
    /// distance is at least that less the bound.
    pub bound: f64,
    /// The band's width, rounded as the values are; infinite if all points were measured.
    pub band: f64,
    /// The places in `values` of the points whose side is not decided, rising: those on the boundary, in its
    /// gaps, or in the common part of shells of unknown kinds. Their values are positive.
    pub undecided: Vec<usize>,
    /// The number of measured points: of each brick its middle, and its points unless they are beyond the band.
    pub measured: usize,
    /// The precision of the values.
    pub precision: Precision,
}

impl Engine {
    /// Returns the signed distances of a solid on a grid, negative inside.
    ///
    /// Guarantee: values are within one bound of the true distances, and signs are never wrong for the solids that the
    /// shells bound, as [`PreparedModel::side`] states. Bricks of 8 × 8 × 8 points that are certainly outside the band cost
    /// one closest point. Results do not depend on the number of threads. O(points near the model log patches).
    ///
    /// # Errors
    /// [`Error::NotClosed`] for a model without sides; [`Error::OptionOutOfRange`] and [`Error::OptionInvalid`];
    /// [`Error::Cancelled`].
    pub fn signed_distances<'a>(
        &'a self,
        model: &'a PreparedModel,
        options: &'a SignedDistanceOptions,
    ) -> Computation<'a, SignedDistances> {
        Computation::new(move |mut watched| {
            Box::pin(async move {
                let all = 0..usize::MAX;
                let Layers { found, rounding } = layers(model, options, all, watched.monitor()).await?;
                Ok(SignedDistances { bound: found.bound + rounding, ..found })
            })
        })
    }
}

impl SignedDistanceOptions {
    /// Returns the grid, of a model of this box.
    pub(super) fn grid_about(&self, aabb: &Aabb) -> Result<Grid> {
        self.band.map_or(Ok(()), |band| positive("band", band))?;
        Grid::new(&self.grid, aabb, self.band.unwrap_or(0.0))
    }
}

/// The signed distances of consecutive layers of bricks along z.
pub(crate) struct Layers {
    /// Those of their points: `grid` and the places of `undecided` are those of the whole. `bound` does not include
    /// the rounding.
    pub(crate) found: SignedDistances,
    /// An upper bound on the errors by the rounding to the precision.
    pub(crate) rounding: f64,
}

/// Returns the signed distances of the layers of bricks in a range, up to the last layer that there is.
///
/// # Errors
/// Those of [`Engine::signed_distances`].
pub(super) async fn layers(
    model: &PreparedModel,
    options: &SignedDistanceOptions,
    range: Range<usize>,
    monitor: &mut dyn Monitor,
) -> Result<Layers> {
    let SignedDistanceOptions { tolerance, relative_tolerance, precision, .. } = *options;
    let permitted = PermittedWidth { tolerance, relative_tolerance };
    permitted.validate()?;
    let aabb = model.bounding_box();
    let grid = options.grid_about(&aabb)?;
    let band = options.band.map_or(f64::INFINITY, |band| precision.rounded(band));
    let gap = permitted.in_units(aabb.diagonal(), DEFAULT_RELATIVE_TOLERANCE);
    let measured = Measured::new(model, gap, 0.0);
    let query = measured.query().ok_or(Error::EmptyModel)?;
    if query.signs() != Signs::Solid {
        return Err(Error::NotClosed { found: model.solid().free_edges.len() });
    }
    let mut progress = Progress::new(monitor, false);
    let [width, depth, height] = grid.counts;
    let [first, end] = [range.start, range.end].map(|layer| layer.saturating_mul(SIDE).min(height));
    let mut found = SignedDistances {
        values: vec![0.0; width * depth * (end - first)],
        bound: 0.0,
        undecided: Vec::new(),
        measured: 0,
        grid,
        band,
        precision,
    };
    let all = bricks(&grid);
    let of_layer = width.div_ceil(SIDE) * depth.div_ceil(SIDE);
    let all = &all[of_layer * first.div_ceil(SIDE)..of_layer * end.div_ceil(SIDE)];
    for (page, bricks) in all.chunks(BRICKS_AT_ONCE).enumerate() {
        let filled = map_items(bricks.to_vec(), |brick| brick.fill(&query, &grid, band));
        for (&brick, filled) in bricks.iter().zip(filled) {
            found.take(brick, filled.ok_or(Error::EmptyModel)?, width * depth * first);
        }
        let done = page * BRICKS_AT_ONCE + bricks.len();
        progress.checkpoint(done as f64 / all.len() as f64).await?;
    }
    found.undecided.sort_unstable();
    let rounding = found.round();
    progress.finish();
    Ok(Layers { found, rounding })
}

impl SignedDistances {
    /// Takes the values of a brick; the first one that is kept has the place `first` in the whole grid.
    fn take(&mut self, brick: Brick, filled: super::bricks::Filled, first: usize) {
        let places: Vec<usize> = brick.places(&self.grid).collect();
        places.iter().zip(filled.values).for_each(|(&place, value)| self.values[place - first] = value);
        self.undecided.extend(filled.undecided.into_iter().map(|local| places[local]));
        self.bound = crate::rounding::upper_max(self.bound, filled.bound);
        self.measured += filled.measured;
    }

    /// Rounds the values to their precision, and returns an upper bound on what that changes.
    fn round(&mut self) -> f64 {
        if self.precision == Precision::Float64 {
            return 0.0;
        }
        let mut largest = 0.0_f64;
        for value in &mut self.values {
            largest = crate::rounding::upper_max(largest, value.abs());
            *value = self.precision.rounded(*value);
        }
        if largest <= f64::from(f32::MAX) {
            FLOAT32_ROUNDING * largest + FLOAT32_UNDERFLOW
        } else {
            f64::INFINITY
        }
    }
}

impl Precision {
    fn rounded(self, value: f64) -> f64 {
        match self {
            Self::Float32 => f64::from(value as f32),
            Self::Float64 => value,
        }
    }
}
