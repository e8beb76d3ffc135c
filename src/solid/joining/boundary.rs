//! The boundary of a solid: the edges of its faces, joined in pairs.

use super::cracks::Cracks;
use super::edges::Edges;
use super::joints::Corner;
use super::orientation::Joined;
use super::pairing::{Pairs, Reach, joined};
use crate::bezier::PointError;
use crate::bvh::{Aabb, Bvh};
use crate::rounding::{VANISHING_LENGTH, gamma};
use crate::solid::strips::{Covering, Ruled, Strip, StripLimits};
use crate::solid::winding::MAX_DEPTH;
use crate::threads::parallel::{map, map_items};
use glam::DVec3;

/// The distance, relative to the model's diagonal, up to which edges are joined where the model
/// states no larger gap. It decides what counts as closed, and no sign depends on it.
const RELATIVE_REACH: f64 = 1e-5;

/// The radius of the tubes in which strips are kept, relative to the diagonal: thin enough for most
/// rays, with few parts of each.
const RELATIVE_RADIUS: f64 = 1e-4;

/// The distance, relative to the diagonal, up to which partners are as near, so that places in the file
/// decide: bodies that stand flush differ by rounding alone, faces beside each other in a body by more.
pub(super) const RELATIVE_TIE: f64 = 1e-9;

/// The roundings of a coordinate along a ray, relative to the largest length of a control point
/// (lemma S3 of docs/solids.md).
const COORDINATE_ROUNDINGS: f64 = 64.0;

/// The edges of a model's faces.
#[derive(Debug)]
pub(crate) struct Boundary {
    /// The edges without a partner.
    free: Vec<FreeEdge>,
    /// The shell of each surface of the model, and the sides to which they turn.
    joined: Joined,
    reach: f64,
    /// An upper bound on the distance of the strips from the patches, with the rounding of both.
    clearance: f64,
    pub(in crate::solid) strips: Vec<Strip>,
    pub(in crate::solid) strip_tree: Bvh,
    /// An upper bound on the error of a coordinate along a ray from the origin (lemma S3).
    pub(in crate::solid) margin: f64,
}

/// An edge without a partner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FreeEdge {
    pub(crate) surface: usize,
    /// Its start, its middle and its end.
    pub(crate) points: [DVec3; 3],
}

impl Boundary {
    /// Joins the edges of surfaces; those farther apart than twice `gap`, and than 1e-5 of the diagonal of
    /// `control_box`, are not joined. `point_error` and `max_degree` are those of the surfaces'
    /// patches. O(n log n) in general position.
    pub(crate) fn new(
        edges: Edges,
        point_error: PointError,
        control_box: &Aabb,
        gap: f64,
        max_degree: usize,
    ) -> Self {
        let reach = reach_of(control_box, gap);
        let distances = Reach { reach, tie: RELATIVE_TIE * control_box.diagonal() };
        let (Pairs { pairs, free, corners }, orientations, _) = joined(edges, distances);
        let (radius, width) =
            (RELATIVE_RADIUS * control_box.diagonal(), RELATIVE_TIE * control_box.diagonal());
        let limits = StripLimits { radius: reach.max(radius), width };
        let mut covering = Covering::default();
        let mut cracks = Cracks::default();
        for (surface, of_pair) in map_items(pairs, |[a, b]| {
            let mut of_pair = Covering::default();
            of_pair.add_pair([a.curve, b.curve], limits, 0);
            (a.surface, of_pair)
        }) {
            cracks.strips.push((surface, [of_pair.area, of_pair.length]));
            covering.add(of_pair);
        }
        let free: Vec<FreeEdge> = free
            .iter()
            .map(|part| FreeEdge {
                surface: part.surface,
                points: [0.0, 0.5, 1.0].map(|t| part.curve.point(t)),
            })
            .collect();
        for Corner { points, surfaces } in corners {
            cracks.add_corner(&points, surfaces);
            covering.add_corner(points);
        }
        let Covering { strips, thickness, .. } = covering;
        let boxes: Vec<Aabb> = map(strips.len(), |index| strips[index].bounding_box());
        let halvings = gamma(2.0 * f64::from(MAX_DEPTH) * max_degree as f64) * control_box.diagonal();
        let coordinates = gamma(COORDINATE_ROUNDINGS) * control_box.farthest_from_origin();
        let margin = 2.0 * point_error.after(0) + halvings + coordinates + VANISHING_LENGTH;
        let mut joined = orientations.shells();
        let rounding = margin - 2.0 * point_error.after(0);
        cracks.added_to(&mut joined, rounding);
        free.iter().for_each(|edge| joined.of_shell[joined.shells[edge.surface] as usize].free += 1);
        Self {
            free,
            reach,
            clearance: thickness + 2.0 * margin,
            joined,
            strip_tree: Bvh::new(&boxes),
            strips,
            margin,
        }
    }

    /// Returns whether there are faces and every edge has a partner.
    pub(crate) fn is_closed(&self) -> bool {
        self.free.is_empty() && !self.joined.shells.is_empty()
    }

    /// Returns the distance up to which edges were joined.
    pub(crate) fn reach(&self) -> f64 {
        self.reach
    }

