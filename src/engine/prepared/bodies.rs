//! The bodies of a model: shells with the voids within them.

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests;

mod nesting;

use self::nesting::{Around, Budget, ShellBoxes};
use super::PreparedModel;
use crate::bvh::Aabb;
use crate::sorting::sort_by_number;
use crate::threads::computed;
use std::collections::BTreeSet;

/// A body by its parts.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::engine) struct BodyParts {
    /// Its shells, the outer one first, with their surfaces: pieces of faces, or triangles by their places.
    pub(in crate::engine) shells: Vec<ShellParts>,
    /// The indices of the bodies that may be voids of this one, and of those that this one may be a void of, in order. If
    /// there are any, it is not known which shells are voids.
    pub(in crate::engine) may_nest_with: Vec<usize>,
    /// A box around it.
    pub(in crate::engine) aabb: Aabb,
}

/// A shell by its surfaces.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::engine) struct ShellParts {
    pub(in crate::engine) shell: u32,
    pub(in crate::engine) surfaces: Vec<u32>,
}

impl PreparedModel {
    /// Returns the bodies, in the order of their first surfaces, computed at first use; none of a cloud.
    ///
    /// Of closed shells that are apart, one that lies within an odd number of others is a void of the innermost of
    /// these (docs/facts.md, section 1); all others are bodies of their own.
    pub(in crate::engine) fn body_parts(&self) -> &[BodyParts] {
        computed::<Vec<BodyParts>>(&self.kept.bodies, || {
            if self.is_cloud() {
                return Vec::new();
            }
            let shells = self.shell_parts();
            let boxes: Vec<ShellBoxes> = shells.iter().map(|shell| self.boxes_of(shell)).collect();
            let around = self.arounds(&shells, &boxes, &mut Budget::default());
            grouped(shells, &boxes, &around)
        })
    }

    /// Returns the number of edges of a body without a partner.
    pub(in crate::engine) fn free_edges_of(&self, parts: &BodyParts) -> usize {
        let joined = self.joined();
        parts.shells.iter().map(|shell| joined.of_shell[shell.shell as usize].free).sum()
    }

    /// Returns the faces of a body, in order.
    pub(in crate::engine) fn faces_of(&self, parts: &BodyParts) -> Vec<usize> {
        let surfaces = parts.shells.iter().flat_map(|shell| &shell.surfaces);
        let face = |&surface: &u32| match &self.facets {
            Some(facets) => facets.group(facets.target.index(surface)),
            None => self.pieces.face(surface as usize),
        };
        surfaces.map(face).collect::<BTreeSet<usize>>().into_iter().collect()
    }

    /// Returns the shells with their surfaces, without those of which all triangles have two equal corners.
    pub(super) fn shell_parts(&self) -> Vec<ShellParts> {
        let joined = self.joined();
        let new = |shell: usize| ShellParts { shell: shell as u32, surfaces: Vec::new() };
        let mut shells: Vec<ShellParts> = (0..joined.of_shell.len()).map(new).collect();
        let mut is_whole = vec![self.facets.is_none(); shells.len()];
        for (surface, &shell) in joined.shells.iter().enumerate() {
            shells[shell as usize].surfaces.push(surface as u32);
            if let Some(facets) = &self.facets {
                let [a, b, c] = facets.target.corners(surface as u32);
                is_whole[shell as usize] |= a != b && b != c && c != a;
            }
        }
        shells.into_iter().filter(|shell| is_whole[shell.shell as usize]).collect()
    }
}

/// Assigns each void to its body. A shell is a void if the innermost shell about it is no void, unless the normals in the
/// source show otherwise.
fn grouped(shells: Vec<ShellParts>, boxes: &[ShellBoxes], around: &[Around]) -> Vec<BodyParts> {
    let depth = |index: usize| around[index].shells.len();
    // A chain: each shell about this one lies within all those that are less deep.
    let is_chain = |index: usize| {
        let mut depths: Vec<usize> = around[index].shells.iter().map(|&outer| depth(outer)).collect();
        depths.sort_unstable();
        depths.into_iter().eq(0..depth(index))
    };
    let mut is_known: Vec<bool> =
        (0..shells.len()).map(|index| around[index].unknown.is_empty() && is_chain(index)).collect();
    let mut outer_first: Vec<usize> = (0..shells.len()).collect();
    sort_by_number(&mut outer_first, |&index| depth(index) as f64);
    let mut is_void = vec![false; shells.len()];
    for index in outer_first {
        let innermost = around[index].shells.iter().copied().max_by_key(|&outer| depth(outer));
        let Some(outer) = innermost.filter(|_| is_known[index]) else { continue };
        let told = around[index].is_void;
        // No void lies in a void.
        is_known[index] = told != Some(true) || !is_void[outer];
        is_void[index] = is_known[index] && told.unwrap_or(!is_void[outer]);
    }
    let mut bodies: Vec<BodyParts> = Vec::new();
    let mut body_of = vec![None; shells.len()];
    let mut voids = Vec::new();
    for (index, shell) in shells.into_iter().enumerate() {
        if is_void[index] {
            voids.push((index, shell));
            continue;
        }
        body_of[index] = Some(bodies.len());
        bodies.push(BodyParts { shells: vec![shell], may_nest_with: Vec::new(), aabb: boxes[index].around });
    }
    for (index, shell) in voids {
        let about = around[index].shells.iter().copied().filter(|&outer| !is_void[outer]);
        if let Some(body) = about.max_by_key(|&outer| depth(outer)).and_then(|owner| body_of[owner]) {
            bodies[body].shells.push(shell);
            body_of[index] = Some(body);
        }
    }
    for index in (0..around.len()).filter(|&index| !is_known[index]) {
        let outer = around[index].shells.iter().chain(&around[index].unknown);
        for (one, other) in outer.filter_map(|&outer| body_of[index].zip(body_of[outer])) {
            bodies[one].may_nest_with.push(other);
            bodies[other].may_nest_with.push(one);
        }
    }
    for BodyParts { may_nest_with, .. } in &mut bodies {
        may_nest_with.sort_unstable();
        may_nest_with.dedup();
    }
    bodies
}
