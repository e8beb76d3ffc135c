//! Method `certified`: an interval to the tolerance that the user asks for.
//!
//! Whole patches are bounded `at_once` where their likes on B or a sphere tell
//! it, and of surfaces of revolution about one axis only a `profile` is taken.
//! The rest of A is cut into cells. `certify` bounds the distance to B from
//! above over a whole cell, from the foot of its centre alone, `blend` by weighted
//! means where several patches are about equally near, `compare` by the
//! polynomials of both, `corners` where the nearest patch changes close to A;
//! `bound` takes the least. `search` halves the cells whose bound is not yet
//! within the tolerance of the largest distance found, to which `climb` leads
//! from the samples that `raise` chooses; `claim` certifies that distance. Every cell ends with a bound, so the
//! largest bound of all is an upper bound of the directed distance whatever
//! an iteration did: one that fails can only loosen.

mod across;
mod at_once;
mod balance;
mod blend;
mod bound;
mod candidates;
mod cell_bounds;
mod certify;
mod claim;
mod climb;
mod compare;
mod corners;
mod correspond;
mod extreme;
mod feet;
mod foot_map;
mod met;
mod nearest;
mod on_sphere;
mod profile;
mod quadratic;
mod queue;
mod raise;
mod region;
mod search;
mod side;
mod step;

pub(crate) use certify::ON_B;
pub(crate) use feet::Foot;
pub(crate) use region::{Cell, Domain, MAX_ASPECT, SearchNode};
pub(crate) use search::{BatchResult, BranchAndBound, Interval};
pub(crate) use side::Operand;

pub use quadratic::Quadratic;
pub use search::Stop;
