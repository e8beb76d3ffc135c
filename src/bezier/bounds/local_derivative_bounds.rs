//! Upper bounds on a patch's derivatives over parts of its domain.

use crate::axis::Axis;
use crate::bezier::{DerivativeBounds, Patch, PatchSet, center_grid};
use crate::param_box::ParamBox;
use crate::rounding::gamma;
use glam::Vec4Swizzles;
use std::sync::OnceLock;

/// The number of equal parts of a patch along each axis. On the patches of a
/// sphere, bounds on third derivatives over a part are up to twice as close.
const PARTS: u32 = 4;
/// The width of a part.
const PART: f64 = 1.0 / PARTS as f64;

/// The number of times that the part at a degenerate edge is halved towards the
/// edge. Derivatives along that edge vanish in proportion to the distance from
/// it, so bounds over narrower parts are closer, until rounding dominates.
const GRADES: u32 = 8;

/// The largest width of a box for which bounds over parts are computed; for
/// wider boxes they gain too little to pay for themselves.
const MAX_PART_WIDTH: f64 = 0.25;

/// The parameter distance by which a patch is extrapolated beyond an edge at which it was cut.
pub(crate) const BEYOND: f64 = 0.125;

/// The largest sum of the degrees in s and t of a patch that is extrapolated:
/// there, [`growth`] is at most 46.
pub(crate) const MAX_DEGREES: usize = 9;

/// The largest absolute sum of the two factors of a step of the restriction that
/// goes beyond an edge, `|1 - x| + |x|` with x = 9/8.
const BEYOND_ONE_EDGE: f64 = 1.0 + 2.0 * BEYOND;

/// The same of both steps for a piece from beyond one edge to beyond the other: the
/// second step has x = -1/9.
const BEYOND_BOTH_EDGES: f64 = BEYOND_ONE_EDGE * (1.0 + 2.0 * BEYOND / (1.0 + BEYOND));

/// The roundings of a restricted control for each degree, in both directions: three
/// a level in one step and five in the other (lemma R6 of docs/rounding.md).
const ROUNDINGS_PER_DEGREE: f64 = 8.0;

/// The roundings of moving a control to a new centre: a product and a difference.
const CENTRING_ROUNDINGS: f64 = 2.0;

/// The distance, relative to the patch's radius, up to which the control points
/// of an edge count as one point.
const DEGENERATE_EXTENT: f64 = 1e-12;

/// Bounds over a patch, over its extension, and over parts of it, each computed
/// at its first use. Most patches of a large model are never used.
#[derive(Debug)]
pub struct LocalDerivativeBounds {
    whole: OnceLock<Box<DerivativeBounds>>,
    extended: OnceLock<Box<DerivativeBounds>>,
    /// The parameters on which the patch's controls give points of the model:
    /// [0, 1]², and a little more beyond edges at which the patch was cut.
    pub extension: ParamBox,
    parts: OnceLock<Box<Parts>>,
}

/// The grid of parts, and the bounds over each.
#[derive(Debug)]
struct Parts {
    lines: [Vec<f64>; 2],
    bounds: Vec<OnceLock<DerivativeBounds>>,
}

impl LocalDerivativeBounds {
    /// Makes the bounds of a patch with this extension; nothing is computed yet.
    #[must_use]
    pub fn new(extension: ParamBox) -> Self {
        Self { whole: OnceLock::new(), extended: OnceLock::new(), extension, parts: OnceLock::new() }
    }

    /// Returns bounds over [0, 1]². `patch` must be the patch of these bounds.
    /// O(p q) at the first use.
    pub fn whole(&self, patch: &Patch<'_>) -> &DerivativeBounds {
        self.whole.get_or_init(|| Box::new(patch.derivative_bounds()))
    }

    /// Returns bounds over [0, 1]², or over the whole extension if the box
    /// [low, high], which must lie in the extension, leaves [0, 1]².
    /// O(p q (p + q)) at the first use.
    pub fn about(&self, patch: &Patch<'_>, low: [f64; 2], high: [f64; 2]) -> &DerivativeBounds {
        if ParamBox::UNIT.contains(low) && ParamBox::UNIT.contains(high) {
            return self.whole(patch);
        }
        self.extended.get_or_init(|| Box::new(patch.bounds_over(self.extension[0], self.extension[1])))
    }

