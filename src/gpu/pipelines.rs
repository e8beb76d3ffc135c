//! Kernels specialised by degree, made at first use and kept.

#[cfg(not(target_arch = "wasm32"))]
use super::box_kernels::BoxKernel;
use super::layouts::{LevelParams, ProjectParams, ReduceParams, SampleParams};
use super::patch_text::patch_text;
use crate::closest::Projection;
use crate::iteration::Culling;
use std::cell::RefCell;
use std::num::NonZeroU64;
use std::rc::Rc;

/// Threads of a workgroup: a multiple of every vendor's wave, small enough
/// that a kernel with many registers still fits.
pub(super) const WORKGROUP_SIZE: u32 = 64;

pub(super) const JET: &str = include_str!("../../shaders/jet.wgsl");
pub(super) const PATCH: &str = include_str!("../../shaders/patch.wgsl");
const BEST: &str = include_str!("../../shaders/best.wgsl");
const FOOT: &str = include_str!("../../shaders/foot.wgsl");
const NEWTON: &str = include_str!("../../shaders/newton.wgsl");
const TANGENT_PLANE: &str = include_str!("../../shaders/tangent_plane.wgsl");
const SAMPLE: &str = include_str!("../../shaders/sample.wgsl");
const PROJECT: &str = include_str!("../../shaders/project.wgsl");
const PROJECT_TREE: &str = include_str!("../../shaders/project_tree.wgsl");
#[cfg(not(target_arch = "wasm32"))]
const PROJECT_PACKET: &str = include_str!("../../shaders/project_packet.wgsl");
const REDUCE: &str = include_str!("../../shaders/reduce.wgsl");
const CELLS: &str = include_str!("../../shaders/cells.wgsl");
const PIECE: &str = include_str!("../../shaders/piece.wgsl");
const HORNER: &str = include_str!("../../shaders/horner.wgsl");
const TALLY: &str = include_str!("../../shaders/tally.wgsl");
const CELL: &str = include_str!("../../shaders/cell.wgsl");
const CERTIFY: &str = include_str!("../../shaders/certify.wgsl");
const SPLIT: &str = include_str!("../../shaders/split.wgsl");
const LEVEL: &str = include_str!("../../shaders/level.wgsl");

/// A kernel and what it is specialised by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kernel {
    Sample {
        degree: [usize; 2],
    },
    Project {
        degree: [usize; 2],
        projection: Projection,
        culling: Culling,
    },
    Reduce,
    Cell {
        degree: [usize; 2],
    },
    Certify {
        degree: [usize; 2],
    },
    Split,
    Level,
    /// Of method `hierarchy`.
    #[cfg(not(target_arch = "wasm32"))]
    Box(BoxKernel),
}

impl Kernel {
    /// The WGSL text of the kernel, for subgroups of `lanes` threads that load
    /// together, or for threads that load alone if 0.
    pub(super) fn text(self, lanes: u32) -> String {
        match self {
            Self::Sample { degree } => joined(&patch_text(degree, 0), &[JET, PATCH, BEST, SAMPLE]),
            Self::Project { degree, projection, culling } => {
                let step = match projection {
                    Projection::Newton => NEWTON,
                    Projection::TangentPlane => TANGENT_PLANE,
                };
                let search = match culling {
                    Culling::None => "",
                    #[cfg(not(target_arch = "wasm32"))]
                    Culling::Tree if lanes > 0 => PROJECT_PACKET,
                    Culling::Tree => PROJECT_TREE,
                };
                joined(&patch_text(degree, lanes), &[JET, PATCH, BEST, FOOT, step, PROJECT, search])
            }
            Self::Reduce => joined("", &[BEST, REDUCE]),
            Self::Cell { degree } => piecewise(degree, CELL),
            Self::Certify { degree } => piecewise(degree, CERTIFY),
            Self::Split => joined("", &[BEST, CELLS, PIECE, TALLY, SPLIT]),
            Self::Level => joined("", &[CELLS, TALLY, LEVEL]),
            #[cfg(not(target_arch = "wasm32"))]
            Self::Box(kernel) => joined(&kernel.text(), &[]),
        }
    }

