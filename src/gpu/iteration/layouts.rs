//! The structs shared with the kernels, field by field as in `shaders`.

use bytemuck::{Pod, Zeroable};

/// `SampleParams` of `sample.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct SampleParams {
    pub(crate) rotation_x: [f32; 4],
    pub(crate) rotation_y: [f32; 4],
    pub(crate) rotation_z: [f32; 4],
    pub(crate) translation: [f32; 4],
    pub(crate) first_row: u32,
    pub(crate) row_count: u32,
    pub(crate) columns: u32,
    pub(crate) padding: u32,
}

/// `Row` of `sample.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Row {
    pub(crate) first_patch: u32,
    pub(crate) first_place: u32,
    pub(crate) s: f32,
    pub(crate) first_sample: u32,
}

/// `Place` of `sample.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Place {
    pub(crate) patch_column: u32,
    pub(crate) t: f32,
}

/// `ProjectParams` of `project.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct ProjectParams {
    pub(crate) first_thread: u32,
    pub(crate) sample_count: u32,
    pub(crate) first_patch: u32,
    pub(crate) patch_count: u32,
    pub(crate) patches_before: u32,
    pub(crate) iterations: u32,
    pub(crate) step_tolerance: f32,
    pub(crate) columns: u32,
}

/// `Node` of `project_tree.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub(crate) struct Node {
    pub(crate) box_min: [f32; 3],
    pub(crate) place: u32,
    pub(crate) box_max: [f32; 3],
    pub(crate) second: u32,
}

/// `Best` of `best.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Best {
    pub(crate) distance_squared: f32,
    pub(crate) patch_and_status: u32,
    pub(crate) s: f32,
    pub(crate) t: f32,
}

/// Bits of `Best::patch_and_status` for the patch.
pub(crate) const STATUS_SHIFT: u32 = 30;

/// `ReduceParams` of `reduce.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct ReduceParams {
    pub(crate) sample_count: u32,
    pub(crate) block_size: u32,
}

/// `Block` of `reduce.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Block {
    pub(crate) best: Best,
    pub(crate) sample: u32,
    pub(crate) converged: u32,
    pub(crate) iteration_limit: u32,
    pub(crate) on_edge: u32,
}

/// `LevelParams` of `cells.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct LevelParams {
    pub(crate) prune_threshold: f32,
    pub(crate) grid: f32,
    pub(crate) slack: f32,
    pub(crate) capacity: u32,
    pub(crate) first_piece: u32,
    pub(crate) piece_count: u32,
}

/// `Cell` of `cells.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Cell {
    pub(crate) center: [f32; 2],
    pub(crate) half: [f32; 2],
    pub(crate) piece: u32,
    pub(crate) foot: u32,
    pub(crate) foot_at: [f32; 2],
    pub(crate) upper: f32,
    pub(crate) reach: f32,
    pub(crate) level: u32,
    pub(crate) verdict: u32,
}

/// `Batch` of `cells.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Batch {
    pub(crate) workgroups: [u32; 3],
    pub(crate) count: u32,
}

/// `Piece` of `piece.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Piece {
    pub(crate) center: [i32; 3],
    pub(crate) value_error: f32,
    pub(crate) first_error: [f32; 2],
    pub(crate) first: [f32; 2],
    pub(crate) second_error: [f32; 3],
    pub(crate) radius: f32,
    pub(crate) second: [f32; 3],
    pub(crate) padding: f32,
    pub(crate) third: [f32; 4],
    pub(crate) low: [f32; 2],
    pub(crate) high: [f32; 2],
}

/// `Tally` of `tally.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Tally {
    pub(crate) next: u32,
    pub(crate) waiting: u32,
    pub(crate) left: u32,
    pub(crate) dropped: u32,
    pub(crate) farthest: u32,
    pub(crate) farthest_piece: u32,
    pub(crate) farthest_s: u32,
    pub(crate) farthest_t: u32,
    pub(crate) cells: u32,
    pub(crate) levels: u32,
}

/// `UNDECIDED` of `cells.wgsl`.
pub(crate) const UNDECIDED: u32 = 4;

