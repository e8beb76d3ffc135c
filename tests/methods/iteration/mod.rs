//! Method `iteration`.

mod accuracy;
mod sampling;
