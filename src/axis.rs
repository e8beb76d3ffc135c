//! The two parameter directions of a surface.

use std::ops::{Index, IndexMut};

/// A parameter direction of a surface: u or v, on a Bézier patch s or t.
///
/// A pair with one entry per direction can be indexed by it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Axis {
    /// The first parameter, u or s.
    U = 0,
    /// The second parameter, v or t.
    V = 1,
}

impl Axis {
    /// Both axes in order.
    pub const BOTH: [Self; 2] = [Self::U, Self::V];

    /// Returns 0 for u and 1 for v.
    #[must_use]
    #[inline]
    pub const fn index(self) -> usize {
        self as usize
    }

    /// Returns v for u and u for v.
    #[must_use]
    #[inline]
    pub const fn other(self) -> Self {
        match self {
            Self::U => Self::V,
            Self::V => Self::U,
        }
    }

    /// Returns the axis of the larger of two values, u if neither is larger.
    #[must_use]
    #[inline]
    pub fn of_larger([u, v]: [f64; 2]) -> Self {
        if v > u { Self::V } else { Self::U }
    }
}

impl std::fmt::Display for Axis {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(match self {
            Self::U => "u",
            Self::V => "v",
        })
    }
}

impl<T> Index<Axis> for [T; 2] {
    type Output = T;

    #[inline]
    fn index(&self, axis: Axis) -> &T {
        &self[axis.index()]
    }
}

impl<T> IndexMut<Axis> for [T; 2] {
    #[inline]
    fn index_mut(&mut self, axis: Axis) -> &mut T {
        &mut self[axis.index()]
    }
}
