//! The permitted width of an interval, in model units or as a fraction of the diagonal.

use crate::error::{Error, Result};

/// # Errors
/// [`Error::OptionOutOfRange`] unless the option is positive and finite.
pub(crate) fn positive(option: &'static str, found: f64) -> Result<()> {
    let is_positive = found.is_finite() && found > 0.0;
    if is_positive { Ok(()) } else { Err(Error::out_of_range(option, found, "a positive finite number")) }
}

/// # Errors
/// [`Error::OptionOutOfRange`] unless the option is finite and not negative.
pub(crate) fn not_negative(option: &'static str, found: f64) -> Result<()> {
    let is_valid = found.is_finite() && found >= 0.0;
    if is_valid { Ok(()) } else { Err(Error::out_of_range(option, found, "a finite number from 0")) }
}

/// The two options that permit the width of an interval, at most one of them given.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PermittedWidth {
    /// The option `tolerance`, in model units.
    pub(crate) tolerance: Option<f64>,
    /// The option `relative_tolerance`, a fraction of the diagonal.
    pub(crate) relative_tolerance: Option<f64>,
}

impl PermittedWidth {
    /// Checks the range of the option that is given, and that the other one is absent.
    ///
    /// # Errors
    /// [`Error::OptionOutOfRange`] unless it is positive and finite; [`Error::OptionInvalid`]
    /// if both are given.
    pub(crate) fn validate(self) -> Result<()> {
        if let Self { tolerance: Some(tolerance), relative_tolerance: Some(relative) } = self {
            let found = format!(
                "both a tolerance, {tolerance:?}, and a relative tolerance, {relative:?}, expected one of them"
            );
            return Err(Error::OptionInvalid { found });
        }
        self.tolerance.map_or(Ok(()), |found| positive("tolerance", found))?;
        self.relative_tolerance.map_or(Ok(()), |found| positive("relative tolerance", found))
    }

    /// Returns the width in model units, where `default` is the fraction of the diagonal if
    /// neither option is given.
    pub(crate) fn in_units(self, diagonal: f64, default: f64) -> f64 {
        self.tolerance.unwrap_or_else(|| self.relative_tolerance.unwrap_or(default) * diagonal)
    }
}
