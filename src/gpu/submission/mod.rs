//! Dispatches gathered into submissions of bounded duration.

mod throughput;

pub(crate) use throughput::{MAX_SECONDS, Throughput};

use super::Gpu;
use super::kernel::{Kernel, Pipeline};
use crate::error::Result;
use std::sync::Arc;
use web_time::Instant;

/// The most dispatches in one submission.
const MAX_DISPATCHES: usize = 256;

/// Bytes between the params of two dispatches: `minUniformBufferOffsetAlignment`
/// of WebGPU by default.
const PARAMS_STRIDE: usize = 256;

/// The most workgroups along one dimension: `maxComputeWorkgroupsPerDimension`
/// of WebGPU by default.
const MAX_WORKGROUPS: u32 = 65_535;

/// One kernel on its buffers.
pub(crate) struct Dispatch<'a> {
    pub(crate) kernel: Kernel,
    pub(crate) pipeline: &'a Pipeline,
    pub(crate) bind_group: &'a wgpu::BindGroup,
    pub(crate) params: &'a [u8],
    pub(crate) extent: Extent<'a>,
    /// Units of work, to which the kernel's time is proportional; 0 excludes
    /// the dispatch from the measurement of throughput.
    pub(crate) units: usize,
}

/// The number of workgroups of a dispatch.
pub(crate) enum Extent<'a> {
    Workgroups(u32),
    /// The first three numbers of a buffer, read when the dispatch is executed.
    Indirect(&'a wgpu::Buffer),
}

/// A submission being recorded.
pub(crate) struct Submission<'a> {
    gpu: &'a Gpu,
    params_buffer: &'a wgpu::Buffer,
    encoder: wgpu::CommandEncoder,
    params: Vec<u8>,
    expected_seconds: f64,
    kernels: Vec<Kernel>,
}

impl Gpu {
    /// A buffer for the params of all dispatches of a submission.
    pub(crate) fn params_buffer(&self) -> wgpu::Buffer {
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        self.buffer("params", (MAX_DISPATCHES * PARAMS_STRIDE) as u64, usage)
    }

    /// The bind group of a pipeline: params, then the storage buffers in order.
    pub(crate) fn bind(
        &self,
        pipeline: &Pipeline,
        params: &wgpu::Buffer,
        storage: &[&wgpu::Buffer],
    ) -> Arc<wgpu::BindGroup> {
        let params = wgpu::BufferBinding { buffer: params, offset: 0, size: Some(pipeline.params_size) };
        let mut entries =
            vec![wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::Buffer(params) }];
        entries.extend(storage.iter().enumerate().map(|(index, buffer)| wgpu::BindGroupEntry {
            binding: index as u32 + 1,
            resource: buffer.as_entire_binding(),
        }));
        Arc::new(self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.layout,
            entries: &entries,
        }))
    }
}

impl<'a> Submission<'a> {
    pub(crate) fn new(gpu: &'a Gpu, params_buffer: &'a wgpu::Buffer) -> Self {
        let encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let kernels = Vec::new();
        Self { gpu, params_buffer, encoder, params: Vec::new(), expected_seconds: 0.0, kernels }
    }

    /// Whether no further dispatch may be recorded, by time or by number.
    fn is_full(&self) -> bool {
        self.expected_seconds >= MAX_SECONDS || self.params.len() >= MAX_DISPATCHES * PARAMS_STRIDE
    }

    /// Records a dispatch. The submission must not be full.
    pub(crate) fn dispatch(&mut self, dispatch: &Dispatch<'_>) {
        let offset = self.params.len();
        self.params.extend_from_slice(dispatch.params);
        self.params.resize(offset + PARAMS_STRIDE, 0);
        self.expected_seconds +=
            dispatch.units as f64 / self.gpu.throughput.units_per_second(dispatch.kernel);
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

    /// Submits and starts an empty submission if this one is full. Returns
    /// whether it was.
    pub(crate) async fn submit_if_full(&mut self) -> Result<bool> {
        let full = self.is_full();
        if full {
            std::mem::replace(self, Submission::new(self.gpu, self.params_buffer)).submit().await?;
        }
        Ok(full)
    }

    /// Submits, waits, and returns the first `bytes` bytes of the buffer
    /// `from`, which are copied through `readable`.
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

    /// Submits, waits, and updates the throughput of the kernels that ran.
    pub(crate) async fn submit(self) -> Result<()> {
        let started = Instant::now();
        self.gpu.queue.write_buffer(self.params_buffer, 0, &self.params);
        self.gpu.queue.submit([self.encoder.finish()]);
        self.gpu.finish().await?;
        let measured = started.elapsed().as_secs_f64();
        for &kernel in &self.kernels {
            self.gpu.throughput.correct(kernel, self.expected_seconds, measured);
        }
        Ok(())
    }
}
