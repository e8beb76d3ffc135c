//! Where the faces of files stand: instances of products, their placements and the names of their levels.

pub(in crate::brep) mod assembly;
pub(in crate::brep) mod foreign;
pub(in crate::brep) mod levels;
pub(in crate::brep) mod placed;
