//! Faces over the seam of a closed surface.

mod rim_beyond_a_seam;

pub(crate) use rim_beyond_a_seam::rim_beyond_a_seam;
