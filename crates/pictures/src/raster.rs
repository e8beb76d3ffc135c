//! The rasterizer: triangles with values at their corners to samples with depths, and these to
//! pixels. It knows nothing of models, files and the web.

use super::camera::Camera;
use glam::DVec3;

/// Samples along each side of a pixel, whose mean its colour is.
pub(super) const OVERSAMPLING: usize = 2;

/// The colour of what no triangle covers: that of paper.
pub(super) const BACKGROUND: [u8; 3] = [255; 3];

/// The brightness of a surface that is seen edge on. One that faces the eye has the colours of the legend.
const GRAZING: f64 = 0.65;

/// The part of its colour that an edge keeps.
const EDGE: f64 = 0.4;

/// The cosine of the angle of two normals beside each other below which there is an edge.
const CREASE: f32 = 0.8;

/// The step of the depth, in samples, beyond which there is an edge: no surface is seen at that angle.
const STEP: f64 = 30.0;

/// The face of samples that no triangle covers.
const NONE: u32 = u32::MAX;

/// A colour by a signed deviation, NaN where it has no sign, and the distance.
pub(crate) type Color<'a> = &'a dyn Fn([f64; 2]) -> [u8; 3];

/// A corner of a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Corner {
    /// Where it is.
    pub(crate) position: DVec3,
    /// The normal of the surface there; 0 for that of the triangle.
    pub(crate) normal: DVec3,
    /// The signed deviation and the distance.
    pub(crate) value: [f64; 2],
}

/// The samples of a picture.
pub(crate) struct Raster {
    size: [usize; 2],
    /// The depth, in samples.
    depths: Vec<f64>,
    /// The face that is seen.
    faces: Vec<u32>,
    normals: Vec<[f32; 3]>,
    colors: Vec<[u8; 3]>,
}

impl Raster {
    /// An empty picture of this width and height in pixels.
    pub(crate) fn new([width, height]: [usize; 2]) -> Self {
        let size = [width * OVERSAMPLING, height * OVERSAMPLING];
        let count = size[0] * size[1];
        Self {
            size,
            depths: vec![f64::NEG_INFINITY; count],
            faces: vec![NONE; count],
            normals: vec![[0.0; 3]; count],
            colors: vec![BACKGROUND; count],
        }
    }

    /// Draws a triangle of a face; one without an area, or with a coordinate that is not finite,
    /// covers nothing. The nearest surface is seen, and of several the first.
    pub(crate) fn triangle(&mut self, camera: &Camera, corners: &[Corner; 3], face: u32, color: Color<'_>) {
        let [a, b, c] = corners.map(|corner| camera.project(corner.position) * OVERSAMPLING as f64);
        let area = cross(a, b, c);
        if !area.is_finite() || area == 0.0 {
            return;
        }
        let flat = {
            let [a, b, c] = corners.map(|corner| corner.position);
            (b - a).cross(c - a).normalize_or_zero()
        };
        let normals = corners.map(|corner| if corner.normal == DVec3::ZERO { flat } else { corner.normal });
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let range = |low: f64, high: f64, size: usize| {
            // Centres of samples are at halves; casts of numbers out of range give the nearest.
            ((low - 0.5).ceil() as usize)..(((high - 0.5).floor() + 1.0) as usize).min(size)
        };
        let near = camera.near * OVERSAMPLING as f64;
        for y in range(low.y, high.y, self.size[1]) {
            for x in range(low.x, high.x, self.size[0]) {
                let at = DVec3::new(x as f64 + 0.5, y as f64 + 0.5, 0.0);
                let weights = [cross(b, c, at) / area, cross(c, a, at) / area, cross(a, b, at) / area];
                if !weights.iter().all(|&weight| weight >= 0.0) {
                    continue;
                }
                let mean = |of: [f64; 3]| of[0] * weights[0] + of[1] * weights[1] + of[2] * weights[2];
                let depth = mean([a.z, b.z, c.z]);
                let index = y * self.size[0] + x;
                if !(depth > self.depths[index] && depth <= near) {
                    continue;
                }
                let [m, n, o] = normals;
                let normal = (m * weights[0] + n * weights[1] + o * weights[2]).normalize_or(flat);
                let value = [0, 1].map(|which| mean(corners.map(|corner| corner.value[which])));
                self.depths[index] = depth;
                self.faces[index] = face;
                self.normals[index] = normal.as_vec3().to_array();
                self.colors[index] = shaded(color(value), normal.dot(camera.toward).abs());
            }
        }
    }

