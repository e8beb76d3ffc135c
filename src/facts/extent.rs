//! The largest coordinate of patches along a direction.

use crate::axis::Axis;
use crate::bezier::Patch;
use crate::interval::Interval;
use crate::rounding::{gamma, upper_max};
use crate::sorting::ordered_by;
use glam::{DVec3, Vec4Swizzles};
use std::collections::BinaryHeap;

/// The largest number of parts that are divided: faces that touch the plane along a curve have many.
const MAX_PARTS: usize = 1 << 15;

/// The roundings of a height relative to the largest length, without those of halvings.
const HEIGHT_ROUNDINGS: f64 = 24.0;

/// The largest number of halvings of a patch: its parts are then shorter than rounding.
const MAX_DEPTH: u32 = 60;

/// A part of a patch by its heights above a plane.
struct Part {
    upper: f64,
    /// A bound on the rounding of its heights.
    error: f64,
    depth: u32,
    degree: [usize; 2],
    /// Heights times weights, and weights.
    controls: Vec<[f64; 2]>,
}

/// Returns an interval of the largest n·(x − origin) over the points x of patches, known to a width of `width`
/// unless that takes too many parts, or float64 does not resolve it: lemma V5 of docs/facts.md. `moved` bounds
/// the error of the patches' points. The direction has a length of 1 up to rounding.
pub(crate) fn largest<'a>(
    patches: impl Iterator<Item = Patch<'a>>,
    direction: DVec3,
    origin: DVec3,
    width: f64,
    moved: f64,
) -> Interval {
    let (mut best, mut heap) = (f64::NEG_INFINITY, BinaryHeap::new());
    let mut count = 0;
    for patch in patches {
        let part = Part::new(&patch, direction, origin);
        raise(&mut best, part.lower());
        if !(part.upper <= best) {
            heap.push(part);
        }
    }
    let mut upper = best;
    while let Some(top) = heap.pop() {
        let is_done = !(top.upper > best + width) || count >= MAX_PARTS || top.depth == MAX_DEPTH;
        if is_done {
            upper = upper_max(upper, top.upper);
            break;
        }
        count += 1;
        for half in top.halves() {
            raise(&mut best, half.lower());
            if !(half.upper <= best) {
                heap.push(half);
            }
        }
    }
    upper = upper_max(upper, best);
    Interval { lower: (best - moved).next_down(), upper: (upper + moved).next_up() }
}

fn raise(best: &mut f64, found: f64) {
    if found > *best {
        *best = found;
    }
}

impl Part {
    fn new(patch: &Patch<'_>, direction: DVec3, origin: DVec3) -> Self {
        let center = patch.center - origin;
        let height = direction.dot(center);
        let controls = patch
            .controls
            .iter()
            .map(|control| [direction.dot(control.xyz()) + height * control.w, control.w]);
        let own = patch.local_points().map(DVec3::length).fold(0.0, upper_max);
        let size = own + center.length();
        let degree = patch.degree.iter().sum::<usize>() as f64;
        let error = gamma(HEIGHT_ROUNDINGS + 2.0 * degree * f64::from(MAX_DEPTH)) * size;
        Self { upper: 0.0, error, depth: 0, degree: patch.degree, controls: controls.collect() }.bounded()
    }

    /// Returns the part with its upper bound, that of the control points.
    fn bounded(mut self) -> Self {
        self.upper = self.controls.iter().map(|[height, w]| height / w).fold(f64::NEG_INFINITY, upper_max)
            + self.error;
        self
    }

    /// Returns a lower bound: the largest height of a corner, which is a point of the patch.
    fn lower(&self) -> f64 {
        let [p, q] = self.degree;
        let columns = q + 1;
        let mut largest = f64::NEG_INFINITY;
        for index in [0, q, p * columns, p * columns + q] {
            let [height, w] = self.controls[index];
            raise(&mut largest, height / w);
        }
        largest - self.error
    }

