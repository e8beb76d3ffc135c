//! Rectangles in a parameter plane.

use crate::axis::Axis;
use bytemuck::Zeroable;
use std::ops::{Index, IndexMut};

/// A closed rectangle of parameters: one interval `[low, high]` per axis.
///
/// It is indexed by an [`Axis`] or by 0 and 1.
#[derive(Debug, Clone, Copy, PartialEq, Default, Zeroable)]
pub struct ParamBox {
    intervals: [[f64; 2]; 2],
}

impl ParamBox {
    /// The domain [0, 1]² of a Bézier patch.
    pub const UNIT: Self = Self::new([0.0, 1.0], [0.0, 1.0]);

    /// Makes the rectangle `u` × `v`, both `[low, high]`.
    #[must_use]
    pub const fn new(u: [f64; 2], v: [f64; 2]) -> Self {
        Self { intervals: [u, v] }
    }

    /// Returns the smallest parameters.
    #[must_use]
    #[inline]
    pub fn low(&self) -> [f64; 2] {
        self.intervals.map(|[low, _]| low)
    }

    /// Returns the largest parameters.
    #[must_use]
    #[inline]
    pub fn high(&self) -> [f64; 2] {
        self.intervals.map(|[_, high]| high)
    }

    /// Returns the lengths of the two intervals.
    #[must_use]
    #[inline]
    pub fn lengths(&self) -> [f64; 2] {
        self.intervals.map(|[low, high]| high - low)
    }

    /// Returns the centre.
    #[must_use]
    #[inline]
    pub fn middle(&self) -> [f64; 2] {
        self.intervals.map(|[low, high]| 0.5 * (low + high))
    }

    /// Returns the parameters at `fractions` of the two intervals; 0 and 1 give the ends exactly.
    #[must_use]
    #[inline]
    pub fn at(&self, fractions: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| {
            let ([low, high], fraction) = (self.intervals[axis], fractions[axis]);
            (1.0 - fraction) * low + fraction * high
        })
    }

    /// Returns the two halves along `axis`, which share the middle.
    #[must_use]
    #[inline]
    pub fn halves(&self, axis: Axis) -> [Self; 2] {
        let middle = self.middle()[axis];
        let mut halves = [*self; 2];
        halves[0][axis][1] = middle;
        halves[1][axis][0] = middle;
        halves
    }

    /// Returns whether the parameters lie in the rectangle, its edges included; false for NaN.
    #[must_use]
    #[inline]
    pub fn contains(&self, parameters: [f64; 2]) -> bool {
        (0..2).all(|axis| {
            let [low, high] = self.intervals[axis];
            (low..=high).contains(&parameters[axis])
        })
    }

    /// Returns whether `other` lies in this rectangle; they may share edges.
    #[must_use]
    #[inline]
    pub fn contains_box(&self, other: &Self) -> bool {
        self.contains(other.low()) && self.contains(other.high())
    }

    /// Returns the smallest rectangle that contains both.
    #[must_use]
    pub(crate) fn union(&self, other: &Self) -> Self {
        let around = |axis: usize| {
            let ([a, b], [c, d]) = (self.intervals[axis], other.intervals[axis]);
            [if a < c { a } else { c }, if b > d { b } else { d }]
        };
        Self::new(around(0), around(1))
    }

    /// Returns the two intervals.
    #[must_use]
    #[inline]
    pub const fn intervals(&self) -> [[f64; 2]; 2] {
        self.intervals
    }
}

impl From<[[f64; 2]; 2]> for ParamBox {
    fn from([u, v]: [[f64; 2]; 2]) -> Self {
        Self::new(u, v)
    }
}

impl Index<usize> for ParamBox {
    type Output = [f64; 2];

    #[inline]
    fn index(&self, axis: usize) -> &[f64; 2] {
        &self.intervals[axis]
    }
}

impl IndexMut<usize> for ParamBox {
    #[inline]
    fn index_mut(&mut self, axis: usize) -> &mut [f64; 2] {
        &mut self.intervals[axis]
    }
}

impl Index<Axis> for ParamBox {
    type Output = [f64; 2];

    #[inline]
    fn index(&self, axis: Axis) -> &[f64; 2] {
        &self.intervals[axis.index()]
    }
}

impl IndexMut<Axis> for ParamBox {
    #[inline]
    fn index_mut(&mut self, axis: Axis) -> &mut [f64; 2] {
        &mut self.intervals[axis.index()]
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    const BOX: ParamBox = ParamBox::new([1.0, 3.0], [-4.0, 4.0]);

    #[test]
    fn halves_share_the_middle_and_cover_the_rectangle() {
        let [low, high] = BOX.halves(Axis::V);
        assert_eq!(low, ParamBox::new([1.0, 3.0], [-4.0, 0.0]));
        assert_eq!(high, ParamBox::new([1.0, 3.0], [0.0, 4.0]));
        assert!(BOX.contains_box(&low) && BOX.contains_box(&high) && !low.contains_box(&BOX));
    }

    #[test]
    fn fractions_and_ends() {
        assert_eq!((BOX.low(), BOX.high()), (BOX.at([0.0; 2]), BOX.at([1.0; 2])));
        assert_eq!((BOX.middle(), BOX.lengths()), (BOX.at([0.5; 2]), [2.0, 8.0]));
        assert!(BOX.contains(BOX.low()) && !BOX.contains([f64::NAN, 0.0]) && !BOX.contains([0.9, 0.0]));
    }
}
