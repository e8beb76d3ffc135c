//! Bounds of a patch's derivatives from its control net.

use super::{Patch, PatchSet, center_grid};
use glam::{DVec4, Vec4Swizzles};

/// Upper bounds of the lengths of a patch's derivatives over [0, 1]^2, by (s, t).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DerivativeBounds {
    /// Largest distance from the patch's centre.
    pub radius: f64,
    /// First derivatives by s and t.
    pub first: [f64; 2],
    /// Second derivatives ss, st, tt.
    pub second: [f64; 3],
    /// Third derivatives sss, sst, stt, ttt.
    pub third: [f64; 4],
}

impl DerivativeBounds {
    /// Makes these bounds hold on a piece too, whose parameters run `faster`.
    fn enclose(&mut self, piece: &Self, faster: f64) {
        let pairs = [
            (&mut self.first[..], &piece.first[..], faster),
            (&mut self.second[..], &piece.second[..], faster.powi(2)),
            (&mut self.third[..], &piece.third[..], faster.powi(3)),
        ];
        for (own, of_piece, factor) in pairs {
            for (own, of_piece) in own.iter_mut().zip(of_piece) {
                // What is no number bounds nothing.
                *own = if of_piece.is_nan() { f64::INFINITY } else { own.max(factor * of_piece) };
            }
        }
    }
}

/// Pieces along each direction that a rational patch's bounds are taken over:
/// on a sphere's patches bounds of third derivatives are then 1.5 to 2 times closer.
const PARTS: usize = 4;

/// Highest order of derivative bounded, plus one.
const ORDERS: usize = 4;

/// Room for the rounding of the differences and the recursion: more than
/// 10^4 roundings of 2^-53 relative to the largest term.
const ROUNDING_ROOM: f64 = 1.0 + 1e-12;

impl Patch<'_> {
    /// Bounds of first to third derivatives.
    ///
    /// The derivative of order (a, b) of the homogeneous surface (X, w) has
    /// the control points `p!/(p-a)! q!/(q-b)!` times the differences of the
    /// net, whose largest length bounds it: `X_ab`, `w_ab`. Differentiating
    /// `X = w x` by Leibniz' rule and solving for the last term,
    ///
    /// `x_ab <= (X_ab + sum C(a,i) C(b,j) w_ij x_(a-i)(b-j)) / w_min`
    ///
    /// over (i, j) != (0, 0), with `x_00` the radius. O(p q).
    #[must_use]
    pub fn derivative_bounds(&self) -> DerivativeBounds {
        let weight = self.controls.iter().fold(f64::INFINITY, |least, control| least.min(control.w));
        let mut bounds = [[0.0_f64; ORDERS]; ORDERS];
        let mut weights = [[0.0_f64; ORDERS]; ORDERS];
        bounds[0][0] = self.local_points().fold(0.0, |radius: f64, point| radius.max(point.length()));
        for order in 1..ORDERS {
            for a in (0..=order).rev() {
                let b = order - a;
                let (numerator, w) = self.difference_bound(a, b);
                weights[a][b] = w;
                let mut sum = numerator;
                for i in 0..=a {
                    for j in 0..=b {
                        if i + j > 0 {
                            let count = (binomial(a, i) * binomial(b, j)) as f64;
                            sum += count * weights[i][j] * bounds[a - i][b - j];
                        }
                    }
                }
                bounds[a][b] = sum / weight * ROUNDING_ROOM;
            }
        }
        DerivativeBounds {
            radius: bounds[0][0],
            first: [bounds[1][0], bounds[0][1]],
            second: [bounds[2][0], bounds[1][1], bounds[0][2]],
            third: [bounds[3][0], bounds[2][1], bounds[1][2], bounds[0][3]],
        }
    }

    /// As [`Patch::derivative_bounds`], of a rational patch piece by piece: the
    /// recursion's excess is proportional to a piece's size, as its weights
    /// and its points about its own centre then vary less. O(pieces p q (p + q)).
    #[must_use]
    pub fn close_derivative_bounds(&self) -> DerivativeBounds {
        let whole = self.derivative_bounds();
        if !self.rational {
            return whole;
        }
        let part = |index: usize| [index as f64 / PARTS as f64, (index + 1) as f64 / PARTS as f64];
        let mut largest = DerivativeBounds { radius: whole.radius, ..DerivativeBounds::default() };
        for index in 0..PARTS * PARTS {
            let controls = self.restricted(part(index / PARTS), part(index % PARTS));
            let mut piece = PatchSet::default();
            piece.push_centered(Patch { controls: &controls, ..*self }, center_grid(whole.radius));
            largest.enclose(&piece.patch(0).derivative_bounds(), PARTS as f64);
        }
        largest
    }

    /// Largest length of the (a, b)-th derivative's controls: space, weight.
    fn difference_bound(&self, a: usize, b: usize) -> (f64, f64) {
        let [p, q] = self.degree;
        if a > p || b > q {
            return (0.0, 0.0);
        }
        let columns = q + 1;
        let (mut space, mut weight) = (0.0_f64, 0.0_f64);
        for i in 0..=p - a {
            for j in 0..=q - b {
                let mut difference = DVec4::ZERO;
                for k in 0..=a {
                    for l in 0..=b {
                        let sign = if (a - k + b - l).is_multiple_of(2) { 1.0 } else { -1.0 };
                        let factor = sign * (binomial(a, k) * binomial(b, l)) as f64;
                        difference += factor * self.controls[(i + k) * columns + j + l];
                    }
                }
                space = space.max(difference.xyz().length());
                weight = weight.max(difference.w.abs());
            }
        }
        let scale = falling_factorial(p, a) * falling_factorial(q, b);
        (scale * space, scale * weight)
    }
}

fn binomial(n: usize, k: usize) -> usize {
    (0..k).fold(1, |product, i| product * (n - i) / (i + 1))
}

fn falling_factorial(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |product, i| product * (n - i) as f64)
}
