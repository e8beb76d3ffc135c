//! The fit in the mean: least squares, with a rule for samples far from B.

mod fit;
mod loss;
mod system;

pub(crate) use fit::{LocalFit, Step};
pub use loss::Robust;
pub(crate) use loss::{Loss, MAX_OUTLIERS};
