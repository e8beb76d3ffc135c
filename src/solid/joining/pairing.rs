//! Edges in pairs, the nearest ones first.

use super::edges::{Edge, Edges, EqualEdges, Pieces};
use super::joints::{Corner, Joints};
use super::orientation::Orientations;
use super::part::{EdgePart, in_one_direction};
use crate::rounding::lower_min;
use std::collections::HashMap;
use std::hash::Hash;

/// The first distance up to which edges are joined, in ties: each of two pieces of a face is within about a tie of their
/// common cut.
const FIRST_LEVEL: f64 = 4.0;

/// The ratio of one distance to the one before it. Edges that belong to each other are mostly nearer to each other than to
/// any others by more than that, also where faces are thinner than the gap of their file.
const LEVEL_RATIO: f64 = 16.0;

/// The distances of edges that are joined.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reach {
    /// The largest one.
    pub(super) reach: f64,
    /// The difference of distances that does not tell partners apart.
    pub(super) tie: f64,
}

/// One of the growing distances up to which edges are joined.
#[derive(Debug, Clone, Copy)]
struct Level {
    reach: f64,
    /// As in [`Reach`].
    tie: f64,
    /// The length up to which two edges may overlap at a corner, so that parts of both tell nothing; negative at the last
    /// level.
    overlap: f64,
    is_last: bool,
}

/// Edges in pairs.
#[derive(Debug, Default)]
pub(super) struct Pairs {
    /// Parts of edges that run side by side in one direction, with their ends in the same two groups of points.
    pub(super) pairs: Vec<[EdgePart; 2]>,
    /// Parts of edges without a partner.
    pub(super) free: Vec<EdgePart>,
    /// The groups of points: ends of parts, and control points of edges that are points to the reach.
    pub(super) corners: Vec<Corner>,
}

/// Joins the edges of surfaces; also returns the sides to which the surfaces turn, and the equal edges.
pub(super) fn joined(edges: Edges, reach: Reach) -> (Pairs, Orientations, Vec<EqualEdges>) {
    let Edges { surfaces, equal, single, pieces, reversed } = edges;
    let mut orientations = Orientations::separate(surfaces).of_source(reversed);
    for &EqualEdges { surfaces: [a, b], runs_alike, are_of_several, .. } in &equal {
        orientations.join(a, b, runs_alike);
        if are_of_several {
            orientations.branch(a);
        }
    }
    // The sides of the pieces of a face help to tell apart the edges of thin ones.
    for Pieces { surfaces: [a, b], is_turned } in &pieces {
        if let Some(is_turned) = *is_turned {
            orientations.join(*a, *b, is_turned);
        }
    }
    let pairs = pairs(single, reach, &mut orientations);
    // The edges of a piece that is thinner than a tie may be joined with each other.
    pieces.iter().for_each(|pieces| orientations.connect(pieces.surfaces[0], pieces.surfaces[1]));
    (pairs, orientations, equal)
}

/// Joins edges in pairs, and tells the sides to which their surfaces turn. Those of one shell of the source are joined
/// before others, as edges of bodies that stand flush coincide, and those that are nearest to each other first. A surface
/// whose edges are all points to the reach is joined to one that has these points. O(n log n) in general position.
fn pairs(edges: Vec<Edge>, reach: Reach, orientations: &mut Orientations) -> Pairs {
    let mut joints = Joints::new(&edges);
    let parts = (0..).zip(edges).map(|(index, edge)| EdgePart::whole(index, edge));
    let (of_shells, mut rest): (Vec<_>, Vec<_>) = parts.partition(|part| part.shell.is_some());
    let mut pairs = Vec::new();
    rest.extend(pair_all(
        &mut joints,
        of_shells,
        |arc| (arc.ends, arc.shell),
        reach,
        orientations,
        &mut pairs,
    ));
    let free = pair_all(&mut joints, rest, |arc| arc.ends, reach, orientations, &mut pairs);
    joints.join_points(&pairs, &free, orientations);
    Pairs { pairs, free, corners: joints.corners() }
}

