//! Restriction of polynomials to an interval as a matrix of Bernstein coefficients.

use super::{bernstein, binomials};
use crate::axis::Axis;
use crate::limits::MAX_ORDER;
use glam::DVec4;

/// The matrix that restricts the Bernstein coefficients of a polynomial to an interval, and elevates
/// their degree.
///
/// Coefficient k of the restriction to [a, b] is the polynomial's blossom at a, p - k times, and at
/// b, k times, so that the matrix has the entries `Σ_i B_i^(p-k)(a) B_(j-i)^k(b)`. One matrix serves all
/// lines of all patches that are cut at the same parameters. With a > b the coefficients are in the
/// order from a to b.
#[derive(Debug, Clone)]
pub(crate) struct Restriction {
    /// The degrees before and after.
    from: usize,
    to: usize,
    /// The matrix by rows; none for whole intervals that are elevated at most once.
    entries: Vec<f64>,
}

impl Restriction {
    /// The restriction of degree `from`, below [`MAX_ORDER`], to an interval in [0, 1] given by its two
    /// ends, elevated to the degree `to`, which is not lower. O(from³ + from² to).
    ///
    /// Each coefficient of the result is a positive combination with at most 8 `from` + 3 (`to` - `from`)
    /// roundings (lemma R6 of docs/rounding.md).
    pub(crate) fn new(from: usize, to: usize, [start, end]: [f64; 2]) -> Self {
        if to - from <= 1 && [start, end] == [0.0, 1.0] {
            return Self { from, to, entries: Vec::new() };
        }
        let order = from + 1;
        let mut entries = vec![0.0; order * order];
        for (k, row) in entries.chunks_exact_mut(order).enumerate() {
            let (at_start, at_end) = (bernstein(from - k, start), bernstein(k, end));
            for (i, a) in at_start.iter().enumerate().take(order - k) {
                for (entry, b) in row[i..=i + k].iter_mut().zip(&at_end) {
                    *entry += a * b;
                }
            }
        }
        Self { from, to, entries: elevated(entries, from, to) }
    }

    /// Whether the coefficients stay as they are.
    pub(crate) fn is_identity(&self) -> bool {
        self.entries.is_empty() && self.from == self.to
    }

    /// The number of degrees by which it elevates.
    pub(crate) fn elevation(&self) -> usize {
        self.to - self.from
    }

    /// Applies it to the lines along an axis of a net of this degree, t fastest, which replace
    /// those of `restricted`; returns the degree of that. It must not be the identity.
    pub(crate) fn apply(
        &self,
        axis: Axis,
        mut degree: [usize; 2],
        controls: &[DVec4],
        restricted: &mut Vec<DVec4>,
    ) -> [usize; 2] {
        let columns = degree[1] + 1;
        degree[axis] = self.to;
        restricted.clear();
        restricted.resize((degree[0] + 1) * (degree[1] + 1), DVec4::ZERO);
        match self.from {
            _ if self.entries.is_empty() => self.elevate(axis, columns, controls, restricted),
            // The most common degrees are unrolled.
            2 => self.apply_unrolled::<3>(axis, columns, controls, restricted),
            3 => self.apply_unrolled::<4>(axis, columns, controls, restricted),
            4 => self.apply_unrolled::<5>(axis, columns, controls, restricted),
            6 => self.apply_unrolled::<7>(axis, columns, controls, restricted),
            from => {
                let mut room = [DVec4::ZERO; MAX_ORDER];
                let line = &mut room[..=from];
                for lines in self.lines(axis, columns, controls.len()) {
                    lines.copy(controls, line);
                    for (k, row) in self.entries.chunks_exact(from + 1).enumerate() {
                        let products = row.iter().zip(&*line).map(|(&factor, &control)| factor * control);
                        restricted[lines.at(k)] =
                            products.reduce(|sum, product| sum + product).unwrap_or_default();
                    }
                }
            }
        }
        degree
    }

    /// The same for lines of N controls.
    #[inline(always)]
    fn apply_unrolled<const N: usize>(
        &self,
        axis: Axis,
        columns: usize,
        controls: &[DVec4],
        restricted: &mut [DVec4],
    ) {
        let mut line = [DVec4::ZERO; N];
        for lines in self.lines(axis, columns, controls.len()) {
            lines.copy(controls, &mut line);
            for (k, row) in self.entries.as_chunks::<N>().0.iter().enumerate() {
                let mut sum = row[0] * line[0];
                for j in 1..N {
                    sum += row[j] * line[j];
                }
                restricted[lines.at(k)] = sum;
            }
        }
    }

    /// Elevates the degree once, of the lines of a whole interval.
    fn elevate(&self, axis: Axis, columns: usize, controls: &[DVec4], elevated: &mut [DVec4]) {
        let share = |part: usize| part as f64 / self.to as f64;
        for line in self.lines(axis, columns, controls.len()) {
            let at = |place: usize| controls[line.starts[0] + place * line.step];
            elevated[line.at(0)] = at(0);
            for k in 1..self.to {
                elevated[line.at(k)] = share(k) * at(k - 1) + share(self.to - k) * at(k);
            }
            elevated[line.at(self.to)] = at(self.from);
        }
    }

    /// The lines along an axis of a net, by its numbers of columns and controls.
    fn lines(&self, axis: Axis, columns: usize, count: usize) -> impl Iterator<Item = Line> {
        let (lines, strides, step) = match axis {
            Axis::U => (columns, [1, 1], columns),
            Axis::V => (count / columns, [columns, self.to + 1], 1),
        };
        (0..lines).map(move |line| Line { starts: strides.map(|stride| line * stride), step })
    }
}

