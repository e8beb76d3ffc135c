//! The edges of faces as arcs: those that are joined, in pairs, and those that are free.

use super::boundary::{RELATIVE_TIE, reach_of};
use super::edges::{EdgePlace, Edges, EqualEdges};
use super::pairing::{Pairs, Reach, joined};
use super::part::EdgePart;
use crate::axis::Axis;
use crate::bvh::Aabb;
use crate::solid::curve::Curve;
use glam::DVec3;

/// A part of the edge of a patch or of a triangle.
#[derive(Debug, Clone)]
pub(crate) struct Arc {
    /// The patch with the side of its parameters, or the triangle.
    pub(crate) place: EdgePlace,
    /// The parameters of its start and its end along that side.
    pub(crate) range: [f64; 2],
    pub(crate) curve: Curve,
}

/// An edge of two faces, or of one.
#[derive(Debug, Clone)]
pub(crate) struct JoinedArc {
    pub(crate) one: Arc,
    /// The arc of the other face, in the same direction; none of a free edge.
    pub(crate) other: Option<Arc>,
    /// Whether the normals of both faces are to different sides of the shell.
    pub(crate) is_turned: bool,
}

/// Returns the edges at which the surfaces of a model end, joined in pairs as [`super::Boundary`] joins them; those
/// between patches within a surface are none. `corners` are those of the triangles of a mesh. O(n log n) in general
/// position.
pub(crate) fn joined_arcs(
    edges: Edges,
    corners: &dyn Fn(u32) -> [DVec3; 3],
    control_box: &Aabb,
    gap: f64,
) -> Vec<JoinedArc> {
    let side_of = |triangle: u32, side: u8| {
        let corners = corners(triangle);
        let ends = [0, 1].map(|end: usize| corners[(usize::from(side) + end) % 3]);
        Curve { center: DVec3::ZERO, controls: ends.map(|end| end.extend(1.0)).to_vec() }
    };
    let reach = reach_of(control_box, gap);
    let distances = Reach { reach, tie: RELATIVE_TIE * control_box.diagonal() };
    let (Pairs { pairs, free, .. }, _, equal) = joined(edges, distances);
    let of_pairs = pairs.into_iter().map(|[one, other]| {
        let is_turned = one.forward == other.forward;
        JoinedArc { one: one.into(), other: Some(other.into()), is_turned }
    });
    let equal =
        equal.into_iter().map(|EqualEdges { surfaces: [first, second], runs_alike, side, .. }| {
            let place = EdgePlace { index: first, axis: Axis::U, end: side };
            let one = Arc { place, range: [0.0, 1.0], curve: side_of(first, side) };
            let other = Arc { place: EdgePlace { index: second, ..place }, ..one.clone() };
            JoinedArc { one, other: Some(other), is_turned: runs_alike }
        });
    let free = free.into_iter().map(|part| JoinedArc { one: part.into(), other: None, is_turned: false });
    equal.chain(of_pairs).chain(free).collect()
}

impl From<EdgePart> for Arc {
    fn from(EdgePart { place, range, curve, .. }: EdgePart) -> Self {
        Self { place, range, curve }
    }
}
