//! The groups of points in which edges end.

use super::clusters::Clusters;
use super::edges::Edge;
use super::orientation::Orientations;
use super::part::EdgePart;
use crate::bvh::{Aabb, Bvh};
use crate::sorting::sort_by_number;
use crate::threads::parallel::map;
use glam::DVec3;
use std::collections::{BTreeMap, HashMap, HashSet};

/// The points of a group, with the surfaces whose edges have them.
#[derive(Debug, Default)]
pub(super) struct Corner {
    pub(super) points: Vec<DVec3>,
    pub(super) surfaces: Vec<usize>,
}

/// A point of an edge.
#[derive(Debug, Clone, Copy)]
struct EdgePoint {
    /// The number of a point of its group.
    number: u32,
    point: DVec3,
    surface: usize,
    shell: Option<u32>,
}

/// The groups of ends so far.
pub(super) struct Joints {
    clusters: Clusters,
    points: Vec<EdgePoint>,
    /// The ends of edges that are points to the distances so far, which go on to join others.
    vanished: Vec<(u32, DVec3)>,
}

impl Joints {
    pub(super) fn new(edges: &[Edge]) -> Self {
        let points = edges.iter().flat_map(|edge| edge.curve.ends().map(|point| (edge, point)));
        let points = (0..).zip(points).map(|(number, (edge, point))| {
            let &Edge { surface, shell, .. } = edge;
            EdgePoint { number, point, surface, shell }
        });
        let clusters = Clusters::separate(2 * edges.len());
        Self { clusters, points: points.collect(), vanished: Vec::new() }
    }

    /// Groups the ends of parts that are within a distance, and returns the parts divided where a group lies on them,
    /// without those that are points: their control points join the group of their ends.
    pub(super) fn arcs(&mut self, parts: Vec<EdgePart>, reach: f64) -> Vec<EdgePart> {
        let ends = parts.iter().flat_map(|part| part.ends.into_iter().zip(part.curve.ends()));
        let ends: Vec<(u32, DVec3)> = ends.chain(self.vanished.iter().copied()).collect();
        self.clusters.join_near(&ends, reach);
        let cuts = self.cuts(&parts, &ends, reach);
        let mut arcs = Vec::with_capacity(parts.len());
        for (mut part, mut cuts) in parts.into_iter().zip(cuts) {
            part.ends = part.ends.map(|end| self.clusters.of(end));
            let EdgePart { surface, shell, ends: [number, end], .. } = part;
            if number == end && part.extent() <= 2.0 * reach {
                self.vanished.extend(part.ends.into_iter().zip(part.curve.ends()));
                let points = part.curve.points();
                self.points.extend(points.map(|point| EdgePoint { number, point, surface, shell }));
                continue;
            }
            sort_by_number(&mut cuts, |cut| cut.0);
            let mut start = 0.0;
            for (t, number) in cuts {
                let [low, high] = part.split((t - start) / (1.0 - start), number);
                let [_, point] = low.curve.ends();
                self.points.push(EdgePoint { number, point, surface, shell });
                arcs.push(low);
                (part, start) = (high, t);
            }
            arcs.push(part);
        }
        arcs
    }

    /// Returns, for every part, the parameters at which groups lie on it that are not its ends'.
    fn cuts(&mut self, parts: &[EdgePart], ends: &[(u32, DVec3)], reach: f64) -> Vec<Vec<(f64, u32)>> {
        let of_part = |index: usize| parts[index].curve.points().fold(Aabb::EMPTY, Aabb::with);
        let tree = Bvh::new(&map(parts.len(), of_part));
        let mut groups: Vec<(u32, DVec3)> =
            ends.iter().map(|&(number, point)| (self.clusters.of(number), point)).collect();
        groups.sort_by_key(|&(cluster, _)| cluster);
        groups.dedup_by_key(|&mut (cluster, _)| cluster);
        let own: Vec<[u32; 2]> =
            parts.iter().map(|part| part.ends.map(|end| self.clusters.of(end))).collect();
        let on_parts = map(groups.len(), |place| {
            let (cluster, point) = groups[place];
            let near = tree.leaves_within(point, reach * reach).into_iter();
            let others = near
                .map(|leaf| tree.primitive(&leaf))
                .filter(|&index| !own[index as usize].contains(&cluster));
            let found = others.filter_map(|index| {
                let (t, distance) = parts[index as usize].curve.closest(point);
                (distance <= reach && 0.0 < t && t < 1.0).then_some((index, t))
            });
            found.collect::<Vec<_>>()
        });
        let mut cuts = vec![Vec::new(); parts.len()];
        for ((cluster, _), found) in groups.into_iter().zip(on_parts) {
            for (index, t) in found {
                cuts[index as usize].push((t, cluster));
            }
        }
        cuts
    }

    /// Joins each surface of which all edges are points to one that has edges with these points: of the same shell, if
    /// that is known, and the nearest one in the file, as pieces of a face follow each other.
    pub(super) fn join_points(
        &mut self,
        pairs: &[[EdgePart; 2]],
        free: &[EdgePart],
        orientations: &mut Orientations,
    ) {
        let with_edges: HashSet<usize> =
            pairs.iter().flatten().chain(free).map(|part| part.surface).collect();
        let is_point = |point: &EdgePoint| !with_edges.contains(&point.surface);
        let mut groups: HashMap<u32, Vec<EdgePoint>> = HashMap::new();
        for point in self.points.iter().filter(|point| is_point(point)) {
            groups.entry(self.clusters.of(point.number)).or_default();
        }
        if groups.is_empty() {
            return;
        }
        for point in &self.points {
            if let Some(group) = groups.get_mut(&self.clusters.of(point.number)) {
                group.push(*point);
            }
        }
        let mut groups: Vec<_> = groups.into_iter().collect();
        sort_by_number(&mut groups, |&(number, _)| f64::from(number));
        for (_, group) in groups {
            for point in group.iter().filter(|point| is_point(point)) {
                let may_join = |other: &&EdgePoint| {
                    other.surface != point.surface
                        && (other.shell == point.shell || other.shell.is_none() || point.shell.is_none())
                };
                let farness = |other: &&EdgePoint| {
                    (other.shell != point.shell, is_point(other), other.surface.abs_diff(point.surface))
                };
                if let Some(other) = group.iter().filter(may_join).min_by_key(farness) {
                    orientations.connect(point.surface as u32, other.surface as u32);
                }
            }
        }
    }

    /// Returns the groups of points.
    pub(super) fn corners(mut self) -> Vec<Corner> {
        let mut corners: BTreeMap<u32, Corner> = BTreeMap::new();
        for EdgePoint { number, point, surface, .. } in self.points {
            let corner = corners.entry(self.clusters.of(number)).or_default();
            corner.points.push(point);
            if corner.surfaces.last() != Some(&surface) {
                corner.surfaces.push(surface);
            }
        }
        corners.into_values().collect()
    }
}
