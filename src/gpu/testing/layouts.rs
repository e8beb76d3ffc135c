//! The kernels are valid WGSL without optional features, and their structs have
//! the layout of the host's.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

use crate::closest::{Projection, Status};
use crate::gpu::certified::kernels as certified;
use crate::gpu::certified::layouts::{
    Batch, CellState, FLOAT64_ONLY, JET_BYTES, LevelParams, Subpatch, Tally,
};
use crate::gpu::float32::UNKNOWN_DISTANCE;
use crate::gpu::hierarchy::kernels as hierarchy;
use crate::gpu::hierarchy::layouts::{
    Bound, Box, BoxesParams, Children, Farthest, Part, StageParams, Totals, WHOLE_MODEL,
};
use crate::gpu::iteration::kernels as iteration;
use crate::gpu::iteration::layouts::{
    Block, ProjectParams, Projected, ReduceParams, SampleColumn, SampleParams, SampleRow,
};
use crate::gpu::kernel::{Access, Kernel, WORKGROUP_SIZE};
use crate::gpu::points::kernels as points;
use crate::gpu::points::layouts::{LocateParams, Located};
use crate::gpu::target::Node;
use crate::iteration::Culling;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{AddressSpace, Expression, Literal, Module, StorageAccess, TypeInner};
use std::mem::offset_of;
use std::path::{Path, PathBuf};

const DEGREES: [[usize; 2]; 4] = [[1, 1], [3, 3], [2, 5], [15, 15]];

/// All kernels, those that evaluate patches for every pair of [`DEGREES`].
fn kernels() -> Vec<Kernel> {
    let mut kernels = vec![
        iteration::reduce(),
        hierarchy::pyramid(),
        hierarchy::bound(),
        hierarchy::extremes(),
        hierarchy::cull(),
        hierarchy::farthest(),
        certified::split(),
        certified::next_level(),
    ];
    for degree in DEGREES {
        kernels.push(iteration::sample(degree));
        for projection in [Projection::Newton, Projection::TangentPlane] {
            for culling in [Culling::Tree, Culling::None] {
                kernels.push(iteration::project(degree, projection, culling));
            }
        }
        kernels.extend([points::locate(degree), points::bound_others(degree)]);
        kernels.push(hierarchy::boxes(degree));
        kernels.push(certified::cell_jet(degree));
        kernels.push(certified::taylor_bound(degree));
    }
    kernels
}

fn parsed(kernel: Kernel) -> Module {
    naga::front::wgsl::parse_str(&kernel.text())
        .unwrap_or_else(|error| panic!("{kernel:?}: {}", error.emit_to_string(&kernel.text())))
}

/// Names and offsets of the members, and size of a struct; `None` if the module has none of this name.
fn layout(module: &Module, name: &str) -> Option<(Vec<(String, u32)>, u32)> {
    module.types.iter().find_map(|(_, candidate)| match &candidate.inner {
        TypeInner::Struct { members, span } if candidate.name.as_deref() == Some(name) => {
            let offsets = members.iter().map(|member| (member.name.clone().unwrap(), member.offset));
            Some((offsets.collect(), *span))
        }
        _ => None,
    })
}

fn constant(module: &Module, name: &str) -> Option<Literal> {
    let (_, constant) =
        module.constants.iter().find(|(_, constant)| constant.name.as_deref() == Some(name))?;
    match module.global_expressions[constant.init] {
        Expression::Literal(literal) => Some(literal),
        ref other => panic!("{name} is {other:?}"),
    }
}

/// The number of modules that declare the struct, after checking it in each.
macro_rules! check_layout {
    ($modules:expr, $name:ident, $($member:ident),+) => {{
        let host = vec![$((stringify!($member).to_owned(), offset_of!($name, $member) as u32)),+];
        let found: Vec<_> = $modules.iter().filter_map(|module| layout(module, stringify!($name))).collect();
        assert!(!found.is_empty(), "no kernel has {}", stringify!($name));
        for layout in found {
            assert_eq!(layout, (host.clone(), size_of::<$name>() as u32), stringify!($name));
        }
    }};
}

#[test]
fn kernels_are_valid_for_every_kind_of_degrees() {
    for kernel in kernels() {
        // Without capabilities: nothing that WebGPU does not guarantee.
        Validator::new(ValidationFlags::all(), Capabilities::empty())
            .validate(&parsed(kernel))
            .unwrap_or_else(|error| panic!("{kernel:?}: {error:?}"));
    }
}

#[test]
fn bindings_are_those_that_the_host_binds() {
    for kernel in kernels() {
        let module = parsed(kernel);
        let mut bound = 0;
        for (_, variable) in module.global_variables.iter() {
            let Some(binding) = &variable.binding else { continue };
            bound += 1;
            match (binding.binding as usize, variable.space) {
                (0, AddressSpace::Uniform) => {
                    let TypeInner::Struct { span, .. } = module.types[variable.ty].inner else { panic!() };
                    assert_eq!(span as usize, kernel.params_bytes, "{kernel:?}");
                }
                (index, AddressSpace::Storage { access }) => {
                    let writes = access.contains(StorageAccess::STORE);
                    assert_eq!(kernel.storage[index - 1] == Access::ReadWrite, writes, "{kernel:?}, {index}");
                }
                other => panic!("{kernel:?}: {other:?}"),
            }
        }
        // The tree's nodes are bound to `project_all` too, which does not declare them.
        let undeclared = usize::from(kernel.entry_point == "project_all");
        assert_eq!(bound + undeclared, 1 + kernel.storage.len(), "{kernel:?}");
    }
}

