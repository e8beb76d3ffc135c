//! The readers of meshes without a scene: STL, PLY, OBJ and OFF.

pub(super) mod obj;
pub(super) mod off;
pub(super) mod ply;
pub(super) mod stl;
