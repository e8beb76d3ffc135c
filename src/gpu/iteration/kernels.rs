//! The kernels of method `iteration`: stages `sample`, `project` and `reduce`.

use super::layouts::{PROJECTED_CONSTANTS, ProjectParams, ReduceParams, SampleParams};
use super::schedule::TILE;
use crate::closest::{MAX_HALVINGS, Projection};
use crate::gpu::kernel::Access::{Read, ReadWrite};
use crate::gpu::kernel::Constant;
use crate::gpu::kernel::{Evaluation, JET, Kernel, PATCH, Source};
use crate::iteration::{BLOCK_SIZE, Culling};

/// The nearest foot found of a sample.
pub(crate) const PROJECTED: Source =
    Source { constants: PROJECTED_CONSTANTS, text: include_str!("../../../shaders/shared/projected.wgsl") };

/// The result of an iteration on one patch.
pub(crate) const FOOT: Source = Source::new(include_str!("../../../shaders/shared/foot.wgsl"));
/// Newton's method on one patch.
pub(crate) const NEWTON: Source = Source {
    constants: &[Constant::u32("MAX_HALVINGS", MAX_HALVINGS)],
    text: include_str!("../../../shaders/shared/newton.wgsl"),
};
const TANGENT_PLANE: Source = Source::new(include_str!("../../../shaders/shared/tangent_plane.wgsl"));
const SAMPLE: Source = Source::new(include_str!("../../../shaders/iteration/sample.wgsl"));
const PROJECT: Source = Source {
    constants: &[Constant::u32("TILE_COLUMNS", TILE[0] as u32), Constant::u32("TILE_ROWS", TILE[1] as u32)],
    text: include_str!("../../../shaders/iteration/project.wgsl"),
};
/// The hierarchy over a group's patches.
pub(crate) const TREE: Source = Source::new(include_str!("../../../shaders/shared/tree.wgsl"));
const PROJECT_TREE: Source = Source::new(include_str!("../../../shaders/iteration/project_tree.wgsl"));
const REDUCE: Source = Source {
    constants: &[Constant::u32("BLOCK_SIZE", BLOCK_SIZE as u32)],
    text: include_str!("../../../shaders/iteration/reduce.wgsl"),
};

/// Stage `sample` on patches of these degrees.
pub(crate) fn sample(degree: [usize; 2]) -> Kernel {
    Kernel {
        name: "sample",
        entry_point: "sample",
        evaluation: Evaluation::Bernstein(degree),
        sources: &[JET, PATCH, PROJECTED, SAMPLE],
        params_bytes: size_of::<SampleParams>(),
        storage: &[Read, Read, Read, Read, ReadWrite, ReadWrite],
    }
}

/// Stage `project` on patches of these degrees.
pub(crate) fn project(degree: [usize; 2], projection: Projection, culling: Culling) -> Kernel {
    let (name, sources): (_, &'static [Source]) = match (projection, culling) {
        (Projection::Newton, Culling::None) => {
            ("project_all, newton", &[JET, PATCH, PROJECTED, FOOT, NEWTON, PROJECT])
        }
        (Projection::Newton, Culling::Tree) => {
            ("project_tree, newton", &[JET, PATCH, PROJECTED, FOOT, NEWTON, PROJECT, TREE, PROJECT_TREE])
        }
        (Projection::TangentPlane, Culling::None) => {
            ("project_all, tangent_plane", &[JET, PATCH, PROJECTED, FOOT, TANGENT_PLANE, PROJECT])
        }
        (Projection::TangentPlane, Culling::Tree) => (
            "project_tree, tangent_plane",
            &[JET, PATCH, PROJECTED, FOOT, TANGENT_PLANE, PROJECT, TREE, PROJECT_TREE],
        ),
    };
    Kernel {
        name,
        entry_point: match culling {
            Culling::None => "project_all",
            Culling::Tree => "project_tree",
        },
        evaluation: Evaluation::Bernstein(degree),
        sources,
        params_bytes: size_of::<ProjectParams>(),
        // The tree's nodes, which `project_all` does not have, are bound to both.
        storage: &[Read, ReadWrite, Read, Read, Read],
    }
}

/// Stage `reduce`.
pub(crate) fn reduce() -> Kernel {
    Kernel {
        name: "reduce",
        entry_point: "reduce",
        evaluation: Evaluation::None,
        sources: &[PROJECTED, REDUCE],
        params_bytes: size_of::<ReduceParams>(),
        storage: &[Read, ReadWrite],
    }
}
