//! Upper bounds on the derivatives of a face's surface about its loops.

use crate::bezier::Patch;
use crate::param_box::ParamBox;
use crate::rounding::upper_max;

/// The factor between a bound and the largest derivative found at centres of parts above which
/// parts are cut: bounds from control points are excessive where weights differ much.
const MAX_EXCESS: f64 = 8.0;

/// Maximum rounds of cutting, each halving both sides of a part, and the number of parts
/// beyond which there is no other.
const MAX_ROUNDS: usize = 8;
const MAX_PARTS: usize = 1024;

/// A part of a rectangle of knots with the bounds over it, by the face's parameters.
struct KnotPart<'a> {
    patch: Patch<'a>,
    rectangle: ParamBox,
    /// The part in the patch's own parameters.
    own: ParamBox,
    bounds: [f64; 2],
}

impl<'a> KnotPart<'a> {
    fn new(patch: Patch<'a>, rectangle: ParamBox, own: ParamBox) -> Self {
        let is_whole = own == ParamBox::UNIT;
        let bounds =
            if is_whole { patch.derivative_bounds() } else { patch.bounds_over(own[0], own[1]) }.first;
        let lengths = rectangle.lengths();
        Self { patch, rectangle, own, bounds: [0, 1].map(|axis| bounds[axis] / lengths[axis]) }
    }

    /// Returns the lengths of the derivatives at the centre.
    fn sampled(&self) -> [f64; 2] {
        let jet = self.patch.jet(self.own.at([0.5; 2]));
        let lengths = self.rectangle.lengths();
        [jet.s.length() / lengths[0], jet.t.length() / lengths[1]]
    }

    /// Returns the quarters that touch a box of the face's parameters.
    fn quarters(&self, within: ParamBox) -> impl Iterator<Item = Self> + '_ {
        let halves = [0, 1].map(|axis| {
            let [low, high] = self.own[axis];
            let middle = 0.5 * (low + high);
            [[low, middle], [middle, high]]
        });
        let quarters = halves[0].into_iter().flat_map(move |u| halves[1].map(|v| ParamBox::new(u, v)));
        quarters
            .filter(move |own| self.touches(*own, within))
            .map(|own| Self::new(self.patch, self.rectangle, own))
    }

    fn touches(&self, own: ParamBox, within: ParamBox) -> bool {
        let [low, high] = [self.rectangle.at(own.low()), self.rectangle.at(own.high())];
        (0..2).all(|axis| low[axis] <= within[axis][1] && within[axis][0] <= high[axis])
    }
}

/// Returns upper bounds on the derivatives, over the patches of these rectangles of knots, where
/// those touch a box of the face's parameters. O(parts p q (p + q)).
pub(super) fn bounds<'a>(patches: impl Iterator<Item = (Patch<'a>, ParamBox)>, within: ParamBox) -> [f64; 2] {
    let mut parts: Vec<KnotPart<'a>> =
        patches.map(|(patch, rectangle)| KnotPart::new(patch, rectangle, ParamBox::UNIT)).collect();
    let (mut settled, mut sampled) = ([0.0_f64; 2], [0.0_f64; 2]);
    for round in 0.. {
        for part in &parts {
            let found = part.sampled();
            sampled = [0, 1].map(|axis| upper_max(sampled[axis], found[axis]));
        }
        let is_last = round == MAX_ROUNDS || parts.len() > MAX_PARTS;
        let mut cut = Vec::new();
        for part in &parts {
            // False for NaN.
            let is_excessive = (0..2).any(|axis| part.bounds[axis] > MAX_EXCESS * sampled[axis]);
            if is_excessive && !is_last {
                cut.extend(part.quarters(within));
            } else {
                settled = [0, 1].map(|axis| upper_max(settled[axis], part.bounds[axis]));
            }
        }
        if cut.is_empty() {
            break;
        }
        parts = cut;
    }
    settled
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::model::{NurbsSurface, SurfaceArrays};
    use crate::untrim::testing::face_within;

    /// (u, v) ↦ (u², v³), whose derivatives are largest at the end, 2 and 3, and 1 and 0.75 at the
    /// centre.
    #[test]
    fn derivatives_at_the_end_are_within_the_bounds() {
        let control_points = (0..12)
            .map(|k| [f64::from(u8::from(k / 4 == 2)), f64::from(u8::from(k % 4 == 3)), 0.0, 1.0])
            .collect();
        let knots = [2, 3].map(|degree: usize| {
            let mut knots = vec![0.0; degree + 1];
            knots.extend(vec![1.0; degree + 1]);
            knots
        });
        let arrays = SurfaceArrays { degree: [2, 3], knots, counts: [3, 4], control_points };
        let surface = NurbsSurface::new(0, arrays).unwrap();
        let face = face_within(&surface, &[&[[0.1, 0.1], [0.9, 0.2], [0.5, 0.9]]]);
        let whole = [(face.patch([0, 0]), face.rectangle([0, 0]))];
        let [in_u, in_v] = bounds(whole.into_iter(), ParamBox::UNIT);
        assert!(in_u >= 2.0 && in_v >= 3.0, "{in_u} {in_v}");
    }
}
