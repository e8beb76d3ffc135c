//! Where the faces of files stand: instances of products, their placements and the names of their levels.

pub(crate) mod assembly;
pub(crate) mod foreign;
pub(crate) mod levels;
pub(crate) mod placed;
