//! The kernels of method `certified`, one per stage. Its stage `project` is
//! that of method `iteration`.

use super::layouts::{CELLS_CONSTANTS, LevelParams, TAYLOR_CONSTANTS};
use crate::gpu::iteration::kernels::PROJECTED;
use crate::gpu::kernel::Access::{Read, ReadWrite};
use crate::gpu::kernel::{Evaluation, JET, Kernel, Source};

const CELLS: Source =
    Source { constants: CELLS_CONSTANTS, text: include_str!("../../../shaders/certified/cells.wgsl") };
const SUBPATCH: Source = Source::new(include_str!("../../../shaders/certified/subpatch.wgsl"));
const HORNER: Source = Source::new(include_str!("../../../shaders/certified/horner.wgsl"));
const TALLY: Source = Source::new(include_str!("../../../shaders/certified/tally.wgsl"));
const CELL_JET: Source = Source::new(include_str!("../../../shaders/certified/cell_jet.wgsl"));
const TAYLOR: Source =
    Source { constants: TAYLOR_CONSTANTS, text: include_str!("../../../shaders/certified/taylor.wgsl") };
const SPLIT: Source = Source::new(include_str!("../../../shaders/certified/split.wgsl"));
const NEXT_LEVEL: Source = Source::new(include_str!("../../../shaders/certified/next_level.wgsl"));

/// Stage `cell_jet` on subpatches of A of these degrees.
pub(crate) fn cell_jet(degree: [usize; 2]) -> Kernel {
    Kernel {
        name: "cell_jet",
        entry_point: "cell_jet",
        evaluation: Evaluation::PowerForm(degree),
        sources: &[JET, PROJECTED, CELLS, SUBPATCH, HORNER, CELL_JET],
        params_bytes: size_of::<LevelParams>(),
        storage: &[Read, Read, Read, Read, ReadWrite, ReadWrite, ReadWrite],
    }
}

/// Stage `taylor_bound` on subpatches of B of these degrees.
pub(crate) fn taylor_bound(degree: [usize; 2]) -> Kernel {
    Kernel {
        name: "taylor_bound",
        entry_point: "taylor_bound",
        evaluation: Evaluation::PowerForm(degree),
        sources: &[JET, PROJECTED, CELLS, SUBPATCH, HORNER, TAYLOR],
        params_bytes: size_of::<LevelParams>(),
        storage: &[Read, ReadWrite, Read, Read, Read, Read, Read],
    }
}

/// Stage `split`.
pub(crate) fn split() -> Kernel {
    Kernel {
        name: "split",
        entry_point: "split",
        evaluation: Evaluation::None,
        sources: &[PROJECTED, CELLS, SUBPATCH, TALLY, SPLIT],
        params_bytes: size_of::<LevelParams>(),
        storage: &[Read, Read, ReadWrite, ReadWrite, ReadWrite, Read],
    }
}

/// Stage `next_level`.
pub(crate) fn next_level() -> Kernel {
    Kernel {
        name: "next_level",
        entry_point: "next_level",
        evaluation: Evaluation::None,
        sources: &[CELLS, TALLY, NEXT_LEVEL],
        params_bytes: size_of::<LevelParams>(),
        storage: &[ReadWrite, ReadWrite],
    }
}
