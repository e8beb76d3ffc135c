//! Surfaces of a degree above the model's, as pieces of a lower one with a proven distance.

use super::super::conversion::Unconvertible;
use super::super::spline::Spline;
use super::SurfaceNet;
use glam::{DVec3, DVec4, Vec4Swizzles};
use nurbs_hausdorff::workspace::{Interpolation, MAX_DEGREE, elevated};

/// The degree of the pieces, that of the pieces of offsets: cells of it are cheap to bound.
const DEGREE: usize = 7;

/// The tolerance relative to the size of the surface, that of the pieces of offsets.
const TOLERANCE: f64 = 1e-9;

/// The deepest bisection of a span: the distance falls by 2⁸ a level.
const MAX_DEPTH: usize = 10;

/// The most pieces along one parameter.
const MAX_PIECES: usize = 1024;

/// The roundings of a residual in units of the largest homogeneous coordinate: four for each of
/// the 18 elevations from [`DEGREE`] to 25, 100 of the point of a joint, and 20 more of values and
/// differences.
const ROUNDING: f64 = 96.0 * f64::EPSILON;

impl SurfaceNet {
    /// Returns the surface itself if the model accepts its degrees, else one of degree [`DEGREE`]
    /// along the parameters whose degree is higher. Its distance at equal parameters is bounded by
    /// lemma T10 and added to the error.
    ///
    /// # Errors
    /// [`Unconvertible::Degree`] if too many pieces are needed, as with weights far apart.
    pub(crate) fn of_accepted_degree(mut self) -> Result<Self, Unconvertible> {
        for axis in [0, 1] {
            if self.degrees[axis] > MAX_DEGREE {
                let (lines, error) = Lowered::of(&self.lines(axis))?;
                self.set_lines(axis, &lines);
                self.error += error;
            }
        }
        Ok(self)
    }

    /// Returns the rows of control points along an axis as curves.
    fn lines(&self, axis: usize) -> Vec<Spline> {
        let (degree, knots) = (self.degrees[axis], &self.knots[axis]);
        let columns = self.knots[1].len() - self.degrees[1] - 1;
        let rows = self.controls.len() / columns;
        let line = |controls| Spline { degree, knots: knots.clone(), controls };
        if axis == 1 {
            return self.controls.chunks(columns).map(|row| line(row.to_vec())).collect();
        }
        let column = |j: usize| (0..rows).map(|i| self.controls[i * columns + j]).collect();
        (0..columns).map(|j| line(column(j))).collect()
    }

    /// Replaces the rows of control points along an axis by those of curves over equal knots.
    fn set_lines(&mut self, axis: usize, lines: &[Spline]) {
        let count = lines[0].controls.len();
        self.controls = if axis == 1 {
            lines.iter().flat_map(|line| line.controls.iter().copied()).collect()
        } else {
            (0..count).flat_map(|i| lines.iter().map(move |line| line.controls[i])).collect()
        };
        self.degrees[axis] = lines[0].degree;
        self.knots[axis].clone_from(&lines[0].knots);
    }
}

/// Lines of control points under construction, all over the same knots.
struct Lowered {
    interpolation: Interpolation,
    /// The middle of the surface's control points, and the radius of a ball that contains them.
    center: DVec3,
    radius: f64,
    knots: Vec<f64>,
    controls: Vec<Vec<DVec4>>,
    error: f64,
}

impl Lowered {
    /// Returns the lines of [`DEGREE`] that stand for clamped lines of a higher one with positive
    /// weights, and the bound on the distance of both surfaces.
    fn of(lines: &[Spline]) -> Result<(Vec<Spline>, f64), Unconvertible> {
        let (center, radius) = ball(lines);
        let mut lowered = Self {
            interpolation: Interpolation::new(DEGREE),
            center,
            radius,
            knots: vec![lines[0].domain()[0]; DEGREE + 1],
            controls: vec![Vec::new(); lines.len()],
            error: 0.0,
        };
        let pieces: Vec<Vec<Spline>> = lines.iter().map(Spline::pieces).collect();
        for span in 0..pieces[0].len() {
            let span: Vec<Spline> = pieces.iter().map(|line| line[span].clone()).collect();
            lowered.piece(&span, 0)?;
        }
        lowered.knots.push(lines[0].domain()[1]);
        let knots = &lowered.knots;
        let line = |controls| Spline { degree: DEGREE, knots: knots.clone(), controls };
        Ok((lowered.controls.into_iter().map(line).collect(), lowered.error))
    }

