//! Method `hierarchy`.

mod accuracy;
mod boxes;
