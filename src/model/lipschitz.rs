//! Bounds on the first derivatives of a surface.

use super::NurbsSurface;
use crate::axis::Axis;
use crate::param_box::ParamBox;
use glam::DVec3;

/// The roundings of the bound: differences, products, quotients and sums.
const ROUNDING: f64 = 1.0 + 1e-12;

impl NurbsSurface {
    /// Returns upper bounds on `|S_u|` and `|S_v|` over a part of the domain: there, a move
    /// of the parameters by (Δu, Δv) moves the point by `|S_u| |Δu| + |S_v| |Δv|` or less.
    /// +∞ where the surface jumps.
    ///
    /// With `X = w (S - c)` for the centre c of the control points, `S_u = (X_u - w_u (S - c)) / w`.
    /// The controls of X_u are `p (X_{i+1} - X_i) / (t_{i+p+1} - t_{i+1})`, and of w_u likewise;
    /// `|S - c|` is at most the largest distance of a control point from c. Of control points
    /// and differences only those count whose B-splines are not 0 on all of the part: control
    /// i's is 0 outside `[t_i, t_{i+p+1}]`, difference i's outside `[t_{i+1}, t_{i+p+1}]`.
    /// O(size).
    #[must_use]
    pub fn lipschitz_bounds(&self, part: ParamBox) -> [f64; 2] {
        let columns = self.counts()[1];
        let touches = |axis: Axis, first: usize, last: usize| {
            let (knots, [start, end]) = (self.knots(axis), part[axis]);
            knots[first] <= end && start <= knots[last]
        };
        let counts = |index: usize| {
            let [i, j] = [index / columns, index % columns];
            let [p, q] = self.degree();
            touches(Axis::U, i, i + p + 1) && touches(Axis::V, j, j + q + 1)
        };
        let controls = || self.control_points().iter().enumerate().filter(|(index, _)| counts(*index));
        let points = || controls().map(|(_, &[x, y, z, _])| DVec3::new(x, y, z));
        let (low, high) = points().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), point| {
            (low.min(point), high.max(point))
        });
        let center = 0.5 * low + 0.5 * high;
        let radius = points().map(|point| point.distance(center)).fold(0.0, f64::max);
        let least = controls().map(|(_, point)| point[3]).fold(f64::INFINITY, f64::min);
        Axis::BOTH.map(|axis| {
            let degree = self.degree()[axis];
            let stride = if axis == Axis::U { columns } else { 1 };
            let knots = self.knots(axis);
            let mut largest = 0.0_f64;
            for (index, &[x, y, z, w]) in controls() {
                let along = if axis == Axis::U { index / columns } else { index % columns };
                let Some(&[x1, y1, z1, w1]) =
                    (along + 1 < self.counts()[axis]).then(|| &self.control_points()[index + stride])
                else {
                    continue;
                };
                if !touches(axis, along + 1, along + degree + 1) {
                    continue;
                }
                let (span_end, span_start) = (knots[along + degree + 1], knots[along + 1]);
                let from = w * (DVec3::new(x, y, z) - center);
                let to = w1 * (DVec3::new(x1, y1, z1) - center);
                let change = (to - from).length() + radius * (w1 - w).abs();
                if change > 0.0 {
                    largest = largest.max(degree as f64 * change / (span_end - span_start));
                }
            }
            ROUNDING * largest / least
        })
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::model::SurfaceArrays;

    /// A sheet of degrees 3 and 1 over [0, 10] x [0, 1], its control points a unit apart
    /// but for the last ones, which reach out by `spike`.
    fn sheet(spike: f64) -> NurbsSurface {
        let inner = (1..10).map(f64::from);
        let knots = [0.0; 4].into_iter().chain(inner).chain([10.0; 4]).collect();
        let point = |index: usize| [[index as f64, 0.0], [index as f64, 1.0]];
        let mut control_points: Vec<[f64; 4]> =
            (0..13).flat_map(point).map(|[x, y]| [x, y, 0.0, 1.0]).collect();
        control_points[24..].iter_mut().for_each(|point| point[2] = spike);
        let arrays = SurfaceArrays {
            degree: [3, 1],
            knots: [knots, vec![0.0, 0.0, 1.0, 1.0]],
            counts: [13, 2],
            control_points,
        };
        NurbsSurface::new(0, arrays).unwrap()
    }

    #[test]
    fn a_part_is_bounded_by_the_control_points_that_it_depends_on() {
        let part = ParamBox::new([2.0, 5.0], [0.0, 1.0]);
        let [flat, spiked] = [0.0, 1e9].map(|spike| sheet(spike).lipschitz_bounds(part));
        assert_eq!(flat, spiked);
        assert!(sheet(1e9).lipschitz_bounds(sheet(1e9).domain())[0] > 1e9);
    }

    #[test]
    fn no_chord_is_longer_than_the_bound_allows() {
        let random = &mut fastrand::Rng::with_seed(5);
        for _ in 0..200 {
            let surface = sheet(4.0 * random.f64());
            let mut ends = [10.0 * random.f64(), 10.0 * random.f64()];
            ends.sort_by(f64::total_cmp);
            let bounds = surface.lipschitz_bounds(ParamBox::new(ends, [0.0, 1.0]));
            let at = |share: f64| (1.0 - share) * ends[0] + share * ends[1];
            for step in 0..20 {
                let [from, to] = [at(f64::from(step) / 20.0), at(f64::from(step + 1) / 20.0)];
                let [start, end] = [from, to].map(|u| DVec3::from_array(surface.point([u, 0.3])));
                let chord = start.distance(end);
                assert!(chord <= bounds[0] * (to - from) * (1.0 + 1e-9) + 1e-14, "{chord} {bounds:?}");
            }
        }
    }
}
