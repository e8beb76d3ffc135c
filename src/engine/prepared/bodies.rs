//! The bodies of a model: shells with the voids within them.

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests;

use super::PreparedModel;
use super::shells::MAX_PAIRS;
use crate::bvh::Aabb;
use crate::sorting::sort_by_number;
use crate::threads::computed;
use std::collections::BTreeSet;

/// The number of pairs of cells that the comparisons of a model's shells may take together, about a second of work. Each
/// comparison still takes [`MIN_PAIRS`] after that. A damaged file may have some hundred shells that are all nearer to
/// each other than its gap.
const MAX_PAIRS_OF_ALL: usize = 8 * MAX_PAIRS;

/// The least number of pairs of cells for one comparison. Fewer show of most shells that they are apart.
const MIN_PAIRS: usize = 1_024;

/// A body by its parts.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::engine) struct BodyParts {
    /// Its shells, the outer one first, with their surfaces: pieces of faces, or triangles by their places.
    pub(in crate::engine) shells: Vec<ShellParts>,
    /// Whether it is known which shells are voids of it.
    pub(in crate::engine) is_nesting_known: bool,
    /// A box around it.
    pub(in crate::engine) aabb: Aabb,
}

/// A shell by its surfaces.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::engine) struct ShellParts {
    pub(in crate::engine) shell: u32,
    pub(in crate::engine) surfaces: Vec<u32>,
}

/// The shells about a closed shell, where that is known.
struct Around {
    shells: Vec<usize>,
    is_known: bool,
}

impl PreparedModel {
    /// Returns the bodies, in the order of their first surfaces, computed at first use; none of a cloud.
    ///
    /// Of closed shells that are apart, one that lies within an odd number of others is a void of the innermost of
    /// these, as `side` has it (docs/solids.md, section 2); all others are bodies of their own.
    pub(in crate::engine) fn body_parts(&self) -> &[BodyParts] {
        computed::<Vec<BodyParts>>(&self.kept.bodies, || {
            if self.is_cloud() {
                return Vec::new();
            }
            let shells = self.shell_parts();
            let boxes: Vec<Aabb> = shells.iter().map(|shell| self.box_of(shell)).collect();
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
    fn shell_parts(&self) -> Vec<ShellParts> {
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

    /// Returns a box around a shell.
    fn box_of(&self, shell: &ShellParts) -> Aabb {
        let of_surface = |&surface: &u32| match &self.facets {
            Some(facets) => facets.target.facet(surface).bounding_box(),
            None => self.box_of_piece(surface as usize),
        };
        shell.surfaces.iter().map(of_surface).fold(Aabb::EMPTY, Aabb::union)
    }

    /// Returns the closed shells about each closed shell.
    fn arounds(&self, shells: &[ShellParts], boxes: &[Aabb], budget: &mut Budget) -> Vec<Around> {
        // Shells of larger meshes have no tree to be compared by.
        let may_compare = self.facets.as_ref().is_none_or(|facets| facets.may_close());
        let numbers = |pair: [usize; 2]| pair.map(|index| shells[index].shell);
        let mut to_compare = self.nested_boxes(shells, boxes);
        to_compare.retain(|&pair| {
            let [inner, outer] = numbers(pair);
            !may_compare || self.shells().may_be_within(inner, outer)
        });
        let mut around: Vec<Around> =
            shells.iter().map(|_| Around { shells: Vec::new(), is_known: true }).collect();
        for (place, &pair) in to_compare.iter().enumerate() {
            let [inner, outer] = numbers(pair);
            let within = may_compare
                .then(|| {
                    let max_pairs = budget.share(to_compare.len() - place);
                    let (within, pairs) = self.shells().is_within(inner, outer, max_pairs);
                    budget.spend(pairs);
                    within
                })
                .flatten();
            match within {
                Some(true) => around[pair[0]].shells.push(pair[1]),
                Some(false) => {}
                None => around[pair[0]].is_known = false,
            }
        }
        around
    }

    /// Returns the pairs of closed shells that have to be compared: the box of the first lies within the box of the
    /// second.
    fn nested_boxes(&self, shells: &[ShellParts], boxes: &[Aabb]) -> Vec<[usize; 2]> {
        let joined = self.joined();
        let is_closed = |index: usize| joined.of_shell[shells[index].shell as usize].free == 0;
        let mut order: Vec<usize> = (0..shells.len()).filter(|&index| is_closed(index)).collect();
        sort_by_number(&mut order, |&index| boxes[index].min.x);
        let mut pairs = Vec::new();
        for (place, &outer) in order.iter().enumerate() {
            let begin_within =
                order[place + 1..].iter().take_while(|&&inner| boxes[inner].min.x <= boxes[outer].max.x);
            let nested = begin_within.filter(|&&inner| is_inside(&boxes[inner], &boxes[outer]));
            pairs.extend(nested.map(|&inner| [inner, outer]));
        }
        pairs
    }
}

/// The pairs of cells that all comparisons of a model's shells may bound.
#[derive(Debug)]
struct Budget {
    left: usize,
}

impl Default for Budget {
    fn default() -> Self {
        Self { left: MAX_PAIRS_OF_ALL }
    }
}

impl Budget {
    /// Returns the number of pairs of cells for the next comparison: an equal share of the budget, for this number of
    /// comparisons that are still to be made.
    fn share(&self, comparisons: usize) -> usize {
        (self.left / comparisons.max(1)).clamp(MIN_PAIRS, MAX_PAIRS)
    }

    fn spend(&mut self, pairs: usize) {
        self.left = self.left.saturating_sub(pairs);
    }
}

/// Returns whether a box lies within another one and is no copy of it.
fn is_inside(inner: &Aabb, outer: &Aabb) -> bool {
    outer.contains(inner) && inner != outer
}

/// Joins voids to the bodies that have them.
fn grouped(shells: Vec<ShellParts>, boxes: &[Aabb], around: &[Around]) -> Vec<BodyParts> {
    let depth = |index: usize| around[index].shells.len();
    // A chain: each shell about this one lies within all those that are less deep.
    let is_chain = |index: usize| {
        let mut depths: Vec<usize> = around[index].shells.iter().map(|&outer| depth(outer)).collect();
        depths.sort_unstable();
        depths.into_iter().eq(0..depth(index))
    };
    let mut bodies: Vec<BodyParts> = Vec::new();
    let mut body_of = vec![usize::MAX; shells.len()];
    let mut voids = Vec::new();
    for (index, shell) in shells.into_iter().enumerate() {
        let is_known = around[index].is_known && is_chain(index);
        if is_known && depth(index) % 2 == 1 {
            voids.push((index, shell));
            continue;
        }
        body_of[index] = bodies.len();
        bodies.push(BodyParts { shells: vec![shell], is_nesting_known: is_known, aabb: boxes[index] });
    }
    for (index, shell) in voids {
        let owner = around[index].shells.iter().copied().find(|&outer| depth(outer) + 1 == depth(index));
        if let Some(body) = owner.and_then(|owner| bodies.get_mut(body_of[owner])) {
            body.shells.push(shell);
        }
    }
    // What may or may not be a void of a body leaves the body unknown, too.
    for (index, around) in around.iter().enumerate().filter(|(_, around)| !around.is_known) {
        let is_about = |outer: usize| is_inside(&boxes[index], &boxes[outer]);
        let _ = around;
        for outer in (0..boxes.len()).filter(|&outer| is_about(outer)) {
            if let Some(body) = bodies.get_mut(body_of[outer]) {
                body.is_nesting_known = false;
            }
        }
    }
    bodies
}
