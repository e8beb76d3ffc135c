//! Vectors of intervals in space.

use super::interval::Interval;

/// A box of points, or of vectors.
pub(crate) type Vector = [Interval; 3];

/// a - b.
pub(crate) fn difference(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

/// The scalar products.
pub(crate) fn dot(a: &Vector, b: &Vector) -> Interval {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The Euclidean norms.
///
/// Components are squared as they are: models are brought to a size near 1 first, so that squares
/// of lengths that matter neither overflow nor vanish.
pub(crate) fn norm(vector: &Vector) -> Interval {
    (vector[0].square() + vector[1].square() + vector[2].square()).sqrt()
}

/// The box of one point.
pub(crate) fn exactly(point: [f64; 3]) -> Vector {
    point.map(Interval::point)
}

/// A point about the middle of the box.
pub(crate) fn middle(vector: &Vector) -> [f64; 3] {
    vector.map(Interval::mid)
}

/// The smallest box that contains both.
pub(crate) fn hull(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|axis| a[axis].hull(b[axis]))
}