    fn entry_point(self) -> &'static str {
        match self {
            Self::Sample { .. } => "sample",
            Self::Project { culling: Culling::None, .. } => "project_all",
            Self::Project { culling: Culling::Tree, .. } => "project_tree",
            Self::Reduce => "reduce",
            Self::Cell { .. } => "cell",
            Self::Certify { .. } => "certify",
            Self::Split => "split",
            Self::Level => "level",
            #[cfg(not(target_arch = "wasm32"))]
            Self::Box(kernel) => kernel.entry_point(),
        }
    }

    /// Bytes of the params, and which storage buffers are written.
    pub(super) fn bindings(self) -> (usize, &'static [bool]) {
        match self {
            Self::Sample { .. } => (size_of::<SampleParams>(), &[false, false, false, false, true, true]),
            Self::Project { .. } => (size_of::<ProjectParams>(), &[false, true, false, false, false]),
            Self::Reduce => (size_of::<ReduceParams>(), &[false, true]),
            Self::Cell { .. } => (LEVEL_BYTES, &[false, false, false, false, true, true, true]),
            Self::Certify { .. } => (LEVEL_BYTES, &[false, true, false, false, false, false, false]),
            Self::Split => (LEVEL_BYTES, &[false, false, true, true, true, false]),
            Self::Level => (LEVEL_BYTES, &[true, true]),
            #[cfg(not(target_arch = "wasm32"))]
            Self::Box(kernel) => kernel.bindings(),
        }
    }
}

const LEVEL_BYTES: usize = size_of::<LevelParams>();

/// The text of a stage that evaluates pieces of these degrees.
fn piecewise([p, q]: [usize; 2], stage: &str) -> String {
    let degrees = format!("const P: u32 = {p}u;\nconst Q: u32 = {q}u;\n");
    joined(&degrees, &[JET, BEST, CELLS, PIECE, HORNER, stage])
}

/// What all kernels begin with, then what was written for one, then parts of files.
fn joined(written: &str, parts: &[&str]) -> String {
    let mut text = format!("const WORKGROUP_SIZE: u32 = {WORKGROUP_SIZE}u;\n");
    text += written;
    parts.iter().for_each(|part| text += part);
    text
}

/// A compiled kernel and the layout its buffers are bound by.
#[derive(Debug)]
pub(super) struct Pipeline {
    pub(super) pipeline: wgpu::ComputePipeline,
    pub(super) layout: wgpu::BindGroupLayout,
    pub(super) params_size: NonZeroU64,
}

/// The pipelines made so far.
#[derive(Debug)]
pub(super) struct Pipelines {
    device: wgpu::Device,
    /// Threads of the subgroups that load together, or 0.
    pub(super) lanes: u32,
    made: RefCell<Vec<(Kernel, Rc<Pipeline>)>>,
}

impl Pipelines {
    pub(super) fn new(device: &wgpu::Device, lanes: u32) -> Self {
        Self { device: device.clone(), lanes, made: RefCell::default() }
    }

    /// The kernel's pipeline, and whether it is new.
    pub(super) fn get(&self, kernel: Kernel) -> (Rc<Pipeline>, bool) {
        if let Some((_, pipeline)) = self.made.borrow().iter().find(|(of, _)| *of == kernel) {
            return (Rc::clone(pipeline), false);
        }
        let pipeline = Rc::new(self.make(kernel, kernel.text(self.lanes)));
        self.made.borrow_mut().push((kernel, Rc::clone(&pipeline)));
        (pipeline, true)
    }

    /// Makes the kernel's pipeline of another text.
    #[cfg(all(feature = "internals", not(target_arch = "wasm32")))]
    pub(super) fn replace(&self, kernel: Kernel, text: String) {
        let pipeline = Rc::new(self.make(kernel, text));
        let mut made = self.made.borrow_mut();
        made.retain(|(of, _)| *of != kernel);
        made.push((kernel, pipeline));
    }

    pub(super) fn make(&self, kernel: Kernel, text: String) -> Pipeline {
        let label = Some(kernel.entry_point());
        let (params_bytes, written) = kernel.bindings();
        // No params struct is empty.
        let params_size = NonZeroU64::new(params_bytes as u64).unwrap_or(NonZeroU64::MIN);
        let buffer = |binding: usize, ty, has_dynamic_offset, min_binding_size| wgpu::BindGroupLayoutEntry {
            binding: binding as u32,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset, min_binding_size },
            count: None,
        };
        let mut entries = vec![buffer(0, wgpu::BufferBindingType::Uniform, true, Some(params_size))];
        for (index, written) in written.iter().enumerate() {
            let ty = wgpu::BufferBindingType::Storage { read_only: !written };
            entries.push(buffer(index + 1, ty, false, None));
        }
        let layout = self
            .device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label, entries: &entries });
        let pipeline_layout = self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label,
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let module = self.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label,
            source: wgpu::ShaderSource::Wgsl(text.into()),
        });
        let pipeline = self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label,
            layout: Some(&pipeline_layout),
            module: &module,
            entry_point: Some(kernel.entry_point()),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        Pipeline { pipeline, layout, params_size }
    }
}
