//! The evaluations per second of the two kernels of `evaluation.wgsl`.

use crate::suite::Anyhow;
use nurbs_hausdorff::internals::bezier::extract;
use nurbs_hausdorff::{Axis, Model, NurbsSurface};
use std::time::Instant;
use wgpu::util::{BufferInitDescriptor, DeviceExt};

/// The entry points of the shader, and the evaluations per invocation.
const ENTRY_POINTS: [&str; 2] = ["bezier", "nurbs"];
const EVALUATIONS: usize = 64;

/// The invocations of one dispatch, which takes tens of milliseconds on a slow device.
const INVOCATIONS: usize = 1 << 12;
const WORKGROUP: u32 = 64;

/// The number of dispatches; the fastest counts.
const ROUNDS: usize = 10;

/// The largest difference of the two kernels' sums, relative to the largest sum: they
/// use float32 and different orders of operations.
const AGREEMENT: f32 = 1e-3;

/// A device with pipelines that do not depend on the surface.
pub(super) struct Gpu {
    device: wgpu::Device,
    queue: wgpu::Queue,
    layout: wgpu::BindGroupLayout,
    pipelines: [wgpu::ComputePipeline; 2],
}

impl Gpu {
    /// Opens a device; `None` without an adapter.
    pub(super) fn new() -> Option<Self> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let adapter =
            pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default())).ok()?;
        let (device, queue) =
            pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default())).ok()?;
        let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None },
            count: None,
        };
        let read = wgpu::BufferBindingType::Storage { read_only: true };
        let written = wgpu::BufferBindingType::Storage { read_only: false };
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &[
                entry(0, wgpu::BufferBindingType::Uniform),
                entry(1, read),
                entry(2, read),
                entry(3, read),
                entry(4, written),
            ],
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let module = device.create_shader_module(wgpu::include_wgsl!("evaluation.wgsl"));
        let pipelines = ENTRY_POINTS.map(|entry_point| {
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(entry_point),
                layout: Some(&pipeline_layout),
                module: &module,
                entry_point: Some(entry_point),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            })
        });
        Some(Self { device, queue, layout, pipelines })
    }

    /// Returns the points with tangents evaluated per second, from Bézier patches and
    /// from the NURBS surface, which must be bicubic and polynomial with uniform knots
    /// over [0, 1].
    ///
    /// Fails if the results of the kernels differ.
    pub(super) fn rates(&self, surface: &NurbsSurface, quick: bool) -> Anyhow<[f64; 2]> {
        let sums = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: (INVOCATIONS * size_of::<[f32; 4]>()) as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let group = self.bind(surface, &sums)?;
        let mut rates = [0.0_f64; 2];
        let mut results = Vec::new();
        for (pipeline, rate) in self.pipelines.iter().zip(&mut rates) {
            for _ in 0..if quick { 1 } else { ROUNDS } {
                let started = Instant::now();
                self.dispatch(pipeline, &group)?;
                let evaluations = (INVOCATIONS * EVALUATIONS) as f64;
                *rate = rate.max(evaluations / started.elapsed().as_secs_f64());
            }
            results.push(self.read(&sums)?);
        }
        let largest = results[0].iter().fold(0.0_f32, |largest, value| largest.max(value.abs()));
        let agree = |(a, b): (&f32, &f32)| (a - b).abs() <= AGREEMENT * largest;
        if !results[0].iter().zip(&results[1]).all(agree) {
            return Err("the kernels disagree".into());
        }
        Ok(rates)
    }

    fn bind(&self, surface: &NurbsSurface, sums: &wgpu::Buffer) -> Anyhow<wgpu::BindGroup> {
        let single = |values: &[f64]| values.iter().map(|&value| value as f32).collect::<Vec<f32>>();
        let controls = single(surface.control_points().as_flattened());
        let knots = single(&Axis::BOTH.map(|axis| surface.knots(axis)).concat());
        let bezier = extract(&Model::new(None, vec![surface.clone()])?);
        let patches = bezier.patches.iter().flat_map(|patch| {
            let center = patch.center;
            let global =
                patch.local_points().map(move |point| (point + center).as_vec3().extend(1.0).to_array());
            global.collect::<Vec<_>>()
        });
        let bezier_controls: Vec<[f32; 4]> = patches.collect();
        let [counts, spans] = [surface.counts(), bezier.grids[0].counts()].map(|pair| pair.map(|n| n as u32));
        let size = [counts[0], counts[1], spans[0], spans[1]];
        let buffer = |contents: &[u8], usage| {
            self.device.create_buffer_init(&BufferInitDescriptor { label: None, contents, usage })
        };
        let stored = wgpu::BufferUsages::STORAGE;
        let buffers = [
            buffer(bytemuck::bytes_of(&size), wgpu::BufferUsages::UNIFORM),
            buffer(bytemuck::cast_slice(&controls), stored),
            buffer(bytemuck::cast_slice(&bezier_controls), stored),
            buffer(bytemuck::cast_slice(&knots), stored),
        ];
        let entries: Vec<wgpu::BindGroupEntry<'_>> = buffers
            .iter()
            .chain([sums])
            .zip(0..)
            .map(|(buffer, binding)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let group = wgpu::BindGroupDescriptor { label: None, layout: &self.layout, entries: &entries };
        Ok(self.device.create_bind_group(&group))
    }

    fn dispatch(&self, pipeline: &wgpu::ComputePipeline, group: &wgpu::BindGroup) -> Anyhow<()> {
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, group, &[]);
        pass.dispatch_workgroups(INVOCATIONS as u32 / WORKGROUP, 1, 1);
        drop(pass);
        self.queue.submit([encoder.finish()]);
        self.device.poll(wgpu::PollType::wait_indefinitely())?;
        Ok(())
    }

    fn read(&self, sums: &wgpu::Buffer) -> Anyhow<Vec<f32>> {
        let copy = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: sums.size(),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_buffer_to_buffer(sums, 0, &copy, 0, sums.size());
        self.queue.submit([encoder.finish()]);
        let (sender, receiver) = std::sync::mpsc::channel();
        copy.map_async(wgpu::MapMode::Read, .., move |result| drop(sender.send(result)));
        self.device.poll(wgpu::PollType::wait_indefinitely())?;
        receiver.recv()??;
        let bytes = copy.get_mapped_range(..)?;
        Ok(bytemuck::pod_collect_to_vec(&bytes))
    }
}
