//! The facets of a model with their tree, and nearest-facet queries.

mod neighbours;

pub(super) use neighbours::NONE;
use neighbours::{Neighbours, neighbours};

use super::facet::Nearest;
use super::{Facet, Group, PointCloud, TriangleMesh};
use crate::area::Area;
use crate::bvh::{Aabb, RangeTree};
use crate::rounding::gamma;
use crate::solid::Joined;
use crate::threads::computed;
use crate::threads::parallel::map;
use glam::DVec3;
use std::sync::OnceLock;

/// The number of triangles of a leaf: the test of a box takes about a third of the time of one.
const TRIANGLES_A_LEAF: usize = 4;

/// The number of points of a leaf: a point takes less time than a box, and little memory.
const POINTS_A_LEAF: usize = 16;

/// The roundings of the area of a triangle, relative to the square of the largest length of a
/// corner: each coordinate of the two edges and of their product.
const AREA_ROUNDINGS: f64 = 32.0;

/// Capacity of the stack of a query: a tree that halves 2^32 facets is less deep.
const STACK: usize = 64;

/// The facets of a mesh or of a cloud, in the order of the leaves of their tree.
#[derive(Debug, Clone)]
pub(crate) struct FacetTarget {
    facets: Facets,
    pub(crate) tree: RangeTree,
    /// The indices of the corners of each triangle, equal for equal points; none of a cloud.
    vertices: Vec<[u32; 3]>,
    /// The triangles along the edges of each, made at their first use.
    neighbours: OnceLock<Neighbours>,
}

/// Facets of one kind.
#[derive(Debug, Clone)]
enum Facets {
    Points(Vec<DVec3>),
    Triangles(Vec<[DVec3; 3]>),
}

/// A point of a facet near a target point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FacetFoot {
    /// The facet, by its place in the order of the leaves.
    pub(crate) facet: u32,
    /// The squared distance, +∞ if none is known.
    pub(crate) distance_squared: f64,
}

impl FacetFoot {
    /// A facet at no known distance.
    pub(crate) fn start(facet: u32) -> Self {
        Self { facet, distance_squared: f64::INFINITY }
    }
}

impl FacetTarget {
    /// Builds the tree over a mesh. O(n log n).
    pub(crate) fn of_mesh(mesh: &TriangleMesh) -> Self {
        let corners = |triangle: u32| mesh.corners(triangle as usize);
        let boxes = |triangle: u32| Facet::Triangle(corners(triangle)).bounding_box();
        let tree = RangeTree::new(mesh.triangles().len(), TRIANGLES_A_LEAF, &boxes);
        let facets = Facets::Triangles(map(tree.order().len(), |place| corners(tree.order()[place])));
        let vertices = tree.order().iter().map(|&index| mesh.triangles()[index as usize]).collect();
        Self { facets, tree, vertices, neighbours: OnceLock::new() }
    }

    /// Builds the tree over a cloud. O(n log n).
    pub(crate) fn of_cloud(cloud: &PointCloud) -> Self {
        let points = cloud.points();
        let boxes = |point: u32| Aabb::EMPTY.with(points[point as usize]);
        let tree = RangeTree::new(points.len(), POINTS_A_LEAF, &boxes);
        let facets = Facets::Points(map(points.len(), |place| points[tree.order()[place] as usize]));
        Self { facets, tree, vertices: Vec::new(), neighbours: OnceLock::new() }
    }

    /// Returns the facets of each group with a tree of their own; the groups are ranges of indices
    /// that cover all facets. O(n log n).
    pub(super) fn of_groups(&self, groups: &[Group]) -> Vec<Self> {
        let places = self.places();
        map(groups.len(), |group| {
            let places = &places[groups[group].facets.clone()];
            let boxes = |index: u32| self.facet(places[index as usize]).bounding_box();
            let leaf = if self.is_cloud() { POINTS_A_LEAF } else { TRIANGLES_A_LEAF };
            let tree = RangeTree::new(places.len(), leaf, &boxes);
            let place = |&index: &u32| places[index as usize] as usize;
            let (facets, vertices) = match &self.facets {
                Facets::Points(points) => {
                    let points = tree.order().iter().map(|index| points[place(index)]);
                    (Facets::Points(points.collect()), Vec::new())
                }
                Facets::Triangles(triangles) => {
                    let triangles = tree.order().iter().map(|index| triangles[place(index)]);
                    let vertices = tree.order().iter().map(|index| self.vertices[place(index)]);
                    (Facets::Triangles(triangles.collect()), vertices.collect())
                }
            };
            Self { facets, tree, vertices, neighbours: OnceLock::new() }
        })
    }

    /// Returns the same facets with their coordinates multiplied by a factor. O(n log n).
    pub(crate) fn scaled(&self, factor: f64) -> Self {
        let facets = match &self.facets {
            Facets::Points(points) => Facets::Points(points.iter().map(|&point| factor * point).collect()),
            Facets::Triangles(triangles) => {
                let scaled = |corners: &[DVec3; 3]| corners.map(|corner| factor * corner);
                Facets::Triangles(triangles.iter().map(scaled).collect())
            }
        };
        let (vertices, neighbours) = (self.vertices.clone(), self.neighbours.clone());
        Self { facets, tree: self.tree.scaled(factor), vertices, neighbours }
    }

