//! What is stated of a body whose boundary meets itself.

use serde::Serialize;

/// A place at which the boundary of a body encloses space twice, or turned over.
///
/// Guarantee (lemma S7 of docs/solids.md): the closed boundary of the body, with the strips that close its gaps, meets
/// itself: it winds about points of the ball and about others near by with numbers that differ by 2 or more. The gaps
/// of the body are smaller than the ball.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct SelfOverlap {
    /// The middle of the ball.
    pub point: [f64; 3],
    /// The radius of the ball, which has no points of the boundary.
    pub radius: f64,
    /// The number of times that the boundary winds about it, 1 or 0 in a body that does not meet itself: 2 or more in
    /// matter that counts twice, -1 or less where walls have passed through each other.
    pub winding: i32,
    /// The indices of the two faces that cross near by, in the body; none of a mesh.
    pub faces: Vec<usize>,
}
