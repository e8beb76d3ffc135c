//! Bounds of the surface's derivatives over parts of a knot rectangle, which get smaller with the part.

use crate::proof::bezier::{Net, SecondDerivatives};
use crate::proof::interval::Interval;
use std::cell::OnceCell;

/// The halvings of a knot rectangle along each axis.
pub(super) const MAX_HALVINGS: u32 = 6;

/// A part of a knot rectangle, in parts of that.
pub(super) struct Region {
    net: Net,
    range: [[f64; 2]; 2],
    halvings: [u32; 2],
    /// With the region's size for the unit.
    bends: SecondDerivatives,
    /// Along both axes, once they are needed.
    halves: [OnceCell<Box<[Region; 2]>>; 2],
}

impl Region {
    /// The whole rectangle.
    pub(super) fn whole(net: &Net) -> Self {
        Self::new(net.clone(), [[0.0, 1.0]; 2], [0; 2])
    }

    fn new(net: Net, range: [[f64; 2]; 2], halvings: [u32; 2]) -> Self {
        let bends = SecondDerivatives::of(&net);
        Self { net, range, halvings, bends, halves: Default::default() }
    }

    /// Returns the bounds over a region that contains a box, and that region's size.
    ///
    /// What leaves the rectangle is near the outermost region, which takes it.
    pub(super) fn around(&self, target: &[Interval; 2]) -> (&SecondDerivatives, [f64; 2]) {
        for axis in 0..2 {
            let [low, high] = self.range[axis];
            let middle = 0.5 * (low + high);
            if self.halvings[axis] == MAX_HALVINGS || (target[axis].lo < middle && target[axis].hi > middle) {
                continue;
            }
            let half = usize::from(target[axis].lo >= middle);
            return self.halves(axis, middle)[half].around(target);
        }
        (&self.bends, self.range.map(|[low, high]| high - low))
    }

    fn halves(&self, axis: usize, middle: f64) -> &[Self; 2] {
        self.halves[axis].get_or_init(|| {
            let [low, high] = self.range[axis];
            let mut halvings = self.halvings;
            halvings[axis] += 1;
            let [first, second] = self.net.split(axis);
            Box::new([(first, [low, middle]), (second, [middle, high])].map(|(net, part)| {
                let mut range = self.range;
                range[axis] = part;
                Self::new(net, range, halvings)
            }))
        })
    }
}
