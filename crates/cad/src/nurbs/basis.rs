//! Knot vectors, clamped or periodic.

use super::conversion::{Unconvertible, check_range};
use super::spline;

/// The B-spline basis of one parameter.
#[derive(Debug, Clone)]
pub(crate) struct Basis {
    pub(crate) degree: usize,
    /// The knots of one period with the control points repeated as needed, or all knots.
    knots: Vec<f64>,
    /// The index of the control point of every basis function of `knots`.
    poles: Vec<usize>,
    cycle: Option<Cycle>,
}

/// The knots of one period, each as often as its multiplicity; the first knot of the
/// next period, which is the last of the file, is not among them.
#[derive(Debug, Clone)]
struct Cycle {
    knots: Vec<f64>,
    period: f64,
    /// The multiplicity of the first knot.
    first: usize,
}

impl Basis {
    /// The basis of a Bézier curve over [0, 1].
    pub(crate) fn bezier(degree: usize) -> Self {
        Self::with_knots(degree, [vec![0.0; degree + 1], vec![1.0; degree + 1]].concat(), degree + 1)
    }

    /// The basis of clamped knots for `count` control points.
    pub(crate) fn with_knots(degree: usize, knots: Vec<f64>, count: usize) -> Self {
        Self { degree, knots, poles: (0..count).collect(), cycle: None }
    }

    /// The basis of pairs of increasing knot and multiplicity, at most degree + 1 each,
    /// for `count` control points. `None` if they do not fit.
    pub(crate) fn new(degree: usize, count: usize, pairs: &[(f64, usize)], periodic: bool) -> Option<Self> {
        let (&(start, first), &(end, last)) = (pairs.first()?, pairs.last()?);
        let flat = |pairs: &[(f64, usize)]| -> Vec<f64> {
            pairs.iter().flat_map(|&(knot, times)| std::iter::repeat_n(knot, times)).collect()
        };
        if !periodic {
            let knots = flat(pairs);
            let fits = count > degree && knots.len() == count + degree + 1 && knots[degree] < knots[count];
            return fits.then(|| Self::with_knots(degree, knots, count));
        }
        let knots = flat(&pairs[..pairs.len() - 1]);
        if pairs.len() < 2 || first != last || first > degree || knots.len() != count {
            return None;
        }
        let cycle = Cycle { knots, period: end - start, first };
        let mut basis = Self { degree, knots: Vec::new(), poles: Vec::new(), cycle: Some(cycle) };
        (basis.knots, basis.poles) = basis.unrolled([start, end]);
        Some(basis)
    }

    /// Returns the periodic basis whose knots beyond one period these are, and the index of its first control
    /// point: the functions of the control points that follow its own must be those of the first ones. Of
    /// clamped knots all control points but the last are its own. `None` for a basis that is periodic,
    /// or whose knots do not repeat.
    pub(crate) fn continued(&self) -> Option<(Self, usize)> {
        let (degree, count) = (self.degree, self.poles.len());
        let [start, end] = self.domain();
        let period = end - start;
        // No function depends on the outer knots.
        let knots = &self.knots[1..count + degree];
        let cycle: Vec<f64> = knots.iter().copied().filter(|&knot| start <= knot && knot < end).collect();
        let repeats = knots
            .iter()
            .zip(knots.get(cycle.len()..)?)
            .all(|(knot, later)| (knot + period - later).abs() <= KNOT_RESOLUTION * period);
        if self.cycle.is_some() || !repeats {
            return None;
        }
        let mut pairs: Vec<(f64, usize)> = Vec::new();
        for &knot in &cycle {
            match pairs.last_mut() {
                Some((last, times)) if *last == knot => *times += 1,
                _ => pairs.push((knot, 1)),
            }
        }
        pairs.push((end, pairs.first()?.1));
        let first = spline::span(&self.knots, degree, count, start) - degree;
        Some((Self::new(degree, cycle.len(), &pairs, true)?, first))
    }

    /// Returns the period of a periodic basis.
    pub(crate) fn period(&self) -> Option<f64> {
        self.cycle.as_ref().map(|cycle| cycle.period)
    }

