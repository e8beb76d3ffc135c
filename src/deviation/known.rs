//! What is known of a model whose map is made.

use serde::Deserialize;

/// What is known of a model that is shown, and shown with it.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct KnownDeviation {
    /// A known upper bound on the distance of all its points from the other model, or one for each
    /// face: no deviation shown exceeds it.
    pub uppers: Vec<f64>,
    /// The farthest point found.
    pub farthest: Option<FarthestPoint>,
}

/// A point of a model with its nearest point on the other one, both in the coordinates of a result.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct FarthestPoint {
    /// Index of the face that has the point.
    pub face: usize,
    /// The point.
    pub point: [f64; 3],
    /// Its nearest point.
    pub foot: [f64; 3],
}
