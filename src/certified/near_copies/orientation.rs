//! The correspondence of the axes of A and of B.

use crate::axis::Axis;
use crate::certified::reparametrization::Reparametrization;
use glam::{DVec2, DVec4};

/// How the axes of A and of B correspond under a map.
#[derive(Debug, Clone, Copy)]
pub(super) struct Orientation {
    /// Whether σ runs along B's second parameter.
    pub(super) swapped: bool,
    /// Whether B's parameter decreases, by A's axes.
    backwards: [bool; 2],
}

impl Orientation {
    pub(super) fn new(map: &Reparametrization) -> Self {
        let mut orientation = Self { swapped: map.p.y.abs() > map.p.x.abs(), backwards: [false; 2] };
        orientation.backwards = orientation.along(map).map(|derivative| derivative < 0.0);
        orientation
    }

    /// The axis of B that corresponds to an axis of A.
    pub(super) fn axis_of_b(&self, axis: Axis) -> Axis {
        if self.swapped { axis.other() } else { axis }
    }

    /// A pair by A's axes in the order of B's.
    pub(super) fn by_axes_of_b<T>(&self, [s, t]: [T; 2]) -> [T; 2] {
        if self.swapped { [t, s] } else { [s, t] }
    }

    /// Whether B's parameter decreases along an axis of A.
    pub(super) fn is_backwards(&self, axis: Axis) -> bool {
        self.backwards[axis.index()]
    }

    /// The derivatives by σ and τ along B's parameter lines.
    pub(super) fn along(&self, map: &Reparametrization) -> [f64; 2] {
        if self.swapped { [map.p.y, map.q.x] } else { [map.p.x, map.q.y] }
    }

    /// The derivatives by σ and τ across them.
    pub(super) fn across(&self, map: &Reparametrization) -> DVec2 {
        if self.swapped { DVec2::new(map.p.x, map.q.y) } else { DVec2::new(map.p.y, map.q.x) }
    }

    /// The control net of a patch of B in the order of A's parameters.
    pub(super) fn oriented(&self, controls: &[DVec4], [p, q]: [usize; 2]) -> Vec<DVec4> {
        let [rows, columns] = if self.swapped { [q, p] } else { [p, q] };
        let mut oriented = Vec::with_capacity(controls.len());
        for i in 0..=rows {
            for j in 0..=columns {
                let i = if self.backwards[0] { rows - i } else { i };
                let j = if self.backwards[1] { columns - j } else { j };
                let [i, j] = if self.swapped { [j, i] } else { [i, j] };
                oriented.push(controls[i * (q + 1) + j]);
            }
        }
        oriented
    }
}
