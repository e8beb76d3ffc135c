//! The boundary of a solid: the edges of its faces, joined in pairs.

use super::clusters::Clusters;
use super::cracks::Cracks;
use super::edges::{Edge, EdgePlace, Edges};
use super::orientation::{Joined, Orientations};
use crate::bezier::PointError;
use crate::bvh::{Aabb, Bvh};
use crate::rounding::{VANISHING_LENGTH, gamma, lower_min};
use crate::solid::curve::Curve;
use crate::solid::strips::{Covering, Ruled, Strip, StripLimits};
use crate::solid::winding::MAX_DEPTH;
use crate::sorting::sort_by_number;
use glam::DVec3;
use std::collections::{BTreeMap, HashMap};

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

/// A part of an edge between two groups of ends.
pub(super) struct EdgePart {
    pub(super) surface: usize,
    pub(super) place: EdgePlace,
    /// The parameters of its start and its end on that side.
    pub(super) range: [f64; 2],
    pub(super) curve: Curve,
    ends: [u32; 2],
    pub(super) forward: bool,
}

impl EdgePart {
    /// Returns the same part from its other end.
    fn reversed(self) -> Self {
        let Self { surface, place, range: [from, to], curve, ends: [start, end], forward } = self;
        let (curve, forward) = (curve.reversed(), !forward);
        Self { surface, place, range: [to, from], curve, ends: [end, start], forward }
    }
}

impl Boundary {
    /// Joins the edges of surfaces; those farther apart than `gap`, and than 1e-5 of the diagonal of
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
        let mut orientations = Orientations::separate(edges.surfaces);
        edges.equal.iter().for_each(|edge| {
            orientations.join(edge.surfaces[0], edge.surfaces[1], edge.runs_alike);
        });
        let mut joints = Joints::new(edges.single, reach, RELATIVE_TIE * control_box.diagonal());
        let arcs = joints.arcs();
        let (mut covering, mut alone) = (Covering::default(), Vec::new());
        let (radius, width) =
            (RELATIVE_RADIUS * control_box.diagonal(), RELATIVE_TIE * control_box.diagonal());
        let limits = StripLimits { radius: reach.max(radius), width };
        let mut cracks = Cracks::default();
        for [a, b] in joints.pair(arcs, &mut alone, &mut orientations) {
            let before = [covering.area, covering.length];
            covering.add_pair([a.curve, b.curve], limits, 0);
            cracks.strips.push((a.surface, [covering.area - before[0], covering.length - before[1]]));
        }
        let free: Vec<FreeEdge> = alone
            .iter()
            .map(|part| FreeEdge {
                surface: part.surface,
                points: [0.0, 0.5, 1.0].map(|t| part.curve.point(t)),
            })
            .collect();
        for Corner { points, surfaces } in joints.corners() {
            cracks.add_corner(&points, surfaces);
            covering.add_corner(points);
        }
        let Covering { strips, thickness, .. } = covering;
        let boxes: Vec<Aabb> = strips.iter().map(Strip::bounding_box).collect();
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

/// Returns the distance up to which edges are joined.
pub(super) fn reach_of(control_box: &Aabb, gap: f64) -> f64 {
    gap.max(RELATIVE_REACH * control_box.diagonal()).max(f64::MIN_POSITIVE)
}

/// Edges with the groups of their ends.
pub(super) struct Joints {
    edges: Vec<Edge>,
    reach: f64,
    /// The difference of distances that does not tell partners apart.
    tie: f64,
    clusters: Clusters,
    /// The points of each group, by its number.
    members: BTreeMap<u32, Corner>,
}

/// The points of a group, with the surfaces whose edges have them.
#[derive(Debug, Default)]
pub(super) struct Corner {
    pub(super) points: Vec<DVec3>,
    pub(super) surfaces: Vec<usize>,
}

impl Corner {
    fn extend(&mut self, points: impl Iterator<Item = DVec3>, surface: usize) {
        self.points.extend(points);
        self.surfaces.push(surface);
    }
}

impl Joints {
    pub(super) fn new(edges: Vec<Edge>, reach: f64, tie: f64) -> Self {
        let points: Vec<DVec3> = edges.iter().flat_map(|edge| edge.curve.ends()).collect();
        let mut clusters = Clusters::new(&points, reach);
        let mut members: BTreeMap<u32, Corner> = BTreeMap::new();
        for (index, &point) in points.iter().enumerate() {
            let corner = members.entry(clusters.of(index as u32)).or_default();
            corner.extend(std::iter::once(point), edges[index / 2].surface);
        }
        Self { edges, reach, tie, clusters, members }
    }

