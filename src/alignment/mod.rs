//! The rigid motion that lays one model on another: the fit in the mean from a pose, the search for
//! poses to start from, and motions by hand (pairs of points, datums).
//!
//! A fit is an estimate: it is local, or from many starts. It bounds no distance. What a pose is
//! worth as an interval is for the search over distances to say.

mod by_hand;
mod field;
mod foot_grid;
mod freedoms;
mod largest;
mod mean;
mod moments;
mod near_symmetries;
mod poses;
mod samples;
mod search;

pub(crate) use by_hand::by_datums;
pub use by_hand::{Datum, DatumFit, Feature, PointPair};
pub(crate) use field::{Field, FootField, Place, Residual, direction_from_facet, foot_on_patches};
pub(crate) use freedoms::Freedoms;
pub(crate) use largest::{
    BoxSearch, Cell, Chart, Clear, Clearance, Contacts, Goal, LargestFit, Reach, contacts,
};
pub use mean::Robust;
pub(crate) use mean::{LocalFit, Loss, MAX_OUTLIERS, Step};
pub(crate) use near_symmetries::near_symmetries;
pub(crate) use poses::{Candidate, distinct};
pub(crate) use samples::Samples;
pub(crate) use search::{Search, principal_poses, random_residual};
