//! The kernels of method `hierarchy`, one per stage.

use super::layouts::{BOX_DISTANCE_CONSTANTS, BOXES_CONSTANTS, BoxesParams, FARTHEST_CONSTANTS, StageParams};
use crate::gpu::kernel::Access::{self, Read, ReadWrite};
use crate::gpu::kernel::{Evaluation, JET, Kernel, PATCH, Source};

const BOX_DISTANCE: Source = Source {
    constants: BOX_DISTANCE_CONSTANTS,
    text: include_str!("../../../shaders/hierarchy/box_distance.wgsl"),
};
const BOXES: Source =
    Source { constants: BOXES_CONSTANTS, text: include_str!("../../../shaders/hierarchy/boxes.wgsl") };
const PYRAMID: Source = Source::new(include_str!("../../../shaders/hierarchy/pyramid.wgsl"));
const BOUND: Source = Source::new(include_str!("../../../shaders/hierarchy/bound.wgsl"));
const EXTREMES: Source = Source::new(include_str!("../../../shaders/hierarchy/extremes.wgsl"));
const CULL: Source = Source::new(include_str!("../../../shaders/hierarchy/cull.wgsl"));
const FARTHEST: Source =
    Source { constants: FARTHEST_CONSTANTS, text: include_str!("../../../shaders/hierarchy/farthest.wgsl") };

/// Stage `boxes` on patches of these degrees.
pub(crate) fn boxes(degree: [usize; 2]) -> Kernel {
    Kernel {
        name: "boxes",
        entry_point: "boxes",
        evaluation: Evaluation::Bernstein(degree),
        sources: &[JET, PATCH, BOX_DISTANCE, BOXES],
        params_bytes: size_of::<BoxesParams>(),
        storage: &[Read, Read, Read, ReadWrite],
    }
}

/// Stage `pyramid`.
pub(crate) fn pyramid() -> Kernel {
    stage("pyramid", &[BOX_DISTANCE, PYRAMID], &[Read, Read, ReadWrite])
}

/// Stage `bound`.
pub(crate) fn bound() -> Kernel {
    stage("bound", &[BOX_DISTANCE, BOUND], &[Read, Read, Read, Read, Read, ReadWrite])
}

/// Stage `extremes`.
pub(crate) fn extremes() -> Kernel {
    stage("extremes", &[BOX_DISTANCE, EXTREMES], &[Read, ReadWrite])
}

/// Stage `cull`.
pub(crate) fn cull() -> Kernel {
    let storage = &[Read, Read, Read, Read, Read, Read, ReadWrite, ReadWrite];
    stage("cull", &[BOX_DISTANCE, CULL], storage)
}

/// Stage `farthest`.
pub(crate) fn farthest() -> Kernel {
    let storage = &[Read, ReadWrite, Read, Read, Read, ReadWrite];
    stage("farthest", &[BOX_DISTANCE, FARTHEST], storage)
}

fn stage(name: &'static str, sources: &'static [Source], storage: &'static [Access]) -> Kernel {
    Kernel {
        name,
        entry_point: name,
        evaluation: Evaluation::None,
        sources,
        params_bytes: size_of::<StageParams>(),
        storage,
    }
}