/// Adds the pairs of parts whose arcs have the same key, at growing distances; returns the arcs that are left.
fn pair_all<K: Eq + Hash>(
    joints: &mut Joints,
    mut parts: Vec<EdgePart>,
    key: impl Fn(&EdgePart) -> K,
    Reach { reach, tie }: Reach,
    orientations: &mut Orientations,
    pairs: &mut Vec<[EdgePart; 2]>,
) -> Vec<EdgePart> {
    let rising = |arc: EdgePart| if arc.ends[0] > arc.ends[1] { arc.reversed() } else { arc };
    let mut level = (FIRST_LEVEL * tie).max(f64::MIN_POSITIVE).min(reach);
    while !parts.is_empty() {
        let arcs = joints.arcs(parts, level);
        let is_last = level >= reach;
        // An arc about as long as a level may be a point at the next one.
        let is_long = |arc: &EdgePart| is_last || arc.extent() >= LEVEL_RATIO * level;
        let (long, short): (Vec<_>, Vec<_>) = arcs.into_iter().map(rising).partition(is_long);
        let overlap = if is_last { -1.0 } else { 2.0 * reach };
        let limits = Level { reach: level, tie, overlap, is_last };
        parts = paired(groups(long, &key), limits, orientations, pairs);
        parts.extend(short);
        if is_last {
            break;
        }
        level = (LEVEL_RATIO * level).min(reach);
    }
    parts
}

/// Adds the arcs of each group in pairs up to a level; returns the others.
fn paired(
    mut groups: Vec<Vec<EdgePart>>,
    level: Level,
    orientations: &mut Orientations,
    pairs: &mut Vec<[EdgePart; 2]>,
) -> Vec<EdgePart> {
    // Groups of two arcs leave no choice, and long ones are no overlaps: the sides that follow from them help to choose in
    // others.
    groups.sort_by_key(|group| (group.len() > 2, group.iter().all(|arc| arc.extent() <= level.overlap)));
    let mut left = Vec::new();
    for mut group in groups {
        while let Some(arc) = group.pop() {
            match partner(&arc, &group, level, orientations) {
                Some(Partner { index, is_one_of_several }) => {
                    let pair = in_one_direction([arc, group.swap_remove(index)]);
                    let [a, b] = &pair;
                    orientations.join(a.surface as u32, b.surface as u32, a.forward == b.forward);
                    if is_one_of_several {
                        orientations.branch(a.surface as u32);
                    }
                    pairs.push(pair);
                }
                None => left.push(arc),
            }
        }
    }
    left
}

/// The partner of an arc.
struct Partner {
    index: usize,
    /// Whether others are as near.
    is_one_of_several: bool,
}

/// Returns whether two arcs from one end to the other run the same way round their surfaces, as the source orients these.
fn run_alike(a: &EdgePart, b: &EdgePart, orientations: &Orientations) -> bool {
    (a.forward == b.forward) != orientations.differ_in_source(a.surface, b.surface)
}

/// Returns the arc nearest to the middle of this one, if it is near enough; of several that are as near, one that runs the
/// other way round its surface, as the source orients that, and of these that of the surface nearest in the file, as a
/// body's faces follow each other. Arcs that run the wrong way round for the
/// sides of their surfaces, as far as these are known, come after all others, and only at the last level: a face thinner
/// than the reach has both its edges near those of its neighbours. Of two parts that are no longer than an overlap, of
/// surfaces whose sides are not known of each other, one has to be a whole edge before that.
fn partner(
    arc: &EdgePart,
    others: &[EdgePart],
    Level { reach, tie, overlap, is_last }: Level,
    orientations: &mut Orientations,
) -> Option<Partner> {
    let middle = arc.curve.point(0.5);
    let distances: Vec<f64> = others.iter().map(|other| other.curve.closest(middle).1).collect();
    let is_sure = arc.extent() > overlap || arc.is_whole();
    let [mut along, mut against] = [Vec::new(), Vec::new()];
    for (index, other) in others.iter().enumerate() {
        let is_open = arc.ends[0] != arc.ends[1];
        let turned = orientations.turned(arc.surface as u32, other.surface as u32).filter(|_| is_open);
        match turned.map(|turned| turned == (arc.forward == other.forward)) {
            Some(false) => against.push(index),
            Some(true) => along.push(index),
            None if is_sure || other.is_whole() => along.push(index),
            None => {}
        }
    }
    if !is_last {
        against.clear();
    }
    [along, against].into_iter().find_map(|indices| {
        let nearest = indices.iter().map(|&index| distances[index]).fold(f64::INFINITY, lower_min);
        let farthest = reach.min(nearest + tie);
        let near = indices.into_iter().filter(|&index| nearest <= reach && distances[index] <= farthest);
        let near: Vec<usize> = near.collect();
        let preference = |&index: &usize| {
            let other = &others[index];
            let is_alike = arc.ends[0] != arc.ends[1] && run_alike(arc, other, orientations);
            (is_alike, other.surface.abs_diff(arc.surface))
        };
        let is_one_of_several = near.len() > 1;
        near.into_iter().min_by_key(preference).map(|index| Partner { index, is_one_of_several })
    })
}

