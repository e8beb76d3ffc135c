//! The rigid motion that lays one model on another: the fit in the mean from a pose, the search for
//! poses to start from, and motions by hand (pairs of points, datums).
//!
//! A fit is an estimate: it is local, or from many starts. It bounds no distance. What a pose is
//! worth as an interval is for the search over distances to say.

mod datums;
mod field;
mod fit;
mod foot_grid;
mod freedoms;
mod largest;
mod loss;
mod moments;
mod points;
mod poses;
mod samples;
mod search;
mod system;

pub(crate) use datums::by_datums;
pub use datums::{Datum, DatumFit, Feature};
pub(crate) use field::{Field, FootField, Place, direction_from_facet, foot_on_patches};
pub(crate) use fit::{LocalFit, Step};
pub(crate) use freedoms::Freedoms;
pub(crate) use largest::{BoxSearch, Chart, Clear, Clearance, Contacts, Goal, LargestFit, contacts};
pub(crate) use loss::Loss;
pub use loss::Robust;
pub use points::PointPair;
pub(crate) use poses::{Candidate, distinct};
pub(crate) use samples::Samples;
pub(crate) use search::{Search, principal_poses, random_residual};