    /// Draws a point as a square of this many pixels.
    pub(crate) fn point(&mut self, camera: &Camera, corner: &Corner, pixels: f64, color: Color<'_>) {
        let at = camera.project(corner.position) * OVERSAMPLING as f64;
        if !at.is_finite() || at.z > camera.near * OVERSAMPLING as f64 {
            return;
        }
        let half = 0.5 * pixels * OVERSAMPLING as f64;
        let range = |at: f64, size: usize| {
            ((at - half).round() as usize)..((at + half).round().max(0.0) as usize).min(size)
        };
        for y in range(at.y, self.size[1]) {
            for x in range(at.x, self.size[0]) {
                let index = y * self.size[0] + x;
                if at.z > self.depths[index] {
                    self.depths[index] = at.z;
                    self.colors[index] = color(corner.value);
                }
            }
        }
    }

    /// Returns whether nothing is drawn in front of a point by more than `slack` pixels.
    pub(crate) fn sees(&self, camera: &Camera, point: DVec3, slack: f64) -> bool {
        let at = camera.project(point) * OVERSAMPLING as f64;
        if !at.is_finite() || at.x < 0.0 || at.y < 0.0 {
            return false;
        }
        let (x, y) = (at.x as usize, at.y as usize);
        x < self.size[0]
            && y < self.size[1]
            && self.depths[y * self.size[0] + x] <= at.z + slack * OVERSAMPLING as f64
    }

    /// Returns red, green and blue of all pixels, the upper row first, with the edges of faces.
    pub(crate) fn pixels(&self) -> Vec<u8> {
        let [width, height] = self.size;
        let mut pixels = Vec::with_capacity(3 * width * height / (OVERSAMPLING * OVERSAMPLING));
        for y in (0..height).step_by(OVERSAMPLING) {
            for x in (0..width).step_by(OVERSAMPLING) {
                let mut sums = [0_u32; 3];
                for row in y..y + OVERSAMPLING {
                    for column in x..x + OVERSAMPLING {
                        let color = self.sample(column, row);
                        sums = [0, 1, 2].map(|part| sums[part] + u32::from(color[part]));
                    }
                }
                let count = (OVERSAMPLING * OVERSAMPLING) as u32;
                pixels.extend(sums.map(|sum| ((sum + count / 2) / count) as u8));
            }
        }
        pixels
    }

    fn sample(&self, x: usize, y: usize) -> [u8; 3] {
        let index = y * self.size[0] + x;
        let right = (x + 1 < self.size[0]).then_some(index + 1);
        let below = (y + 1 < self.size[1]).then_some(index + self.size[0]);
        let is_edge = [right, below].into_iter().flatten().any(|other| self.is_edge(index, other));
        if is_edge {
            self.colors[index].map(|part| (f64::from(part) * EDGE) as u8)
        } else {
            self.colors[index]
        }
    }

    /// Whether an edge of a face, a crease or a contour is between two samples beside each other.
    fn is_edge(&self, one: usize, other: usize) -> bool {
        if self.faces[one] != self.faces[other] {
            return true;
        }
        if self.faces[one] == NONE {
            return false;
        }
        let [[a, b, c], [d, e, f]] = [self.normals[one], self.normals[other]];
        // The two sides of a surface have opposite normals in some files.
        (a * d + b * e + c * f).abs() < CREASE || (self.depths[one] - self.depths[other]).abs() > STEP
    }
}

/// Twice the signed area of a triangle as it is seen.
fn cross(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
}