/// Returns the arcs of each key, in the order in which the keys are met.
fn groups<K: Eq + Hash>(arcs: Vec<EdgePart>, key: impl Fn(&EdgePart) -> K) -> Vec<Vec<EdgePart>> {
    let (mut groups, mut places): (Vec<Vec<EdgePart>>, HashMap<K, usize>) = Default::default();
    for arc in arcs {
        let place = *places.entry(key(&arc)).or_insert(groups.len());
        match groups.get_mut(place) {
            Some(group) => group.push(arc),
            None => groups.push(vec![arc]),
        }
    }
    groups
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::super::edges::EdgePlace;
    use super::*;
    use crate::axis::Axis;
    use crate::solid::curve::Curve;
    use glam::DVec3;

    const REACH: Reach = Reach { reach: 1e-3, tie: 1e-9 };

    /// The edges of a polygon.
    fn polygon(surface: usize, shell: Option<u32>, corners: &[[f64; 2]]) -> Vec<Edge> {
        let at = |[x, y]: [f64; 2]| DVec3::new(x, y, 0.0).extend(1.0);
        let place = EdgePlace { index: surface as u32, axis: Axis::U, end: 0 };
        let ends = corners.iter().zip(corners.iter().cycle().skip(1));
        ends.map(|(&from, &to)| {
            let curve = Curve { center: DVec3::ZERO, controls: vec![at(from), at(to)] };
            Edge { surface, place, curve, forward: true, shell }
        })
        .collect()
    }

    fn square(side: f64, [x, y]: [f64; 2]) -> [[f64; 2]; 4] {
        [[x, y], [x + side, y], [x + side, y + side], [x, y + side]]
    }

    /// Returns the shells of so many surfaces, and the number of free edges.
    fn joined(surfaces: usize, edges: Vec<Edge>) -> (Vec<u32>, usize) {
        let mut orientations = Orientations::separate(surfaces);
        let found = pairs(edges, REACH, &mut orientations);
        (orientations.shells().shells, found.free.len())
    }

    /// A square with a hole, and what fills the hole, with an edge that misses it by a tenth of the reach. All edges of the
    /// hole are points to the reach.
    #[test]
    fn faces_smaller_than_the_reach_are_joined_along_their_edges() {
        let mut hole = square(2e-4, [0.5, 0.5]);
        let frame = [polygon(0, None, &square(1.0, [0.0; 2])), polygon(0, None, &hole)].concat();
        hole[1][0] += 1e-4;
        let filled = [frame.clone(), polygon(1, None, &hole)].concat();
        assert_eq!(joined(2, filled), (vec![0, 0], 4));
        let pairs = |hole: &[[f64; 2]]| {
            let edges = [frame.clone(), polygon(1, None, hole)].concat();
            pairs(edges, REACH, &mut Orientations::separate(2)).pairs.len()
        };
        assert_eq!(pairs(&square(2e-4, [0.5, 0.5])), 4);
    }

    /// A square that is smaller than the reach, and farther from its hole than it is large.
    #[test]
    fn a_face_without_edges_is_joined_to_the_face_that_has_its_points() {
        let frame = |shell| {
            [polygon(0, shell, &square(1.0, [0.0; 2])), polygon(0, shell, &square(1e-4, [0.5, 0.5]))].concat()
        };
        let small = |shell| polygon(1, shell, &square(1e-4, [0.5005, 0.5]));
        assert_eq!(joined(2, [frame(None), small(None)].concat()).0, [0, 0]);
        assert_eq!(joined(2, [frame(Some(3)), small(None)].concat()).0, [0, 0]);
        assert_eq!(joined(2, [frame(Some(3)), small(Some(3))].concat()).0, [0, 0]);
        assert_eq!(joined(2, [frame(Some(3)), small(Some(4))].concat()).0, [0, 1]);
    }

    /// Two faces beside a third one that is thinner than the reach. The edges of its long sides miss those of its
    /// neighbours by less than its width.
    #[test]
    fn the_nearest_edges_are_joined_first() {
        let rectangle = |[left, right]: [f64; 2]| [[left, 0.0], [right, 0.0], [right, 1.0], [left, 1.0]];
        let width = 4e-4;
        let [first, last] = [rectangle([-1.0, -1e-5]), rectangle([width + 1e-5, 1.0])];
        let thin = rectangle([0.0, width]);
        for order in [[0, 1, 2], [1, 0, 2], [2, 0, 1], [0, 2, 1]] {
            let of = |face: usize| polygon(face, None, &[first, thin, last][face]);
            let edges = order.map(of).concat();
            let found = pairs(edges, REACH, &mut Orientations::separate(3));
            let mut joined: Vec<[usize; 2]> = found
                .pairs
                .iter()
                .map(|[a, b]| [a.surface.min(b.surface), a.surface.max(b.surface)])
                .collect();
            joined.sort_unstable();
            assert_eq!(joined, [[0, 1], [1, 2]], "{order:?}");
        }
    }

    /// Two faces side by side, of which one passes into the other by less than the reach: their edges that lie on each
    /// other there are no pair.
    #[test]
    fn an_overlap_shorter_than_the_reach_is_no_pair() {
        let rectangle = |[left, right]: [f64; 2]| [[left, 0.0], [right, 0.0], [right, 1.0], [left, 1.0]];
        for overlap in [5e-8, 9e-7, 1e-5, 9e-4] {
            let edges = [
                polygon(0, None, &rectangle([0.0, 1.0 + overlap])),
                polygon(1, None, &rectangle([1.0, 2.0])),
            ];
            let mut orientations = Orientations::separate(2);
            let found = pairs(edges.concat(), REACH, &mut orientations);
            let sides: Vec<bool> =
                found.pairs.iter().map(|[a, _]| (a.curve.point(0.5).x - 1.0).abs() <= overlap).collect();
            assert_eq!(sides, [true], "{overlap}");
            assert_eq!(orientations.turned(0, 1), Some(false));
        }
    }

    /// One face has two neighbours, and the smaller one's edge is shorter than the reach. All of that edge is joined to a
    /// part of the first face's edge.
    #[test]
    fn a_whole_edge_is_joined_to_a_part_of_another_one_though_it_be_short() {
        let small = 8e-4;
        let edges = [
            polygon(0, None, &[[-1.0, 0.0], [0.0, 0.0], [0.0, 1.0], [-1.0, 1.0]]),
            polygon(1, None, &[[0.0, 0.0], [1.0, 0.0], [1.0, small], [0.0, small]]),
            polygon(2, None, &[[0.0, small], [2.0, small], [2.0, 1.0], [0.0, 1.0]]),
        ];
        let found = pairs(edges.concat(), REACH, &mut Orientations::separate(3));
        let shortest = found.pairs.iter().filter(|[a, _]| a.extent() < 1e-3);
        assert_eq!(shortest.map(|[a, b]| a.surface.min(b.surface)).collect::<Vec<_>>(), [0]);
    }

    /// Three faces have an edge in common. The one that is farther from the first is of its shell.
    #[test]
    fn edges_of_a_shell_are_joined_before_others_that_are_as_near() {
        let rectangle = |[left, right]: [f64; 2]| [[left, 0.0], [right, 0.0], [right, 1.0], [left, 1.0]];
        let edges = [
            polygon(0, Some(1), &rectangle([-1.0, 0.0])),
            polygon(1, Some(2), &rectangle([0.0, 1.0])),
            polygon(2, Some(1), &[[1e-9, 0.0], [2.0, 0.5], [1e-9, 1.0]]),
        ];
        assert_eq!(joined(3, edges.concat()).0, [0, 1, 0]);
    }

    /// A piece without width: its long edges are joined with each other, and it is of the shell of its face. Of pieces
    /// whose sides are known the edges run as the sides have it.
    #[test]
    fn pieces_of_a_face_are_of_one_shell() {
        let edges = [
            polygon(0, None, &square(1.0, [0.0; 2])),
            polygon(1, None, &[[3.0, 0.0], [4.0, 0.0]]),
            polygon(2, None, &square(1.0, [6.0, 0.0])),
        ];
        let of = |pieces: Vec<Pieces>| {
            let edges = Edges { surfaces: 3, single: edges.concat(), pieces, ..Edges::default() };
            let (pairs, orientations, _) = super::joined(edges, REACH);
            let found = orientations.shells();
            (pairs.pairs.len(), found.shells, found.turned)
        };
        let pieces = |is_turned| vec![Pieces { surfaces: [0, 1], is_turned }];
        assert_eq!(of(Vec::new()), (1, vec![0, 1, 2], vec![false; 3]));
        assert_eq!(of(pieces(None)), (1, vec![0, 0, 1], vec![false; 3]));
        assert_eq!(of(pieces(Some(true))), (1, vec![0, 0, 1], vec![false, true, false]));
    }
}