    /// Returns the edges divided where an end of another edge lies on them, without those that are
    /// points: their control points join the group of their ends.
    pub(super) fn arcs(&mut self) -> Vec<EdgePart> {
        let cuts = self.cuts();
        let edges = std::mem::take(&mut self.edges);
        let mut arcs = Vec::with_capacity(edges.len());
        for (index, (Edge { surface, place, curve, forward }, mut cuts)) in
            edges.into_iter().zip(cuts).enumerate()
        {
            let ends = [0, 1].map(|end| self.clusters.of((2 * index + end) as u32));
            let extent = curve.points().fold(Aabb::EMPTY, Aabb::with).diagonal();
            if ends[0] == ends[1] && extent <= 2.0 * self.reach {
                self.members.entry(ends[0]).or_default().extend(curve.points(), surface);
                continue;
            }
            sort_by_number(&mut cuts, |cut| cut.0);
            let (mut rest, mut start, mut from) = (curve, 0.0, ends[0]);
            for (t, cluster) in cuts {
                let [low, high] = rest.split((t - start) / (1.0 - start));
                let [_, end] = low.ends();
                self.members.entry(cluster).or_default().extend(std::iter::once(end), surface);
                let (range, ends) = ([start, t], [from, cluster]);
                arcs.push(EdgePart { surface, place, range, curve: low, ends, forward });
                (rest, start, from) = (high, t, cluster);
            }
            let (range, ends) = ([start, 1.0], [from, ends[1]]);
            arcs.push(EdgePart { surface, place, range, curve: rest, ends, forward });
        }
        arcs
    }

    /// Returns, for every edge, the parameters at which groups lie on it that are not its ends'.
    fn cuts(&mut self) -> Vec<Vec<(f64, u32)>> {
        let of_edge = |edge: &Edge| edge.curve.points().fold(Aabb::EMPTY, Aabb::with);
        let tree = Bvh::new(&self.edges.iter().map(of_edge).collect::<Vec<_>>());
        let mut cuts = vec![Vec::new(); self.edges.len()];
        for (&cluster, corner) in &self.members {
            let point = corner.points[0];
            for leaf in tree.leaves_within(point, self.reach * self.reach) {
                let index = tree.primitive(&leaf) as usize;
                let ends = [0, 1].map(|end| self.clusters.of((2 * index + end) as u32));
                if ends.contains(&cluster) {
                    continue;
                }
                let (t, distance) = self.edges[index].curve.closest(point);
                if distance <= self.reach && 0.0 < t && t < 1.0 {
                    cuts[index].push((t, cluster));
                }
            }
        }
        cuts
    }

    /// Returns the arcs in pairs that run side by side in one direction; the others are free.
    pub(super) fn pair(
        &self,
        arcs: Vec<EdgePart>,
        free: &mut Vec<EdgePart>,
        orientations: &mut Orientations,
    ) -> Vec<[EdgePart; 2]> {
        let mut groups: HashMap<[u32; 2], Vec<EdgePart>> = HashMap::new();
        let mut keys = Vec::new();
        for mut arc in arcs {
            if arc.ends[0] > arc.ends[1] {
                arc = arc.reversed();
            }
            groups.entry(arc.ends).or_insert_with(|| {
                keys.push(arc.ends);
                Vec::new()
            });
            if let Some(group) = groups.get_mut(&arc.ends) {
                group.push(arc);
            }
        }
        // Groups of two arcs leave no choice: the sides that follow from them help to choose in others.
        let (sure, others): (Vec<_>, Vec<_>) =
            keys.into_iter().partition(|key| groups.get(key).is_some_and(|group| group.len() <= 2));
        let mut pairs = Vec::new();
        for key in sure.into_iter().chain(others) {
            let mut group = groups.remove(&key).unwrap_or_default();
            while let Some(arc) = group.pop() {
                match self.partner(&arc, &group, orientations) {
                    Some(index) => {
                        let pair = in_one_direction([arc, group.swap_remove(index)]);
                        let [a, b] = &pair;
                        orientations.join(a.surface as u32, b.surface as u32, a.forward == b.forward);
                        pairs.push(pair);
                    }
                    None => free.push(arc),
                }
            }
        }
        pairs
    }

