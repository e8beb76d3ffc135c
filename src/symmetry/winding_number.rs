//! The winding number of a closed polygon.

use glam::DVec2;

/// Returns the winding number about the origin of the closed polygon with these
/// corners; no side may pass through the origin.
///
/// It counts the crossings of the negative x axis with their signs. O(corners).
pub(super) fn winding(corners: &[DVec2]) -> i32 {
    let mut turns = 0;
    for (index, from) in corners.iter().enumerate() {
        let to = corners[(index + 1) % corners.len()];
        let down = from.y >= 0.0;
        if down != (to.y >= 0.0) && from.x + (to.x - from.x) * from.y / (from.y - to.y) < 0.0 {
            turns += if down { 1 } else { -1 };
        }
    }
    turns
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    fn regular(corners: u32, turns: f64, center: DVec2) -> Vec<DVec2> {
        let angle = |index: u32| std::f64::consts::TAU * turns * f64::from(index) / f64::from(corners);
        (0..corners).map(|index| center + DVec2::from_angle(angle(index))).collect()
    }

    #[test]
    fn polygons_around_and_next_to_the_origin() {
        for corners in [3, 4, 5, 8, 9] {
            assert_eq!(winding(&regular(corners, 1.0, DVec2::ZERO)), 1);
            assert_eq!(winding(&regular(corners, -1.0, DVec2::ZERO)), -1);
            assert_eq!(winding(&regular(corners, 1.0, DVec2::new(-3.0, 0.1))), 0);
            assert_eq!(winding(&regular(corners, 1.0, DVec2::new(-3.0, 0.0))), 0);
        }
        assert_eq!(winding(&regular(9, 2.0, DVec2::ZERO)), 2);
        // Half a circle forth and back.
        let there = regular(8, 0.5, DVec2::ZERO);
        let back: Vec<_> = there.iter().chain(there.iter().rev()).copied().collect();
        assert_eq!(winding(&back), 0);
    }
}
