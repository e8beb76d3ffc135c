//! The triangles of a mesh that are joined along their edges.

/// The place of no triangle.
pub(crate) const NONE: u32 = u32::MAX;

/// The neighbours of the triangles of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Neighbours {
    /// For each triangle, that along each of its edges, from a corner to the next one, or [`NONE`].
    pub(super) along: Vec<[u32; 3]>,
    /// The triangles of edges that more than two have.
    pub(super) branched: Vec<u32>,
}

/// Returns the neighbours of triangles that are given by the indices of their corners, which are below `vertices`.
///
/// Neighbours are mutual: edges of the same two vertices are joined in pairs, of opposite directions
/// first, and where their number is odd one is left over. Triangles with two equal corners have no
/// neighbours. O(n) where vertices have few triangles.
pub(super) fn neighbours(triangles: &[[u32; 3]], vertices: usize) -> Neighbours {
    let mut found = vec![[NONE; 3]; triangles.len()];
    let mut branched = Vec::new();
    let ends = |edge: u32| {
        let (corners, start) = (triangles[edge as usize / 3], edge as usize % 3);
        [corners[start], corners[(start + 1) % 3]]
    };
    let (mut edges, starts) = by_least_vertex(triangles, vertices, &ends);
    for range in starts.windows(2) {
        let around = &mut edges[range[0] as usize..range[1] as usize];
        // The larger vertex, then the direction.
        let key = |edge: &u32| {
            let [start, end] = ends(*edge);
            (start.max(end), start > end, *edge)
        };
        around.sort_unstable_by_key(key);
        for equal in around.chunk_by(|one, other| key(one).0 == key(other).0) {
            if equal.len() > 2 {
                branched.extend(equal.iter().map(|edge| edge / 3));
            }
            let (along, against) = equal.split_at(equal.partition_point(|edge| !key(edge).1));
            let pairs = along.len().min(against.len());
            let opposite = along.iter().zip(against).map(|(&one, &other)| [one, other]);
            let rest = along[pairs..].chunks_exact(2).chain(against[pairs..].chunks_exact(2));
            for [one, other] in opposite.chain(rest.map(|pair| [pair[0], pair[1]])) {
                found[one as usize / 3][one as usize % 3] = other / 3;
                found[other as usize / 3][other as usize % 3] = one / 3;
            }
        }
    }
    Neighbours { along: found, branched }
}

/// Returns the edges of all triangles with three different corners in the order of their least
/// vertices, and where those of each vertex start. An edge is three times its triangle and its place.
fn by_least_vertex(
    triangles: &[[u32; 3]],
    vertices: usize,
    ends: &impl Fn(u32) -> [u32; 2],
) -> (Vec<u32>, Vec<u32>) {
    let of = |(triangle, &[a, b, c]): (usize, &[u32; 3])| {
        let is_whole = a != b && b != c && c != a;
        (0..if is_whole { 3 } else { 0 }).map(move |edge| 3 * triangle as u32 + edge)
    };
    let all = || triangles.iter().enumerate().flat_map(of);
    let least = |edge: u32| {
        let [start, end] = ends(edge);
        start.min(end) as usize
    };
    let mut starts = vec![0_u32; vertices + 1];
    all().for_each(|edge| starts[least(edge) + 1] += 1);
    for vertex in 0..vertices {
        starts[vertex + 1] += starts[vertex];
    }
    let mut next = starts.clone();
    let mut edges = vec![0; starts[vertices] as usize];
    for edge in all() {
        let place = &mut next[least(edge)];
        edges[*place as usize] = edge;
        *place += 1;
    }
    (edges, starts)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::solid::Joined;

    #[test]
    fn triangles_of_an_edge_are_neighbours_of_each_other() {
        // A tetrahedron, a loose triangle, and one that has collapsed along an edge of it.
        let triangles = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0], [4, 5, 6], [4, 5, 4]];
        let expected = [[1, 2, 3], [3, 2, 0], [1, 3, 0], [2, 1, 0], [NONE; 3], [NONE; 3]];
        assert_eq!(neighbours(&triangles, 7).along, expected);
    }

    /// At an edge of several triangles pairs have opposite directions where they can; of three one is
    /// left over.
    #[test]
    fn the_edges_of_several_triangles_are_joined_in_pairs() {
        let fan = [[0, 1, 2], [0, 1, 3], [1, 0, 4], [1, 0, 5]];
        let along: Vec<u32> = neighbours(&fan, 6).along.iter().map(|found| found[0]).collect();
        assert_eq!(along, [2, 3, 0, 1]);
        let alike: Vec<u32> = neighbours(&fan[..2], 6).along.iter().map(|found| found[0]).collect();
        assert_eq!(alike, [1, 0]);
        let three: Vec<u32> = neighbours(&fan[..3], 6).along.iter().map(|found| found[0]).collect();
        assert_eq!(three, [2, NONE, 0]);
    }

    /// Two tetrahedra that share the edge from 0 to 1, with faces turned over: all turn as those of the first one do
    /// that are not turned over, or nothing is stated of their sides.
    #[test]
    fn tetrahedra_that_share_an_edge_turn_to_sides_that_agree_or_to_none() {
        let outward =
            [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0], [1, 0, 4], [0, 1, 5], [1, 4, 5], [4, 0, 5]];
        let mut stated = 0;
        for turned in 0..1_u32 << outward.len() {
            let is_turned = |index: usize| turned >> index & 1 == 1;
            let turn =
                |(index, [a, b, c]): (usize, [u32; 3])| if is_turned(index) { [a, c, b] } else { [a, b, c] };
            let triangles: Vec<[u32; 3]> = outward.into_iter().enumerate().map(turn).collect();
            let Neighbours { along, branched } = neighbours(&triangles, 6);
            let joined = Joined::of_neighbours(&triangles, &along, &branched, NONE);
            assert!(joined.of_shell.iter().all(|shell| shell.free == 0));
            if joined.of_shell.iter().any(|shell| shell.is_one_sided) {
                continue;
            }
            stated += 1;
            let first = |index: usize| joined.shells.iter().position(|&shell| shell == joined.shells[index]);
            let agrees = |index: usize| {
                let first = first(index).unwrap_or_default();
                joined.turned[index] == (is_turned(index) != is_turned(first))
            };
            assert!((0..outward.len()).all(agrees), "{turned:b}");
        }
        // Of the sides that the mesh states without a contradiction, and of their opposites, at least.
        assert!(stated >= 2, "{stated}");
    }

    #[test]
    fn every_neighbour_is_mutual_and_has_the_edge() {
        let random = &mut fastrand::Rng::with_seed(80);
        for _ in 0..200 {
            let count = random.u32(3..12);
            let triangles: Vec<[u32; 3]> =
                (0..random.usize(1..40)).map(|_| [0; 3].map(|_| random.u32(0..count))).collect();
            let found = neighbours(&triangles, count as usize).along;
            for (triangle, of) in found.iter().enumerate() {
                for (edge, &other) in of.iter().enumerate().filter(|(_, other)| **other != NONE) {
                    let ends = |triangle: usize, edge: usize| {
                        let mut ends = [triangles[triangle][edge], triangles[triangle][(edge + 1) % 3]];
                        ends.sort_unstable();
                        ends
                    };
                    let is_back = |back: usize| {
                        found[other as usize][back] == triangle as u32
                            && ends(other as usize, back) == ends(triangle, edge)
                    };
                    assert!((0..3).any(is_back), "{triangles:?}");
                }
            }
        }
    }
}
