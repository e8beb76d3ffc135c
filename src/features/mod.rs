//! Feature edges: where a surface turns by more than an angle, and where it ends (docs/score.md, lemmas E1 to E4).

mod comparison;
mod edges;
mod faces;
mod piece;
mod turn;

pub(crate) use comparison::Counterparts;
pub(crate) use edges::FeatureEdges;
pub(crate) use faces::Faces;
pub(crate) use piece::Piece;
pub(crate) use turn::Sharpness;
