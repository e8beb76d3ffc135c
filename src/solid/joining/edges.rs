//! The edges at which the patches of a model's surfaces, or the triangles of a mesh, end.

use crate::axis::Axis;
use crate::bezier::{BezierModel, Patch};
use crate::solid::curve::Curve;
use crate::sorting::sort_by_number;
use glam::DVec3;
use std::collections::{HashMap, HashSet};

/// A side of a patch, or of a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct EdgePlace {
    /// The patch of the model, or the place of the triangle.
    pub(crate) index: u32,
    /// The parameter that is constant along a patch's side.
    pub(crate) axis: Axis,
    /// Its value, 0 or 1; of a triangle the number of the corner where the side begins.
    pub(crate) end: u8,
}

/// Two equal edges of triangles.
#[derive(Debug, Clone, Copy)]
pub(super) struct EqualEdges {
    /// The triangles.
    pub(super) surfaces: [u32; 2],
    /// Whether both run the same way round their surfaces.
    pub(super) runs_alike: bool,
    /// Whether others are equal to them.
    pub(super) are_of_several: bool,
    /// The side of the first triangle.
    pub(super) side: u8,
}

/// The edge of a patch at which its surface ends.
#[derive(Debug, Clone)]
pub(super) struct Edge {
    pub(super) surface: usize,
    pub(super) place: EdgePlace,
    pub(super) curve: Curve,
    /// Whether the curve runs about the surface's normal as the fingers of the right hand do.
    pub(super) forward: bool,
    /// The shell that the surface belongs to in its source, if that is known.
    pub(super) shell: Option<u32>,
}

/// Where a surface comes from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SurfaceOrigin {
    /// The face that it is a piece of; pieces of a face follow each other.
    pub(crate) face: usize,
    /// Whether its normal is opposite to that of the face; none where that is not known.
    pub(crate) is_turned: Option<bool>,
    /// Whether the source turns its normal over. It is false where the source states no side.
    pub(crate) is_reversed: bool,
    /// The shell of the face in its source, if that is known.
    pub(crate) shell: Option<u32>,
}

impl SurfaceOrigin {
    /// The origin of a whole face.
    #[cfg(all(test, not(target_arch = "wasm32")))]
    pub(crate) fn whole(face: usize) -> Self {
        Self { face, is_turned: Some(false), is_reversed: false, shell: None }
    }
}

/// Two pieces of one face.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pieces {
    pub(super) surfaces: [u32; 2],
    /// Whether their normals are to different sides of the face, if that is known.
    pub(super) is_turned: Option<bool>,
}

/// The edges of surfaces.
#[derive(Debug, Default)]
pub(crate) struct Edges {
    /// The number of surfaces.
    pub(super) surfaces: usize,
    /// Equal edges, which cancel (docs/solids.md, section 1).
    pub(super) equal: Vec<EqualEdges>,
    /// The other edges.
    pub(super) single: Vec<Edge>,
    /// Pieces of faces, each with the one before it.
    pub(super) pieces: Vec<Pieces>,
    /// Whether the source turns a surface over, for each; none for triangles, which it does not.
    pub(super) reversed: Vec<bool>,
}

/// The equal edges of triangles that have no partner yet.
#[derive(Debug, Default)]
struct OpenEdges {
    /// The numbers of their places, with their ends.
    open: Vec<(usize, [DVec3; 2])>,
    /// The number of all equal edges.
    count: u32,
}

impl Edges {
    /// Returns all edges of the surfaces: those of patches without a neighbour in the surface, or
    /// one that a knot of full multiplicity separates. `origin` tells where a surface comes from.
    pub(crate) fn of_surfaces(model: &BezierModel, origin: impl Fn(usize) -> SurfaceOrigin) -> Self {
        let origins: Vec<SurfaceOrigin> = (0..model.grids.len()).map(origin).collect();
        let both = (1..).zip(origins.windows(2)).filter(|(_, both)| both[0].face == both[1].face);
        let pieces = both.map(|(index, both)| {
            let is_turned = both[0].is_turned.zip(both[1].is_turned).map(|(one, other)| one != other);
            Pieces { surfaces: [index - 1, index], is_turned }
        });
        let pieces = pieces.collect();
        let reversed = origins.iter().map(|origin| origin.is_reversed).collect();
        Self { surfaces: origins.len(), equal: Vec::new(), single: edges(model, &origins), pieces, reversed }
    }

