//! Bounds of a patch's derivatives over parts of it.

use super::{DerivativeBounds, Patch, PatchSet, center_grid};
use crate::param_box::ParamBox;
use glam::Vec4Swizzles;
use std::sync::OnceLock;

/// Equal parts of a patch along each direction: on a sphere's patches, bounds
/// of third derivatives over a part are up to twice as close.
const PARTS: u32 = 4;
const PART: f64 = 1.0 / PARTS as f64;

/// Times that the part at a degenerate edge is halved. Derivatives along that
/// edge vanish in proportion to the distance from it, which only bounds over
/// ever narrower parts show; over still narrower ones rounding weighs more.
const GRADES: u32 = 8;

/// Width of a box from which on bounds over parts are not worth their making.
const WIDE: f64 = 0.25;

/// How far beyond an edge at which a patch was cut its controls are followed.
pub(crate) const BEYOND: f64 = 0.125;

/// Degrees in s and t together up to which they are followed: `|1 - x| + |x|`
/// is at most 1.25 there, and 1.23 from there to the other edge's, so rounding
/// grows by no more than `1.25^9 < 8`, and beyond both edges `1.53^9 < 46`.
pub(crate) const MAX_DEGREES: usize = 9;

/// Rounding of a part's controls relative to the patch's largest: three of
/// 2^-53 for each of two restrictions and each degree, or some hundred inside,
/// which beyond both edges grow by less than 46.
const ROUNDING: f64 = 2048.0 * f64::EPSILON;

/// Net points of an edge are one when this near, relative to the patch's radius.
const DEGENERATE: f64 = 1e-12;

/// Bounds over the whole patch, over all of its room, and over parts, made when
/// first asked for.
#[derive(Debug)]
pub struct LocalDerivativeBounds {
    whole: OnceLock<DerivativeBounds>,
    roomy: OnceLock<DerivativeBounds>,
    /// The parameters, by axis, at which the patch's controls tell points of
    /// the model: [0, 1], and a little more where it was cut.
    pub room: ParamBox,
    parts: OnceLock<Parts>,
}

/// A grid of parts.
#[derive(Debug)]
struct Parts {
    lines: [Vec<f64>; 2],
    bounds: Vec<OnceLock<DerivativeBounds>>,
}

impl LocalDerivativeBounds {
    /// Of a patch for which `room` holds.
    #[must_use]
    pub fn new(room: ParamBox) -> Self {
        Self { whole: OnceLock::new(), roomy: OnceLock::new(), room, parts: OnceLock::new() }
    }

    /// Bounds over [0, 1]^2 of the patch that these are of. O(p q) at first.
    pub fn whole(&self, patch: &Patch<'_>) -> &DerivativeBounds {
        self.whole.get_or_init(|| patch.derivative_bounds())
    }

    /// Bounds over [0, 1]^2, or over the whole room where the box, which must
    /// lie in it, does not lie in that. O(p q (p + q)) at first.
    pub fn about(&self, patch: &Patch<'_>, low: [f64; 2], high: [f64; 2]) -> &DerivativeBounds {
        if low.into_iter().chain(high).all(|parameter| (0.0..=1.0).contains(&parameter)) {
            return self.whole(patch);
        }
        self.roomy.get_or_init(|| patch.bounds_over(self.room[0], self.room[1]))
    }

    /// Bounds over the box, which must lie in the room, of the patch that
    /// these are of: those of all parts that it touches. O(parts touched), and
    /// O(p q (p + q)) for each when it is first touched.
    #[must_use]
    pub fn over(&self, patch: &Patch<'_>, low: [f64; 2], high: [f64; 2]) -> DerivativeBounds {
        if (0..2).any(|axis| high[axis] - low[axis] > WIDE) {
            return *self.about(patch, low, high);
        }
        let radius = self.whole(patch).radius;
        let Parts { lines, bounds } = self.parts.get_or_init(|| Parts::new(patch, radius, self.room));
        let touched = [0, 1].map(|axis| {
            let lines = &lines[axis];
            let first = lines.partition_point(|&line| line <= low[axis]).clamp(1, lines.len() - 1) - 1;
            first..lines.partition_point(|&line| line < high[axis]).clamp(first + 1, lines.len() - 1)
        });
        let [rows, columns] = touched;
        let mut all = DerivativeBounds { radius, ..DerivativeBounds::default() };
        for s in rows {
            for t in columns.clone() {
                let part =
                    || patch.bounds_over([lines[0][s], lines[0][s + 1]], [lines[1][t], lines[1][t + 1]]);
                all.enclose(bounds[s * (lines[1].len() - 1) + t].get_or_init(part));
            }
        }
        all
    }
}

impl Parts {
    fn new(patch: &Patch<'_>, radius: f64, room: ParamBox) -> Self {
        let lines = [0, 1].map(|axis| {
            let [low, high] = room[axis];
            let grades =
                [0, 1].map(|end| if is_degenerate(patch, axis, end == 1, radius) { GRADES } else { 0 });
            let mut lines = vec![0.0];
            if low < 0.0 {
                lines.insert(0, low);
            }
            for halvings in (1..=grades[0]).rev() {
                lines.push(PART / f64::from(1_u32 << halvings));
            }
            for part in 1..PARTS {
                lines.push(PART * f64::from(part));
            }
            for halvings in 1..=grades[1] {
                lines.push(1.0 - PART / f64::from(1_u32 << halvings));
            }
            lines.push(1.0);
            if high > 1.0 {
                lines.push(high);
            }
            lines
        });
        let mut bounds = Vec::new();
        bounds.resize_with((lines[0].len() - 1) * (lines[1].len() - 1), OnceLock::new);
        Self { lines, bounds }
    }
}

/// Whether an edge along which `axis` is constant is a point.
fn is_degenerate(patch: &Patch<'_>, axis: usize, at_end: bool, radius: f64) -> bool {
    let columns = patch.degree[1] + 1;
    let steps = patch.degree[1 - axis];
    let (across, along) = if axis == 0 { (columns, 1) } else { (1, columns) };
    let first = if at_end { patch.degree[axis] * across } else { 0 };
    let point = |step: usize| {
        let control = patch.controls[first + step * along];
        control.xyz() / control.w
    };
    (1..=steps).all(|step| point(step).distance(point(0)) <= DEGENERATE * radius)
}

impl Patch<'_> {
    /// Bounds over a box by the patch's parameters: the recursion's excess is
    /// proportional to the box's size, as its weights and its points about
    /// its own centre then vary less.
    fn bounds_over(&self, s: [f64; 2], t: [f64; 2]) -> DerivativeBounds {
        let controls = self.restricted(s, t);
        let part = Patch { controls: &controls, ..*self };
        let mut centered = PatchSet::default();
        centered.push_centered(part, center_grid(part.bounding_box().diagonal()));
        let mut lost = [0.0_f64; 2];
        for control in self.controls {
            let size = [control.xyz().length(), control.w];
            lost = [0, 1].map(|kind| lost[kind].max(ROUNDING * size[kind]));
        }
        centered.patch(0).derivative_bounds_within(lost).slower([s[1] - s[0], t[1] - t[0]])
    }
}