/// The colour under a lamp at the eye, by the cosine of the angle to the normal.
fn shaded(color: [u8; 3], cosine: f64) -> [u8; 3] {
    color.map(|part| (f64::from(part) * (GRAZING + (1.0 - GRAZING) * cosine) + 0.5) as u8)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    const SIZE: [usize; 2] = [120, 100];

    /// From above, a pixel a unit, with the origin in the middle.
    fn above() -> Camera {
        Camera::around(DVec3::ZERO, 50.0, DVec3::Z, SIZE)
    }

    fn corner(x: f64, y: f64, z: f64, value: f64) -> Corner {
        Corner { position: DVec3::new(x, y, z), normal: DVec3::ZERO, value: [value, value.abs()] }
    }

    /// Red is the value.
    fn red([value, _]: [f64; 2]) -> [u8; 3] {
        [value.round() as u8, 0, 0]
    }

    fn at(raster: &Raster, x: usize, y: usize) -> [u8; 3] {
        let first = 3 * (y * SIZE[0] + x);
        [0, 1, 2].map(|part| raster.pixels()[first + part])
    }

    #[test]
    fn a_sphere_covers_the_area_of_its_circle_and_is_darker_at_its_rim() {
        let (radius, count) = (40.0, 60);
        let point = |row: usize, column: usize| {
            let (polar, turn) = (PI * row as f64 / count as f64, PI * column as f64 / count as f64);
            let normal = DVec3::new(polar.sin() * turn.cos(), polar.sin() * turn.sin(), polar.cos());
            Corner { position: radius * normal, normal, value: [200.0, 200.0] }
        };
        let mut raster = Raster::new(SIZE);
        for row in 0..count {
            for column in 0..2 * count {
                let [a, b] = [point(row, column), point(row, column + 1)];
                let [c, d] = [point(row + 1, column), point(row + 1, column + 1)];
                raster.triangle(&above(), &[a, c, b], 0, &red);
                raster.triangle(&above(), &[b, c, d], 0, &red);
            }
        }
        let covered = raster.faces.iter().filter(|&&face| face == 0).count();
        let samples = PI * (radius * OVERSAMPLING as f64).powi(2);
        assert!((covered as f64 / samples - 1.0).abs() < 0.01, "{covered} of {samples}");
        // The middle faces the eye; at 30 of 40 from it the cosine is the root of 1 - 9/16.
        assert_eq!(at(&raster, 60, 50), [200, 0, 0]);
        let expected = 200.0 * (0.65 + 0.35 * (7.0_f64 / 16.0).sqrt());
        assert!((f64::from(at(&raster, 90, 50)[0]) - expected).abs() < 3.0, "{:?}", at(&raster, 90, 50));
    }

    #[test]
    fn values_are_linear_on_a_triangle_and_outside_is_paper() {
        let mut raster = Raster::new(SIZE);
        // The value is the distance from the left end.
        let corners =
            [corner(-50.0, -40.0, 0.0, 0.0), corner(50.0, -40.0, 0.0, 100.0), corner(-50.0, 40.0, 0.0, 0.0)];
        raster.triangle(&above(), &corners, 0, &red);
        for x in [20, 35, 50] {
            // The middle of the pixel is at half; y is downwards.
            let expected = x as f64 + 0.5 - 10.0;
            assert!((f64::from(at(&raster, x, 80)[0]) - expected).abs() <= 1.0, "{x}");
        }
        assert_eq!(at(&raster, 100, 20), BACKGROUND);
    }

    #[test]
    fn the_nearer_triangle_is_seen_whichever_is_drawn_first() {
        let near =
            [corner(-30.0, -30.0, 5.0, 50.0), corner(30.0, -30.0, 5.0, 50.0), corner(0.0, 30.0, 5.0, 50.0)];
        let far = near.map(|corner| Corner {
            value: [150.0, 150.0],
            position: corner.position - 20.0 * DVec3::Z,
            ..corner
        });
        for order in [[&near, &far], [&far, &near]] {
            let mut raster = Raster::new(SIZE);
            order.iter().for_each(|triangle| raster.triangle(&above(), triangle, 0, &red));
            assert_eq!(at(&raster, 60, 50), [50, 0, 0]);
            assert!(raster.sees(&above(), DVec3::new(0.0, 0.0, 5.0), 1.0));
            assert!(!raster.sees(&above(), DVec3::new(0.0, 0.0, -15.0), 1.0));
        }
    }

    #[test]
    fn edges_between_faces_are_dark_and_within_a_face_are_not() {
        let half = |side: f64| {
            [corner(0.0, -40.0, 0.0, 200.0), corner(0.0, 40.0, 0.0, 200.0), corner(side, 0.0, 0.0, 200.0)]
        };
        for (face, expected) in [(0, 200), (1, 200 - 60)] {
            let mut raster = Raster::new(SIZE);
            raster.triangle(&above(), &half(-40.0), 0, &red);
            raster.triangle(&above(), &half(40.0), face, &red);
            // One of the two columns of samples left of the edge has 0.4 of its colour.
            assert_eq!(at(&raster, 59, 50)[0], expected);
            assert_eq!(at(&raster, 61, 50)[0], 200);
        }
    }

    #[test]
    fn what_has_no_area_or_number_covers_nothing() {
        let mut raster = Raster::new(SIZE);
        let [a, b] = [corner(-30.0, -30.0, 0.0, 9.0), corner(30.0, 30.0, 0.0, 9.0)];
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let c = corner(value, 0.0, 0.0, 9.0);
            raster.triangle(&above(), &[a, b, c], 0, &red);
            raster.point(&above(), &c, 3.0, &red);
        }
        raster.triangle(&above(), &[a, b, b], 0, &red);
        raster.triangle(&above(), &[a, a, a], 0, &red);
        assert!(raster.pixels().iter().all(|&part| part == BACKGROUND[0]));
        // A depth without a number is behind everything.
        let deep = [a, b, corner(30.0, -30.0, f64::NAN, 9.0)];
        raster.triangle(&above(), &deep, 0, &red);
        assert!(raster.pixels().iter().all(|&part| part == BACKGROUND[0]));
        raster.point(&above(), &corner(0.0, 0.0, 0.0, 9.0), 4.0, &red);
        assert_eq!(at(&raster, 60, 50), [9, 0, 0]);
        // One that is far larger than the picture is cut at its ends.
        raster.triangle(&above(), &[a, b, corner(1e200, 0.0, 0.0, 9.0)], 0, &red);
        assert!(Raster::new([0, 0]).pixels().is_empty());
    }
}