    /// Returns the edges of triangles, each a surface, in the order of their file, with the number of
    /// the surface. Edges between the same two corners are equal, and those without length, which are
    /// points, are left out. O(n).
    ///
    /// Of more than two equal edges those are paired that run opposite ways, of triangles that follow each other, and
    /// copies of triangles after all others: so the mesh keeps its own orientation where it has one, and bodies that
    /// follow each other in a file, or a mesh that stands in it twice, are shells of their own.
    pub(crate) fn of_triangles(triangles: impl Iterator<Item = (usize, [DVec3; 3])>) -> Self {
        let mut edges = Self::default();
        // By the bits of both ends.
        let mut open: HashMap<[Bits; 2], OpenEdges> = HashMap::new();
        let mut pairs = Vec::new();
        for (triangle, [a, b, c]) in copies_last(triangles) {
            edges.surfaces += 1;
            for (side, ends) in [[a, b], [b, c], [c, a]].into_iter().enumerate() {
                let [first, second] = ends.map(bits);
                if first == second {
                    continue;
                }
                let key = if first < second { [first, second] } else { [second, first] };
                let place = 3 * triangle + side;
                let all = open.entry(key).or_default();
                all.count += 1;
                match all.open.iter().rposition(|(_, other)| bits(other[0]) == second) {
                    Some(index) => pairs.push((key, [all.open.remove(index).0, place], false)),
                    None => all.open.push((place, ends)),
                }
            }
        }
        let mut single = Vec::new();
        let mut alike = Vec::new();
        for (&key, OpenEdges { open, .. }) in &open {
            let both = open.chunks_exact(2);
            single.extend(both.remainder().iter().copied());
            alike.extend(both.map(|both| (key, [both[0].0, both[1].0], true)));
        }
        // No two begin at one place.
        sort_by_number(&mut alike, |&(_, [place, _], _)| place as f64);
        let several: HashSet<[Bits; 2]> =
            open.iter().filter(|(_, all)| all.count > 2).map(|(&key, _)| key).collect();
        let equal = pairs.into_iter().chain(alike).map(|(key, places, runs_alike)| EqualEdges {
            surfaces: places.map(|place| (place / 3) as u32),
            runs_alike,
            are_of_several: several.contains(&key),
            side: (places[0] % 3) as u8,
        });
        edges.equal = equal.collect();
        // A table has no order of its own.
        sort_by_number(&mut single, |&(place, _)| place as f64);
        let edge = |(place, ends): (usize, [DVec3; 2])| {
            let controls = ends.map(|end| end.extend(1.0)).to_vec();
            let curve = Curve { center: DVec3::ZERO, controls };
            let index = (place / 3) as u32;
            let place = EdgePlace { index, axis: Axis::U, end: (place % 3) as u8 };
            Edge { surface: index as usize, place, curve, forward: true, shell: None }
        };
        edges.single = single.into_iter().map(edge).collect();
        edges
    }
}

/// The bits of the coordinates of a corner.
type Bits = [u64; 3];

fn bits(point: DVec3) -> Bits {
    point.to_array().map(f64::to_bits)
}

/// Returns the triangles in their order, but the second one of each three corners after all first
/// ones, and so on.
fn copies_last(triangles: impl Iterator<Item = (usize, [DVec3; 3])>) -> Vec<(usize, [DVec3; 3])> {
    let mut counts: HashMap<[Bits; 3], u32> = HashMap::new();
    let numbered = triangles.map(|triangle| {
        let mut corners = triangle.1.map(bits);
        corners.sort_unstable();
        let count = counts.entry(corners).or_default();
        *count += 1;
        (*count, triangle)
    });
    let mut numbered: Vec<_> = numbered.collect();
    sort_by_number(&mut numbered, |&(copy, _)| f64::from(copy));
    numbered.into_iter().map(|(_, triangle)| triangle).collect()
}

/// Returns the edges of the patches that have no neighbour there in their surface.
fn edges(model: &BezierModel, origins: &[SurfaceOrigin]) -> Vec<Edge> {
    let mut edges = Vec::new();
    for (surface, grid) in model.grids.iter().enumerate() {
        let ([rows, columns], shell) = (grid.counts(), origins[surface].shell);
        for index in 0..rows * columns {
            let patch = model.patches.patch(grid.first + index);
            let place = [index / columns, index % columns];
            for (axis, of_axis) in grid.multiplicities.iter().enumerate() {
                for end in 0..2 {
                    let line = place[axis] + end;
                    let is_end = line == 0 || line == grid.counts()[axis];
                    if is_end || usize::from(of_axis[line]) > patch.degree[axis] {
                        // At t = 0 along s, at s = 1 along t, and back at the other two.
                        let forward = (axis == 1) == (end == 0);
                        let (index, side) = ((grid.first + index) as u32, Axis::BOTH[axis]);
                        let place = EdgePlace { index, axis: side, end: end as u8 };
                        edges.push(Edge { surface, place, curve: edge(&patch, axis, end), forward, shell });
                    }
                }
            }
        }
    }
    edges
}

