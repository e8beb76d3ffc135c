//! Dispatches gathered into submissions of bounded duration.

use crate::error::Result;
use crate::gpu::Gpu;
use crate::gpu::kernel::{Kernel, Pipeline};
use std::cell::RefCell;
use std::rc::Rc;
use web_time::Instant;

/// Seconds that a submission may be expected to take: browsers kill work of
/// seconds, and this is also the grain of progress and cancelling.
const MAX_SECONDS: f64 = 0.2;

/// Units a second assumed of a kernel never run: slow enough that the first
/// dispatch stays short on a software adapter.
const FIRST_RATE: f64 = 2e4;

/// A rate changes by at most this factor at a time, in case a measurement is odd.
const MAX_RATE_CHANGE: f64 = 8.0;

/// Params in one submission, at most.
const MAX_DISPATCHES: usize = 256;

/// Bytes between params: the offset alignment that every device accepts.
const PARAMS_STRIDE: usize = 256;

/// Workgroups along one dimension, at most: the default limit of WebGPU.
const MAX_WORKGROUPS: u32 = 65_535;

/// How fast each kernel was seen to run, in units of work a second.
#[derive(Debug, Default)]
pub(crate) struct Pace(RefCell<Vec<(Kernel, f64)>>);

impl Pace {
    fn rate(&self, kernel: Kernel) -> f64 {
        self.0.borrow().iter().find(|(of, _)| *of == kernel).map_or(FIRST_RATE, |&(_, rate)| rate)
    }

    /// Units of work of this kernel that fill a submission; at least 1.
    pub(crate) fn chunk(&self, kernel: Kernel) -> usize {
        (self.rate(kernel) * MAX_SECONDS).max(1.0) as usize
    }
}

/// One kernel on its buffers.
pub(crate) struct Dispatch<'a> {
    pub(crate) kernel: Kernel,
    pub(crate) pipeline: &'a Pipeline,
    pub(crate) bind_group: &'a wgpu::BindGroup,
    pub(crate) params: &'a [u8],
    pub(crate) extent: Extent<'a>,
    /// Units of work: what the kernel's time is proportional to. 0 where the
    /// time says nothing of the kernel.
    pub(crate) units: usize,
}

/// How many workgroups a dispatch has.
pub(crate) enum Extent<'a> {
    Workgroups(u32),
    /// As the first numbers of a buffer say when it comes to it.
    Indirect(&'a wgpu::Buffer),
}

/// A submission being recorded.
pub(crate) struct Work<'a> {
    gpu: &'a Gpu,
    params: &'a wgpu::Buffer,
    encoder: wgpu::CommandEncoder,
    bytes: Vec<u8>,
    expected: f64,
    kernels: Vec<Kernel>,
}

impl Gpu {
    /// A buffer for the params of a submission.
    pub(crate) fn params(&self) -> wgpu::Buffer {
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        self.buffer("params", (MAX_DISPATCHES * PARAMS_STRIDE) as u64, usage)
    }

    /// The bind group of a pipeline: params, then the storage buffers in order.
    pub(crate) fn bind(
        &self,
        pipeline: &Pipeline,
        params: &wgpu::Buffer,
        storage: &[&wgpu::Buffer],
    ) -> Rc<wgpu::BindGroup> {
        let params = wgpu::BufferBinding { buffer: params, offset: 0, size: Some(pipeline.params_size) };
        let mut entries =
            vec![wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::Buffer(params) }];
        for (index, buffer) in storage.iter().enumerate() {
            entries.push(wgpu::BindGroupEntry {
                binding: index as u32 + 1,
                resource: buffer.as_entire_binding(),
            });
        }
        Rc::new(self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.layout,
            entries: &entries,
        }))
    }
}

impl<'a> Work<'a> {
    pub(crate) fn new(gpu: &'a Gpu, params: &'a wgpu::Buffer) -> Self {
        let encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        Self { gpu, params, encoder, bytes: Vec::new(), expected: 0.0, kernels: Vec::new() }
    }

    /// Whether the submission is long enough, in time or in dispatches.
    fn is_full(&self) -> bool {
        self.expected >= MAX_SECONDS || self.bytes.len() >= MAX_DISPATCHES * PARAMS_STRIDE
    }

    /// Records a dispatch; the submission must not be full.
    pub(crate) fn dispatch(&mut self, dispatch: &Dispatch<'_>) {
        let offset = self.bytes.len();
        self.bytes.extend_from_slice(dispatch.params);
        self.bytes.resize(offset + PARAMS_STRIDE, 0);
        self.expected += dispatch.units as f64 / self.gpu.pace.rate(dispatch.kernel);
        if dispatch.units > 0 && !self.kernels.contains(&dispatch.kernel) {
            self.kernels.push(dispatch.kernel);
        }
        let mut pass = self.encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&dispatch.pipeline.pipeline);
        pass.set_bind_group(0, dispatch.bind_group, &[offset as u32]);
        match dispatch.extent {
            Extent::Workgroups(count) => {
                let rows = count.div_ceil(MAX_WORKGROUPS).max(1);
                pass.dispatch_workgroups(count.div_ceil(rows).max(1), rows, 1);
            }
            Extent::Indirect(buffer) => pass.dispatch_workgroups_indirect(buffer, 0),
        }
    }

    /// Submits and begins anew if it is full; whether it was.
    pub(crate) async fn make_room(&mut self) -> Result<bool> {
        let full = self.is_full();
        if full {
            std::mem::replace(self, Work::new(self.gpu, self.params)).submit().await?;
        }
        Ok(full)
    }

    /// Submits, waits, and reads the first `bytes` of a buffer by way of another.
    pub(crate) async fn read(
        mut self,
        from: &wgpu::Buffer,
        readable: &wgpu::Buffer,
        bytes: u64,
    ) -> Result<Vec<u8>> {
        let gpu = self.gpu;
        self.encoder.copy_buffer_to_buffer(from, 0, readable, 0, bytes);
        self.submit().await?;
        gpu.read(readable, bytes).await
    }

    /// Submits, waits, and learns how fast the kernels are.
    pub(crate) async fn submit(self) -> Result<()> {
        let Self { gpu, params, encoder, bytes, expected, kernels } = self;
        let started = Instant::now();
        gpu.queue.write_buffer(params, 0, &bytes);
        gpu.queue.submit([encoder.finish()]);
        gpu.finish().await?;
        let factor =
            (expected / started.elapsed().as_secs_f64()).clamp(1.0 / MAX_RATE_CHANGE, MAX_RATE_CHANGE);
        let mut rates = gpu.pace.0.borrow_mut();
        for kernel in kernels {
            match rates.iter_mut().find(|(of, _)| *of == kernel) {
                Some((_, rate)) => *rate *= factor,
                None => rates.push((kernel, FIRST_RATE * factor)),
            }
        }
        Ok(())
    }
}
