//! How fine maps become.

/// How fine a map becomes, for what it is looked at in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fineness {
    /// The part of the largest deviation by which the middle of an edge may be off.
    pub(crate) step: f64,
    /// The shortest edge that is split for its deviation, in diagonals.
    pub(crate) min_edge: f64,
    /// The number of edges after which no more are tried.
    pub(crate) max_tried: usize,
}

impl Fineness {
    /// For a screen on which one goes near: less than a legend shows, and edges of a pixel where the model fills
    /// the screen.
    pub(crate) const SCREEN: Self = Self { step: 1.0 / 150.0, min_edge: 1.0 / 1000.0, max_tried: 180_000 };
}
