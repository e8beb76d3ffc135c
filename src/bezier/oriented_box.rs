//! Boxes along a patch's own directions.

use super::Patch;
use glam::{DVec3, Vec4Swizzles};

/// A box around a patch along three directions square to each other, which for
/// a patch that is nearly flat is little larger than the patch.
#[derive(Debug, Clone, Copy)]
pub struct OrientedBox {
    /// The patch's centre.
    center: DVec3,
    axes: [DVec3; 3],
    /// The range along each axis, relative to the centre.
    low: DVec3,
    high: DVec3,
}

impl OrientedBox {
    /// Of the control points, along the longer mean direction of the net, near
    /// the other one and square to both; along x, y and z where these are
    /// parallel. O(p q).
    #[must_use]
    pub fn new(patch: &Patch<'_>) -> Self {
        let (last, columns) = (patch.controls.len() - 1, patch.degree[1]);
        let way = |from: usize, to: usize| {
            let at = |index: usize| patch.controls[index].xyz() / patch.controls[index].w;
            at(to) - at(from)
        };
        let [rising, falling] = [way(0, last), way(columns, last - columns)];
        let [s, t] = [rising + falling, rising - falling];
        let [long, short] = if s.length_squared() > t.length_squared() { [s, t] } else { [t, s] };
        let first = long.normalize_or_zero();
        let across = short - first.dot(short) * first;
        // Once more, as little may be left of it but rounding.
        let second = (across - first.dot(across) * first).normalize_or_zero();
        let axes = if second == DVec3::ZERO {
            [DVec3::X, DVec3::Y, DVec3::Z]
        } else {
            [first, second, first.cross(second)]
        };
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for point in patch.local_points() {
            let place = along(&axes, point);
            (low, high) = (low.min(place), high.max(place));
        }
        Self { center: patch.center, axes, low, high }
    }

    /// At most the squared distance from `point` to the patch, but for rounding,
    /// by which its root may be off by 32 units of 2^-53 of the largest coordinate.
    #[must_use]
    pub fn min_distance_squared(&self, point: DVec3) -> f64 {
        let place = along(&self.axes, point - self.center);
        (self.low - place).max(place - self.high).max(DVec3::ZERO).length_squared()
    }
}

fn along(axes: &[DVec3; 3], way: DVec3) -> DVec3 {
    DVec3::new(axes[0].dot(way), axes[1].dot(way), axes[2].dot(way))
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::OrientedBox;
    use crate::bezier::{Patch, extract};
    use crate::param_box::ParamBox;
    use crate::shapes::shape;
    use glam::{DVec3, DVec4};

    /// The box contains the patch, so no point of it is nearer, and for nearly
    /// flat patches askew to the axes it is closer than the aligned box.
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

    /// Points, lines and nets whose diagonals are opposite have boxes along
    /// directions square to each other too.
    #[test]
    fn degenerate_nets_have_square_axes() {
        let nets = [
            [[0.0; 3]; 4],
            [[0.1, 0.2, 0.3], [0.2, 0.4, 0.6], [0.3, 0.6, 0.9], [0.4, 0.8, 1.2]],
            [[0.0; 3], [1.0, 1.0, 1.0], [1.0, 1.0, 1.0 + 1e-16], [1e-17, 0.0, 0.0]],
            [[0.1, 0.2, 0.7], [0.1, 0.2, 0.7], [0.3, 0.3, 0.3], [0.3, 0.3, 0.3]],
        ];
        for net in nets {
            let controls = net.map(|[x, y, z]| DVec4::new(x, y, z, 1.0));
            let patch = Patch {
                surface: 0,
                degree: [1, 1],
                domain: ParamBox::UNIT,
                center: DVec3::ZERO,
                controls: &controls,
                rational: false,
            };
            let [a, b, c] = OrientedBox::new(&patch).axes;
            for (one, other) in [(a, b), (b, c), (c, a)] {
                assert!(one.dot(other).abs() < 1e-15 && (one.length() - 1.0).abs() < 1e-15, "{net:?}");
            }
        }
    }
}
