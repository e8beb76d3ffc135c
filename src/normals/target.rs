//! Model B in parts with boxes and cones, halved when they are first needed.

use super::quad::Quad;
use super::{NormalCone, Region, Shape};
use crate::axis::Axis;
use crate::bezier::Patch;
use crate::bvh::Aabb;
use crate::closest::{Target, newton};
use crate::facets::{Facet, FacetTarget};
use crate::param_box::ParamBox;
use crate::solid::longer_axis_of_controls;
use glam::DVec3;
use std::sync::OnceLock;

/// The number of times that a patch is halved at most.
const MAX_DEPTH: u32 = 40;

/// The steps towards the closest point of a patch: where they do not suffice a part counts as farther.
const NEWTON_STEPS: u32 = 6;

/// A part of a patch of B.
#[derive(Debug)]
pub(crate) struct Node {
    patch: u32,
    part: ParamBox,
    depth: u32,
    pub(super) region: Region,
    pub(super) quad: OnceLock<Option<Quad>>,
    cone: OnceLock<Option<NormalCone>>,
    halves: OnceLock<Option<Box<[Node; 2]>>>,
}

/// Model B.
pub(crate) enum NormalTarget<'a> {
    /// Patches with their tree.
    Patches {
        /// The patches.
        target: &'a Target,
        /// What is known of each, from its first use on.
        roots: Vec<OnceLock<Box<Node>>>,
    },
    /// Triangles, whose corners are off by at most `error`.
    Triangles {
        /// The triangles with their tree.
        facets: &'a FacetTarget,
        /// The distance of the corners from the exact ones.
        error: f64,
    },
}

impl<'a> NormalTarget<'a> {
    /// Makes the target of patches; nothing is computed yet.
    pub(crate) fn of_patches(target: &'a Target) -> Self {
        let roots = (0..target.patches.len()).map(|_| OnceLock::new()).collect();
        Self::Patches { target, roots }
    }

    /// Calls `visit` with the patches or triangles whose boxes are within `reach` of a box, those in nearer boxes of
    /// the tree first, until it returns false. O(parts of the tree in reach).
    pub(super) fn near(&self, aabb: &Aabb, reach: f64, visit: &mut dyn FnMut(u32) -> bool) {
        let reach_squared = reach * reach;
        let gap_squared = |other: &Aabb| aabb.gap(other).length_squared();
        let is_far = |other: &Aabb| gap_squared(other) > reach_squared;
        let ordered = |children: [u32; 2], of: &dyn Fn(u32) -> Aabb| {
            let [one, other] = children.map(|child| gap_squared(&of(child)));
            // The nearer one is taken first from the end.
            if one <= other { [children[1], children[0]] } else { children }
        };
        let mut stack = vec![0_u32];
        while let Some(index) = stack.pop() {
            match self {
                Self::Patches { target, .. } => {
                    let nodes = target.tree.nodes();
                    let Some(node) = nodes.get(index as usize).filter(|node| !is_far(&node.aabb)) else {
                        continue;
                    };
                    if !node.is_leaf() {
                        let children = [index + 1, node.right_child];
                        stack.extend(ordered(children, &|child| nodes[child as usize].aabb));
                    } else if !visit(target.tree.primitive(node)) {
                        return;
                    }
                }
                Self::Triangles { facets, .. } => {
                    let nodes = facets.tree.nodes();
                    let Some(node) = nodes.get(index as usize).filter(|node| !is_far(&node.aabb)) else {
                        continue;
                    };
                    if let Some(children) = node.children(index) {
                        stack.extend(ordered(children, &|child| nodes[child as usize].aabb));
                    } else if !node.range().all(|place| visit(place as u32)) {
                        return;
                    }
                }
            }
        }
    }

    /// Returns the shape of a triangle; `None` of a patch.
    pub(super) fn triangle(&self, place: u32) -> Option<Shape> {
        let Self::Triangles { facets, error } = self else { return None };
        let Facet::Triangle(corners) = facets.facet(place) else { return None };
        Some(Shape::of_points(corners.to_vec(), NormalCone::of_facet(facets, place, *error)))
    }

    /// Returns a whole patch; `None` of a triangle.
    pub(super) fn root(&self, patch: u32) -> Option<&Node> {
        let Self::Patches { target, roots } = self else { return None };
        let root = || Box::new(Node::new(&target.patches.patch(patch as usize), patch, ParamBox::UNIT, 0));
        Some(roots.get(patch as usize)?.get_or_init(root))
    }