    /// Returns the neighbours of each triangle along its edges, by their places; those of a cloud are
    /// none. O(n) at first use.
    pub(super) fn neighbours(&self) -> &[[u32; 3]] {
        &self.known_neighbours().along
    }

    fn known_neighbours(&self) -> &Neighbours {
        computed(&self.neighbours, || {
            let largest = self.vertices.iter().flatten().max();
            neighbours(&self.vertices, largest.map_or(0, |&vertex| vertex as usize + 1))
        })
    }

    /// Returns the triangles that share edges of the same two vertices. O(n).
    pub(super) fn joined(&self) -> Joined {
        let Neighbours { along, branched } = self.known_neighbours();
        Joined::of_neighbours(&self.vertices, along, branched, NONE)
    }

    /// Returns the indices of the vertices of a triangle, equal for equal points.
    pub(crate) fn corners(&self, place: u32) -> [u32; 3] {
        self.vertices[place as usize]
    }

    /// Returns the number of facets.
    pub(crate) fn len(&self) -> usize {
        self.tree.order().len()
    }

    /// Returns whether the facets are points.
    pub(crate) fn is_cloud(&self) -> bool {
        matches!(self.facets, Facets::Points(_))
    }

    /// Returns the box of all facets.
    pub(crate) fn bounding_box(&self) -> Aabb {
        self.tree.bounding_box()
    }

    /// Returns the facet at a place in the order of the leaves.
    #[inline]
    pub(crate) fn facet(&self, place: u32) -> Facet {
        match &self.facets {
            Facets::Points(points) => Facet::Point(points[place as usize]),
            Facets::Triangles(triangles) => Facet::Triangle(triangles[place as usize]),
        }
    }

    /// Returns the index in the model of the facet at a place in the order of the leaves.
    pub(crate) fn index(&self, place: u32) -> usize {
        self.tree.order()[place as usize] as usize
    }

    /// Returns the places of the facets in the order of the leaves, by their indices. O(n).
    pub(super) fn places(&self) -> Vec<u32> {
        let mut places = vec![0; self.len()];
        for (place, &index) in self.tree.order().iter().enumerate() {
            places[index as usize] = place as u32;
        }
        places
    }

    /// Returns the area of a facet, 0 of a point, as an interval that holds it.
    pub(crate) fn area(&self, place: u32) -> Area {
        let Facet::Triangle([a, b, c]) = self.facet(place) else { return Area::default() };
        let length = self.bounding_box().farthest_from_origin();
        let rounding = gamma(AREA_ROUNDINGS) * length * length;
        let area = 0.5 * (b - a).cross(c - a).length();
        let lower = area - rounding;
        Area { lower: if lower > 0.0 { lower } else { 0.0 }, upper: area + rounding }
    }

    /// Returns the squared distance to one facet.
    #[inline]
    pub(crate) fn distance_squared(&self, facet: u32, target: DVec3) -> f64 {
        self.facet(facet).nearest(target).distance_squared
    }

    /// Returns the nearest facet up to rounding, or the first found within `sufficient`. The search
    /// starts from a facet that may be near. O(log n) in general position.
    pub(crate) fn nearest(&self, target: DVec3, start: u32, sufficient: f64) -> FacetFoot {
        let sufficient_squared = if sufficient > 0.0 { sufficient * sufficient } else { -1.0 };
        let distance_squared = self.distance_squared(start, target);
        let mut foot = FacetFoot { facet: start, distance_squared };
        if distance_squared <= sufficient_squared {
            return foot;
        }
        self.visit(target, foot.distance_squared, |place| {
            let distance_squared = self.distance_squared(place, target);
            if distance_squared < foot.distance_squared {
                foot = FacetFoot { facet: place, distance_squared };
            }
            (foot.distance_squared, foot.distance_squared <= sufficient_squared)
        });
        foot
    }

    /// Returns the nearest facet with its nearest point, and a lower bound on the distance of all
    /// facets, which rounding has not been taken off (lemma F3 of docs/meshes.md).
    pub(crate) fn certified(&self, target: DVec3, start: u32) -> (FacetFoot, Nearest, f64) {
        let mut nearest = self.facet(start).nearest(target);
        let mut facet = start;
        let mut lower = f64::INFINITY;
        self.visit(target, nearest.distance_squared, |place| {
            let of_facet = self.facet(place);
            let found = of_facet.nearest(target);
            if found.distance_squared < nearest.distance_squared {
                (facet, nearest) = (place, found);
            }
            let bound = of_facet.distance_of_planes(target, &found);
            lower = if bound < lower { bound } else { lower };
            (nearest.distance_squared, false)
        });
        // The facets that were not visited are at least as far as their boxes, and those as `nearest`.
        let upper = nearest.distance_squared.sqrt();
        let foot = FacetFoot { facet, distance_squared: nearest.distance_squared };
        (foot, nearest, if lower < upper { lower } else { upper })
    }

