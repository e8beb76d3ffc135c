//! Rectangles of A's patches.

/// A rectangle of a patch of A.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cell {
    /// The patch.
    pub(crate) patch: u32,
    /// Its centre (s, t).
    pub(crate) center: [f64; 2],
    /// Half its width in s and t.
    pub(crate) half: [f64; 2],
}

/// Ratio of a cell's side lengths up to which both sides are halved; else only
/// the longer one is.
pub(crate) const MAX_ASPECT: f64 = 2.0;

impl Cell {
    /// A whole patch.
    pub(crate) fn whole(patch: u32) -> Self {
        Self { patch, center: [0.5; 2], half: [0.5; 2] }
    }

    pub(super) fn is_whole(&self) -> bool {
        self.half == [0.5; 2]
    }

    /// The (s, t) of a place (σ, τ) in [-1, 1]^2.
    pub(crate) fn at(&self, place: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| (self.center[axis] + place[axis] * self.half[axis]).clamp(0.0, 1.0))
    }

    /// The range of s and that of t.
    pub(crate) fn ranges(&self) -> [[f64; 2]; 2] {
        [0, 1].map(|axis| [self.center[axis] - self.half[axis], self.center[axis] + self.half[axis]])
    }

    /// An upper bound on the distance of the cell's points from that of its
    /// centre, given bounds of the lengths of A's first derivatives.
    pub(super) fn radius(&self, [s, t]: [f64; 2]) -> f64 {
        self.half[0] * s + self.half[1] * t
    }

    /// Whether s and t are along the cell's longer side, or along both where they are about
    /// equally long, by the same lengths of derivatives.
    pub(super) fn longer_sides(&self, [s, t]: [f64; 2]) -> [bool; 2] {
        let lengths = [s * self.half[0], t * self.half[1]];
        [lengths[0] * MAX_ASPECT >= lengths[1], lengths[1] * MAX_ASPECT >= lengths[0]]
    }

    /// The parts of the cell halved along s, along t, or along both.
    pub(crate) fn halves(&self, is_halved: [bool; 2]) -> impl Iterator<Item = Self> + use<> {
        let cell = *self;
        let half = [0, 1].map(|axis| if is_halved[axis] { 0.5 * cell.half[axis] } else { cell.half[axis] });
        let sides = is_halved.map(|is_halved| if is_halved { &[-1.0, 1.0][..] } else { &[0.0][..] });
        sides[0].iter().flat_map(move |&s| {
            sides[1].iter().map(move |&t| Self {
                patch: cell.patch,
                center: [cell.center[0] + s * half[0], cell.center[1] + t * half[1]],
                half,
            })
        })
    }
}
