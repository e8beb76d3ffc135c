//! Two models as a question opens them: checked, and in one unit.

use super::hint::hint;
use super::{CommonOptions, Query};
use crate::engine::PreparedModel;
use crate::engine::clock::Clock;
use crate::engine::direction::Direction;
use crate::error::Result;
use std::sync::Arc;

/// Two models of one unit, with the options of the question about them and its clock.
pub(in crate::engine) struct Opened<'a> {
    models: [&'a PreparedModel; 2],
    /// B in the unit of A, where it stated another one.
    scaled: Option<Arc<PreparedModel>>,
    common: CommonOptions,
    clock: Clock,
}

impl<'a> Opened<'a> {
    /// Opens A and B for a question.
    ///
    /// # Errors
    /// Those of [`Query::validate`]; [`crate::Error::UnitsDiffer`]; those of a model that is scaled to a unit.
    pub(in crate::engine) fn new(models: [&'a PreparedModel; 2], question: &impl Query) -> Result<Self> {
        question.validate()?;
        let common = question.common();
        let clock = Clock::start(common.max_seconds);
        let [a, b] = models;
        let scaled = b.in_unit_of(a, common.scale_units)?;
        Ok(Self { models, scaled, common, clock })
    }

    /// Returns A and B, in the unit of A.
    pub(in crate::engine) fn models(&self) -> [&PreparedModel; 2] {
        let [a, b] = self.models;
        [a, self.scaled.as_deref().unwrap_or(b)]
    }

    /// Returns A and B, in the unit of A, if both have faces.
    ///
    /// # Errors
    /// [`crate::Error::FacetsUnsupported`] with `what` for a cloud of points.
    pub(in crate::engine) fn models_with_faces(&self, what: &'static str) -> Result<[&PreparedModel; 2]> {
        let models = self.models();
        models.iter().try_for_each(|model| model.require_faces(what))?;
        Ok(models)
    }

    /// Returns the direction from A, moved by the options' transform, to B.
    pub(in crate::engine) fn forward(&self) -> Direction<'_> {
        let [from, to] = self.models();
        Direction { from, to, transform: self.common.transform }
    }

    /// Returns the direction from B to A, in A's own frame.
    pub(in crate::engine) fn reverse(&self) -> Direction<'_> {
        let [to, from] = self.models();
        Direction { from, to, transform: self.common.transform.inverse() }
    }

    /// Returns one line on what may be wrong with the units of both models.
    pub(in crate::engine) fn hint(&self) -> Option<String> {
        let [a, b] = self.models;
        hint(a, b)
    }

    /// Returns the clock, which runs since the models were opened.
    pub(in crate::engine) fn clock(&self) -> Clock {
        self.clock
    }
}
