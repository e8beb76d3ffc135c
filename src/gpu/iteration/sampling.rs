//! The samples of a model, and the patches that they lie on, row by row.

use super::layouts::{SampleColumn, SampleRow};
use crate::bezier::{BezierModel, Patch};
use crate::gpu::Gpu;
use crate::gpu::degree_groups::{Controls, max_patches};
use crate::gpu::float32::{ModelFrame, patch_error};
use crate::iteration::{SampleGrid, Sampling};
use glam::DVec3;
use std::ops::Range;

/// A sampling on the GPU: the rows of every page with the patches that they lie on.
#[derive(Debug)]
pub(crate) struct GpuSampling {
    /// The origin of the coordinates before the model is moved.
    pub(crate) origin: DVec3,
    /// The factor of the coordinates before the model is moved.
    pub(crate) scale: f64,
    pub(crate) pages: Vec<Vec<SampleGroup>>,
    /// The largest number of samples of a row.
    pub(crate) columns: usize,
    /// The largest number of samples of a page.
    pub(crate) page_samples: u64,
    /// Upper bound on the error of a sample in float32 before it is moved, in model units.
    pub(crate) coordinate_error: f64,
    /// Upper bound on the distance of a sample from the origin.
    pub(crate) radius: f64,
}

/// Rows of one page on patches of one degree.
#[derive(Debug)]
pub(crate) struct SampleGroup {
    pub(crate) degree: [usize; 2],
    pub(crate) row_count: u32,
    pub(crate) column_count: u32,
    pub(crate) controls: Controls,
    pub(crate) rows: wgpu::Buffer,
    pub(crate) columns: wgpu::Buffer,
}

/// A group that rows are still added to.
struct Draft {
    degree: [usize; 2],
    column_count: usize,
    rows: Vec<SampleRow>,
    columns: Vec<SampleColumn>,
    patches: Vec<u32>,
    /// Surface and row of the patches appended last, and where they start.
    last_patches: Option<((usize, usize), u32)>,
    /// Surface whose columns were appended last, and where they start.
    last_columns: Option<(usize, u32)>,
}

impl Draft {
    fn new(degree: [usize; 2], column_count: usize) -> Self {
        Self {
            degree,
            column_count,
            rows: Vec::new(),
            columns: Vec::new(),
            patches: Vec::new(),
            last_patches: None,
            last_columns: None,
        }
    }
}

impl Gpu {
    /// Uploads all pages.
    pub(crate) fn upload_sampling(&self, model: &BezierModel, sampling: &Sampling) -> GpuSampling {
        let frame = ModelFrame::new(model.patches.bounding_box());
        let pages = sampling.pages();
        GpuSampling {
            origin: frame.origin,
            scale: frame.scale,
            pages: pages.iter().map(|page| self.upload_page(model, sampling, page, &frame)).collect(),
            columns: sampling.grids.iter().map(|grid| grid.counts()[1]).max().unwrap_or(0),
            page_samples: pages.iter().map(|page| page.len() as u64).max().unwrap_or(0),
            coordinate_error: model.patches.iter().map(|patch| patch_error(&patch)).fold(0.0, f64::max),
            radius: frame.radius,
        }
    }

    fn upload_page(
        &self,
        model: &BezierModel,
        sampling: &Sampling,
        page: &Range<usize>,
        frame: &ModelFrame,
    ) -> Vec<SampleGroup> {
        let mut drafts: Vec<Draft> = Vec::new();
        for surface in sampling.surface(page.start)..=sampling.surface(page.end - 1) {
            let grid = &sampling.grids[surface];
            let samples = page.start.max(grid.first)..page.end.min(grid.first + grid.len());
            for first_sample in samples.step_by(grid.counts()[1]) {
                add_row(&mut drafts, model, surface, grid, first_sample, (first_sample - page.start) as u32);
            }
        }
        let group = |draft: &Draft| SampleGroup {
            degree: draft.degree,
            row_count: draft.rows.len() as u32,
            column_count: draft.column_count as u32,
            controls: self.upload_patches(&model.patches, &draft.patches, frame.origin, frame.scale),
            rows: self.upload("sample rows", &draft.rows),
            columns: self.upload("sample columns", &draft.columns),
        };
        drafts.iter().map(group).collect()
    }
}

/// Adds the row that starts at `first_sample` to a draft whose binding holds its patches.
fn add_row(
    drafts: &mut Vec<Draft>,
    model: &BezierModel,
    surface: usize,
    grid: &SampleGrid,
    first_sample: usize,
    first_in_page: u32,
) {
    let patches = &model.grids[surface];
    let patch_columns = patches.counts()[1];
    let Patch { degree, .. } = model.patches.patch(patches.first);
    let (patch_row, s) = grid.locations[0][grid.row_and_column(first_sample).0];
    let open = drafts.iter().position(|draft| {
        draft.degree == degree
            && draft.column_count == grid.counts()[1]
            && draft.patches.len() + patch_columns <= max_patches(degree)
    });
    let index = open.unwrap_or_else(|| {
        drafts.push(Draft::new(degree, grid.counts()[1]));
        drafts.len() - 1
    });
    let draft = &mut drafts[index];
    let first_patch = match draft.last_patches {
        Some((key, first)) if key == (surface, patch_row) => first,
        _ => {
            let first = draft.patches.len() as u32;
            let start = patches.first + patch_row * patch_columns;
            draft.patches.extend(start as u32..(start + patch_columns) as u32);
            draft.last_patches = Some(((surface, patch_row), first));
            first
        }
    };
    let first_column = match draft.last_columns {
        Some((key, first)) if key == surface => first,
        _ => {
            let first = draft.columns.len() as u32;
            let column =
                |&(column, t): &(usize, f64)| SampleColumn { patch_column: column as u32, t: t as f32 };
            draft.columns.extend(grid.locations[1].iter().map(column));
            draft.last_columns = Some((surface, first));
            first
        }
    };
    draft.rows.push(SampleRow { first_patch, first_column, s: s as f32, first_sample: first_in_page });
}