#[test]
fn structs_have_the_layout_of_the_host() {
    let modules: Vec<Module> = kernels().into_iter().map(parsed).collect();
    check_layout!(
        modules,
        SampleParams,
        rotation_x,
        rotation_y,
        rotation_z,
        translation,
        row_count,
        column_count,
        padding
    );
    check_layout!(modules, SampleRow, first_patch, first_column, s, first_sample);
    check_layout!(modules, SampleColumn, patch_column, t);
    check_layout!(
        modules,
        ProjectParams,
        first_thread,
        sample_count,
        first_patch,
        patch_count,
        patches_before,
        iterations,
        step_tolerance,
        column_count
    );
    check_layout!(modules, LocateParams, first_point, end_point, patches_before, iterations, permitted);
    check_layout!(modules, Located, foot, owner, point, own, others);
    check_layout!(modules, Node, box_min, code, box_max, right_child);
    check_layout!(modules, Projected, distance_squared, patch_and_status, s, t);
    check_layout!(modules, ReduceParams, sample_count);
    check_layout!(modules, Block, farthest, sample, converged, iteration_limit, on_edge);
    check_layout!(
        modules,
        BoxesParams,
        first,
        end,
        rescale,
        margin,
        rotation_x,
        rotation_y,
        rotation_z,
        translation
    );
    check_layout!(modules, Part, s, t, patch_index, node, growth, padding);
    check_layout!(modules, Box, low, high);
    check_layout!(modules, Children, first, count);
    check_layout!(modules, StageParams, first, end, capacity, phase);
    check_layout!(modules, Bound, near, far);
    check_layout!(modules, Totals, near, far, pairs);
    check_layout!(modules, Farthest, a, far, b);
    check_layout!(
        modules,
        LevelParams,
        prune_threshold,
        center_unit,
        center_error,
        capacity,
        first_subpatch,
        subpatch_count
    );
    check_layout!(modules, Batch, workgroups, count);
    check_layout!(
        modules,
        CellState,
        center,
        half,
        subpatch,
        foot_subpatch,
        foot_parameters,
        upper,
        foot_distance,
        level,
        verdict
    );
    check_layout!(
        modules,
        Subpatch,
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
    check_layout!(
        modules,
        Tally,
        next_cells,
        waiting_cells,
        leftover_cells,
        pruned_upper,
        farthest,
        farthest_subpatch,
        farthest_s,
        farthest_t,
        cells,
        levels
    );
    let jets: Vec<_> = modules.iter().filter_map(|module| layout(module, "Jet")).collect();
    assert!(!jets.is_empty() && jets.iter().all(|(_, size)| u64::from(*size) == JET_BYTES));
}

#[test]
fn generated_constants_arrive_with_their_values() {
    for (kernel, name, expected) in [
        (iteration::reduce(), "WORKGROUP_SIZE", Literal::U32(WORKGROUP_SIZE)),
        (iteration::reduce(), "UNKNOWN_DISTANCE", Literal::F32(UNKNOWN_DISTANCE)),
        (iteration::reduce(), "CONVERGED", Literal::U32(Status::Converged as u32)),
        (iteration::reduce(), "ITERATION_LIMIT", Literal::U32(Status::IterationLimit as u32)),
        (iteration::reduce(), "ON_EDGE", Literal::U32(Status::OnEdge as u32)),
        (hierarchy::boxes([3, 3]), "WHOLE_MODEL", Literal::F32(WHOLE_MODEL)),
        (certified::split(), "FLOAT64_ONLY", Literal::U32(FLOAT64_ONLY)),
        (certified::taylor_bound([2, 5]), "P", Literal::U32(2)),
        (certified::taylor_bound([2, 5]), "Q", Literal::U32(5)),
        (certified::taylor_bound([2, 5]), "UNIT_ROUNDOFF", Literal::F32(f32::EPSILON)),
    ] {
        assert_eq!(constant(&parsed(kernel), name), Some(expected), "{name}");
    }
}

/// All files below a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] }).collect()
}

#[test]
fn every_shader_names_its_twin_on_the_cpu() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for shader in files(&root.join("shaders")) {
        let text = std::fs::read_to_string(&shader).unwrap();
        let head: String = text.lines().take_while(|line| line.starts_with("//")).collect();
        assert!(head.contains("CPU") && head.contains("twin"), "{}", shader.display());
        for name in text.split('`').filter(|name| name.starts_with("src/")) {
            assert!(root.join(name).is_file(), "{}: {name} does not exist", shader.display());
        }
    }
}
