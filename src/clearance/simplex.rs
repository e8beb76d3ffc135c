//! The point of a simplex nearest to the origin.

use glam::DVec3;

/// The point of a simplex nearest to the origin, as a combination of its corners.
#[derive(Debug, Clone, Copy)]
pub(super) struct NearestOfSimplex {
    /// The weights of the corners, 0 or more, with sum 1.
    pub(super) weights: [f64; 4],
    /// The point.
    pub(super) point: DVec3,
}

/// Returns the point nearest to the origin of the hull of up to four corners, on the assumption
/// that the last corner is a corner of the face that it lies on.
///
/// That holds in the iteration of Gilbert, Johnson and Keerthi, whose last corner lies farther
/// against the point before than all others. Any answer is a point of the hull.
pub(super) fn nearest_of_simplex(corners: &[DVec3]) -> NearestOfSimplex {
    let Some((&last, others)) = corners.split_last() else {
        return NearestOfSimplex { weights: [0.0; 4], point: DVec3::ZERO };
    };
    let mut best = single(others.len(), last);
    for chosen in 1_u32..1 << others.len() {
        let members = (0..others.len()).filter(|index| chosen >> index & 1 == 1);
        let Some(found) = on_face(others, last, members) else { continue };
        if found.point.length_squared() < best.point.length_squared() {
            best = found;
        }
    }
    best
}

/// Returns the corner itself.
fn single(index: usize, corner: DVec3) -> NearestOfSimplex {
    let mut weights = [0.0; 4];
    weights[index] = 1.0;
    NearestOfSimplex { weights, point: corner }
}

/// Returns the point nearest to the origin of the affine hull of `last` and these others, if it
/// lies in their convex hull.
fn on_face(
    others: &[DVec3],
    last: DVec3,
    members: impl Iterator<Item = usize> + Clone,
) -> Option<NearestOfSimplex> {
    // The least squares of `last + Σ λ_k edge_k`, by the normal equations.
    let mut edges = [DVec3::ZERO; 3];
    let mut count = 0;
    for member in members.clone() {
        edges[count] = others[member] - last;
        count += 1;
    }
    let product = |i: usize, j: usize| edges[i].dot(edges[j]);
    let right = [0, 1, 2].map(|i| -edges[i].dot(last));
    let solution = match count {
        1 => [right[0] / product(0, 0), 0.0, 0.0],
        2 => {
            let (aa, ab, bb) = (product(0, 0), product(0, 1), product(1, 1));
            let determinant = aa * bb - ab * ab;
            let [x, y] = [bb * right[0] - ab * right[1], aa * right[1] - ab * right[0]];
            [x / determinant, y / determinant, 0.0]
        }
        _ => {
            // Cramer's rule on the edges themselves, as three of them span the space.
            let [a, b, c] = edges;
            let volume = a.dot(b.cross(c));
            [-last.dot(b.cross(c)), -last.dot(c.cross(a)), -last.dot(a.cross(b))].map(|part| part / volume)
        }
    };
    let rest = 1.0 - solution.iter().take(count).sum::<f64>();
    // NaN fails too, which degenerate faces give.
    if !(rest >= 0.0 && solution.iter().take(count).all(|&weight| weight >= 0.0)) {
        return None;
    }
    let mut weights = [0.0; 4];
    weights[others.len()] = rest;
    let mut point = last;
    for ((member, weight), edge) in members.zip(solution).zip(edges) {
        weights[member] = weight;
        point += weight * edge;
    }
    Some(NearestOfSimplex { weights, point })
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_point_lies_on_a_corner_an_edge_a_face_or_inside() {
        let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z];
        let near = |corners: &[DVec3]| nearest_of_simplex(corners).point;
        assert_eq!(near(&[2.0 * x, x]), x);
        assert_eq!(near(&[x + y, x - y]), x);
        assert!(near(&[x, y, z]).distance(DVec3::splat(1.0 / 3.0)) < 1e-15);
        assert!(near(&[x - z, y - z, -x - y - z, z]).length() < 1e-15);
    }

    #[test]
    fn the_weights_give_the_point() {
        let corners = [DVec3::new(1.0, 2.0, 3.0), DVec3::new(1.0, -1.0, 2.5), DVec3::new(1.5, 0.0, -1.0)];
        let found = nearest_of_simplex(&corners);
        let sum: DVec3 = corners.iter().zip(found.weights).map(|(&corner, weight)| weight * corner).sum();
        assert!(sum.distance(found.point) < 1e-14);
    }
}
