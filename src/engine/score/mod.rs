//! The score of a candidate against the truth: every number an interval (docs/score.md).
//!
//! It composes what the engine has: statistics in both directions, the Hausdorff distance, facts, bodies and
//! `diff`. Nothing is sampled, so that there is no seed.

mod matched;
mod numbers;
mod options;
mod parts;
mod placement;
mod requirements;
mod result;
mod search;

pub use numbers::ScoreNumber;
pub use options::{ScoreAlignment, ScoreOptions};
pub use placement::Placement;
pub use requirements::Requirement;
pub use result::{
    AtAngle, AtThreshold, Difference, EdgeLengths, EdgesAt, FaceCounts, HausdorffScore, Score, ScoredModel,
    SurfaceScore,
};
