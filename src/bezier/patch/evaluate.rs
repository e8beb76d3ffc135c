//! Evaluation of points and derivatives of a patch.

use crate::bezier::MAX_ORDER;
use crate::bezier::Patch;
use crate::bezier::basis::bernstein::{Basis, fill};
use glam::{DVec3, DVec4, Vec4Swizzles};

/// A point of a surface with its first and second derivatives by (s, t).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jet {
    /// The point.
    pub point: DVec3,
    /// First derivative by s.
    pub s: DVec3,
    /// First derivative by t.
    pub t: DVec3,
    /// Second derivative by s.
    pub ss: DVec3,
    /// Mixed second derivative.
    pub st: DVec3,
    /// Second derivative by t.
    pub tt: DVec3,
}

impl Jet {
    /// Returns the unit normal s × t, or `None` where the derivatives are parallel or vanish.
    #[must_use]
    pub fn normal(&self) -> Option<DVec3> {
        normal(self.s, self.t)
    }
}

/// Returns the unit normal s × t, or `None` where the derivatives are parallel or vanish.
pub(crate) fn normal(s: DVec3, t: DVec3) -> Option<DVec3> {
    let normal = s.cross(t);
    // Below this sine, rounding determines the direction of the product.
    const MIN_SINE: f64 = 1e-10;
    (normal.length() > MIN_SINE * s.length() * t.length()).then(|| normal.normalize())
}

impl Patch<'_> {
    /// Returns the surface point at (s, t) in [0, 1]².
    ///
    /// Its error is at most 8 (p + q) + 8 roundings of the patch's radius and one of its
    /// centre (lemma R5 of docs/rounding.md). O(p q).
    #[must_use]
    pub fn point(&self, parameters: [f64; 2]) -> DVec3 {
        let sum = match self.degree {
            [2, 2] => self.sum_unrolled::<3, 3>(parameters),
            [2, 3] => self.sum_unrolled::<3, 4>(parameters),
            [3, 2] => self.sum_unrolled::<4, 3>(parameters),
            [3, 3] => self.sum_unrolled::<4, 4>(parameters),
            _ => self.sum(parameters),
        };
        self.center + sum.xyz() / sum.w
    }

    /// Returns the homogeneous point of a patch of any degrees.
    fn sum(&self, parameters: [f64; 2]) -> DVec4 {
        let basis = bases::<MAX_ORDER>(self.degree, parameters);
        let columns = self.degree[1] + 1;
        let mut sum = DVec4::ZERO;
        for (row, s) in self.controls.chunks_exact(columns).zip(basis[0][0]) {
            sum += s * contract(row, &basis[1][0]);
        }
        sum
    }

    /// Returns the homogeneous point of a patch of degrees N - 1 and M - 1.
    #[inline(always)]
    fn sum_unrolled<const N: usize, const M: usize>(&self, [s, t]: [f64; 2]) -> DVec4 {
        let mut values = [DVec4::ZERO; N];
        for (value, row) in values.iter_mut().zip(self.controls.as_chunks::<M>().0) {
            [*value, ..] = casteljau(*row, t);
        }
        casteljau(values, s)[0]
    }

    /// Returns the point and the first and second derivatives at (s, t) in
    /// [0, 1]², by the quotient rule (Piegl and Tiller, *The NURBS Book*, eq.
    /// 4.20). O(p q).
    #[must_use]
    pub fn jet(&self, parameters: [f64; 2]) -> Jet {
        // The most common degrees are unrolled; most evaluations are of these.
        match self.degree {
            [2, 2] => self.jet_unrolled::<3, 3>(parameters),
            [2, 3] => self.jet_unrolled::<3, 4>(parameters),
            [3, 2] => self.jet_unrolled::<4, 3>(parameters),
            [3, 3] => self.jet_unrolled::<4, 4>(parameters),
            [0..8, 0..8] => self.jet_from_bases::<8>(self.degree, parameters),
            degree => self.jet_from_bases::<MAX_ORDER>(degree, parameters),
        }
    }

    /// Evaluates the jet of a patch of these degrees, both below N.
    #[inline(always)]
    fn jet_from_bases<const N: usize>(&self, degree: [usize; 2], parameters: [f64; 2]) -> Jet {
        let basis = bases::<N>(degree, parameters);
        let columns = degree[1] + 1;
        let [mut h, mut s, mut t, mut ss, mut st, mut tt] = [DVec4::ZERO; 6];
        for (i, row) in self.controls.chunks_exact(columns).enumerate() {
            let [value, first, second] = contract_thrice(row, &basis[1]);
            h += basis[0][0][i] * value;
            s += basis[0][1][i] * value;
            ss += basis[0][2][i] * value;
            t += basis[0][0][i] * first;
            st += basis[0][1][i] * first;
            tt += basis[0][0][i] * second;
        }
        self.quotient([h, s, t, ss, st, tt])
    }

    /// Evaluates the jet of a patch of degrees N - 1 in s and M - 1 in t by de
    /// Casteljau's algorithm, first along the rows and then across them.
    #[inline(always)]
    fn jet_unrolled<const N: usize, const M: usize>(&self, [s, t]: [f64; 2]) -> Jet {
        let [mut value, mut first, mut second] = [[DVec4::ZERO; N]; 3];
        for (i, row) in self.controls.as_chunks::<M>().0.iter().enumerate().take(N) {
            [value[i], first[i], second[i]] = casteljau(*row, t);
        }
        let [p, q] = [(N - 1) as f64, (M - 1) as f64];
        let [h, s_difference, ss_difference] = casteljau(value, s);
        let [t_difference, st_difference, _] = casteljau(first, s);
        let [tt_difference, ..] = casteljau(second, s);
        self.quotient([
            h,
            p * s_difference,
            q * t_difference,
            p * (p - 1.0) * ss_difference,
            p * q * st_difference,
            q * (q - 1.0) * tt_difference,
        ])
    }

    /// Returns the jet of the quotient, given the homogeneous point and its derivatives.
    #[inline(always)]
    fn quotient(&self, [h, s, t, ss, st, tt]: [DVec4; 6]) -> Jet {
        let inverse = 1.0 / h.w;
        let local = h.xyz() * inverse;
        let ds = (s.xyz() - s.w * local) * inverse;
        let dt = (t.xyz() - t.w * local) * inverse;
        Jet {
            point: self.center + local,
            s: ds,
            t: dt,
            ss: (ss.xyz() - 2.0 * s.w * ds - ss.w * local) * inverse,
            st: (st.xyz() - s.w * dt - t.w * ds - st.w * local) * inverse,
            tt: (tt.xyz() - 2.0 * t.w * dt - tt.w * local) * inverse,
        }
    }
}

