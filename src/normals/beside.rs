//! Points with their normals by the formulas of both models, and the audit of lemmas N3 and N7 by them.

use super::Likenesses;
use super::comparison::Own;
use glam::DVec3;

/// The rounding of an angle of two normals that are computed from derivatives, in radians. [`crate::bezier::Jet::normal`]
/// states none at a smaller sine of the derivatives than 1e-10, which loses ten of the sixteen digits.
const ANGLE_ROUNDING: f64 = 1e-5;

/// A part of A as its formula makes it: no box, cone or control point of a part is used.
pub(crate) trait ByFormula {
    /// Returns the corners and the middle of the part, moved.
    fn points(&self) -> Vec<DVec3>;

    /// Returns the middle of the part, moved, and a point of B near it; `None` where none is known, or a normal.
    fn beside(&self) -> Option<[OrientedPoint; 2]>;
}

/// A point of a surface with a normal there, to either side and of any length but 0.
#[derive(Debug, Clone, Copy)]
pub(crate) struct OrientedPoint {
    pub(crate) point: DVec3,
    pub(crate) normal: DVec3,
}

impl Likenesses<'_> {
    /// The audit of the premise that all parts of B within a distance of a part of A are alike: returns whether the point
    /// beside the middle is within it and is not alike. O(p q).
    pub(super) fn is_refuted_beside(&self, own: &Own<'_>, within: f64) -> bool {
        let Some([middle, beside]) = own.formula.beside() else { return false };
        let angle = middle.normal.cross(beside.normal).length().atan2(middle.normal.dot(beside.normal).abs());
        // Not "is larger", so that NaN refutes.
        middle.point.distance(beside.point) <= within && !(angle <= self.angle + ANGLE_ROUNDING)
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
pub(super) mod tests {
    use super::*;
    use crate::bezier::{Patch, PatchSet};
    use crate::closest::Target;
    use crate::normals::{Likeness, NormalCone, NormalTarget, Reach, Shape};

    /// A part that states these points, and these two with their normals.
    pub(in crate::normals) struct Points(
        pub(in crate::normals) Vec<DVec3>,
        pub(in crate::normals) Option<[OrientedPoint; 2]>,
    );

    impl ByFormula for Points {
        fn points(&self) -> Vec<DVec3> {
            self.0.clone()
        }

        fn beside(&self) -> Option<[OrientedPoint; 2]> {
            self.1
        }
    }

    /// A tile from 0.2 to 0.3 above a square is alike by distance at 0.25, and up to 0.5 alike. A point beside its middle
    /// with another normal refutes the first, if it is within the distances of the tile.
    #[test]
    fn a_point_beside_that_is_not_alike_refutes() {
        let corner = |x: f64, y: f64| DVec3::new(x, y, 0.0).extend(1.0);
        let controls = [corner(0.0, 0.0), corner(0.0, 1.0), corner(1.0, 0.0), corner(1.0, 1.0)];
        let mut patches = PatchSet::default();
        patches.push(Patch::whole([1, 1], DVec3::ZERO, &controls));
        let target = Target::new(patches);
        let target = NormalTarget::of_patches(&target);
        let points =
            [[0.4, 0.4, 0.2], [0.4, 0.6, 0.2], [0.6, 0.4, 0.3], [0.6, 0.6, 0.3]].map(DVec3::from_array);
        let cone = NormalCone::of_triangle([points[0], points[1], points[2]], 0.0);
        let shape = Shape::of_points(points.to_vec(), cone);
        let middle = OrientedPoint { point: DVec3::new(0.5, 0.5, 0.25), normal: DVec3::new(-0.5, 0.0, 1.0) };
        let likeness = |threshold: f64, height: f64, normal: DVec3| {
            let likenesses = Likenesses::new(&target, Reach::new(threshold, [0.0; 2]), 0.6);
            let beside = OrientedPoint { point: DVec3::new(0.5, 0.5, height), normal };
            let formula = Points(points.to_vec(), Some([middle, beside]));
            likenesses.of(&shape, [0.2, 0.3], &formula)
        };
        assert_eq!(likeness(0.25, 0.0, DVec3::Z), Likeness::ByDistance);
        assert_eq!(likeness(0.25, 0.0, -DVec3::Z), Likeness::ByDistance, "sheets have no side");
        assert_eq!(likeness(0.25, 0.0, DVec3::X), Likeness::Open);
        assert_eq!(likeness(0.25, 0.0, DVec3::NAN), Likeness::Open);
        assert_eq!(likeness(0.25, -0.06, DVec3::X), Likeness::ByDistance, "beyond the distances of the tile");
        // The angle of the tile's normal is 0.4636.
        let turned = |angle: f64| DVec3::new(angle.sin(), 0.0, angle.cos());
        assert_eq!(likeness(0.25, 0.0, turned(0.13)), Likeness::ByDistance);
        assert_eq!(likeness(0.25, 0.0, turned(0.14)), Likeness::Open);
    }
}
