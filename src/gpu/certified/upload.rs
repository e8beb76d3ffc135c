//! Upload of subpatches: power form, centres and derivative bounds.

use super::float32_error::{Float32Error, scaled, weight_scale};
use super::layouts::Subpatch;
use super::subpatches::Subpatches;
use crate::bezier::{BEYOND, Patch};
use crate::certified::Operand;
use crate::error::{Error, Result};
use crate::gpu::Gpu;
use crate::gpu::float32::{round, round_up};
use crate::gpu::subpatch_domain::SubpatchDomain;
use glam::DVec3;

/// The coordinates of both models on the GPU.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SubpatchFrame {
    pub(crate) origin: DVec3,
    pub(crate) scale: f64,
    /// Unit of the subpatches' centres, a power of two.
    pub(crate) center_unit: f64,
}

/// Subpatches on the GPU, group by group.
#[derive(Debug)]
pub(crate) struct GpuSubpatches {
    pub(crate) subpatches: wgpu::Buffer,
    pub(crate) groups: Vec<SubpatchGroup>,
    /// The subpatch of every index on the GPU, and the inverse permutation.
    order: Vec<u32>,
    indices: Vec<u32>,
}

impl GpuSubpatches {
    /// The index of a subpatch on the GPU.
    pub(crate) fn index_of(&self, subpatch: usize) -> u32 {
        self.indices[subpatch]
    }

    /// The subpatch whose index a kernel wrote.
    ///
    /// # Errors
    /// [`Error::GpuFailed`] if the index is out of range.
    pub(crate) fn subpatch(&self, index: u32) -> Result<usize> {
        let found = || format!("a kernel wrote subpatch {index} of {}", self.order.len());
        let subpatch = self.order.get(index as usize).ok_or_else(|| Error::GpuFailed { found: found() })?;
        Ok(*subpatch as usize)
    }
}

/// Subpatches of one pair of degrees.
#[derive(Debug)]
pub(crate) struct SubpatchGroup {
    pub(crate) degree: [usize; 2],
    /// Index of the first subpatch on the GPU.
    pub(crate) first: usize,
    pub(crate) count: usize,
    pub(crate) coefficients: wgpu::Buffer,
}

/// The parameters over which derivative bounds hold.
#[derive(Debug, Clone, Copy)]
pub(crate) enum BoundsDomain<'a> {
    /// The subpatch.
    Subpatch,
    /// The subpatch and a small margin, within the parameters at which its
    /// patch of this operand, extended, is a part of the model.
    Extended(&'a Operand<'a>),
}

impl Gpu {
    /// Uploads the subpatches in the order of `groups`.
    pub(crate) fn upload_subpatches(
        &self,
        subpatches: &Subpatches,
        groups: &[([usize; 2], Vec<u32>)],
        bounds: BoundsDomain<'_>,
        frame: &SubpatchFrame,
    ) -> GpuSubpatches {
        let mut order: Vec<u32> = Vec::with_capacity(subpatches.domains.len());
        let mut records: Vec<Subpatch> = Vec::with_capacity(subpatches.domains.len());
        let mut uploaded = Vec::with_capacity(groups.len());
        for (degree, members) in groups {
            let mut coefficients: Vec<[f32; 4]> = Vec::new();
            for &member in members {
                let patch = subpatches.patches.patch(member as usize);
                let weight_scale = weight_scale(&patch);
                let power_form = patch.monomials();
                coefficients.extend(power_form.iter().map(|&c| round(scaled(c, weight_scale, frame.scale))));
                records.push(record(&patch, &subpatches.domains[member as usize], bounds, frame));
            }
            uploaded.push(SubpatchGroup {
                degree: *degree,
                first: order.len(),
                count: members.len(),
                coefficients: self.upload("coefficients", &coefficients),
            });
            order.extend_from_slice(members);
        }
        let mut indices = vec![0; order.len()];
        for (index, &subpatch) in order.iter().enumerate() {
            indices[subpatch as usize] = index as u32;
        }
        GpuSubpatches { subpatches: self.upload("subpatches", &records), groups: uploaded, order, indices }
    }
}

fn record(
    patch: &Patch<'_>,
    domain: &SubpatchDomain,
    bounds: BoundsDomain<'_>,
    frame: &SubpatchFrame,
) -> Subpatch {
    let error = Float32Error::new(patch, frame.scale);
    let own = patch.derivative_bounds();
    // The derivatives by (σ, τ) are those by the bounds' parameters times h and k.
    let (bounds, [h, k], low, high) = match bounds {
        BoundsDomain::Subpatch => (own, [0.5; 2], [-1.0; 2], [1.0; 2]),
        BoundsDomain::Extended(operand) => {
            let extension = operand.room(domain.patch);
            let low = [0, 1].map(|axis| (domain.low[axis] - BEYOND).max(extension[axis][0]));
            let high =
                [0, 1].map(|axis| (domain.low[axis] + domain.width[axis] + BEYOND).min(extension[axis][1]));
            (
                operand.bounds(domain.patch, low, high),
                domain.width.map(|width| 0.5 * width),
                [0, 1].map(|axis| domain.subpatch_parameter(axis, low[axis])),
                [0, 1].map(|axis| domain.subpatch_parameter(axis, high[axis])),
            )
        }
    };
    let up = |value: f64| round_up(frame.scale * value);
    let [ss, st, tt] = bounds.second;
    let [sss, sst, stt, ttt] = bounds.third;
    let center = frame.scale / frame.center_unit * (patch.center - frame.origin);
    Subpatch {
        center: center.to_array().map(|x| x.round() as i32),
        value_error: round_up(error.value),
        first_error: error.first.map(round_up),
        first: [up(h * bounds.first[0]), up(k * bounds.first[1])],
        second_error: error.second.map(round_up),
        radius: up(own.radius),
        second: [up(h * h * ss), up(h * k * st), up(k * k * tt)],
        padding: 0.0,
        third: [up(h * h * h * sss), up(h * h * k * sst), up(h * k * k * stt), up(k * k * k * ttt)],
        // Dyadic numbers of few digits, so that float32 is exact.
        low: low.map(|x| x as f32),
        high: high.map(|x| x as f32),
    }
}
