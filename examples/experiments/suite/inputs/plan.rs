//! The plan of the sweeps in `sweep.json`, which the page in `www` reads as well.

use super::super::Anyhow;
use serde::Deserialize;

/// The content of the file.
#[derive(Debug, Deserialize)]
#[serde(bound(deserialize = "'de: 'static"))]
pub(crate) struct Plan {
    /// The table's columns, in order.
    pub(crate) columns: Vec<&'static str>,
    /// The largest distance of A's centre from B's along the path, relative to the
    /// distance at which their boxes separate.
    pub(crate) reach: f64,
    /// The number of projections beyond which a method that tries all patches runs at
    /// the middle position only, and there only if it subdivides none.
    pub(crate) most_projections: usize,
    /// Runs at one position are repeated up to `rounds` times while all of them
    /// together take less than this many seconds; the shortest time counts.
    pub(crate) repeated_seconds: f64,
    pub(crate) rounds: usize,
    /// The number of passes over the positions for methods that take less than that.
    pub(crate) passes: usize,
    pub(crate) pairs: Vec<PairPlan>,
}

/// Two models, and the path of A past B.
#[derive(Debug, Deserialize)]
pub(crate) struct PairPlan {
    /// The short name, used in file names.
    pub(crate) name: &'static str,
    pub(crate) a: Source,
    pub(crate) b: Source,
    /// The direction of A's path through B.
    pub(crate) axis: [f64; 3],
    /// The offset of A's path from B's centre, in diagonals of B: equal bodies do not
    /// coincide, and no symmetry helps.
    pub(crate) aside: [f64; 3],
}

/// The source of a model.
#[derive(Debug, Clone, Copy, Deserialize)]
pub(crate) struct Source {
    /// The name of a shape.
    pub(crate) shape: &'static str,
    /// The third-party model that the shape replaces where its file does not exist.
    #[serde(rename = "for")]
    pub(crate) stands_for: Option<&'static str>,
    /// Whether to use only the first surface of that model.
    #[serde(default)]
    pub(crate) first_surface: bool,
}

impl Plan {
    pub(crate) fn read() -> Anyhow<Self> {
        Ok(serde_json::from_str(include_str!("../../sweep.json"))?)
    }
}
