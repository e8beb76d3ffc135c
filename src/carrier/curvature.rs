//! The curvature of a patch at a point.

use crate::bezier::Jet;
use glam::DVec3;

/// Principal curvatures, positive where the patch bends toward the normal.
#[derive(Debug, Clone, Copy)]
pub(super) struct Curvature {
    pub(super) normal: DVec3,
    /// The one of smaller size first.
    pub(super) values: [f64; 2],
    /// Their directions, of length 1.
    pub(super) directions: [DVec3; 2],
}

impl Curvature {
    /// Returns the curvature by the two fundamental forms; `None` where there is no normal.
    pub(super) fn of(jet: &Jet) -> Option<Self> {
        let normal = jet.normal()?;
        let x = jet.s.normalize();
        let y = normal.cross(x);
        // The derivatives in the frame of x and y are (a, 0) and (b, d).
        let [a, b, d] = [jet.s.length(), jet.t.dot(x), jet.t.dot(y)];
        let [ss, st, tt] = [jet.ss, jet.st, jet.tt].map(|second| second.dot(normal));
        let xx = ss / (a * a);
        let xy = (st - b * ss / a) / (a * d);
        let yy = (tt - 2.0 * b * st / a + b * b * ss / (a * a)) / (d * d);
        let (mean, half) = (0.5 * (xx + yy), 0.5 * (xx - yy));
        let radius = half.hypot(xy);
        let (sin, cos) = (0.5 * xy.atan2(half)).sin_cos();
        // Of the algebraically larger curvature, then of the other.
        let [first, second] = [cos * x + sin * y, cos * y - sin * x];
        let [high, low] = [mean + radius, mean - radius];
        let (values, directions) = if low.abs() <= high.abs() {
            ([low, high], [second, first])
        } else {
            ([high, low], [first, second])
        };
        values.iter().all(|value| value.is_finite()).then_some(Self { normal, values, directions })
    }

    /// Returns the centre of the larger curvature at a point.
    pub(super) fn center(&self, point: DVec3) -> DVec3 {
        point + self.normal / self.values[1]
    }
}

/// Returns the centre, the axis and the radius of the circle through three points; `None` for points
/// on a line.
pub(super) fn circle([a, b, c]: [DVec3; 3]) -> Option<(DVec3, DVec3, f64)> {
    let (u, v) = (b - a, c - a);
    let normal = u.cross(v);
    let toward = v.length_squared() * normal.cross(u) + u.length_squared() * v.cross(normal);
    let offset = toward / (2.0 * normal.length_squared());
    let axis = normal.try_normalize()?;
    offset.is_finite().then(|| (a + offset, axis, offset.length()))
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn a_circle_goes_through_its_points() {
        let place = |turn: f64| DVec3::new(1.0, 2.0, 3.0) + 0.7 * DVec3::new(turn.cos(), 0.0, turn.sin());
        let found = circle([0.1, 1.3, 2.0].map(place)).unwrap_or_else(|| unreachable!("it is a circle"));
        assert!(found.0.distance(DVec3::new(1.0, 2.0, 3.0)) < 1e-13 && (found.2 - 0.7).abs() < 1e-13);
        assert!(found.1.cross(DVec3::Y).length() < 1e-13);
        assert!(circle([0.0, 1.0, 2.0].map(|x| DVec3::new(x, 0.5 * x, -x))).is_none());
    }

    /// z = 2 u² + u v - v² / 2 over an oblique frame, at its vertex.
    #[test]
    fn curvatures_are_those_of_the_paraboloid_in_any_parameters() {
        let [u, v] = [DVec3::new(2.0, 1.0, 0.0), DVec3::new(-0.5, 1.5, 0.0)];
        let form = |a: DVec3, b: DVec3| DVec3::Z * (4.0 * a.x * b.x + a.x * b.y + a.y * b.x - a.y * b.y);
        let jet = Jet { point: DVec3::ZERO, s: u, t: v, ss: form(u, u), st: form(u, v), tt: form(v, v) };
        let found = Curvature::of(&jet).unwrap_or_else(|| unreachable!("there is a normal"));
        // The eigenvalues of [[4, 1], [1, -1]].
        let root = 29.0_f64.sqrt() / 2.0;
        for (value, expected) in found.values.into_iter().zip([1.5 - root, 1.5 + root]) {
            assert!((value - expected).abs() < 1e-13, "{value} and {expected}");
        }
        for (direction, value) in found.directions.into_iter().zip(found.values) {
            let image = DVec3::new(4.0 * direction.x + direction.y, direction.x - direction.y, 0.0);
            assert!(image.distance(value * direction) < 1e-13);
        }
    }
}
