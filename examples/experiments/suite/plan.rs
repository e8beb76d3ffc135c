//! What is swept, and how: `sweep.json`, which the page in `www` reads as well.

use super::Anyhow;
use serde::Deserialize;

/// The file's content.
#[derive(Debug, Deserialize)]
#[serde(bound(deserialize = "'de: 'static"))]
pub(crate) struct Plan {
    /// The table's columns, in order.
    pub(crate) columns: Vec<&'static str>,
    /// How far A goes from B's centre, relative to where their boxes part.
    pub(crate) reach: f64,
    /// Projections of samples on patches beyond which a method that tries all
    /// patches is run in the middle only, and there only if it cuts none.
    pub(crate) most_projections: usize,
    /// Runs at one position are repeated `rounds` times, while all of them
    /// together take less, in seconds, and the shortest time is told.
    pub(crate) repeated_seconds: f64,
    pub(crate) rounds: usize,
    /// Passes over the positions, of methods that take less than that.
    pub(crate) passes: usize,
    pub(crate) pairs: Vec<PairPlan>,
}

/// Two models, and the way of A past B.
#[derive(Debug, Deserialize)]
pub(crate) struct PairPlan {
    /// Short, for file names.
    pub(crate) name: &'static str,
    pub(crate) a: Source,
    pub(crate) b: Source,
    /// A moves along it through B.
    pub(crate) axis: [f64; 3],
    /// What A passes B's centre at, in B's diagonals: off the centre, so that
    /// equal bodies do not coincide and no symmetry helps.
    pub(crate) aside: [f64; 3],
}

/// Where a model comes from.
#[derive(Debug, Clone, Copy, Deserialize)]
pub(crate) struct Source {
    /// A shape's name.
    pub(crate) shape: &'static str,
    /// The model of others that the shape stands in for.
    #[serde(rename = "for")]
    pub(crate) stands_for: Option<&'static str>,
    /// Whether only the first surface of that model is meant.
    #[serde(default)]
    pub(crate) first_surface: bool,
}

impl Plan {
    pub(crate) fn read() -> Anyhow<Self> {
        Ok(serde_json::from_str(include_str!("../sweep.json"))?)
    }
}