    /// Returns the index of the arc nearest to the middle of this one, if it is near enough; of several
    /// that are as near, that of the surface nearest in the file, as a body's faces follow each other.
    /// Arcs that run the wrong way round for the sides of their surfaces, as far as these are known, come
    /// after all others: a face thinner than the reach has both its edges near those of its neighbours.
    fn partner(&self, arc: &EdgePart, others: &[EdgePart], orientations: &mut Orientations) -> Option<usize> {
        let middle = arc.curve.point(0.5);
        let distances: Vec<f64> = others.iter().map(|other| other.curve.closest(middle).1).collect();
        let mut is_against = |index: usize| {
            let other = &others[index];
            let is_open = arc.ends[0] != arc.ends[1];
            is_open && {
                let turned = orientations.turned(arc.surface as u32, other.surface as u32);
                turned.is_some_and(|turned| turned != (arc.forward == other.forward))
            }
        };
        let [mut along, mut against] = [Vec::new(), Vec::new()];
        for index in 0..others.len() {
            if is_against(index) { against.push(index) } else { along.push(index) }
        }
        [along, against].into_iter().find_map(|indices| {
            let nearest = indices.iter().map(|&index| distances[index]).fold(f64::INFINITY, lower_min);
            let farthest = self.reach.min(nearest + self.tie);
            let near =
                indices.into_iter().filter(|&index| nearest <= self.reach && distances[index] <= farthest);
            near.min_by_key(|&index| others[index].surface.abs_diff(arc.surface))
        })
    }

    /// Returns the points of the groups.
    fn corners(self) -> impl Iterator<Item = Corner> {
        self.members.into_values()
    }
}

/// Turns the second of two closed arcs round where that runs against the first.
fn in_one_direction([a, b]: [EdgePart; 2]) -> [EdgePart; 2] {
    if a.ends[0] != a.ends[1] {
        return [a, b];
    }
    let [early, late] = [0.25, 0.75].map(|t| b.curve.closest(a.curve.point(t)).0);
    if early <= late {
        return [a, b];
    }
    [a, b.reversed()]
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::axis::Axis;
    use crate::rounding::UNIT_ROUNDOFF;

    fn edge(surface: usize, points: &[[f64; 3]]) -> Edge {
        let controls = points.iter().map(|&point| DVec3::from_array(point).extend(1.0)).collect();
        let place = EdgePlace { index: surface as u32, axis: Axis::U, end: 0 };
        Edge { surface, place, curve: Curve { center: DVec3::ZERO, controls }, forward: true }
    }

    fn boundary(single: Vec<Edge>, gap: f64) -> Boundary {
        let surfaces = single.len();
        let control_box = single.iter().flat_map(|edge| edge.curve.points()).fold(Aabb::EMPTY, Aabb::with);
        let edges = Edges { surfaces, equal: Vec::new(), single };
        Boundary::new(edges, PointError::default(), &control_box, gap, 1)
    }

    /// A straight edge and one that rises to a height of 0.1 between the same ends.
    #[test]
    fn edges_whose_middles_are_far_apart_stay_free() {
        let [start, end] = [[0.0; 3], [1.0, 0.0, 0.0]];
        let edges = || vec![edge(0, &[start, end]), edge(1, &[start, [0.5, 0.2, 0.0], end])];
        for (gap, free) in [(0.0, 2), (0.09, 2), (0.11, 0)] {
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
