//! Writers of small files, for tests of the readers.

pub mod brep;
pub mod iges;
pub mod step;
