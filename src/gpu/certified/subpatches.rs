//! Patches cut into subpatches that are small enough for float32.

use super::layouts::LEVELS;
use crate::axis::Axis;
use crate::bezier::{Patch, PatchSet, center_grid, net_length};
use crate::certified::Cell;
use crate::gpu::subpatch_domain::SubpatchDomain;
use crate::model::RigidTransform;
use glam::{DVec4, Vec4Swizzles};
use std::ops::Range;

/// The most halvings of one patch: 65,536 subpatches, more than are allowed in all.
const MAX_HALVINGS: u32 = 16;

/// A cell, or its intersection with a subpatch, in the subpatch's (σ, τ).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SubpatchCell {
    pub(crate) subpatch: usize,
    pub(crate) center: [f64; 2],
    /// Half the widths in σ and τ.
    pub(crate) half: [f64; 2],
}

/// The smallest half-width of a cell that kernels take. The centres of its
/// descendants within one submission are multiples of 2^-23 in [-1, 1], which
/// float32 represents exactly.
const MIN_HALF_WIDTH: f64 = 1.0 / (1_u32 << (23 - LEVELS - 1)) as f64;

impl SubpatchCell {
    /// Whether float32 represents the cell and all its descendants within one
    /// submission exactly.
    pub(crate) fn is_exact_in_float32(&self) -> bool {
        let is_exact = |&x: &f64| f64::from(x as f32) == x;
        self.center.iter().chain(&self.half).all(is_exact)
            && self.half.iter().all(|&half| half >= MIN_HALF_WIDTH)
    }
}

/// The moved subpatches of one model; those of a patch are consecutive.
#[derive(Debug)]
pub(crate) struct Subpatches {
    pub(crate) patches: PatchSet,
    pub(crate) domains: Vec<SubpatchDomain>,
    of_patch: Vec<Range<usize>>,
}

impl Subpatches {
    /// Halves every patch until `fits` holds for all its subpatches. Returns
    /// `None` if that takes more than `max_count` subpatches or more than
    /// [`MAX_HALVINGS`] halvings of one patch.
    pub(crate) fn new(
        patches: &PatchSet,
        transform: &RigidTransform,
        fits: &dyn Fn(&Patch<'_>) -> bool,
        max_count: usize,
    ) -> Option<Self> {
        let grid = center_grid(patches.bounding_box().diagonal());
        let mut subpatches = Self { patches: PatchSet::default(), domains: Vec::new(), of_patch: Vec::new() };
        for (index, patch) in patches.iter().enumerate() {
            let first = subpatches.domains.len();
            let rotate = |control: &DVec4| transform.rotate(control.xyz()).extend(control.w);
            let controls: Vec<DVec4> = patch.controls.iter().map(rotate).collect();
            let moved = Patch { center: transform.apply(patch.center), controls: &controls, ..patch };
            let domain = SubpatchDomain::whole(index as u32);
            if !subpatches.add(&moved, domain, grid, fits, MAX_HALVINGS, max_count) {
                return None;
            }
            subpatches.of_patch.push(first..subpatches.domains.len());
        }
        Some(subpatches)
    }

    /// Adds the patch or, unless it fits, its halves. Returns whether the limits are kept.
    fn add(
        &mut self,
        patch: &Patch<'_>,
        domain: SubpatchDomain,
        grid: f64,
        fits: &dyn Fn(&Patch<'_>) -> bool,
        halvings: u32,
        max_count: usize,
    ) -> bool {
        let mut centered = PatchSet::default();
        centered.push_centered(*patch, grid);
        let subpatch = centered.patch(0);
        if fits(&subpatch) {
            self.patches.push(subpatch);
            self.domains.push(domain);
            return self.domains.len() <= max_count;
        }
        let axis = Axis::of_larger([net_length(&subpatch, 0), net_length(&subpatch, 1)]);
        let halves = subpatch.halves(axis);
        halvings > 0
            && halves.iter().enumerate().all(|(index, controls)| {
                let half = Patch { controls, ..subpatch };
                self.add(&half, domain.half(axis.index(), index == 1), grid, fits, halvings - 1, max_count)
            })
    }

    /// The intersections of a cell with the subpatches of its patch.
    pub(crate) fn intersections(&self, cell: &Cell) -> impl Iterator<Item = SubpatchCell> {
        let (center, half) = (cell.center, cell.half);
        self.of_patch[cell.patch as usize].clone().filter_map(move |subpatch| {
            let domain = &self.domains[subpatch];
            let ends = [0, 1].map(|axis| {
                let low = domain.subpatch_parameter(axis, center[axis] - half[axis]).max(-1.0);
                let high = domain.subpatch_parameter(axis, center[axis] + half[axis]).min(1.0);
                [low, high]
            });
            ends.iter().all(|[low, high]| low < high).then(|| SubpatchCell {
                subpatch,
                center: ends.map(|[low, high]| 0.5 * (low + high)),
                half: ends.map(|[low, high]| 0.5 * (high - low)),
            })
        })
    }

    /// The cell as a rectangle of its patch.
    pub(crate) fn cell(&self, cell: &SubpatchCell) -> Cell {
        let domain = &self.domains[cell.subpatch];
        let half = [0, 1].map(|axis| 0.5 * cell.half[axis] * domain.width[axis]);
        Cell { patch: domain.patch, center: domain.of_symmetric(cell.center), half }
    }
}