/// A line of controls: the indices of its first control before and after a restriction, and the step
/// from one to the next.
struct Line {
    starts: [usize; 2],
    step: usize,
}

impl Line {
    /// Copies the controls of the line before the restriction.
    #[inline(always)]
    fn copy(&self, controls: &[DVec4], line: &mut [DVec4]) {
        for (place, control) in line.iter_mut().enumerate() {
            *control = controls[self.starts[0] + place * self.step];
        }
    }

    /// The index of control k after it.
    #[inline(always)]
    fn at(&self, k: usize) -> usize {
        self.starts[1] + k * self.step
    }
}

/// The rows of a matrix elevated from a degree to another.
fn elevated(entries: Vec<f64>, from: usize, to: usize) -> Vec<f64> {
    if from == to {
        return entries;
    }
    let order = from + 1;
    let mut raised = vec![0.0; (to + 1) * order];
    for (l, k, share) in elevation_shares(from, to) {
        for (sum, entry) in raised[k * order..][..order].iter_mut().zip(&entries[l * order..]) {
            *sum += share * entry;
        }
    }
    raised
}

/// The shares of coefficient l of degree `from` in coefficient k of degree `to`, which is not lower, as
/// (l, k, share): `C(from, l) C(to - from, k - l) / C(to, k)`, where that is not 0.
pub(crate) fn elevation_shares(from: usize, to: usize) -> impl Iterator<Item = (usize, usize, f64)> {
    let [of_from, of_rest, of_to] = [from, to - from, to].map(binomials);
    let share = move |l: usize, m: usize| (l, l + m, of_from[l] * of_rest[m] / of_to[l + m]);
    (0..=from).flat_map(move |l| (0..=to - from).map(move |m| share(l, m)))
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::bezier::Patch;
    use glam::DVec3;

    /// The restricted and elevated net is that of the same points, along either axis and from either
    /// end.
    #[test]
    fn a_restriction_has_the_points_of_the_interval() {
        let random = &mut fastrand::Rng::with_seed(31);
        for case in 0..200 {
            let degree = [random.usize(1..8), random.usize(1..8)];
            let controls: Vec<DVec4> = (0..(degree[0] + 1) * (degree[1] + 1))
                .map(|_| DVec4::new(random.f64(), random.f64(), random.f64(), 0.5 + random.f64()))
                .collect();
            let axis = Axis::BOTH[case % 2];
            let ends =
                [[random.f64(), random.f64()], [0.0, random.f64()], [1.0, 0.0], [0.0, 1.0]][case / 2 % 4];
            let to = degree[axis] + 1 + random.usize(0..3);
            let mut restricted = Vec::new();
            let raised =
                Restriction::new(degree[axis], to, ends).apply(axis, degree, &controls, &mut restricted);
            assert_eq!((raised[axis], raised[axis.other()]), (to, degree[axis.other()]));
            let [whole, piece] = [(degree, &controls), (raised, &restricted)]
                .map(|(degree, controls)| Patch::whole(degree, DVec3::ZERO, controls));
            for _ in 0..10 {
                let place = [random.f64(), random.f64()];
                let mut on_whole = place;
                on_whole[axis] = (1.0 - place[axis]) * ends[0] + place[axis] * ends[1];
                let distance = piece.point(place).distance(whole.point(on_whole));
                assert!(distance <= 1e-13, "{distance:e}");
            }
        }
    }

    /// The coefficients are a mean of the controls: equal weights stay as they are, up to rounding.
    #[test]
    fn a_restriction_takes_means() {
        let controls = [DVec4::ONE; 4];
        for to in 3..8 {
            for ends in [[0.0, 1.0], [0.25, 0.7], [0.9, 0.0]] {
                let restriction = Restriction::new(3, to, ends);
                if restriction.is_identity() {
                    continue;
                }
                let mut restricted = Vec::new();
                restriction.apply(Axis::V, [0, 3], &controls, &mut restricted);
                assert_eq!(restricted.len(), to + 1);
                assert!(
                    restricted.iter().all(|mean| (*mean - DVec4::ONE).length() <= 1e-14),
                    "{restricted:?}"
                );
            }
        }
    }

    /// Lemma R6: the entries of intervals of any length have small relative errors, as those of [0, h] by
    /// their closed form `C(k, j) h^j (1 - h)^(k - j)`, and so has the other end by symmetry.
    #[test]
    fn entries_have_small_relative_errors() {
        for (degree, width) in [(3, 1e-12), (10, 0.3), (15, 1e-3), (15, 1.0 - 2.0_f64.powi(-50))] {
            let restriction = Restriction::new(degree, degree, [0.0, width]);
            for (k, row) in restriction.entries.chunks_exact(degree + 1).enumerate() {
                for (j, &entry) in row.iter().enumerate().take(k + 1) {
                    let exact = binomials(k)[j] * width.powi(j as i32) * (1.0 - width).powi((k - j) as i32);
                    let error = (entry / exact - 1.0).abs() / f64::EPSILON;
                    assert!(error <= (4 * degree) as f64, "{degree} {width}: {entry:e} {exact:e}");
                }
                assert!(row[k + 1..].iter().all(|entry| *entry == 0.0));
            }
        }
    }

    /// The identity has no matrix; from the other end the order is reversed, without rounding.
    #[test]
    fn whole_intervals_are_exact() {
        assert!(Restriction::new(5, 5, [0.0, 1.0]).is_identity());
        let controls = [0.1, 0.2, 0.7].map(DVec4::splat);
        let mut reversed = Vec::new();
        Restriction::new(2, 2, [1.0, 0.0]).apply(Axis::U, [2, 0], &controls, &mut reversed);
        assert_eq!(reversed, [0.7, 0.2, 0.1].map(DVec4::splat));
    }
}
