//! One Bézier patch, and the storage of many.

pub(in crate::bezier) mod evaluate;
pub(in crate::bezier) mod subdivide;
mod tensor_grid;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod testing;

pub use evaluate::Jet;
pub(crate) use evaluate::normal;
#[cfg(feature = "gpu")]
pub(crate) use subdivide::net_length;
pub(crate) use tensor_grid::HomogeneousTangents;
#[cfg(all(test, not(target_arch = "wasm32")))]
pub(crate) use testing::quarter_of_cylinder;

use crate::axis::Axis;
use crate::bvh::Aabb;
use crate::param_box::ParamBox;
use bytemuck::Zeroable;
use glam::{DVec3, DVec4, Vec4Swizzles};
use std::sync::Arc;

/// One rational Bézier patch, borrowed from its set.
///
/// The surface point at (s, t) in [0, 1]² is `center + (x, y, z) / w` with
/// (x, y, z, w) the Bernstein sum of `controls`.
#[derive(Debug, Clone, Copy)]
pub struct Patch<'a> {
    /// Index of the surface in its model.
    pub surface: usize,
    /// Degrees in s and t.
    pub degree: [usize; 2],
    /// The part of the surface's domain that [0, 1]² is mapped to. Where the surface jumps at the upper end, it is
    /// the last number before the knot, whose point is the patch's.
    pub domain: ParamBox,
    /// The point that the controls are relative to.
    pub center: DVec3,
    /// Homogeneous controls `(w (p - center), w)`, t fastest, w > 0.
    pub controls: &'a [DVec4],
    /// True if the weights differ from each other.
    pub rational: bool,
}

#[cfg(all(test, not(target_arch = "wasm32")))]
impl<'a> Patch<'a> {
    /// A patch that is a surface of its own, as tests take them.
    pub(crate) fn whole(degree: [usize; 2], center: DVec3, controls: &'a [DVec4]) -> Self {
        let rational = controls.iter().any(|control| control.w != controls[0].w);
        Self { surface: 0, degree, domain: ParamBox::UNIT, center, controls, rational }
    }
}

impl Patch<'_> {
    /// Returns the surface parameters (u, v) of the patch parameters (s, t).
    #[must_use]
    pub fn surface_parameters(&self, parameters: [f64; 2]) -> [f64; 2] {
        self.domain.at(parameters)
    }

    /// Returns whether the patch does not change along an axis of degree 1, as
    /// its two rows of controls there are equal. O(p q).
    pub(crate) fn is_constant(&self, axis: Axis) -> bool {
        let columns = self.degree[1] + 1;
        self.degree[axis] == 1
            && match axis {
                Axis::U => self.controls[..columns] == self.controls[columns..],
                Axis::V => self.controls.chunks_exact(2).all(|pair| pair[0] == pair[1]),
            }
    }

    /// Returns the positions of the control points relative to `center`.
    pub fn local_points(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.controls.iter().map(|control| control.xyz() / control.w)
    }

    /// Returns the box of the control points, which contains the patch by the
    /// convex hull property, as all weights are positive. O(p q).
    #[must_use]
    pub fn bounding_box(&self) -> Aabb {
        let local = self.local_points().fold(Aabb::EMPTY, Aabb::with);
        Aabb { min: local.min + self.center, max: local.max + self.center }
    }
}

/// Returns the homogeneous controls of the same points relative to `point`.
pub(crate) fn relative(controls: &[DVec4], point: DVec3) -> Vec<DVec4> {
    controls.iter().map(|control| (control.xyz() - control.w * point).extend(control.w)).collect()
}

/// A patch without its controls, which begin at index `first` of the set's.
#[derive(Debug, Clone, Zeroable)]
pub(in crate::bezier) struct Entry {
    pub(in crate::bezier) surface: u32,
    pub(in crate::bezier) degree: [u8; 2],
    pub(in crate::bezier) rational: bool,
    pub(in crate::bezier) first: usize,
    pub(in crate::bezier) domain: ParamBox,
    pub(in crate::bezier) center: DVec3,
}

/// A list of patches of any mixture of degrees, with all controls in one array. Copies
/// share their memory until one is changed.
#[derive(Debug, Clone, Default)]
pub struct PatchSet {
    entries: Arc<Vec<Entry>>,
    controls: Arc<Vec<DVec4>>,
}

impl PatchSet {
    /// Makes the set of these patches.
    pub(in crate::bezier) fn new(entries: Vec<Entry>, controls: Vec<DVec4>) -> Self {
        Self { entries: Arc::new(entries), controls: Arc::new(controls) }
    }

    /// Returns the number of patches.
    #[must_use]
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Returns whether the set has no patches.
    #[cfg(feature = "internals")]
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Returns patch `index`, which must be below [`PatchSet::len`].
    #[must_use]
    pub fn patch(&self, index: usize) -> Patch<'_> {
        let entry = &self.entries[index];
        let degree = entry.degree.map(usize::from);
        let size = (degree[0] + 1) * (degree[1] + 1);
        Patch {
            surface: entry.surface as usize,
            degree,
            domain: entry.domain,
            center: entry.center,
            controls: &self.controls[entry.first..entry.first + size],
            rational: entry.rational,
        }
    }

    /// Iterates over all patches in order.
    pub fn iter(&self) -> impl Iterator<Item = Patch<'_>> {
        (0..self.len()).map(|index| self.patch(index))
    }

    /// Appends a copy of `patch`.
    pub fn push(&mut self, patch: Patch<'_>) {
        Arc::make_mut(&mut self.entries).push(Entry {
            surface: patch.surface as u32,
            degree: patch.degree.map(|degree| degree as u8),
            rational: patch.rational,
            first: self.controls.len(),
            domain: patch.domain,
            center: patch.center,
        });
        Arc::make_mut(&mut self.controls).extend_from_slice(patch.controls);
    }

    /// Reserves space for more patches and controls.
    pub(crate) fn reserve(&mut self, patches: usize, controls: usize) {
        Arc::make_mut(&mut self.entries).reserve(patches);
        Arc::make_mut(&mut self.controls).reserve(controls);
    }

    /// Returns the number of control points of all patches.
    pub(crate) fn control_count(&self) -> usize {
        self.controls.len()
    }

    /// Appends all patches of `other`.
    #[cfg(feature = "internals")]
    pub fn append(&mut self, other: &Self) {
        let offset = self.controls.len();
        let moved = |entry: &Entry| Entry { first: entry.first + offset, ..entry.clone() };
        Arc::make_mut(&mut self.entries).extend(other.entries.iter().map(moved));
        Arc::make_mut(&mut self.controls).extend_from_slice(&other.controls);
    }

    /// Returns the box of all patches. O(controls).
    #[must_use]
    pub fn bounding_box(&self) -> Aabb {
        self.iter().fold(Aabb::EMPTY, |aabb, patch| aabb.union(patch.bounding_box()))
    }
}
