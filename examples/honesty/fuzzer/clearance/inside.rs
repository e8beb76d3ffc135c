//! Whether points lie inside a solid, by rays through its triangles.

use glam::DVec3;

/// The rays from a point, which must agree.
const DIRECTIONS: [[f64; 3]; 5] = [
    [0.31, 0.57, 0.76],
    [-0.83, 0.21, 0.52],
    [0.11, -0.93, 0.35],
    [-0.47, -0.38, -0.79],
    [0.67, 0.29, -0.68],
];

/// The triangles of a closed model.
pub(crate) struct Triangles {
    corners: Vec<[DVec3; 3]>,
    /// The distance from the corners below which nothing is said: the triangles are off the faces by
    /// less.
    margin: f64,
}

impl Triangles {
    pub(super) fn new(corners: Vec<[DVec3; 3]>, margin: f64) -> Self {
        Self { corners, margin }
    }

    /// Returns whether the point is inside; `None` near the triangles, or where rays disagree.
    pub(crate) fn contain(&self, point: DVec3) -> Option<bool> {
        let near = self.corners.iter().any(|triangle| distance_to_box(point, triangle) < self.margin);
        if near {
            return None;
        }
        let parities = DIRECTIONS.map(|direction| {
            let direction = DVec3::from_array(direction);
            self.corners.iter().filter(|triangle| is_crossed(point, direction, triangle)).count() % 2 == 1
        });
        parities.iter().all(|&parity| parity == parities[0]).then_some(parities[0])
    }
}

/// The distance from the box of a triangle.
fn distance_to_box(point: DVec3, [a, b, c]: &[DVec3; 3]) -> f64 {
    let (low, high) = (a.min(*b).min(*c), a.max(*b).max(*c));
    point.distance(point.clamp(low, high))
}

/// Whether a ray crosses a triangle (Möller and Trumbore 1997).
fn is_crossed(start: DVec3, direction: DVec3, &[a, b, c]: &[DVec3; 3]) -> bool {
    let (one, two) = (b - a, c - a);
    let normal = direction.cross(two);
    let determinant = one.dot(normal);
    if determinant == 0.0 {
        return false;
    }
    let offset = start - a;
    let u = offset.dot(normal) / determinant;
    let across = offset.cross(one);
    let v = direction.dot(across) / determinant;
    u >= 0.0 && v >= 0.0 && u + v <= 1.0 && two.dot(across) / determinant > 0.0
}