/// Returns the edge of a patch at an end of an axis.
fn edge(patch: &Patch<'_>, axis: usize, end: usize) -> Curve {
    let [rows, columns] = patch.degree.map(|degree| degree + 1);
    let controls = if axis == 0 {
        let first = end * (rows - 1) * columns;
        patch.controls[first..first + columns].to_vec()
    } else {
        patch.controls.iter().skip(end * (columns - 1)).step_by(columns).copied().collect()
    };
    Curve { center: patch.center, controls }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::bezier::extract;
    use crate::model::{Model, SurfaceArrays};

    /// Two squares in one surface, between which it continues, or jumps over a crack.
    #[test]
    fn a_surface_ends_where_it_jumps() {
        let count = |ends: &[f64], knots: &[f64]| {
            let row = |&x: &f64| [[x, 0.0, 0.0, 1.0], [x, 1.0, 0.0, 1.0]];
            let arrays = SurfaceArrays {
                degree: [1, 1],
                knots: [knots.to_vec(), vec![0.0, 0.0, 1.0, 1.0]],
                counts: [ends.len(), 2],
                control_points: ends.iter().flat_map(row).collect(),
            };
            Edges::of_surfaces(
                &extract(&Model::from_arrays(None, vec![arrays]).unwrap()),
                SurfaceOrigin::whole,
            )
            .single
            .len()
        };
        assert_eq!(count(&[0.0, 1.0, 2.0], &[0.0, 0.0, 1.0, 2.0, 2.0]), 6);
        assert_eq!(count(&[0.0, 1.0, 1.5, 2.5], &[0.0, 0.0, 1.0, 1.0, 2.0, 2.0]), 8);
    }

    /// A tetrahedron has six edges of two triangles; without one of these three are single. A sliver
    /// with two equal corners has two equal edges, which cancel.
    #[test]
    fn edges_of_one_triangle_are_single() {
        let [a, b, c, d] = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let counts = |triangles: &[[DVec3; 3]]| {
            let edges = Edges::of_triangles(triangles.iter().copied().enumerate());
            assert_eq!(edges.surfaces, triangles.len());
            [edges.equal.len(), edges.single.len()]
        };
        let faces = [[a, b, c], [a, b, d], [a, c, d], [b, c, d]];
        assert_eq!(counts(&faces), [6, 0]);
        assert_eq!(counts(&faces[..3]), [3, 3]);
        assert_eq!(counts(&[[a, b, b]]), [1, 0]);
        let single = Edges::of_triangles(faces[..1].iter().copied().enumerate()).single;
        let ends: Vec<[DVec3; 2]> = single.iter().map(|edge| edge.curve.ends()).collect();
        assert_eq!(ends, [[a, b], [b, c], [c, a]]);
    }

    /// A tetrahedron that stands twice in its file, one after the other or each triangle twice, is two
    /// shells whose triangles are not paired with each other.
    #[test]
    fn copies_of_triangles_are_shells_of_their_own() {
        let [a, b, c, d] = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let faces = [[a, b, c], [a, b, d], [a, c, d], [b, c, d]];
        let turned = |[a, b, c]: [DVec3; 3]| [b, c, a];
        let one_after_the_other: Vec<_> = faces.into_iter().chain(faces.map(turned)).collect();
        let each_twice: Vec<_> = faces.into_iter().flat_map(|face| [face, turned(face)]).collect();
        for (triangles, is_of_first) in [
            (one_after_the_other, (|place| place < 4) as fn(u32) -> bool),
            (each_twice, |place| place % 2 == 0),
        ] {
            let edges = Edges::of_triangles(triangles.into_iter().enumerate());
            assert_eq!([edges.equal.len(), edges.single.len()], [12, 0]);
            assert!(
                edges.equal.iter().all(|edge| is_of_first(edge.surfaces[0]) == is_of_first(edge.surfaces[1])),
                "{:?}",
                edges.equal
            );
        }
    }
}
