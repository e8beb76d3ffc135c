//! Signed distances of a solid on a grid.

use super::bricks::{Brick, bricks};
use super::grid::{Grid, GridOptions};
use super::query::Measured;
use crate::engine::{Computation, Engine, PreparedModel, Signs};
use crate::error::{Error, Result};
use crate::progress::{Monitor, Progress};
use crate::threads::parallel::map_items;
use crate::tolerance::{PermittedWidth, positive};
use serde::{Deserialize, Serialize};

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
    /// The number of closest points that were computed: points of bricks beyond the band have one in all.
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
            Box::pin(async move { compute(model, options, watched.monitor()).await })
        })
    }
}

async fn compute(
    model: &PreparedModel,
    options: &SignedDistanceOptions,
    monitor: &mut dyn Monitor,
) -> Result<SignedDistances> {
    let SignedDistanceOptions { tolerance, relative_tolerance, precision, .. } = *options;
    let permitted = PermittedWidth { tolerance, relative_tolerance };
    permitted.validate()?;
    options.band.map_or(Ok(()), |band| positive("band", band))?;
    let band = options.band.map_or(f64::INFINITY, |band| precision.rounded(band));
    let aabb = model.bounding_box();
    let grid = Grid::new(&options.grid, &aabb, options.band.unwrap_or(0.0))?;
    let gap = permitted.in_units(aabb.diagonal(), DEFAULT_RELATIVE_TOLERANCE);
    let measured = Measured::new(model, gap, 0.0);
    let query = measured.query().ok_or(Error::EmptyModel)?;
    if query.signs() != Signs::Solid {
        return Err(Error::NotClosed { found: model.solid().free_edges.len() });
    }
    let mut progress = Progress::new(monitor, false);
    let mut found = SignedDistances {
        values: vec![0.0; grid.len()],
        bound: 0.0,
        undecided: Vec::new(),
        measured: 0,
        grid,
        band,
        precision,
    };
    let all = bricks(&grid);
    for (page, bricks) in all.chunks(BRICKS_AT_ONCE).enumerate() {
        let filled = map_items(bricks.to_vec(), |brick| brick.fill(&query, &grid, band));
        for (&brick, filled) in bricks.iter().zip(filled) {
            found.take(brick, filled.ok_or(Error::EmptyModel)?);
        }
        let done = page * BRICKS_AT_ONCE + bricks.len();
        progress.checkpoint(done as f64 / all.len() as f64).await?;
    }
    found.undecided.sort_unstable();
    found.round();
    progress.finish();
    Ok(found)
}

impl SignedDistances {
    fn take(&mut self, brick: Brick, filled: super::bricks::Filled) {
        let places: Vec<usize> = brick.places(&self.grid).collect();
        places.iter().zip(filled.values).for_each(|(&place, value)| self.values[place] = value);
        self.undecided.extend(filled.undecided.into_iter().map(|local| places[local]));
        self.bound = crate::rounding::upper_max(self.bound, filled.bound);
        self.measured += filled.measured;
    }

    /// Rounds the values to their precision, and adds what that changes to the bound.
    fn round(&mut self) {
        if self.precision == Precision::Float64 {
            return;
        }
        let mut largest = 0.0_f64;
        for value in &mut self.values {
            largest = crate::rounding::upper_max(largest, value.abs());
            *value = self.precision.rounded(*value);
        }
        self.bound += FLOAT32_ROUNDING * largest + FLOAT32_UNDERFLOW;
        if !(largest <= f64::from(f32::MAX)) {
            self.bound = f64::INFINITY;
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
