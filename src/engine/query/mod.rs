//! Questions about two models: the options that they share, and how both models are opened.

mod hint;
mod opened;

pub(super) use opened::Opened;

use super::options::{at_least_one, at_least_zero};
use super::{Computation, Engine, PreparedModel};
use crate::error::Result;
use crate::model::RigidTransform;
use crate::tolerance::{PermittedWidth, positive};

/// The options that questions about two models share. Those that a question does not have are at their defaults.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct CommonOptions {
    /// The permitted width of intervals of lengths, in model units, positive.
    pub tolerance: Option<f64>,
    /// The same as a fraction of a diagonal. Both at once are an error.
    pub relative_tolerance: Option<f64>,
    /// Seconds after which the answer so far is returned, positive.
    pub max_seconds: Option<f64>,
    /// What a search examines before the answer so far is returned, 1 or more.
    pub max_cells: Option<usize>,
    /// Whether B is scaled to the unit of A where both state different ones; else they are an error.
    pub scale_units: bool,
    /// Moves A.
    pub transform: RigidTransform,
}

impl CommonOptions {
    /// Checks every range.
    ///
    /// # Errors
    /// [`crate::Error::OptionOutOfRange`] naming the option; [`crate::Error::OptionInvalid`] for both widths.
    pub(super) fn validate(&self) -> Result<()> {
        self.permitted_width().validate()?;
        self.max_seconds.map_or(Ok(()), |seconds| positive("max seconds", seconds))?;
        at_least_one("max cells", self.max_cells)
    }

    /// Returns the permitted width of intervals, in model units: `default` is the fraction of the diagonal if neither
    /// option states it.
    pub(super) fn width(&self, diagonal: f64, default: f64) -> f64 {
        self.permitted_width().in_units(diagonal, default)
    }

    fn permitted_width(&self) -> PermittedWidth {
        PermittedWidth { tolerance: self.tolerance, relative_tolerance: self.relative_tolerance }
    }
}

/// A question about two models, A and B: options whose ranges are checked, and the computation that answers it.
///
/// The engine's method of the same name is the usual way to ask. This trait is for what asks any question, such as
/// bindings to other languages.
///
/// ```
/// use nurbs_hausdorff::{ClearanceOptions, Engine, Error, PreparedModel, Query, shapes::shape};
///
/// fn ask<Q: Query>(question: &Q, models: [&PreparedModel; 2]) -> Result<Q::Answer, Error> {
///     question.validate()?;
///     question.ask(&Engine::cpu(), models).wait()
/// }
///
/// let [a, b] = [PreparedModel::new(&shape("sphere")?)?, PreparedModel::new(&shape("sphere-larger")?)?];
/// assert!(ask(&ClearanceOptions::default(), [&a, &b])?.converged);
/// # Ok::<(), Error>(())
/// ```
pub trait Query: Sized {
    /// The result.
    type Answer;

    /// Returns the options that it shares with other questions.
    fn common(&self) -> CommonOptions;

    /// Returns the same question with A moved by `transform`.
    #[must_use]
    fn moved(self, transform: RigidTransform) -> Self;

    /// Returns the same question with a budget of seconds, if it has none and takes one.
    #[must_use]
    fn within(self, _max_seconds: Option<f64>) -> Self {
        self
    }

    /// Checks the ranges of the options that only this question has.
    ///
    /// # Errors
    /// [`crate::Error::OptionOutOfRange`] naming the option; [`crate::Error::OptionInvalid`] for options that
    /// contradict each other.
    fn validate_own(&self) -> Result<()>;

    /// Checks the ranges of all options.
    ///
    /// # Errors
    /// [`crate::Error::OptionOutOfRange`] naming the option; [`crate::Error::OptionInvalid`] for options that
    /// contradict each other.
    fn validate(&self) -> Result<()> {
        self.common().validate()?;
        self.validate_own()
    }

    /// Returns the computation that answers it, of A and of B.
    fn ask<'a>(&'a self, engine: &'a Engine, models: [&'a PreparedModel; 2])
    -> Computation<'a, Self::Answer>;
}

/// Implements [`Query`] for options by the method of the engine that answers. The options have these fields of
/// [`CommonOptions`] by name, `max_seconds` beside them if they have it, and `require_own` checks all others.
macro_rules! impl_query {
    ($options:ty, $method:ident -> $answer:ty, [$($common:ident),*] $(, $max_seconds:ident)?) => {
        impl $crate::engine::Query for $options {
            type Answer = $answer;

            fn common(&self) -> $crate::engine::CommonOptions {
                $crate::engine::CommonOptions {
                    $($common: self.$common.into(),)*
                    $($max_seconds: self.$max_seconds,)?
                    ..Default::default()
                }
            }

            fn moved(self, transform: $crate::model::RigidTransform) -> Self {
                Self { transform, ..self }
            }

            $(fn within(self, $max_seconds: Option<f64>) -> Self {
                Self { $max_seconds: self.$max_seconds.or($max_seconds), ..self }
            })?

            fn validate_own(&self) -> $crate::error::Result<()> {
                self.require_own()
            }

            fn ask<'a>(
                &'a self,
                engine: &'a $crate::engine::Engine,
                [a, b]: [&'a $crate::engine::PreparedModel; 2],
            ) -> $crate::engine::Computation<'a, $answer> {
                engine.$method(a, b, self)
            }
        }
    };
}

pub(super) use impl_query;

/// # Errors
/// [`crate::Error::OptionOutOfRange`] unless the limit, if there is one, is 0 or more and finite.
pub(super) fn validate_limit(limit: Option<f64>) -> Result<()> {
    limit.map_or(Ok(()), |limit| at_least_zero("limit", limit))
}
