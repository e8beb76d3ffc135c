//! Boxes aligned with a patch's own directions.

use crate::bezier::Patch;
use crate::rounding::unit;
use glam::{DVec3, Vec4Swizzles};

/// A box around a patch along three orthogonal axes. For a nearly flat patch it
/// is little larger than the patch.
#[derive(Debug, Clone, Copy)]
pub struct OrientedBox {
    /// The patch's centre.
    center: DVec3,
    axes: [DVec3; 3],
    /// The range along each axis, relative to the centre.
    low: DVec3,
    high: DVec3,
}

/// The sine of the angle between the net's mean directions from which on they span the plane of
/// the first two axes. Rounding moves directions by some 2^-53, which is then a part of 2^-26 of
/// the sine at most; between more nearly parallel ones it may be all that there is.
const MIN_SINE: f64 = 1.0 / 134_217_728.0;

impl OrientedBox {
    /// Returns the box of the control points. Its first axis is the longer of the
    /// net's two mean directions, its second lies in their plane; where they
    /// are parallel, the axes are x, y and z. O(p q).
    #[must_use]
    pub fn new(patch: &Patch<'_>) -> Self {
        let (last, columns) = (patch.controls.len() - 1, patch.degree[1]);
        let leg = |from: usize, to: usize| {
            let at = |index: usize| patch.controls[index].xyz() / patch.controls[index].w;
            at(to) - at(from)
        };
        let [rising, falling] = [leg(0, last), leg(columns, last - columns)];
        let [s, t] = [rising + falling, rising - falling];
        let [long, short] = if s.abs().max_element() > t.abs().max_element() { [s, t] } else { [t, s] };
        let [first, other] = [long, short].map(unit);
        let across = other - first.dot(other) * first;
        // Of parallel directions rounding remains, which may be parallel to the first axis itself.
        let axes = if across.length() > MIN_SINE {
            // The second projection removes what rounding left along the first axis.
            let second = (across - first.dot(across) * first).normalize();
            [first, second, first.cross(second)]
        } else {
            [DVec3::X, DVec3::Y, DVec3::Z]
        };
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for point in patch.local_points() {
            let coordinates = coordinates(&axes, point);
            (low, high) = (low.min(coordinates), high.max(coordinates));
        }
        Self { center: patch.center, axes, low, high }
    }

    /// Returns a lower bound on the squared distance from `point` to the patch,
    /// up to rounding: the error of its root is at most 32 units of 2^-53 of
    /// the largest coordinate.
    #[must_use]
    pub fn min_distance_squared(&self, point: DVec3) -> f64 {
        let coordinates = coordinates(&self.axes, point - self.center);
        (self.low - coordinates).max(coordinates - self.high).max(DVec3::ZERO).length_squared()
    }
}

/// Returns the coordinates of a vector along orthonormal axes.
fn coordinates(axes: &[DVec3; 3], vector: DVec3) -> DVec3 {
    DVec3::new(axes[0].dot(vector), axes[1].dot(vector), axes[2].dot(vector))
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use crate::bezier::OrientedBox;
    use crate::bezier::{Patch, extract};
    use crate::shapes::shape;
    use glam::{DVec3, DVec4};

    /// The box contains the patch, so no point of it is nearer, and for nearly
    /// flat patches oblique to the axes it is closer than the aligned box.
    #[test]
    fn no_point_of_a_patch_is_nearer_than_its_oriented_box() {
        let random = &mut fastrand::Rng::with_seed(7);
        let mut number = || 2.0 * random.f64() - 1.0;
        let (mut closer, mut count) = (0, 0);
        for name in ["bottle", "torus", "wavy-sheet", "naca-wing"] {
            let Ok(model) = shape(name) else { unreachable!() };
            let patches = extract(&model).patches;
            for patch in patches.iter() {
                let oriented = OrientedBox::new(&patch);
                let size = patch.bounding_box().diagonal();
                let from = patch.center + size * DVec3::new(number(), number(), number());
                let least = oriented.min_distance_squared(from).sqrt();
                closer += usize::from(least > patch.bounding_box().min_distance_squared(from).sqrt());
                count += 1;
                for _ in 0..50 {
                    let point = patch.point([number().abs(), number().abs()]);
                    assert!(point.distance(from) >= least - 1e-12 * size, "{name}");
                }
            }
        }
        assert!(2 * closer > count, "{closer} of {count}");
    }

    /// Points, lines and nets with opposite diagonals have boxes with orthogonal
    /// axes too.
    #[test]
    fn degenerate_nets_have_orthogonal_axes() {
        let nets = [
            [[0.0; 3]; 4],
            [[0.1, 0.2, 0.3], [0.2, 0.4, 0.6], [0.3, 0.6, 0.9], [0.4, 0.8, 1.2]],
            [[0.0; 3], [1.0, 1.0, 1.0], [1.0, 1.0, 1.0 + 1e-16], [1e-17, 0.0, 0.0]],
            [[0.1, 0.2, 0.7], [0.1, 0.2, 0.7], [0.3, 0.3, 0.3], [0.3, 0.3, 0.3]],
        ];
        for net in nets {
            check_axes(net);
        }
        // All along one line: the directions are parallel up to rounding.
        let random = &mut fastrand::Rng::with_seed(8);
        let mut number = || 2.0 * random.f64() - 1.0;
        for _ in 0..1000 {
            let along = [number(), number(), number()];
            let places = [0.0, number(), number(), number()];
            check_axes(places.map(|place| along.map(|value| place * value)));
        }
        // Squares of their lengths underflow.
        for exponent in -545..-500 {
            let net = [[0.0; 3], [0.0, 1.0, 0.3], [1.3, 0.1, 0.0], [1.0, 1.0, 0.2]];
            check_axes(net.map(|point| point.map(|value: f64| value * 2.0_f64.powi(exponent))));
        }
        // Directions are nearly parallel, so that one projection leaves a part along the first axis.
        for angle in [1e-7, 2e-8, 1e-8] {
            check_axes([[0.0; 3], [0.1, 0.2 + angle, 0.7], [0.3, 0.6, 2.1], [0.4, 0.8 - angle, 2.8]]);
        }
        // As found by fuzzing: rounding alone remained, parallel to the first axis.
        let on_diagonal = |y: f64| [0.0, y, y];
        check_axes([-0.0625, 0.0, 0.0, 0.0].map(on_diagonal));
    }

    fn check_axes(net: [[f64; 3]; 4]) {
        let controls = net.map(|[x, y, z]| DVec4::new(x, y, z, 1.0));
        let patch = Patch::whole([1, 1], DVec3::ZERO, &controls);
        let [a, b, c] = OrientedBox::new(&patch).axes;
        for (one, other) in [(a, b), (b, c), (c, a)] {
            assert!(one.dot(other).abs() < 1e-15 && (one.length() - 1.0).abs() < 1e-15, "{net:?}");
        }
    }
}
