//! The fit in the largest distance (Chebyshev's norm), and its certificate: an interval of the least
//! largest distance over all motions of a box.

mod bound;
mod chart;
mod contacts;
mod fit;
mod minorant;
mod program;
mod search;

pub(crate) use bound::{Clear, Clearance, Contacts};
pub(crate) use chart::{Cell, Chart};
pub(crate) use contacts::contacts;
pub(crate) use fit::{LargestFit, Reach};
pub(crate) use search::{BoxSearch, Goal};
