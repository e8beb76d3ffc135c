//! Files of all kinds on the command line.

mod archives;
mod gaps;
mod mesh_files;
mod meshes;
mod rhino;
mod trimmed;
