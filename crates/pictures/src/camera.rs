//! The camera: an orthographic one, so that lengths across a picture compare.

use glam::DVec3;

/// The part of the picture that what is fitted fills.
const FILL: f64 = 0.94;

/// The sine of the angle to the vertical below which a direction has no side that is up.
const MIN_SINE: f64 = 1e-6;

/// An orthographic camera with its picture.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Camera {
    right: DVec3,
    up: DVec3,
    /// The unit vector towards the eye.
    pub(super) toward: DVec3,
    /// What the middle of the picture shows.
    center: DVec3,
    /// Pixels per unit of length.
    scale: f64,
    /// Width and height of the picture, in pixels.
    size: [f64; 2],
    /// The largest depth that is drawn; what is nearer to the eye is cut away.
    pub(super) near: f64,
}

impl Camera {
    /// Returns a camera that sees all points as large as they fit.
    pub(crate) fn fitting(points: &[DVec3], toward: DVec3, [width, height]: [usize; 2]) -> Self {
        let mut camera = Self::new(toward, [width as f64, height as f64]);
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for &point in points.iter().filter(|point| point.is_finite()) {
            let seen = camera.axes(point);
            (low, high) = (low.min(seen), high.max(seen));
        }
        if low.is_finite() && high.is_finite() {
            let (middle, lengths) = (0.5 * (low + high), high - low);
            camera.center = camera.right * middle.x + camera.up * middle.y + camera.toward * middle.z;
            let [across, upwards] = camera.size;
            let scale = FILL * (across / lengths.x).min(upwards / lengths.y);
            camera.scale = if scale.is_finite() && scale > 0.0 { scale } else { 1.0 };
        }
        camera
    }

    /// Returns a camera that sees a ball, and nothing that is nearer to the eye.
    pub(crate) fn around(center: DVec3, radius: f64, toward: DVec3, [width, height]: [usize; 2]) -> Self {
        let mut camera = Self::new(toward, [width as f64, height as f64]);
        let scale = 0.5 * camera.size[0].min(camera.size[1]) / radius;
        camera.center = center;
        camera.scale = if scale.is_finite() && scale > 0.0 { scale } else { 1.0 };
        camera.near = camera.scale * radius;
        camera
    }

    fn new(toward: DVec3, size: [f64; 2]) -> Self {
        let toward = toward.try_normalize().unwrap_or(DVec3::Z);
        let across = DVec3::Z.cross(toward);
        // From above and below, y is up.
        let right = if across.length() > MIN_SINE { across.normalize() } else { DVec3::X };
        let up = toward.cross(right);
        Self { right, up, toward, center: DVec3::ZERO, scale: 1.0, size, near: f64::INFINITY }
    }

    fn axes(&self, point: DVec3) -> DVec3 {
        DVec3::new(self.right.dot(point), self.up.dot(point), self.toward.dot(point))
    }

    /// Returns where a point is seen: pixels from the left and from above, and the depth, in pixels
    /// too, which grows towards the eye.
    pub(crate) fn project(&self, point: DVec3) -> DVec3 {
        let seen = self.axes(point - self.center) * self.scale;
        DVec3::new(0.5 * self.size[0] + seen.x, 0.5 * self.size[1] - seen.y, seen.z)
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn a_box_fits_and_directions_are_those_of_a_reader() {
        let corners: Vec<DVec3> = (0..8)
            .map(|corner| {
                DVec3::new(f64::from(corner & 1), f64::from(corner >> 1 & 1), f64::from(corner >> 2))
            })
            .map(|corner| corner * DVec3::new(4.0, 2.0, 1.0) + 100.0)
            .collect();
        // From the front, x is to the right and z upwards: 4 across fill 94 % of 200 pixels.
        let camera = Camera::fitting(&corners, -DVec3::Y, [200, 300]);
        let [low, high] = [DVec3::splat(100.0), DVec3::new(104.0, 102.0, 101.0)].map(|at| camera.project(at));
        assert!((low.x - 6.0).abs() < 1e-9 && (high.x - 194.0).abs() < 1e-9, "{low} {high}");
        assert!((low.y - (150.0 + 23.5)).abs() < 1e-9 && (high.y - (150.0 - 23.5)).abs() < 1e-9);
        // What is at the front is nearer to the eye.
        assert!(low.z > high.z);
        let above = Camera::fitting(&corners, DVec3::Z, [200, 300]);
        assert!(above.project(DVec3::new(104.0, 102.0, 0.0)).x > 190.0);
        assert!(above.project(DVec3::new(104.0, 102.0, 0.0)).y < 150.0);
    }

    #[test]
    fn no_points_and_no_numbers_are_seen_at_no_place() {
        for points in [vec![], vec![DVec3::NAN], vec![DVec3::ONE]] {
            let camera = Camera::fitting(&points, DVec3::NAN, [20, 10]);
            assert!(camera.project(DVec3::ONE).is_finite(), "{points:?}");
        }
        assert!(Camera::around(DVec3::ZERO, 0.0, DVec3::ZERO, [20, 10]).project(DVec3::ONE).is_finite());
    }
}