    /// Calls `visit` on the facets of all leaves whose boxes are nearer than the squared distance
    /// that it returned last, nearest child first, until it returns that this suffices.
    #[inline]
    pub(super) fn visit(
        &self,
        target: DVec3,
        mut bound_squared: f64,
        mut visit: impl FnMut(u32) -> (f64, bool),
    ) {
        let nodes = self.tree.nodes();
        let to_box = |index: u32| nodes[index as usize].aabb.min_distance_squared(target);
        let mut stack = [(0.0_f64, 0_u32); STACK];
        let mut height = usize::from(!nodes.is_empty());
        while height > 0 {
            height -= 1;
            let (distance_squared, index) = stack[height];
            if distance_squared > bound_squared {
                continue;
            }
            let node = &nodes[index as usize];
            let Some([left, right]) = node.children(index) else {
                for place in node.range() {
                    let (bound, is_done) = visit(place as u32);
                    bound_squared = bound;
                    if is_done {
                        return;
                    }
                }
                continue;
            };
            let (to_left, to_right) = (to_box(left), to_box(right));
            let children = if to_left <= to_right {
                [(to_right, right), (to_left, left)]
            } else {
                [(to_left, left), (to_right, right)]
            };
            for child in children {
                if child.0 <= bound_squared {
                    stack[height] = child;
                    height += 1;
                }
            }
        }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::facets::TriangleMesh;
    use crate::facets::facet_rounding;
    use num_rational::BigRational;
    use num_traits::Zero;

    fn mesh(corners: &[DVec3]) -> FacetTarget {
        let triangles: Vec<[u32; 3]> =
            (0..corners.len() as u32 / 3).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        FacetTarget::of_mesh(&TriangleMesh::new(corners, &triangles).unwrap())
    }

    fn exact(point: DVec3) -> [BigRational; 3] {
        point.to_array().map(|number| BigRational::from_float(number).unwrap())
    }

    fn squared(number: f64) -> BigRational {
        let number = BigRational::from_float(number).unwrap();
        &number * &number
    }

    /// Four times the square of the exact area.
    fn exact_square(corners: &[DVec3]) -> BigRational {
        let [a, b, c] = [0, 1, 2].map(|corner| exact(corners[corner]));
        let of = |end: &[BigRational; 3], axis: usize| &end[axis % 3] - &a[axis % 3];
        let across = |axis: usize| of(&b, axis + 1) * of(&c, axis + 2) - of(&b, axis + 2) * of(&c, axis + 1);
        [0, 1, 2].map(across).into_iter().fold(BigRational::zero(), |sum, one| sum + &one * &one)
    }

    /// In exact arithmetic, of triangles of any size and far from the origin, where differences of
    /// coordinates are rounded; without an allowance neither bound holds.
    #[test]
    fn areas_hold_the_exact_ones() {
        let random = &mut fastrand::Rng::with_seed(72);
        let mut missed = [0; 2];
        for round in 0..2000 {
            let size = if round % 2 == 0 { 1.0 } else { 1000.0 };
            let point = |random: &mut fastrand::Rng| DVec3::from_array([0; 3].map(|_| random.f64() - 0.5));
            let mut corners = [0; 3].map(|_| size * point(random));
            if round % 3 == 0 {
                // A sliver has an area of the size of its rounding.
                corners[2] = corners[0].lerp(corners[1], random.f64()) + 1e-14 * size * point(random);
            }
            let area = mesh(&corners).area(0);
            let square = exact_square(&corners);
            let four = BigRational::from_float(4.0).unwrap();
            assert!(&four * squared(area.lower) <= square, "{area:?} of {corners:?}");
            assert!(&four * squared(area.upper) >= square, "{area:?} of {corners:?}");
            let middle = &four * squared(0.5 * (area.lower + area.upper));
            missed[usize::from(middle < square)] += 1;
        }
        assert!(missed.iter().all(|&count| count > 500), "{missed:?}");
    }

    /// Lemma F3: a facet whose box is no nearer than the nearest point found is not visited, and
    /// counts with the distance of that point.
    #[test]
    fn facets_that_are_not_visited_are_no_nearer_than_the_nearest_point() {
        let random = &mut fastrand::Rng::with_seed(73);
        let height = 0.7;
        let corners: Vec<DVec3> =
            (0..3 * 40).map(|_| DVec3::new(random.f64(), random.f64(), height)).collect();
        let target = mesh(&corners);
        for _ in 0..4000 {
            let from = DVec3::new(random.f64(), random.f64(), random.f64());
            let start = target.nearest(from, 0, 0.0).facet;
            let (foot, _, lower) = target.certified(from, start);
            let exact = (0..target.len() as u32)
                .map(|facet| target.distance_squared(facet, from))
                .fold(f64::INFINITY, crate::rounding::lower_min)
                .sqrt();
            assert!(lower - facet_rounding(2.0) <= exact, "{lower} {exact}");
            assert!(foot.distance_squared.sqrt() >= exact);
        }
    }
}
