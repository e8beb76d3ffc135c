//! Functions of second and third order that nearly vanish on a piece, by least squares.
//!
//! Any function gives a bound: what is found here decides only how close it is. Among the functions of second
//! order are those of all quadrics through a point, and those of third order follow a smooth surface up to
//! the fifth order of the piece's size: a surface has 15 terms below that order, and they have 19.

use super::quadric::{Cubic, Quadric};
use crate::approximation::least_squares::LeastSquares;
use crate::rounding::{lower_min, upper_max};
use glam::DVec3;

/// Points along each side of a piece that a function is fitted to.
pub(super) const POINTS_ALONG: usize = 5;
pub(super) const POINTS: usize = POINTS_ALONG * POINTS_ALONG;

/// Terms as exponents of two coordinates along the tangent plane and of the height, in the order in which they are
/// used: those of a paraboloid, of any quadric, and those of third order below the fifth order of the
/// piece's size.
const PARABOLOID: [[usize; 3]; 6] = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [2, 0, 0], [1, 1, 0], [0, 2, 0]];
const QUADRIC: [[usize; 3]; 3] = [[1, 0, 1], [0, 1, 1], [0, 0, 2]];
const CUBIC: [[usize; 3]; 7] = [[3, 0, 0], [2, 1, 0], [1, 2, 0], [0, 3, 0], [2, 0, 1], [1, 1, 1], [0, 2, 1]];

/// The functions of rising order, each with the terms that it has more.
pub(super) const ORDERS: [&[[usize; 3]]; 3] = [&PARABOLOID, &QUADRIC, &CUBIC];

/// A value at each of the points.
type Column = [f64; POINTS];

/// A fit of the height over a plane by terms of rising order.
pub(super) struct Fit {
    normal: DVec3,
    /// The coordinates whose products are the terms.
    coordinates: [DVec3; 3],
    /// Their values at the points.
    points: [Column; 3],
    /// The terms that are used.
    terms: Vec<[usize; 3]>,
    squares: LeastSquares<Column>,
}

impl Fit {
    /// Takes a plane's normal with a tangent, and points about a point of the plane.
    pub(super) fn new(normal: DVec3, tangent: DVec3, samples: &[DVec3]) -> Option<Self> {
        let samples: &[DVec3; POINTS] = samples.try_into().ok()?;
        let first = tangent.normalize();
        let axes = [first, normal.cross(first), normal];
        let values = axes.map(|axis| samples.map(|sample| axis.dot(sample)));
        let size = |values: &Column| values.iter().fold(0.0_f64, |size, value| upper_max(size, value.abs()));
        let [x, y, z] = [0, 1, 2].map(|axis| size(&values[axis]));
        let scales = [x.max(y), x.max(y), z];
        let is_proper = scales.iter().all(|scale| *scale > 0.0 && scale.is_finite());
        is_proper.then(|| Self {
            normal,
            coordinates: [0, 1, 2].map(|axis| axes[axis] / scales[axis]),
            points: [0, 1, 2].map(|axis| values[axis].map(|value| value / scales[axis])),
            terms: Vec::new(),
            squares: LeastSquares::new(values[2]),
        })
    }

    /// Half the range of the function's values at the points.
    pub(super) fn spread(&self) -> f64 {
        let [least, largest] = self
            .squares
            .residual()
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, largest], &value| {
                [lower_min(least, value), upper_max(largest, value)]
            });
        0.5 * (largest - least)
    }

    /// Adds terms until what is left is at most `sufficient`: more of them would follow rounding, and their
    /// factors turn the function.
    pub(super) fn add(&mut self, terms: &[[usize; 3]], sufficient: f64) {
        for &term in terms {
            if self.spread() <= sufficient {
                return;
            }
            if self.squares.add(self.values(term)) {
                self.terms.push(term);
            }
        }
    }

    fn values(&self, term: [usize; 3]) -> Column {
        let mut column = [1.0; POINTS];
        for (axis, exponent) in term.into_iter().enumerate() {
            for _ in 0..exponent {
                for (value, coordinate) in column.iter_mut().zip(&self.points[axis]) {
                    *value *= coordinate;
                }
            }
        }
        column
    }

    /// The height less the terms with their factors, without the constant.
    pub(super) fn function(&self) -> Cubic {
        let mut function = Cubic::of(Quadric::of_plane(self.normal));
        for (term, factor) in self.terms.iter().zip(self.squares.factors()) {
            let named = term.iter().zip(&self.coordinates);
            let named = named.flat_map(|(&exponent, &coordinate)| std::iter::repeat_n(coordinate, exponent));
            match named.collect::<Vec<_>>()[..] {
                [a] => function.quadric.linear -= factor * a,
                [a, b] => function.add_product(-factor, a, b),
                [a, b, c] => function.add_triple_product(-factor, a, b, c),
                _ => {}
            }
        }
        function
    }
}
