//! Kernels specialised by degree, made at first use and kept.

use crate::closest::Projection;
#[cfg(not(target_arch = "wasm32"))]
use crate::gpu::hierarchy::kernels::BoxKernel;
use crate::gpu::iteration::layouts::{LevelParams, ProjectParams, ReduceParams, SampleParams};
use crate::gpu::patch_wgsl::patch_text;
use crate::iteration::Culling;
use std::cell::RefCell;
use std::num::NonZeroU64;
use std::rc::Rc;

/// Threads of a workgroup: a multiple of every vendor's wave, small enough
/// that a kernel with many registers still fits.
pub(crate) const WORKGROUP_SIZE: u32 = 64;

pub(crate) const JET: &str = include_str!("../../shaders/shared/jet.wgsl");
pub(crate) const PATCH: &str = include_str!("../../shaders/shared/patch.wgsl");
const BEST: &str = include_str!("../../shaders/shared/projected.wgsl");
const FOOT: &str = include_str!("../../shaders/shared/foot.wgsl");
const NEWTON: &str = include_str!("../../shaders/shared/newton.wgsl");
const TANGENT_PLANE: &str = include_str!("../../shaders/shared/tangent_plane.wgsl");
const SAMPLE: &str = include_str!("../../shaders/iteration/sample.wgsl");
const PROJECT: &str = include_str!("../../shaders/iteration/project.wgsl");
const PROJECT_TREE: &str = include_str!("../../shaders/iteration/project_tree.wgsl");
const REDUCE: &str = include_str!("../../shaders/iteration/reduce.wgsl");
const CELLS: &str = include_str!("../../shaders/certified/cells.wgsl");
const PIECE: &str = include_str!("../../shaders/certified/subpatch.wgsl");
const HORNER: &str = include_str!("../../shaders/certified/horner.wgsl");
const TALLY: &str = include_str!("../../shaders/certified/tally.wgsl");
const CELL: &str = include_str!("../../shaders/certified/cell_jet.wgsl");
const CERTIFY: &str = include_str!("../../shaders/certified/taylor.wgsl");
const SPLIT: &str = include_str!("../../shaders/certified/split.wgsl");
const LEVEL: &str = include_str!("../../shaders/certified/next_level.wgsl");

/// A kernel and what it is specialised by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kernel {
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
    /// The WGSL text of the kernel.
    pub(crate) fn text(self) -> String {
        match self {
            Self::Sample { degree } => joined(&patch_text(degree), &[JET, PATCH, BEST, SAMPLE]),
            Self::Project { degree, projection, culling } => {
                let step = match projection {
                    Projection::Newton => NEWTON,
                    Projection::TangentPlane => TANGENT_PLANE,
                };
                let search = match culling {
                    Culling::None => "",
                    Culling::Tree => PROJECT_TREE,
                };
                joined(&patch_text(degree), &[JET, PATCH, BEST, FOOT, step, PROJECT, search])
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
    pub(crate) fn bindings(self) -> (usize, &'static [bool]) {
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
pub(crate) struct Pipeline {
    pub(crate) pipeline: wgpu::ComputePipeline,
    pub(crate) layout: wgpu::BindGroupLayout,
    pub(crate) params_size: NonZeroU64,
}

/// The pipelines made so far.
#[derive(Debug)]
pub(crate) struct Pipelines {
    device: wgpu::Device,
    made: RefCell<Vec<(Kernel, Rc<Pipeline>)>>,
}

impl Pipelines {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        Self { device: device.clone(), made: RefCell::default() }
    }

    /// The kernel's pipeline, and whether it is new.
    pub(crate) fn get(&self, kernel: Kernel) -> (Rc<Pipeline>, bool) {
        if let Some((_, pipeline)) = self.made.borrow().iter().find(|(of, _)| *of == kernel) {
            return (Rc::clone(pipeline), false);
        }
        let pipeline = Rc::new(self.make(kernel, kernel.text()));
        self.made.borrow_mut().push((kernel, Rc::clone(&pipeline)));
        (pipeline, true)
    }

    /// Makes the kernel's pipeline of another text.
    #[cfg(not(target_arch = "wasm32"))]
    pub(crate) fn replace(&self, kernel: Kernel, text: String) {
        let pipeline = Rc::new(self.make(kernel, text));
        let mut made = self.made.borrow_mut();
        made.retain(|(of, _)| *of != kernel);
        made.push((kernel, pipeline));
    }

    pub(crate) fn make(&self, kernel: Kernel, text: String) -> Pipeline {
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
