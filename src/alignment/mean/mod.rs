//! The fit in the mean: least squares, with a rule for samples far from B.

mod fit;
mod loss;
mod system;

pub(crate) use fit::{LocalFit, Step};
pub(crate) use loss::Loss;
pub use loss::Robust;
