//! Kernels: their WGSL text and bindings, and the pipelines made of them at first use.

mod constants;
mod patch_wgsl;

pub(crate) use constants::Constant;

use crate::threads::locked;
use patch_wgsl::{binomials_wgsl, patch_wgsl};
use std::num::NonZeroU64;
use std::sync::{Arc, Mutex};

/// Threads of a workgroup: a multiple of every vendor's subgroup size, and few
/// enough that kernels with many registers still fit.
pub(crate) const WORKGROUP_SIZE: u32 = 64;

/// A file of `shaders` with the constants that are generated above it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Source {
    pub(crate) constants: &'static [Constant],
    pub(crate) text: &'static str,
}

impl Source {
    /// A file without generated constants.
    pub(crate) const fn new(text: &'static str) -> Self {
        Self { constants: &[], text }
    }
}

/// A point with its derivatives, of any evaluator.
pub(crate) const JET: Source = Source::new(include_str!("../../../shaders/shared/jet.wgsl"));

/// Evaluation of Bézier patches; requires [`Evaluation::Bernstein`].
pub(crate) const PATCH: Source = Source::new(include_str!("../../../shaders/shared/patch.wgsl"));

/// The WGSL that is generated for the degrees of the patches that a kernel evaluates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Evaluation {
    /// None: the kernel evaluates no patch.
    None,
    /// The degrees `P` and `Q`, and the functions of [`patch_wgsl`].
    Bernstein([usize; 2]),
    /// The same, with the binomial coefficients of [`binomials_wgsl`].
    Squares([usize; 2]),
    /// The degrees `P` and `Q` only.
    PowerForm([usize; 2]),
}

/// The access of a kernel to a storage buffer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Access {
    Read,
    ReadWrite,
}

/// A compute kernel. Its binding 0 is a uniform struct of parameters; the
/// storage buffers follow in order.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kernel {
    /// Distinguishes kernels of equal evaluation.
    pub(crate) name: &'static str,
    pub(crate) entry_point: &'static str,
    pub(crate) evaluation: Evaluation,
    pub(crate) sources: &'static [Source],
    pub(crate) params_bytes: usize,
    pub(crate) storage: &'static [Access],
}

impl PartialEq for Kernel {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name && self.evaluation == other.evaluation
    }
}

impl Kernel {
    /// The complete WGSL text.
    pub(crate) fn text(&self) -> String {
        let mut text = Constant::u32("WORKGROUP_SIZE", WORKGROUP_SIZE).to_string();
        match self.evaluation {
            Evaluation::None => {}
            Evaluation::Bernstein(degree) => text += &patch_wgsl(degree),
            Evaluation::Squares(degree) => {
                text += &patch_wgsl(degree);
                text += &binomials_wgsl(degree);
            }
            Evaluation::PowerForm([p, q]) => {
                text += &Constant::u32("P", p as u32).to_string();
                text += &Constant::u32("Q", q as u32).to_string();
            }
        }
        for source in self.sources {
            source.constants.iter().for_each(|constant| text += &constant.to_string());
            text += source.text;
        }
        text
    }
}

/// A compiled kernel and the layout that its buffers are bound by.
#[derive(Debug)]
pub(crate) struct Pipeline {
    pub(crate) pipeline: wgpu::ComputePipeline,
    pub(crate) layout: wgpu::BindGroupLayout,
    pub(crate) params_size: NonZeroU64,
}

/// The pipelines made so far on one device.
#[derive(Debug)]
pub(crate) struct Pipelines {
    device: wgpu::Device,
    made: Mutex<Vec<(Kernel, Arc<Pipeline>)>>,
}

impl Pipelines {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        Self { device: device.clone(), made: Mutex::default() }
    }

    /// Returns the kernel's pipeline, and whether this call made it.
    pub(crate) fn get(&self, kernel: Kernel) -> (Arc<Pipeline>, bool) {
        let known = |made: &[(Kernel, Arc<Pipeline>)]| {
            made.iter().find(|(made, _)| *made == kernel).map(|(_, pipeline)| Arc::clone(pipeline))
        };
        if let Some(pipeline) = known(&locked(&self.made)) {
            return (pipeline, false);
        }
        let pipeline = Arc::new(self.make(kernel, kernel.text()));
        locked(&self.made).push((kernel, Arc::clone(&pipeline)));
        (pipeline, true)
    }

    /// Replaces the kernel's pipeline by one of another text, for benchmarks.
    #[cfg(all(feature = "internals", not(target_arch = "wasm32")))]
    pub(crate) fn replace(&self, kernel: Kernel, text: String) {
        let pipeline = Arc::new(self.make(kernel, text));
        let mut made = locked(&self.made);
        made.retain(|(other, _)| *other != kernel);
        made.push((kernel, pipeline));
    }

    /// Makes a pipeline of `text`, which has the kernel's entry point and bindings.
    pub(crate) fn make(&self, kernel: Kernel, text: String) -> Pipeline {
        let label = Some(kernel.name);
        // No struct of parameters is empty.
        let params_size = NonZeroU64::new(kernel.params_bytes as u64).unwrap_or(NonZeroU64::MIN);
        let buffer = |binding: usize, ty, has_dynamic_offset, min_binding_size| wgpu::BindGroupLayoutEntry {
            binding: binding as u32,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset, min_binding_size },
            count: None,
        };
        let mut entries = vec![buffer(0, wgpu::BufferBindingType::Uniform, true, Some(params_size))];
        entries.extend(kernel.storage.iter().enumerate().map(|(index, &access)| {
            let ty = wgpu::BufferBindingType::Storage { read_only: access == Access::Read };
            buffer(index + 1, ty, false, None)
        }));
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
            entry_point: Some(kernel.entry_point),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        Pipeline { pipeline, layout, params_size }
    }
}