    /// Returns the halves of a part of a patch; `None` of one that is halved no further.
    pub(super) fn halves<'n>(&self, node: &'n Node) -> Option<&'n [Node; 2]> {
        let Self::Patches { target, .. } = self else { return None };
        let halves = || {
            let patch = target.patches.patch(node.patch as usize);
            let halves = node.part.halves(node.axis(&patch)?);
            Some(Box::new(halves.map(|part| Node::new(&patch, node.patch, part, node.depth + 1))))
        };
        node.halves.get_or_init(halves).as_deref()
    }

    /// Returns a cone about the normals of a part of a patch; `None` where there may be none. Most parts are out of reach,
    /// so that it is computed at its first use.
    pub(super) fn cone(&self, node: &Node) -> Option<NormalCone> {
        let Self::Patches { target, .. } = self else { return None };
        let cone = || NormalCone::of_patch(&target.patches.patch(node.patch as usize), node.part);
        *node.cone.get_or_init(cone)
    }

    /// Returns the quadrilateral that a part of a patch covers, but for a distance; `None` where there is none.
    pub(super) fn quad<'n>(&self, node: &'n Node) -> Option<&'n Quad> {
        let Self::Patches { target, .. } = self else { return None };
        let degree = || target.patches.patch(node.patch as usize).degree;
        node.quad.get_or_init(|| Quad::of(&node.region.points, degree())).as_ref()
    }

    /// Returns some point of a part of a patch, one near to a point.
    pub(super) fn near_point(&self, node: &Node, point: DVec3) -> Option<DVec3> {
        let Self::Patches { target, .. } = self else { return None };
        let patch = target.patches.patch(node.patch as usize);
        let foot = newton(&patch, point, node.part.middle(), NEWTON_STEPS);
        let within = [0, 1].map(|axis| {
            let [low, high] = node.part[axis];
            foot.parameters[axis].clamp(low, high)
        });
        Some(patch.point(within))
    }

    /// Returns the squared distance of a point from a triangle.
    pub(super) fn distance_squared_of(&self, place: u32, point: DVec3) -> f64 {
        match self {
            Self::Triangles { facets, .. } => facets.distance_squared(place, point),
            Self::Patches { .. } => f64::INFINITY,
        }
    }
}

impl Node {
    fn new(patch: &Patch<'_>, index: u32, part: ParamBox, depth: u32) -> Self {
        let region = Region::of_part(patch, part, None);
        let (quad, cone, halves) = (OnceLock::new(), OnceLock::new(), OnceLock::new());
        Self { patch: index, part, depth, region, quad, cone, halves }
    }

    /// Returns the axis along which the part is longer; `None` for one that is halved no further.
    fn axis(&self, patch: &Patch<'_>) -> Option<Axis> {
        let [s, t] = self.part.intervals();
        (self.depth < MAX_DEPTH).then(|| longer_axis_of_controls(patch.degree, &patch.restricted(s, t)))
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::bezier::{PatchSet, quarter_of_cylinder};

    /// The normals of a quarter of a cylinder turn from x to y: the cone of all of it has both, and those of its halves
    /// along the arc one each.
    #[test]
    fn cones_are_about_the_normals_of_their_own_part() {
        let controls = quarter_of_cylinder();
        let mut patches = PatchSet::default();
        patches.push(Patch::whole([2, 1], DVec3::ZERO, &controls));
        let target = Target::new(patches);
        let target = NormalTarget::of_patches(&target);
        let root = target.root(0).unwrap();
        let normals = [[DVec3::ZERO, DVec3::Y, DVec3::Z], [DVec3::ZERO, DVec3::Z, DVec3::X]];
        let of_axes = normals.map(|corners| NormalCone::of_triangle(corners, 0.0).unwrap());
        let holds = |node: &Node| {
            let cone = target.cone(node).unwrap();
            of_axes.map(|axis| cone.angles(&axis)[0] <= 0.0)
        };
        assert_eq!(holds(root), [true, true]);
        let mut halves = root
            .part
            .halves(Axis::U)
            .map(|part| holds(&Node::new(&Patch::whole([2, 1], DVec3::ZERO, &controls), 0, part, 1)));
        halves.sort_unstable();
        assert_eq!(halves, [[false, true], [true, false]]);
    }
}