/// Bytes of `Jet` of `jet.wgsl` in a buffer.
pub(crate) const JET_BYTES: u64 = 96;

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::closest::Projection;
    use crate::gpu::hierarchy::layouts::{
        Bound, Box, BoxesParams, Children, Farthest, OF_CELLS, OF_DISTANCES, Part, StepParams, Totals,
        WHOLE_MODEL,
    };
    use crate::gpu::{hierarchy::kernels::BoxKernel, iteration::FARTHEST, kernel::Kernel};
    use crate::iteration::Culling;
    use naga::valid::{Capabilities, Validator};
    use naga::{Expression, Literal, Module, TypeInner};
    use std::mem::offset_of;

    const DEGREES: [[usize; 2]; 4] = [[1, 1], [3, 3], [2, 5], [15, 15]];

    fn kernels() -> Vec<Kernel> {
        let mut kernels = vec![
            Kernel::Reduce,
            Kernel::Split,
            Kernel::Level,
            Kernel::Box(BoxKernel::Pyramid),
            Kernel::Box(BoxKernel::Bound),
            Kernel::Box(BoxKernel::Extremes),
            Kernel::Box(BoxKernel::Cull),
            Kernel::Box(BoxKernel::Farthest),
        ];
        for degree in DEGREES {
            kernels.push(Kernel::Box(BoxKernel::Boxes { degree }));
            kernels.push(Kernel::Sample { degree });
            kernels.push(Kernel::Cell { degree });
            kernels.push(Kernel::Certify { degree });
            for projection in [Projection::Newton, Projection::TangentPlane] {
                for culling in [Culling::Tree, Culling::None] {
                    kernels.push(Kernel::Project { degree, projection, culling });
                }
            }
        }
        kernels
    }

    fn parsed(kernel: Kernel) -> Module {
        naga::front::wgsl::parse_str(&kernel.text()).unwrap()
    }

    /// Offsets of the members and size of a struct, by naga.
    fn layout(module: &Module, name: &str) -> (Vec<(String, u32)>, u32) {
        for (_, candidate) in module.types.iter() {
            if candidate.name.as_deref() == Some(name)
                && let TypeInner::Struct { members, span } = &candidate.inner
            {
                let offsets = members.iter().map(|member| (member.name.clone().unwrap(), member.offset));
                return (offsets.collect(), *span);
            }
        }
        panic!("no struct {name}");
    }

    fn literal(module: &Module, name: &str) -> Literal {
        let (_, constant) =
            module.constants.iter().find(|(_, constant)| constant.name.as_deref() == Some(name)).unwrap();
        match module.global_expressions[constant.init] {
            Expression::Literal(literal) => literal,
            ref other => panic!("{name} is {other:?}"),
        }
    }

    fn constant(module: &Module, name: &str) -> u32 {
        match literal(module, name) {
            Literal::U32(value) => value,
            other => panic!("{name} is {other:?}"),
        }
    }

    macro_rules! same_layout {
        ($module:expr, $name:ident, $($member:ident),+) => {
            let ours = vec![$((stringify!($member).to_owned(), offset_of!($name, $member) as u32)),+];
            assert_eq!(layout($module, stringify!($name)), (ours, size_of::<$name>() as u32));
        };
    }

    #[test]
    fn kernels_are_valid_for_every_kind_of_degrees() {
        for kernel in kernels() {
            // Without capabilities: nothing that WebGPU does not guarantee.
            Validator::new(naga::valid::ValidationFlags::all(), Capabilities::empty())
                .validate(&parsed(kernel))
                .unwrap_or_else(|error| panic!("{kernel:?}: {error:?}"));
        }
    }

    fn same_level(module: &Module) {
        same_layout!(module, LevelParams, prune_threshold, grid, slack, capacity, first_piece, piece_count);
        same_layout!(module, Batch, workgroups, count);
        same_layout!(module, Cell, center, half, piece, foot, foot_at, upper, reach, level, verdict);
    }

    #[test]
    fn structs_lie_as_in_the_kernels() {
        for kernel in kernels() {
            let module = &parsed(kernel);
            match kernel {
                Kernel::Sample { .. } => {
                    same_layout!(
                        module,
                        SampleParams,
                        rotation_x,
                        rotation_y,
                        rotation_z,
                        translation,
                        first_row,
                        row_count,
                        columns,
                        padding
                    );
                    same_layout!(module, Row, first_patch, first_place, s, first_sample);
                    same_layout!(module, Place, patch_column, t);
                    same_layout!(module, Best, distance_squared, patch_and_status, s, t);
                }
                Kernel::Project { culling, .. } => {
                    same_layout!(
                        module,
                        ProjectParams,
                        first_thread,
                        sample_count,
                        first_patch,
                        patch_count,
                        patches_before,
                        iterations,
                        step_tolerance,
                        columns
                    );
                    if culling == Culling::Tree {
                        same_layout!(module, Node, box_min, place, box_max, second);
                    }
                    same_layout!(module, Best, distance_squared, patch_and_status, s, t);
                    assert_eq!(constant(module, "PATCH_MASK"), (1 << STATUS_SHIFT) - 1);
                }
                Kernel::Cell { .. } | Kernel::Certify { .. } => {
                    same_level(module);
                    same_layout!(
                        module,
                        Piece,
                        center,
                        value_error,
                        first_error,
                        first,
                        second_error,
                        radius,
                        second,
                        padding,
                        third,
                        low,
                        high
                    );
                    same_layout!(module, Best, distance_squared, patch_and_status, s, t);
                    assert_eq!(u64::from(layout(module, "Jet").1), JET_BYTES);
                }
                Kernel::Split | Kernel::Level => {
                    same_level(module);
                    assert_eq!(constant(module, "UNDECIDED"), UNDECIDED);
                    same_layout!(
                        module,
                        Tally,
                        next,
                        waiting,
                        left,
                        dropped,
                        farthest,
                        farthest_piece,
                        farthest_s,
                        farthest_t,
                        cells,
                        levels
                    );
                }
                Kernel::Box(BoxKernel::Boxes { .. }) => {
                    same_layout!(
                        module,
                        BoxesParams,
                        first,
                        end,
                        rescale,
                        slack,
                        rotation_x,
                        rotation_y,
                        rotation_z,
                        translation
                    );
                    same_layout!(module, Part, s, t, patch_index, node, growth, padding);
                    assert_eq!(literal(module, "WHOLE_MODEL"), Literal::F32(WHOLE_MODEL));
                    same_layout!(module, Box, low, high);
                }
                Kernel::Box(BoxKernel::Pyramid) => {
                    same_layout!(module, StepParams, first, end, capacity, phase);
                    same_layout!(module, Children, first, count);
                    same_layout!(module, Box, low, high);
                }
                Kernel::Box(BoxKernel::Bound) => {
                    same_layout!(module, Bound, near, far);
                    assert_eq!(literal(module, "FARTHEST"), Literal::F32(FARTHEST));
                }
                Kernel::Box(BoxKernel::Extremes | BoxKernel::Cull) => {
                    same_layout!(module, Bound, near, far);
                    same_layout!(module, Totals, near, far, pairs);
                }
                Kernel::Box(BoxKernel::Farthest) => {
                    same_layout!(module, Bound, near, far);
                    same_layout!(module, Totals, near, far, pairs);
                    same_layout!(module, Farthest, a, far, b);
                    assert_eq!(constant(module, "OF_CELLS"), OF_CELLS);
                    assert_eq!(constant(module, "OF_DISTANCES"), OF_DISTANCES);
                }
                Kernel::Reduce => {
                    same_layout!(module, ReduceParams, sample_count, block_size);
                    same_layout!(module, Block, best, sample, converged, iteration_limit, on_edge);
                    assert_eq!(constant(module, "STATUS_SHIFT"), STATUS_SHIFT);
                    assert_eq!(literal(module, "FARTHEST"), Literal::F32(FARTHEST));
                }
            }
        }
    }

    #[test]
    fn statuses_are_numbered_as_in_the_kernels() {
        let module = &parsed(Kernel::Reduce);
        for (name, status) in [
            ("CONVERGED", crate::closest::Status::Converged),
            ("ITERATION_LIMIT", crate::closest::Status::IterationLimit),
            ("ON_EDGE", crate::closest::Status::OnEdge),
        ] {
            assert_eq!(constant(module, name), status as u32);
        }
    }
}
