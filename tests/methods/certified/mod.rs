//! Method `certified`.

mod bisector_maxima;
mod copies_and_offsets;
mod limits_and_reports;
mod revolution_and_spheres;
mod scales;
