//! Faces: their surfaces, their loops and the curves of these.

mod degrees;
mod elementary;
mod loops;
mod p_curves;
pub(crate) mod polygons;
mod seams;
mod splines;
