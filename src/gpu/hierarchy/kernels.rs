//! The kernels of method `hierarchy`.

use crate::gpu::hierarchy::layouts::{BoxesParams, StepParams};
use crate::gpu::kernel::{JET, PATCH};
use crate::gpu::patch_wgsl::patch_text;

const BOX: &str = include_str!("../../../shaders/hierarchy/box_distance.wgsl");
const BOXES: &str = include_str!("../../../shaders/hierarchy/boxes.wgsl");
const PYRAMID: &str = include_str!("../../../shaders/hierarchy/pyramid.wgsl");
const BOUND: &str = include_str!("../../../shaders/hierarchy/bound.wgsl");
const EXTREMES: &str = include_str!("../../../shaders/hierarchy/extremes.wgsl");
const CULL: &str = include_str!("../../../shaders/hierarchy/cull.wgsl");
const FARTHEST: &str = include_str!("../../../shaders/hierarchy/farthest.wgsl");

/// A stage and what it is specialised by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum BoxKernel {
    Boxes { degree: [usize; 2] },
    Pyramid,
    Bound,
    Extremes,
    Cull,
    Farthest,
}

impl BoxKernel {
    /// The WGSL text of the kernel.
    pub(crate) fn text(self) -> String {
        match self {
            Self::Boxes { degree } => [&patch_text(degree), JET, PATCH, BOX, BOXES].concat(),
            Self::Pyramid => [BOX, PYRAMID].concat(),
            Self::Bound => [BOX, BOUND].concat(),
            Self::Extremes => [BOX, EXTREMES].concat(),
            Self::Cull => [BOX, CULL].concat(),
            Self::Farthest => [BOX, FARTHEST].concat(),
        }
    }

    pub(crate) fn entry_point(self) -> &'static str {
        match self {
            Self::Boxes { .. } => "boxes",
            Self::Pyramid => "pyramid",
            Self::Bound => "bound",
            Self::Extremes => "extremes",
            Self::Cull => "cull",
            Self::Farthest => "farthest",
        }
    }

    /// Bytes of the params, and which storage buffers are written.
    pub(crate) fn bindings(self) -> (usize, &'static [bool]) {
        let step = size_of::<StepParams>();
        match self {
            Self::Boxes { .. } => (size_of::<BoxesParams>(), &[false, false, false, true]),
            Self::Pyramid => (step, &[false, false, true]),
            Self::Bound => (step, &[false, false, false, false, false, true]),
            Self::Extremes => (step, &[false, true]),
            Self::Cull => (step, &[false, false, false, false, false, false, true, true]),
            Self::Farthest => (step, &[false, true, false, false, false, true]),
        }
    }
}
