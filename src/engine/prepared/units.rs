//! Models in other units.

use super::PreparedModel;
use crate::error::{Error, Result};
use crate::limits::is_in_range;
use crate::model::{Model, is_unit};
use crate::rounding::gamma;
use crate::threads::locked;
use std::sync::Arc;

/// The roundings of a coordinate scaled to another unit: the factor and the product.
const SCALE_ROUNDINGS: f64 = 4.0;

impl PreparedModel {
    /// Returns the metres per coordinate unit, if they are known.
    #[must_use]
    pub fn unit(&self) -> Option<f64> {
        self.unit
    }

    /// Returns the model with coordinates in units of this many metres, whatever it stated. Nothing is scaled. `source`
    /// is the model that it was prepared from, and none of a mesh or of points.
    ///
    /// # Errors
    /// [`Error::UnitInvalid`].
    pub fn with_unit(self, metres: f64, source: Option<&Model>) -> Result<Self> {
        if !is_unit(metres) {
            return Err(Error::UnitInvalid { found: metres });
        }
        let source = source.map(|model| model.clone().with_unit(metres)).transpose()?;
        *locked(&self.kept.scaled) = None;
        Ok(Self { unit: Some(metres), source, ..self })
    }

    /// Returns this model in the unit of `other` if both state different units, else
    /// `None`; the last one is kept.
    ///
    /// # Errors
    /// [`Error::UnitsDiffer`] if the units differ and must not be scaled; those of
    /// [`Model::scaled_to_unit`] and [`PreparedModel::new`].
    pub(crate) fn in_unit_of(&self, other: &Self, scale: bool) -> Result<Option<Arc<Self>>> {
        let Some(factor) = self.factor_to_unit_of(other, scale)? else { return Ok(None) };
        let kept = locked(&self.kept.scaled).clone();
        if let Some(kept) = kept.filter(|kept| kept.unit == other.unit) {
            return Ok(Some(kept));
        }
        let prepared = Arc::new(self.scaled_by(factor, other.unit)?);
        *locked(&self.kept.scaled) = Some(Arc::clone(&prepared));
        Ok(Some(prepared))
    }

    /// Returns the factor of lengths from this model's unit to that of `other`, if both state different ones.
    ///
    /// # Errors
    /// [`Error::UnitsDiffer`] if the units differ and must not be scaled.
    pub(in crate::engine) fn factor_to_unit_of(&self, other: &Self, scale: bool) -> Result<Option<f64>> {
        match (other.unit, self.unit) {
            (Some(a), Some(b)) if a != b && scale => Ok(Some(b / a)),
            (Some(a), Some(b)) if a != b => Err(Error::UnitsDiffer { a, b }),
            _ => Ok(None),
        }
    }

    /// Returns this model with all lengths from the origin times a positive factor, in the same unit.
    ///
    /// # Errors
    /// [`Error::PointOutOfRange`], [`Error::NumberTooLarge`]; those of [`PreparedModel::new`].
    pub(in crate::engine) fn scaled(&self, factor: f64) -> Result<Self> {
        self.scaled_by(factor, self.unit)
    }

    /// Returns this model with all lengths times `factor`, in the unit `unit`.
    fn scaled_by(&self, factor: f64, unit: Option<f64>) -> Result<Self> {
        if let Some(facets) = &self.facets {
            let scaled = facets.scaled(factor);
            let length = scaled.target.bounding_box().farthest_from_origin();
            if !is_in_range(length) {
                return Err(Error::PointOutOfRange { index: 0, found: length });
            }
            let gap = if self.gap > 0.0 {
                (self.gap * factor * (1.0 + gamma(SCALE_ROUNDINGS))).next_up()
            } else {
                0.0
            };
            return Ok(Self::with_facets(scaled, gap, unit));
        }
        let source = self.source.as_ref().ok_or(Error::EmptyModel)?;
        let mut prepared = Self::new(&source.scaled(factor, unit)?)?;
        let rounding = gamma(SCALE_ROUNDINGS) * prepared.bounding_box.farthest_from_origin();
        prepared.bezier.point_error.include_deviation(rounding);
        Ok(prepared)
    }
}
