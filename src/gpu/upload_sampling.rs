//! The patches and places of a model's samples, row by row.

use super::Gpu;
use super::groups::{Controls, most_patches};
use super::layouts::{Place, Row};
use super::rounding::OwnFrame;
use super::upload_target::patch_error;
use crate::bezier::{BezierModel, Patch};
use crate::iteration::{SampleGrid, Sampling};
use glam::DVec3;
use std::ops::Range;

/// A sampling on the GPU: the pages' rows, and only the patches they touch.
#[derive(Debug)]
pub(crate) struct GpuSampling {
    /// What the sampled points are relative to before they are moved.
    pub(super) origin: DVec3,
    /// What they are multiplied by.
    pub(super) scale: f64,
    pub(super) pages: Vec<Vec<SampleGroup>>,
    pub(super) samples: usize,
    /// Bound of the error of a sample's coordinates in float32 before it is moved.
    pub(super) coordinate_error: f64,
    /// Largest distance of a sample from the origin.
    pub(super) radius: f64,
}

/// Rows of one degree in one page.
#[derive(Debug)]
pub(super) struct SampleGroup {
    pub(super) degree: [usize; 2],
    pub(super) row_count: u32,
    pub(super) columns: u32,
    pub(super) controls: Controls,
    pub(super) rows: wgpu::Buffer,
    pub(super) places: wgpu::Buffer,
}

/// A group still being filled.
struct Draft {
    degree: [usize; 2],
    columns: usize,
    rows: Vec<Row>,
    places: Vec<Place>,
    patches: Vec<u32>,
    /// Surface and row of patches uploaded last, and where they begin.
    last: Option<((usize, usize), u32)>,
    /// Surface whose places were written last, and where they begin.
    last_places: Option<(usize, u32)>,
}

impl Draft {
    fn new(degree: [usize; 2], columns: usize) -> Self {
        Self {
            degree,
            columns,
            rows: Vec::new(),
            places: Vec::new(),
            patches: Vec::new(),
            last: None,
            last_places: None,
        }
    }
}

impl Gpu {
    /// Uploads all pages.
    pub(crate) fn upload_sampling(&self, model: &BezierModel, sampling: &Sampling) -> GpuSampling {
        let OwnFrame { origin, scale, radius } = OwnFrame::of(model.patches.bounding_box());
        let pages = sampling
            .pages()
            .iter()
            .map(|page| self.upload_page(model, sampling, page, origin, scale))
            .collect();
        GpuSampling {
            origin,
            scale,
            pages,
            samples: sampling.grids.first().map_or(0, |grid| grid.counts()[1]),
            coordinate_error: model.patches.iter().map(|patch| patch_error(&patch)).fold(0.0, f64::max),
            radius,
        }
    }

    fn upload_page(
        &self,
        model: &BezierModel,
        sampling: &Sampling,
        page: &Range<usize>,
        origin: DVec3,
        scale: f64,
    ) -> Vec<SampleGroup> {
        let mut drafts: Vec<Draft> = Vec::new();
        for surface in sampling.surface(page.start)..=sampling.surface(page.end - 1) {
            let grid = &sampling.grids[surface];
            let columns = grid.counts()[1];
            let rows = page.start.max(grid.first)..page.end.min(grid.first + grid.len());
            for first_sample in rows.step_by(columns) {
                add_row(&mut drafts, model, surface, grid, first_sample, (first_sample - page.start) as u32);
            }
        }
        let group = |draft: &Draft| SampleGroup {
            degree: draft.degree,
            row_count: draft.rows.len() as u32,
            columns: draft.columns as u32,
            controls: self.upload_patches(&model.patches, &draft.patches, origin, scale),
            rows: self.upload("rows", &draft.rows),
            places: self.upload("places", &draft.places),
        };
        drafts.iter().map(group).collect()
    }
}

/// Adds the row of samples at `first_sample` to a draft with room for its patches.
fn add_row(
    drafts: &mut Vec<Draft>,
    model: &BezierModel,
    surface: usize,
    grid: &SampleGrid,
    first_sample: usize,
    in_page: u32,
) {
    let patches = &model.grids[surface];
    let in_v = patches.counts()[1];
    let Patch { degree, .. } = model.patches.patch(patches.first);
    let (patch_row, s) = grid.locations[0][grid.row_and_column(first_sample).0];
    let open = drafts
        .iter()
        .position(|draft| draft.degree == degree && draft.patches.len() + in_v <= most_patches(degree));
    let place = open.unwrap_or_else(|| {
        drafts.push(Draft::new(degree, grid.counts()[1]));
        drafts.len() - 1
    });
    let draft = &mut drafts[place];
    let first_patch = match draft.last {
        Some((key, first)) if key == (surface, patch_row) => first,
        _ => {
            let first = draft.patches.len() as u32;
            let start = patches.first + patch_row * in_v;
            draft.patches.extend(start as u32..(start + in_v) as u32);
            draft.last = Some(((surface, patch_row), first));
            first
        }
    };
    let first_place = match draft.last_places {
        Some((key, first)) if key == surface => first,
        _ => {
            let first = draft.places.len() as u32;
            let place = |&(column, t): &(usize, f64)| Place { patch_column: column as u32, t: t as f32 };
            draft.places.extend(grid.locations[1].iter().map(place));
            draft.last_places = Some((surface, first));
            first
        }
    };
    draft.rows.push(Row { first_patch, first_place, s: s as f32, first_sample: in_page });
}