    /// Returns the halves along the parameter in which the heights bend more.
    fn halves(&self) -> [Self; 2] {
        let axis = if self.bend(Axis::V) > self.bend(Axis::U) { Axis::V } else { Axis::U };
        let columns = self.degree[1] + 1;
        let (lines, order, step, stride) = match axis {
            Axis::U => (columns, self.degree[0] + 1, columns, 1),
            Axis::V => (self.degree[0] + 1, columns, 1, columns),
        };
        let (mut low, mut high) = (self.controls.clone(), self.controls.clone());
        for line in 0..lines {
            let at = |index: usize| line * stride + index * step;
            for level in 1..order {
                for index in 0..order - level {
                    let [a, b] = [high[at(index)], high[at(index + 1)]];
                    high[at(index)] = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
                }
                low[at(level)] = high[at(0)];
            }
        }
        [low, high].map(|controls| {
            Self { upper: 0.0, error: self.error, depth: self.depth + 1, degree: self.degree, controls }
                .bounded()
        })
    }

    /// Returns the sum of the second differences of the heights along a parameter; of a part that bends along
    /// neither, the slopes count.
    fn bend(&self, axis: Axis) -> f64 {
        let columns = self.degree[1] + 1;
        let step = if axis == Axis::U { columns } else { 1 };
        let height = |index: usize| self.controls[index][0] / self.controls[index][1];
        let mut sum = 0.0;
        for index in 0..self.controls.len() {
            let place = [index / columns, index % columns][axis];
            if place + 1 < self.degree[axis] {
                sum += (height(index) - 2.0 * height(index + step) + height(index + 2 * step)).abs();
            }
        }
        sum
    }
}

ordered_by!(Part, |part| part.upper);

/// Returns an interval of the largest n·(x − origin) of points that are off by at most `moved`.
pub(crate) fn largest_of_points(
    points: impl Iterator<Item = DVec3>,
    direction: DVec3,
    origin: DVec3,
    moved: f64,
) -> Interval {
    let (mut best, mut size) = (f64::NEG_INFINITY, 0.0);
    for point in points {
        let offset = point - origin;
        raise(&mut best, direction.dot(offset));
        size = upper_max(size, offset.length_squared());
    }
    Interval::about(best, moved + gamma(HEIGHT_ROUNDINGS) * size.sqrt())
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use glam::DVec4;
    use num_rational::BigRational;

    /// Lemma V5 for bilinear patches, which are farthest at a corner, in rational numbers: those of the coordinates
    /// as they are, far from 0 and near each other, so that the roundings of heights are larger than their ends'.
    #[test]
    fn extents_contain_the_farthest_corner() {
        let exact = |number: f64| BigRational::from_float(number).unwrap();
        let random = &mut fastrand::Rng::with_seed(46);
        for _ in 0..200 {
            let mut vector = |size: f64| DVec3::from_array([0; 3].map(|_| size * (random.f64() - 0.5)));
            let (origin, direction) = (vector(1e3), vector(1.0).normalize());
            let center = origin + vector(1e3);
            let locals = [(); 4].map(|()| vector(1.0) + (origin - center));
            let heights = locals.map(|local| {
                let along = |axis: usize| {
                    exact(direction[axis]) * (exact(center[axis]) + exact(local[axis]) - exact(origin[axis]))
                };
                along(0) + along(1) + along(2)
            });
            let farthest = heights.into_iter().max().unwrap();
            let controls: Vec<DVec4> = locals.iter().map(|local| local.extend(1.0)).collect();
            let patch = Patch::whole([1, 1], center, &controls);
            let found = largest(std::iter::once(patch), direction, origin, 1.0, 0.0);
            assert!(exact(found.lower) <= farthest && farthest <= exact(found.upper), "{found:?}");
            assert!(found.width() < 1e-9, "{found:?}");
        }
    }
}