/// Returns the value at t, the first derivative divided by the degree N - 1 and
/// the second divided by (N - 1)(N - 2), by de Casteljau's algorithm.
#[inline(always)]
fn casteljau<const N: usize>(mut controls: [DVec4; N], t: f64) -> [DVec4; 3] {
    let between = |a: DVec4, b: DVec4| (1.0 - t) * a + t * b;
    for last in (3..N).rev() {
        for index in 0..last {
            controls[index] = between(controls[index], controls[index + 1]);
        }
    }
    let [a, b, c] = [controls[0], controls[1], controls[2]];
    let [low, high] = [between(a, b), between(b, c)];
    [between(low, high), high - low, (a - b) + (c - b)]
}

/// Evaluates the bases of both directions.
#[inline(always)]
fn bases<const N: usize>(degree: [usize; 2], parameters: [f64; 2]) -> [Basis<N>; 2] {
    let mut bases = [[[0.0; N]; 3]; 2];
    fill(&mut bases[0], degree[0], parameters[0]);
    fill(&mut bases[1], degree[1], parameters[1]);
    bases
}

/// Returns the sum of the controls times the basis values.
#[inline(always)]
pub(in crate::bezier) fn contract(row: &[DVec4], basis: &[f64]) -> DVec4 {
    row.iter().zip(basis).fold(DVec4::ZERO, |sum, (&control, &value)| sum + value * control)
}

/// Returns the sums of the controls times the values of a basis and of its derivatives.
#[inline(always)]
fn contract_thrice<const N: usize>(row: &[DVec4], basis: &Basis<N>) -> [DVec4; 3] {
    let [mut value, mut first, mut second] = [DVec4::ZERO; 3];
    for (((&control, &of_value), &of_first), &of_second) in
        row.iter().zip(&basis[0]).zip(&basis[1]).zip(&basis[2])
    {
        value += of_value * control;
        first += of_first * control;
        second += of_second * control;
    }
    [value, first, second]
}
