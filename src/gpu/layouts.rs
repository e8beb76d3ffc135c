//! The structs shared with the kernels, field by field as in `shaders`.

use bytemuck::{Pod, Zeroable};

/// `SampleParams` of `sample.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct SampleParams {
    pub(super) rotation_x: [f32; 4],
    pub(super) rotation_y: [f32; 4],
    pub(super) rotation_z: [f32; 4],
    pub(super) translation: [f32; 4],
    pub(super) first_row: u32,
    pub(super) row_count: u32,
    pub(super) columns: u32,
    pub(super) padding: u32,
}

/// `Row` of `sample.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Row {
    pub(super) first_patch: u32,
    pub(super) first_place: u32,
    pub(super) s: f32,
    pub(super) first_sample: u32,
}

/// `Place` of `sample.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Place {
    pub(super) patch_column: u32,
    pub(super) t: f32,
}

/// `ProjectParams` of `project.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct ProjectParams {
    pub(super) first_thread: u32,
    pub(super) sample_count: u32,
    pub(super) first_patch: u32,
    pub(super) patch_count: u32,
    pub(super) patches_before: u32,
    pub(super) iterations: u32,
    pub(super) step_tolerance: f32,
    pub(super) columns: u32,
}

/// `Node` of `project_tree.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub(super) struct Node {
    pub(super) box_min: [f32; 3],
    pub(super) place: u32,
    pub(super) box_max: [f32; 3],
    pub(super) second: u32,
}

/// `Best` of `best.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Best {
    pub(super) distance_squared: f32,
    pub(super) patch_and_status: u32,
    pub(super) s: f32,
    pub(super) t: f32,
}

/// Bits of `Best::patch_and_status` for the patch.
pub(super) const STATUS_SHIFT: u32 = 30;

/// `ReduceParams` of `reduce.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct ReduceParams {
    pub(super) sample_count: u32,
    pub(super) block_size: u32,
}

/// `Block` of `reduce.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Block {
    pub(super) best: Best,
    pub(super) sample: u32,
    pub(super) converged: u32,
    pub(super) iteration_limit: u32,
    pub(super) on_edge: u32,
}

/// `LevelParams` of `cells.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct LevelParams {
    pub(super) prune_threshold: f32,
    pub(super) grid: f32,
    pub(super) slack: f32,
    pub(super) capacity: u32,
    pub(super) first_piece: u32,
    pub(super) piece_count: u32,
}

/// `Cell` of `cells.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Cell {
    pub(super) center: [f32; 2],
    pub(super) half: [f32; 2],
    pub(super) piece: u32,
    pub(super) foot: u32,
    pub(super) foot_at: [f32; 2],
    pub(super) upper: f32,
    pub(super) reach: f32,
    pub(super) level: u32,
    pub(super) verdict: u32,
}

/// `Batch` of `cells.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Batch {
    pub(super) workgroups: [u32; 3],
    pub(super) count: u32,
}

/// `Piece` of `piece.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Piece {
    pub(super) center: [i32; 3],
    pub(super) value_error: f32,
    pub(super) first_error: [f32; 2],
    pub(super) first: [f32; 2],
    pub(super) second_error: [f32; 3],
    pub(super) radius: f32,
    pub(super) second: [f32; 3],
    pub(super) padding: f32,
    pub(super) third: [f32; 4],
    pub(super) low: [f32; 2],
    pub(super) high: [f32; 2],
}

/// `Tally` of `tally.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Tally {
    pub(super) next: u32,
    pub(super) waiting: u32,
    pub(super) left: u32,
    pub(super) dropped: u32,
    pub(super) farthest: u32,
    pub(super) farthest_piece: u32,
    pub(super) farthest_s: u32,
    pub(super) farthest_t: u32,
    pub(super) cells: u32,
    pub(super) levels: u32,
}

/// `UNDECIDED` of `cells.wgsl`.
pub(super) const UNDECIDED: u32 = 4;

/// Bytes of `Jet` of `jet.wgsl` in a buffer.
pub(super) const JET_BYTES: u64 = 96;

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]
mod tests {
    use super::super::box_layouts::{
        Bound, Box, BoxesParams, Children, Farthest, OF_CELLS, OF_DISTANCES, Part, StepParams, Totals,
        WHOLE_MODEL,
    };
    use super::super::{box_kernels::BoxKernel, pipelines::Kernel, stages::FARTHEST};
    use super::*;
    use crate::closest::Projection;
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
