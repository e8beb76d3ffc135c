//! The commands that score generated models.

pub(crate) mod score;
pub(crate) mod summary;