    /// Appends the lines of a Bézier piece, or of its halves.
    fn piece(&mut self, lines: &[Spline], depth: usize) -> Result<(), Unconvertible> {
        let fits: Vec<Vec<DVec4>> = lines.iter().map(|line| self.fit(line)).collect();
        let distance = self.distance(lines, &fits);
        let [start, end] = lines[0].domain();
        if distance <= TOLERANCE * 2.0 * self.radius {
            self.error = self.error.max(distance);
            self.knots.extend([end; DEGREE]);
            for (line, fit) in self.controls.iter_mut().zip(&fits) {
                // Both sides of a joint have its homogeneous point, up to rounding.
                let shared = usize::from(!line.is_empty());
                line.extend(&fit[shared..]);
            }
            return Ok(());
        }
        if depth == MAX_DEPTH || self.knots.len() > DEGREE * MAX_PIECES {
            return Err(Unconvertible::Degree);
        }
        let middle = 0.5 * (start + end);
        for half in [[start, middle], [middle, end]] {
            let halves: Vec<Spline> = lines.iter().map(|line| line.sub_piece(half)).collect();
            self.piece(&halves, depth + 1)?;
        }
        Ok(())
    }

    /// Returns the Bernstein coefficients of [`DEGREE`] through homogeneous points of a piece.
    fn fit(&self, line: &Spline) -> Vec<DVec4> {
        let [start, end] = line.domain();
        let at = |&node: &f64| line.homogeneous((1.0 - node) * start + node * end);
        let values: Vec<DVec4> = self.interpolation.nodes().iter().map(at).collect();
        self.interpolation.coefficients(&values)
    }

    /// The bound of lemma T10 on the distance of the surface's part from that of the fits; ∞ where
    /// these have no positive weights.
    fn distance(&self, lines: &[Spline], fits: &[Vec<DVec4>]) -> f64 {
        let (mut residual, mut largest, mut least_weight) = (0.0_f64, 0.0_f64, f64::INFINITY);
        for (line, fit) in lines.iter().zip(fits) {
            least_weight = fit.iter().map(|control| control.w).fold(least_weight, f64::min);
            for (&control, raised) in line.controls.iter().zip(elevated(fit.clone(), line.degree)) {
                let moved = raised - control;
                let length = (moved.xyz() - moved.w * self.center).length() + self.radius * moved.w.abs();
                if !length.is_finite() {
                    return f64::INFINITY;
                }
                residual = residual.max(length);
                largest =
                    largest.max(control.xyz().length() + control.w * (self.center.length() + self.radius));
            }
        }
        if least_weight > 0.0 { (residual + ROUNDING * largest) / least_weight } else { f64::INFINITY }
    }
}