    /// Returns bounds over the box [low, high], which must lie in the extension:
    /// the largest over all parts that the box touches. O(parts touched), and
    /// O(p q (p + q)) for each part at its first use.
    #[must_use]
    pub fn over(&self, patch: &Patch<'_>, low: [f64; 2], high: [f64; 2]) -> DerivativeBounds {
        if (0..2).any(|axis| high[axis] - low[axis] > MAX_PART_WIDTH) {
            return *self.about(patch, low, high);
        }
        let radius = self.whole(patch).radius;
        let parts = || Box::new(Parts::new(patch, radius, self.extension));
        let Parts { lines, bounds } = &**self.parts.get_or_init(parts);
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
    /// Divides the extension of a patch, finer towards degenerate edges.
    fn new(patch: &Patch<'_>, radius: f64, extension: ParamBox) -> Self {
        let lines = Axis::BOTH.map(|axis| {
            let [low, high] = extension[axis];
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

/// Returns whether the edge at the start or the end of `axis` is a point.
fn is_degenerate(patch: &Patch<'_>, axis: Axis, at_end: bool, radius: f64) -> bool {
    let columns = patch.degree[1] + 1;
    let steps = patch.degree[axis.other()];
    let (across, along) = if axis == Axis::U { (columns, 1) } else { (1, columns) };
    let first = if at_end { patch.degree[axis] * across } else { 0 };
    let point = |step: usize| {
        let control = patch.controls[first + step * along];
        control.xyz() / control.w
    };
    (1..=steps).all(|step| point(step).distance(point(0)) <= DEGENERATE_EXTENT * radius)
}

impl Patch<'_> {
    /// Returns bounds over the box `s` × `t`, on derivatives by the patch's own
    /// parameters.
    ///
    /// The excess of the recursion is proportional to the size of the box, as
    /// weights, and points relative to the box's own centre, vary less over it.
    pub(crate) fn bounds_over(&self, s: [f64; 2], t: [f64; 2]) -> DerivativeBounds {
        let (part, error) = self.centered_part(s, t);
        part.patch(0).derivative_bounds_within(error).rescaled([s[1] - s[0], t[1] - t[0]])
    }

    /// Returns the part over the box `s` × `t` about its own centre, with bounds on the errors of
    /// its controls, in space and weight.
    fn centered_part(&self, s: [f64; 2], t: [f64; 2]) -> (PatchSet, [f64; 2]) {
        let controls = self.restricted(s, t);
        let part = Patch { controls: &controls, ..*self };
        let mut centered = PatchSet::default();
        centered.push_centered(part, center_grid(part.bounding_box().diagonal()));
        let shift = (centered.patch(0).center - self.center).length();
        let error = restriction_error(self.degree, [s, t], self.largest_controls(), shift);
        (centered, error)
    }
}

/// Returns bounds on the errors, in space and weight, of controls restricted to a box and
/// moved to a centre at distance `shift`, of controls of these largest sizes (lemma R6).
fn restriction_error([p, q]: [usize; 2], [s, t]: [[f64; 2]; 2], largest: [f64; 2], shift: f64) -> [f64; 2] {
    let growth = growth(p, s) * growth(q, t);
    let [space, weight] = largest.map(|largest| growth * largest);
    let restriction = gamma(ROUNDINGS_PER_DEGREE * (p + q) as f64);
    [restriction * space + gamma(CENTRING_ROUNDINGS) * (space + weight * shift), restriction * weight]
}

/// Returns a bound on the growth of controls, and of their errors, in a restriction
/// to this interval: 1 inside [0, 1], where controls are averaged.
fn growth(degree: usize, [start, end]: [f64; 2]) -> f64 {
    let per_degree = match (start < 0.0, end > 1.0) {
        (false, false) => 1.0,
        (true, true) => BEYOND_BOTH_EDGES,
        _ => BEYOND_ONE_EDGE,
    };
    per_degree.powi(degree as i32)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::rounding::UNIT_ROUNDOFF;
    use glam::{DVec3, DVec4};

    /// Lemma R6: 8 (p + q) roundings of controls that grow beyond each edge, in both
    /// directions at once too, and 2 of the change of centre.
    #[test]
    fn errors_of_a_restriction_grow_beyond_the_edges() {
        let [inside, one, both] = [[0.25, 0.5], [-0.125, 0.5], [-0.125, 1.125]];
        let factor = |[low, high]: [f64; 2]| match (low < 0.0, high > 1.0) {
            (false, false) => 1.0_f64,
            (true, true) => 1.25 * 11.0 / 9.0,
            _ => 1.25,
        };
        let ([space, weight], shift) = ([3.0, 2.0], 0.5);
        for s in [inside, one, both] {
            for t in [inside, one, both] {
                let (p, q) = (3, 2);
                let growth = factor(s).powi(p) * factor(t).powi(q);
                let restriction = 8.0 * f64::from(p + q);
                let lemma = [
                    growth * (restriction * space + 2.0 * (space + weight * shift)),
                    growth * restriction * weight,
                ];
                let found = restriction_error([p as usize, q as usize], [s, t], [space, weight], shift);
                for (found, lemma) in found.into_iter().zip(lemma) {
                    let part = found / (UNIT_ROUNDOFF * lemma);
                    assert!((1.0..=1.02).contains(&part), "{part} over {s:?} × {t:?}");
                }
            }
        }
    }

    /// Lemma R6 with the shift of the centre, which is the distance of both centres: the part of a
    /// square with corners (±1, ±1) about (4, 0) whose centre is (4.5, 0.5).
    #[test]
    fn the_error_of_a_part_has_the_distance_of_the_centres() {
        let corner = |x: f64, y: f64| DVec4::new(x, y, 0.0, 1.0);
        let controls = [corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, -1.0), corner(1.0, 1.0)];
        let (degree, center) = ([1, 1], 4.0 * DVec3::X);
        let patch = Patch::whole(degree, center, &controls);
        let (part, error) = patch.centered_part([0.5, 1.0], [0.5, 1.0]);
        assert_eq!(part.patch(0).center, DVec3::new(4.5, 0.5, 0.0));
        let (largest, shift) = (2.0_f64.sqrt(), 0.5_f64.sqrt());
        let lemma = [16.0 * largest + 2.0 * (largest + shift), 16.0];
        for (found, lemma) in error.into_iter().zip(lemma) {
            let part = found / (UNIT_ROUNDOFF * lemma);
            assert!((1.0..=1.02).contains(&part), "{part}");
        }
    }

    /// The lines of the parts rise from one end of the extension to the other, finer towards edges
    /// that are a point.
    #[test]
    fn parts_divide_the_extension() {
        let (degree, center) = ([1, 1], DVec3::ZERO);
        let wide = [DVec4::new(1.0, -1.0, 0.0, 1.0), DVec4::new(1.0, 1.0, 0.0, 1.0)];
        for (controls, finest) in [
            ([DVec4::W, DVec4::W, wide[0], wide[1]], [true, false]),
            ([wide[0], wide[1], DVec4::W, DVec4::W], [false, true]),
            ([wide[0], wide[1], -wide[0] + 2.0 * DVec4::W, -wide[1] + 2.0 * DVec4::W], [false, false]),
        ] {
            let patch = Patch::whole(degree, center, &controls);
            for [low, high] in [[0.0, 1.0], [-0.125, 1.0], [0.0, 1.125], [-0.125, 1.125]] {
                let extension = ParamBox::new([low, high], [0.0, 1.0]);
                let Parts { lines: [along_s, along_t], .. } = Parts::new(&patch, 1.0, extension);
                assert_eq!(along_t, [0.0, 0.25, 0.5, 0.75, 1.0]);
                assert_eq!([along_s[0], along_s[along_s.len() - 1]], [low, high]);
                assert!(along_s.windows(2).all(|pair| pair[0] < pair[1]), "{along_s:?}");
                assert!([0.0, 0.25, 0.5, 0.75, 1.0].iter().all(|line| along_s.contains(line)), "{along_s:?}");
                for (end, is_finest) in [0.25 / 256.0, 1.0 - 0.25 / 256.0].iter().zip(finest) {
                    assert_eq!(along_s.contains(end), is_finest, "{along_s:?}");
                }
            }
        }
    }

    /// Each box has the bounds of the parts that it touches, and of all of them.
    #[test]
    fn boxes_have_the_bounds_of_their_parts() {
        let control = |index: usize| {
            let [i, j] = [(index / 4) as f64, (index % 4) as f64];
            DVec4::new(i * i * i - j, j * j * j - i * j, i * j * j, 1.0)
        };
        let controls: Vec<DVec4> = (0..16).map(control).collect();
        let (degree, center) = ([3, 3], DVec3::ZERO);
        let patch = Patch::whole(degree, center, &controls);
        let local = LocalDerivativeBounds::new(ParamBox::UNIT);
        let part = |place: [f64; 2]| {
            let [s, t] = place.map(|place| [0.25 * place, 0.25 * (place + 1.0)]);
            DerivativeBounds { radius: local.whole(&patch).radius, ..patch.bounds_over(s, t) }
        };
        for index in 0..16 {
            let place = [index / 4, index % 4].map(f64::from);
            let [low, high] = [0.25, 0.75].map(|at| place.map(|place| 0.25 * (place + at)));
            assert_eq!(local.over(&patch, low, high), part(place), "{place:?}");
        }
        // Over a line between two parts along each axis, and a point on such lines.
        let mut both = part([1.0, 2.0]);
        for place in [[2.0, 2.0], [1.0, 3.0], [2.0, 3.0]] {
            both.enclose(&part(place));
        }
        assert_eq!(local.over(&patch, [0.45, 0.7], [0.55, 0.8]), both);
        for at in [0.0, 0.25, 0.5, 1.0] {
            assert!(local.over(&patch, [at; 2], [at; 2]).second[0] > 0.0, "{at}");
        }
    }

    /// A box that leaves the unit square on one side only has the bounds of the extension.
    #[test]
    fn boxes_beyond_an_edge_have_the_bounds_of_the_extension() {
        let controls: Vec<DVec4> = [0.0, 0.0, 1.0, 4.0]
            .iter()
            .flat_map(|&z| [0.0, 1.0].map(|y| DVec4::new(z, y, z * z, 1.0)))
            .collect();
        let (degree, center) = ([3, 1], DVec3::ZERO);
        let patch = Patch::whole(degree, center, &controls);
        let extension = ParamBox::new([-0.125, 1.125], [0.0, 1.0]);
        let local = LocalDerivativeBounds::new(extension);
        let whole = *local.whole(&patch);
        for (low, high, is_inside) in [
            ([0.5; 2], [1.0; 2], true),
            ([0.5, 0.0], [1.125, 1.0], false),
            ([-0.125, 0.0], [0.5, 1.0], false),
        ] {
            assert_eq!(*local.about(&patch, low, high) == whole, is_inside, "{low:?} {high:?}");
        }
    }
}
