//! Trimmed faces: their validation, and their cut into patches.

mod untrim;
mod validation;
