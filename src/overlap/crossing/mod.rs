//! Pieces that the other boundary crosses near a level set: lemma O3 of docs/facts.md.

mod half_square;
mod level;

use super::carrier::Form;
use super::density::Slopes;
use super::piece::Weight;
use crate::axis::Axis;
use crate::interval::Interval;
use crate::rounding::gamma;
pub(super) use half_square::Affine;
pub(super) use level::Level;

/// The roundings of the value of an affine function, relative to its size.
const VALUE_ROUNDINGS: f64 = 8.0;

/// The parameters of a piece's corners, in the order of its control points.
pub(super) const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]];

/// Two convex parts of the square of a piece's parameters in which it has no point of the other boundary.
#[derive(Debug, Clone, Copy)]
pub(super) struct Crossing {
    height: Affine,
    /// The value above which the first part lies, and that below which the second one does.
    levels: [f64; 2],
    /// Whether the parts are inside the other solid, where that is known.
    pub(super) is_inside: [Option<bool>; 2],
}

impl Crossing {
    /// Returns the parts in which a function is certain to be above and below two values.
    pub(super) fn new(form: &Form, [above, below]: [f64; 2]) -> Self {
        let (height, [low, high]) = form.affine();
        let levels = [(above - low).next_up(), (below - high).next_down()];
        Self { height, levels, is_inside: [None; 2] }
    }

    /// Returns whether one of the parts is the whole square.
    pub(super) fn is_one_part(&self) -> bool {
        let first = self.part(0);
        first.is_some() && (1..CORNERS.len()).all(|corner| self.part(corner) == first)
    }

    /// Returns a corner of the square in each part, where one has any.
    pub(super) fn corners(&self) -> [Option<usize>; 2] {
        [0, 1].map(|part| (0..CORNERS.len()).find(|&corner| self.part(corner) == Some(part)))
    }

    /// Returns whether a corner of the square is inside the other solid, where that is known.
    pub(super) fn side(&self, corner: usize) -> Option<bool> {
        self.part(corner).and_then(|part| self.is_inside[part])
    }

    /// Returns the part that a corner lies in.
    fn part(&self, corner: usize) -> Option<usize> {
        let error = gamma(VALUE_ROUNDINGS) * self.height.size();
        let value = self.height.at(CORNERS[corner]);
        if value - error > self.levels[0] {
            Some(0)
        } else if value + error < self.levels[1] {
            Some(1)
        } else {
            None
        }
    }

    /// Returns the parts of a half of the square.
    pub(super) fn half(&self, axis: Axis, is_high: bool) -> Self {
        let height = self.height.half(axis, is_high);
        let error = gamma(VALUE_ROUNDINGS) * self.height.size();
        Self { height, levels: [self.levels[0] + error, self.levels[1] - error], ..*self }
    }

