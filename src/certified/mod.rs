//! Method `certified`: an interval of the requested width.
//!
//! Theorem. Let nodes cover A, each with an upper bound on the distance of its
//! points to B, and let `lower` be a lower bound on the distance to B of one
//! point of A, the witness. Then the directed distance lies between `lower` and
//! the largest of the upper bounds.
//!
//! A branch and bound ([`search`]) narrows that interval. It bounds nodes
//! ([`bounds`]), prunes those whose upper bound is within the tolerance of
//! `lower`, and branches the others; far points that it comes across ascend to
//! local maxima ([`ascent`]), whose distances are certified and raise `lower`.
//! Both need nearest points on B ([`nearest`]). Every node ends with an upper
//! bound, so an iteration that fails can loosen the interval and not falsify
//! it. `docs/method.md` has the proofs.

mod ascent;
mod audit;
mod bounds;
mod cell;
mod cell_context;
mod faces;
mod generatrix;
mod maximin;
mod near_copies;
mod nearest;
mod operand;
mod reparametrization;
mod rounding;
mod search;
mod sheets;
mod spread;
#[cfg(all(test, not(target_arch = "wasm32")))]
pub(crate) mod testing;

pub(crate) use audit::{Refutation, SpreadRefutation, audit_whole};
pub(crate) use cell::{Cell, MAX_ASPECT};
pub(crate) use faces::{OnSheet, TrimmedFaces};
pub(crate) use generatrix::Generatrix;
pub(crate) use near_copies::blocks::Block;
pub(crate) use nearest::Foot;
pub(crate) use operand::{Operand, Pair};
pub(crate) use search::{BatchResult, BranchAndBound, Domain, Gains, SearchNode};

pub(crate) use sheets::{SheetCache, Sheets};
pub(crate) use spread::{CellSpread, Density, LinearBounds, SpreadStart, Spreads};

pub use audit::{Audit, AuditReport, Lemma, Lemmas};
#[cfg(feature = "internals")]
pub use bounds::Quadratic;