    /// Checks that a range is one that an edge may have.
    ///
    /// # Errors
    /// [`Unconvertible::Range`] if it is empty or, on a periodic basis, too long or far away.
    pub(crate) fn check_range(&self, [start, end]: [f64; 2]) -> Result<(), Unconvertible> {
        match &self.cycle {
            Some(Cycle { knots, period, .. }) => check_range([start - knots[0], end - knots[0]], *period),
            None if start < end => Ok(()),
            None => Err(Unconvertible::Range),
        }
    }

    /// Returns the number of control points in the file.
    pub(crate) fn pole_count(&self) -> usize {
        self.cycle.as_ref().map_or(self.poles.len(), |cycle| cycle.knots.len())
    }

    /// Returns the domain; of a periodic basis, one period.
    pub(crate) fn domain(&self) -> [f64; 2] {
        [self.knots[self.degree], self.knots[self.poles.len()]]
    }

    /// Returns knots whose domain contains `range`, if the basis is periodic, and the
    /// index of the control point of every basis function.
    ///
    /// The infinite sequence of knots is T[k] = knots[k mod n] + period ⌊k / n⌋. In the
    /// first span of the file, which begins with T[first - 1], the first degree + 1
    /// control points are active.
    pub(crate) fn unrolled(&self, range: [f64; 2]) -> (Vec<f64>, Vec<usize>) {
        let Some(Cycle { knots, period, first }) = &self.cycle else {
            return (self.knots.clone(), self.poles.clone());
        };
        let (count, degree) = (knots.len() as i64, self.degree as i64);
        let knot = |index: i64| {
            let turn = index.div_euclid(count);
            knots[index.rem_euclid(count) as usize] + turn as f64 * period
        };
        let start = knots[0];
        let turn = |parameter: f64| ((parameter - start) / period).floor() as i64;
        // The span that contains the start, and the one that the end lies in or ends.
        let mut low = turn(range[0]) * count + *first as i64 - 1;
        while knot(low + 1) <= range[0] {
            low += 1;
        }
        let mut high = low;
        while knot(high + 1) < range[1] {
            high += 1;
        }
        let pole = |index: i64| (index - (*first as i64 - 1) + degree).rem_euclid(count) as usize;
        ((low - degree..=high + degree + 1).map(knot).collect(), (low - degree..=high).map(pole).collect())
    }

    /// Returns a parameter of the domain that stands for the same point, if the basis
    /// is periodic.
    pub(crate) fn reduced(&self, parameter: f64) -> f64 {
        match &self.cycle {
            Some(Cycle { knots, period, .. }) => knots[0] + (parameter - knots[0]).rem_euclid(*period),
            None => parameter,
        }
    }

    /// Returns the interval around a parameter on which the same polynomial is used; the outer
    /// ones of a basis without period are unbounded.
    pub(crate) fn cell(&self, parameter: f64) -> [f64; 2] {
        let (knots, degree, count) = (&self.knots, self.degree, self.poles.len());
        let reduced = self.reduced(parameter);
        let span = spline::span(knots, degree, count, reduced);
        let shift = parameter - reduced;
        let is_outer = |end: f64, last: f64| self.cycle.is_none() && end == last;
        let [start, end] = self.domain();
        [
            if is_outer(knots[span], start) { f64::NEG_INFINITY } else { knots[span] + shift },
            if is_outer(knots[span + 1], end) { f64::INFINITY } else { knots[span + 1] + shift },
        ]
    }

    /// Returns the knots and control point indices of [`Basis::domain`].
    pub(crate) fn one_period(&self) -> (&[f64], &[usize]) {
        (&self.knots, &self.poles)
    }

    /// Returns clamped knots over `range`: the knots inside, with their multiplicities.
    /// A range beyond the knots extends the outer spans, so that the old ends are no knots.
    pub(crate) fn clamped(&self, [start, end]: [f64; 2]) -> Vec<f64> {
        let (knots, poles) = self.unrolled([start, end]);
        // Knots nearer to an end than rounding moves parameters in files are the end itself.
        let margin = KNOT_RESOLUTION * (end - start);
        let low = knots[self.degree].max(start + margin);
        let high = knots[poles.len()].min(end - margin);
        let mut clamped = vec![start; self.degree + 1];
        clamped.extend(knots.iter().filter(|&&knot| knot > low && knot < high));
        clamped.extend(vec![end; self.degree + 1]);
        clamped
    }
}

/// Part of a range below which two knots are the same: files state parameters of edges
/// to 15 digits.
const KNOT_RESOLUTION: f64 = 1e-12;