    /// Returns the interval of ⅓ ∫ b (x − origin)·n over a piece, b being 1 inside the other solid, 0 outside and
    /// anything between on its boundary. `cone` is the integral without b for the computed piece, and exact points are
    /// off from its own by at most `moved`.
    pub(super) fn inner(&self, slopes: &Slopes, weight: &Weight, cone: Interval, moved: f64) -> Interval {
        let above = self.height.part_above(self.levels[0]);
        let one = Interval::exactly(1.0);
        let below = one - self.height.part_above(self.levels[1]);
        let between = (one - above - below).not_negative();
        let variation = slopes.variation(weight.radius);
        let density = cone + Interval::about(0.0, variation);
        // Any part of a region, up to the region.
        let any = |part: Interval| {
            let all = density * part;
            Interval {
                lower: if all.lower < 0.0 { all.lower } else { 0.0 },
                upper: if all.upper > 0.0 { all.upper } else { 0.0 },
            }
        };
        let side = |is_inside: Option<bool>, part: Interval| match is_inside {
            Some(false) => Interval::exactly(0.0),
            Some(true) => {
                // The densities of a part and of the rest are off by the same sum.
                let smaller = part.smaller(one - part).upper;
                cone * part + Interval::about(0.0, variation * smaller)
            }
            None => any(part.not_negative()),
        };
        let [inside_above, inside_below] = self.is_inside;
        let sum = side(inside_above, above) + side(inside_below, below) + any(between);
        sum + Interval::about(0.0, 3.0 * weight.displacement(moved, slopes.border()))
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::bezier::extract;
    use crate::overlap::BoundarySide;
    use crate::overlap::piece::Patches;
    use crate::shapes;
    use glam::DVec3;

    fn crossing(middle: f64, slopes: [f64; 2], levels: [f64; 2]) -> Crossing {
        Crossing { height: Affine { middle, slopes }, levels, is_inside: [Some(true), Some(false)] }
    }

    #[test]
    fn corners_are_those_of_the_parts() {
        let across = crossing(0.0, [2.0, 1.0], [0.25, -1.25]);
        // The corners' values are −1.5, −0.5, 0.5 and 1.5.
        assert_eq!([0, 1, 2, 3].map(|corner| across.part(corner)), [Some(1), None, Some(0), Some(0)]);
        assert_eq!(across.corners(), [Some(2), Some(0)]);
        assert_eq!([0, 1, 2].map(|corner| across.side(corner)), [Some(false), None, Some(true)]);
        assert!(!across.is_one_part());
        assert!(crossing(2.0, [2.0, 1.0], [0.25, -1.25]).is_one_part());
        assert!(crossing(-3.0, [2.0, 1.0], [0.25, -1.25]).is_one_part());
        // Beyond a level by no more than rounding may have made.
        assert_eq!(crossing(0.0, [2.0, 1.0], [1.5 - 1e-15, -1.5 + 1e-15]).corners(), [None; 2]);
        // On a level, and where it is not told from it.
        assert_eq!(crossing(0.0, [2.0, 1.0], [1.5, -1.5 - 1e-17]).corners(), [None; 2]);
        assert_eq!(crossing(f64::NAN, [2.0, 1.0], [0.0; 2]).corners(), [None; 2]);
    }

    /// A function that bends over a piece: corners count as above a value, and below one, only where all of the piece
    /// from there to the line is.
    #[test]
    fn parts_leave_out_what_the_function_differs_by() {
        let ball = |radius: f64| {
            let model = shapes::sphere(DVec3::ZERO, radius).unwrap();
            Patches::new(&extract(&model).patches, std::iter::empty(), None, |_| BoundarySide::Outward)
        };
        let (on, through) = (ball(2.0), ball(1.0));
        let mut bent = 0;
        for (whole, other) in on.faces().zip(through.faces()) {
            let near = (whole, &whole.root);
            let level = Level::around(&[near], (other, &other.root), None).unwrap();
            let piece = &whole.halves(&whole.root).unwrap()[0];
            // A sphere has one value on its own carrier: its affine function is it, up to rounding.
            let own = Crossing::new(&level.form(whole, piece), [1e-6, -1e-6]);
            assert_eq!(own.corners(), [None; 2]);
            let turned = ball(2.0).moved_by(DVec3::new(0.5, 0.25, 0.125));
            for whole in turned.faces() {
                let form = level.form(whole, &whole.root);
                let (function, [low, high]) = form.affine();
                let crossing = Crossing::new(&form, [0.0, 0.0]);
                for (corner, place) in CORNERS.into_iter().enumerate() {
                    let value = function.at(place);
                    bent += usize::from(value.abs() > 1e-9 && value + low < 0.0 && value + high > 0.0);
                    match crossing.part(corner) {
                        Some(0) => assert!(value + low > 0.0, "{value} {low}"),
                        Some(_) => assert!(value + high < 0.0, "{value} {high}"),
                        None => {}
                    }
                }
            }
        }
        assert!(bent > 10, "{bent} corners are near");
    }

    #[test]
    fn a_half_has_the_values_and_sides_of_its_corners() {
        let whole = crossing(0.0, [2.0, 1.0], [0.25, -0.75]);
        let at = |crossing: &Crossing, place| crossing.height.at(place);
        for (axis, is_high, offset) in [
            (Axis::U, false, [0.0, 0.0]),
            (Axis::U, true, [0.5, 0.0]),
            (Axis::V, false, [0.0, 0.0]),
            (Axis::V, true, [0.0, 0.5]),
        ] {
            let half = whole.half(axis, is_high);
            for (corner, place) in CORNERS.into_iter().enumerate() {
                let mut there = place;
                there[axis.index()] *= 0.5;
                let there = [there[0] + offset[0], there[1] + offset[1]];
                let value = at(&whole, there);
                assert_eq!(at(&half, place), value);
                let side = if value > 0.25 { Some(true) } else { (value < -0.75).then_some(false) };
                assert_eq!(half.side(corner), side, "{axis} {is_high} {corner}");
            }
            assert!(half.levels[0] > 0.25 && half.levels[1] < -0.75, "they grow by the rounding");
        }
    }

    /// A plane square whose cones have one density, of which a line cuts off 3/8.
    #[test]
    fn parts_have_their_shares_of_the_cone() {
        let slopes = Slopes { point: [0.0; 2], normal: [0.0; 2] };
        let weight = Weight { area: 1.0, radius: 3.0 };
        let cone = Interval::exactly(1.0);
        let inner = |levels, is_inside| {
            Crossing { is_inside, ..crossing(0.0, [2.0, 0.0], levels) }.inner(&slopes, &weight, cone, 0.0)
        };
        let close = |found: Interval, expected: [f64; 2]| {
            let off = [found.lower - expected[0], found.upper - expected[1]];
            assert!(off.iter().all(|off| off.abs() < 1e-12), "{found:?} without {expected:?}");
        };
        close(inner([0.25, 0.25], [Some(true), Some(false)]), [0.375; 2]);
        close(inner([0.25, 0.25], [Some(false), Some(true)]), [0.625; 2]);
        close(inner([0.25, -0.25], [Some(true), Some(false)]), [0.375, 0.625]);
        close(inner([0.25, -0.25], [Some(true), None]), [0.375, 1.0]);
        close(inner([0.25, -0.25], [None, Some(true)]), [0.375, 1.0]);
        // A density that varies by up to V is off by V times the smaller part.
        let slopes = Slopes { point: [0.5; 2], normal: [0.25; 2] };
        let variation = slopes.variation(weight.radius);
        let found = crossing(0.0, [2.0, 0.0], [0.5, 0.5]).inner(&slopes, &weight, cone, 0.0);
        close(found, [0.25 - 0.25 * variation, 0.25 + 0.25 * variation]);
        let found = crossing(0.0, [2.0, 0.0], [-0.5, -0.5]).inner(&slopes, &weight, cone, 0.0);
        close(found, [0.75 - 0.25 * variation, 0.75 + 0.25 * variation]);
        // Where a part may be inside or outside, the bounds hold for both.
        let unknown = Crossing { is_inside: [None, Some(false)], ..crossing(0.0, [2.0, 0.0], [0.5, 0.5]) };
        let found = unknown.inner(&slopes, &weight, cone, 0.0);
        close(found, [0.0, 0.25 + 0.25 * variation]);
        // Moved by 0.01, with borders of at most 2 about each of the three parts: 3 (1 + 3 · 2 / 3) / 100.
        let found = crossing(0.0, [2.0, 0.0], [0.5, 0.5]).inner(&slopes, &weight, cone, 0.01);
        close(found, [0.25 - 0.25 * variation - 0.09, 0.25 + 0.25 * variation + 0.09]);
    }
}