    /// Returns the radius of a ball that certainly has no points of the faces nor of the strips,
    /// for a point that is at least `distance` from the patches; negative if none is known.
    pub(crate) fn clear_radius(&self, distance: f64) -> f64 {
        distance - self.clearance
    }

    /// Returns the strips, as patches in whose hulls they lie.
    pub(crate) fn strips(&self) -> impl Iterator<Item = Ruled> + '_ {
        self.strips.iter().map(Strip::ruled)
    }

    /// Returns an upper bound on the distance of faces and strips from computed ones, both together.
    pub(crate) fn rounding(&self) -> f64 {
        2.0 * self.margin
    }

    /// Returns the edges without a partner.
    pub(crate) fn free_edges(&self) -> &[FreeEdge] {
        &self.free
    }

    /// Returns the number of the shell that each surface belongs to, from 0.
    pub(crate) fn shells(&self) -> &[u32] {
        &self.joined.shells
    }

    /// Returns the shells, with the sides to which their surfaces turn.
    pub(crate) fn joined(&self) -> &Joined {
        &self.joined
    }
}

/// Returns the distance up to which edges are joined. Each of two faces may be as far from their edge as the gap.
pub(super) fn reach_of(control_box: &Aabb, gap: f64) -> f64 {
    (2.0 * gap).max(RELATIVE_REACH * control_box.diagonal()).max(f64::MIN_POSITIVE)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::super::edges::{Edge, EdgePlace};
    use super::*;
    use crate::axis::Axis;
    use crate::rounding::UNIT_ROUNDOFF;
    use crate::solid::curve::Curve;

    fn edge(surface: usize, points: &[[f64; 3]]) -> Edge {
        let controls = points.iter().map(|&point| DVec3::from_array(point).extend(1.0)).collect();
        let place = EdgePlace { index: surface as u32, axis: Axis::U, end: 0 };
        let curve = Curve { center: DVec3::ZERO, controls };
        Edge { surface, place, curve, forward: true, shell: None }
    }

    fn boundary(single: Vec<Edge>, gap: f64) -> Boundary {
        let surfaces = single.len();
        let control_box = single.iter().flat_map(|edge| edge.curve.points()).fold(Aabb::EMPTY, Aabb::with);
        let edges = Edges { surfaces, single, ..Edges::default() };
        Boundary::new(edges, PointError::default(), &control_box, gap, 1)
    }

    /// A straight edge and one that rises to a height of 0.1 between the same ends.
    #[test]
    fn edges_whose_middles_are_far_apart_stay_free() {
        let [start, end] = [[0.0; 3], [1.0, 0.0, 0.0]];
        let edges = || vec![edge(0, &[start, end]), edge(1, &[start, [0.5, 0.2, 0.0], end])];
        for (gap, free) in [(0.0, 2), (0.045, 2), (0.055, 0)] {
            let found = boundary(edges(), gap);
            assert_eq!((found.free_edges().len(), found.is_closed()), (free, free == 0), "{gap}");
        }
    }

    /// A loop and its copy that runs the other way round are joined by strips without width.
    #[test]
    fn closed_edges_are_joined_whichever_way_they_run() {
        let mut points = vec![[0.0; 3], [2.0, -1.0, 0.0], [2.0, 3.0, 0.0], [-1.0, 2.0, 0.0], [0.0; 3]];
        let one = edge(0, &points);
        points.reverse();
        let found = boundary(vec![one, edge(1, &points)], 0.0);
        assert!(found.is_closed());
        let thickness = 1.0 - found.clear_radius(1.0);
        assert!(thickness < 2.5 * RELATIVE_RADIUS * 5.0, "{thickness}");
    }

    /// The terms of m in lemma S3, each where the others vanish or are subtracted, and twice the sum
    /// in the radius of balls without points (lemma S4).
    #[test]
    fn the_margin_has_the_terms_of_the_lemma() {
        let margin = |aabb: Aabb, deviation: f64, max_degree: usize| {
            let mut error = PointError::default();
            error.include_deviation(deviation);
            let edges = Edges { surfaces: 1, ..Edges::default() };
            let found = Boundary::new(edges, error, &aabb, 0.0, max_degree);
            assert_eq!(found.clear_radius(1.0), 1.0 - 2.0 * found.margin);
            found.margin
        };
        let is_near = |found: f64, expected: f64| {
            assert!(expected <= found && found <= 1.02 * expected, "{found:e} for {expected:e}");
        };
        let corner = DVec3::new(3.0, 0.0, 4.0);
        let [origin, point] = [DVec3::ZERO, corner].map(|at| Aabb { min: at, max: at });
        is_near(margin(origin, 0.25, 3), 0.5);
        is_near(margin(point, 0.0, 3), UNIT_ROUNDOFF * 64.0 * 5.0);
        // With as many halvings as a patch may take, H = 64.
        let both = Aabb { min: -corner, max: corner };
        let halvings = margin(both, 0.0, 3) - margin(point, 0.0, 3);
        is_near(halvings, UNIT_ROUNDOFF * 2.0 * 64.0 * 3.0 * 10.0);
    }
}
