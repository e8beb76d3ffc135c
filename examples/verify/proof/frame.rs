//! Where the models are proved about: moved to the origin and scaled to a size near 1.

use super::interval::Interval;
use super::surface::Model;
use super::vector::{Vector, exactly, middle};

/// How A is moved: a rotation by a quaternion `[x, y, z, w]`, not necessarily of length 1, then a
/// translation.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Motion {
    pub(crate) rotation: [f64; 4],
    pub(crate) translation: [f64; 3],
}

impl Motion {
    /// Moves nothing.
    pub(crate) const IDENTITY: Self = Self { rotation: [0.0, 0.0, 0.0, 1.0], translation: [0.0; 3] };

    /// Where a point goes: q p q* / |q|² + t, whose matrix is exactly a rotation for every q but 0.
    fn apply(&self, point: &Vector) -> Vector {
        if *self == Self::IDENTITY {
            return *point;
        }
        let [x, y, z, w] = self.rotation.map(Interval::point);
        let length = x.square() + y.square() + z.square() + w.square();
        let two = Interval::point(2.0);
        let rows = [
            [w.square() + x.square() - y.square() - z.square(), two * (x * y - w * z), two * (x * z + w * y)],
            [two * (x * y + w * z), w.square() - x.square() + y.square() - z.square(), two * (y * z - w * x)],
            [two * (x * z - w * y), two * (y * z + w * x), w.square() - x.square() - y.square() + z.square()],
        ];
        std::array::from_fn(|axis| {
            let row = &rows[axis];
            let turned = row[0] * point[0] + row[1] * point[1] + row[2] * point[2];
            turned / length + Interval::point(self.translation[axis])
        })
    }
}

impl PartialEq for Motion {
    fn eq(&self, other: &Self) -> bool {
        self.rotation == other.rotation && self.translation == other.translation
    }
}

/// A common frame of both models: points p become (p - center) scale, distances d become d scale.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Frame {
    center: [f64; 3],
    /// A power of two.
    pub(crate) scale: f64,
    /// The larger diagonal of the two boxes of control points, A's before it is moved, as the
    /// library has it; not scaled and not rigorous.
    pub(crate) diagonal: f64,
}

impl Frame {
    /// The frame about B and the moved A in which the larger extent is near 1.
    pub(crate) fn new(a: &Model, motion: &Motion, b: &Model) -> Self {
        let moved = a.points().map(|point| middle(&motion.apply(&exactly(point))));
        let [lo, hi] = bounds(moved.chain(b.points()));
        let center = std::array::from_fn(|axis| 0.5 * lo[axis] + 0.5 * hi[axis]);
        let extent = (0..3).map(|axis| hi[axis] - lo[axis]).fold(0.0, f64::max);
        let diagonal = |model: &Model| {
            let [lo, hi] = bounds(model.points());
            let [x, y, z] = std::array::from_fn(|axis| hi[axis] - lo[axis]);
            f64::hypot(f64::hypot(x, y), z)
        };
        Self { center, scale: 1.0 / power_of_two(extent), diagonal: f64::max(diagonal(a), diagonal(b)) }
    }

    /// The point in the frame, moved first.
    pub(crate) fn place(&self, point: [f64; 3], motion: &Motion) -> Vector {
        let moved = motion.apply(&exactly(point));
        let scale = Interval::point(self.scale);
        std::array::from_fn(|axis| (moved[axis] - Interval::point(self.center[axis])) * scale)
    }
}

/// The power of two at or just below a positive number; 1 for 0 and what is not finite.
pub(crate) fn power_of_two(value: f64) -> f64 {
    let exponent = value.log2().floor();
    if exponent.is_finite() { exponent.exp2() } else { 1.0 }
}

/// The box of points.
fn bounds(points: impl Iterator<Item = [f64; 3]>) -> [[f64; 3]; 2] {
    points.fold([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]], |[lo, hi], point| {
        [
            std::array::from_fn(|axis| lo[axis].min(point[axis])),
            std::array::from_fn(|axis| hi[axis].max(point[axis])),
        ]
    })
}