/// Returns the center and the radius of the ball around the box of all control points.
fn ball(lines: &[Spline]) -> (DVec3, f64) {
    let points = || lines.iter().flat_map(Spline::points);
    let (low, high) =
        (points().fold(DVec3::INFINITY, DVec3::min), points().fold(DVec3::NEG_INFINITY, DVec3::max));
    (0.5 * (low + high), 0.5 * low.distance(high))
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// The segment of length 2 about (x, 0, 0) in a degree, with the center and the radius of its ball.
    fn segment(degree: usize, x: f64) -> (Lowered, Spline) {
        let ends = [-1.0, 1.0].map(|end| DVec4::new(x + end, 0.0, 0.0, 1.0)).to_vec();
        let knots = [vec![0.0; degree + 1], vec![1.0; degree + 1]].concat();
        let line = Spline { degree, knots, controls: elevated(ends, degree) };
        let lowered = Lowered {
            interpolation: Interpolation::new(DEGREE),
            center: x * DVec3::X,
            radius: 1.0,
            knots: Vec::new(),
            controls: Vec::new(),
            error: 0.0,
        };
        (lowered, line)
    }

    #[test]
    fn the_bound_is_attained_by_a_move_and_by_a_change_of_weights() {
        let (lowered, line) = segment(20, 0.0);
        let fit = lowered.fit(&line);
        assert!(lowered.distance(std::slice::from_ref(&line), std::slice::from_ref(&fit)) < 1e-13);
        // Points moved by (0, 0.03, 0.04) are 0.05 away.
        let moved = fit.iter().map(|control| control + DVec4::new(0.0, 0.03, 0.04, 0.0)).collect();
        let found = lowered.distance(std::slice::from_ref(&line), &[moved]);
        assert!((found - 0.05).abs() < 1e-13, "{found}");
        // Weights of 1.25 move the ends to ±0.8, by 0.2, and weights of 0.8 to ±1.25, by 0.25.
        for (weight, expected) in [(1.25, 0.2), (0.8, 0.25)] {
            let weighted = fit.iter().map(|control| control.with_w(weight)).collect();
            let found = lowered.distance(std::slice::from_ref(&line), &[weighted]);
            assert!((found - expected).abs() < 1e-13, "{found}");
        }
    }

    /// The least weight of any control point divides the residual.
    #[test]
    fn one_small_weight_makes_the_bound_larger() {
        let (lowered, line) = segment(20, 0.0);
        let mut fit = lowered.fit(&line);
        fit[3].w = 0.5;
        let change = |(control, raised): (&DVec4, DVec4)| (raised.w - control.w).abs();
        let largest = line.controls.iter().zip(elevated(fit.clone(), 20)).map(change).fold(0.0, f64::max);
        let found = lowered.distance(&[line], &[fit]);
        assert!(largest > 0.1 && (found - largest / 0.5).abs() < 1e-12, "{found} {largest}");
    }

    #[test]
    fn all_control_points_are_in_the_ball() {
        let lines = [[3.0, -1.0, 2.0], [1.0, 5.0, -4.0]].map(|point| {
            let controls = [1.0, 2.0].map(|w| (w * (w * DVec3::from(point))).extend(w)).to_vec();
            Spline { degree: 1, knots: vec![0.0, 0.0, 1.0, 1.0], controls }
        });
        let (center, radius) = ball(&lines);
        let distances: Vec<f64> =
            lines.iter().flat_map(|line| line.points().map(|point| point.distance(center))).collect();
        assert!(
            distances.iter().all(|&distance| distance <= radius * (1.0 + 1e-15)),
            "{distances:?} {radius}"
        );
        assert!(distances.iter().any(|&distance| distance > 0.9 * radius), "{distances:?} {radius}");
    }

    #[test]
    fn weights_below_zero_bound_nothing() {
        let (lowered, line) = segment(20, 0.0);
        let fit = lowered.fit(&line).iter().map(|control| control.with_w(-1.0)).collect();
        assert_eq!(lowered.distance(&[line], &[fit]), f64::INFINITY);
    }

    /// Weights are compared about the center: those of 1.25 move the ends 9 and 11 to 7.2 and 8.8.
    #[test]
    fn the_bound_is_attained_far_from_the_origin() {
        let (lowered, line) = segment(20, 10.0);
        let fit = lowered.fit(&line);
        let weighted = fit.iter().map(|control| control.with_w(1.25)).collect();
        let found = lowered.distance(std::slice::from_ref(&line), &[weighted]);
        assert!((found - 2.2).abs() < 1e-12, "{found}");
        // Of coordinates of 1e6 the roundings that the lemma counts are left.
        let (lowered, line) = segment(20, 1e6);
        let fit = lowered.fit(&line);
        let found = lowered.distance(&[line], &[fit]);
        let expected = 96.0 * f64::EPSILON * 2e6;
        assert!(found >= expected && found < 1.1 * expected, "{found} {expected}");
    }

    /// Pseudo-random numbers of [0, 1), a linear congruential generator's.
    fn numbers(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed;
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        }
    }

    /// Surfaces of degrees 16 to 25 along the lines, with knots, weights and a place of their own.
    #[test]
    fn points_of_random_surfaces_are_within_the_bound() {
        let mut attained = 0.0_f64;
        for seed in 0..60 {
            let mut next = numbers(seed);
            let degree = 16 + seed as usize % 10;
            let spans = 1 + (3.0 * next()) as usize;
            let mut knots = vec![0.0; degree + 1];
            knots.extend((1..spans).map(|span| (span as f64 + 0.5 * next()) / (spans as f64 + 1.0)));
            knots.extend(vec![1.0; degree + 1]);
            let (spread, place) = (1.0 + 3.0 * next(), 100.0 * next());
            let mut line = || {
                let mut control = || {
                    let point = DVec3::new(place + next(), next(), next());
                    let weight = spread.powf(next());
                    (weight * point).extend(weight)
                };
                let controls = (0..degree + spans).map(|_| control()).collect();
                Spline { degree, knots: knots.clone(), controls }
            };
            let lines = [line(), line(), line()];
            let (lowered, error) = Lowered::of(&lines).unwrap_or_default();
            assert!(error > 0.0 && error < 1e-8, "{seed}: {error}");
            for _ in 0..400 {
                let (t, a, b) = (next(), next(), next());
                let shares = [(1.0 - a) * (1.0 - b), a * (1.0 - b), b];
                let [from, to] = [&lines[..], &lowered].map(|lines| {
                    let sum: DVec4 =
                        lines.iter().zip(shares).map(|(line, share)| share * line.homogeneous(t)).sum();
                    sum.xyz() / sum.w
                });
                attained = attained.max(from.distance(to) / error);
            }
        }
        // The pieces are as far off as is said, within the ratio of a polynomial to its coefficients.
        assert!(attained <= 1.0 && attained > 0.1, "{attained}");
    }
}
