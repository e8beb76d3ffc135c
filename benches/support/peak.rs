//! The float32 peak of the present GPU, as reached by a kernel of multiply-adds only.

use super::clock::Stopwatch;
use wgpu::util::DeviceExt;

/// Multiply-adds per accumulator in the unrolled body of the loop.
const UNROLLED: usize = 32;

/// Iterations of the loop.
const ITERATIONS: usize = 500;

/// Threads: many for every core, and some hundredths of a second on a software adapter.
const THREADS: u32 = 1 << 12;

/// Floating-point operations of a multiply-add.
const OPERATIONS: usize = 2;

/// The arrangement of the multiply-adds.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Variant {
    /// Independent sums per thread, of four components each if `vec4`.
    accumulators: usize,
    vec4: bool,
    workgroup: u32,
}

/// From too few sums to hide latency to more than fit into registers.
pub(crate) const VARIANTS: [Variant; 10] = [
    Variant { accumulators: 4, vec4: false, workgroup: 64 },
    Variant { accumulators: 6, vec4: false, workgroup: 64 },
    Variant { accumulators: 7, vec4: false, workgroup: 64 },
    Variant { accumulators: 8, vec4: false, workgroup: 64 },
    Variant { accumulators: 9, vec4: false, workgroup: 64 },
    Variant { accumulators: 10, vec4: false, workgroup: 64 },
    Variant { accumulators: 11, vec4: false, workgroup: 64 },
    Variant { accumulators: 12, vec4: false, workgroup: 64 },
    Variant { accumulators: 2, vec4: true, workgroup: 64 },
    Variant { accumulators: 2, vec4: true, workgroup: 256 },
];

impl std::fmt::Display for Variant {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { accumulators, vec4, workgroup } = self;
        let kind = if *vec4 { "vec4" } else { "f32" };
        write!(f, "{accumulators} {kind}, {workgroup} threads per workgroup")
    }
}

impl Variant {
    fn operations(self) -> f64 {
        let width = if self.vec4 { 4 } else { 1 };
        let per_thread = self.accumulators * width * OPERATIONS * UNROLLED * ITERATIONS;
        per_thread as f64 * f64::from(THREADS)
    }

    /// WGSL that computes sums tending to `y / (1 - x)`, which do not overflow.
    /// The compiler knows neither x nor y, and all sums contribute to the result.
    fn text(self) -> String {
        let kind = if self.vec4 { "vec4<f32>" } else { "f32" };
        let sums: Vec<String> = (0..self.accumulators).map(|index| format!("a{index}")).collect();
        let start: String = sums
            .iter()
            .enumerate()
            .map(|(index, a)| format!("var {a} = {kind}(start + {index}.0);\n"))
            .collect();
        let body: String =
            sums.iter().map(|a| format!("{a} = {a} * x + y;\n")).collect::<String>().repeat(UNROLLED);
        let sum = sums.join(" + ");
        let result = if self.vec4 { format!("dot({sum}, vec4<f32>(1.0))") } else { sum };
        let workgroup = self.workgroup;
        format!(
            "@group(0) @binding(0) var<storage, read> operands: array<f32>;
@group(0) @binding(1) var<storage, read_write> out: array<f32>;
@compute @workgroup_size({workgroup})
fn peak(@builtin(global_invocation_id) id: vec3<u32>) {{
let x = {kind}(operands[0]);
let y = {kind}(operands[1]);
let start = f32(id.x);
{start}for (var k = 0u; k < {ITERATIONS}u; k++) {{
{body}}}
out[id.x] = {result};
}}"
        )
    }
}

/// A separate device with the kernels of all variants.
pub(crate) struct Peak {
    device: wgpu::Device,
    queue: wgpu::Queue,
    /// Whether the adapter is a software adapter, which runs on the CPU.
    pub(crate) on_cpu: bool,
    made: Vec<(Variant, wgpu::ComputePipeline, wgpu::BindGroup)>,
}

impl Peak {
    pub(crate) fn new() -> Self {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let preferred = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..Default::default()
        };
        let adapter = pollster::block_on(instance.request_adapter(&preferred)).expect("an adapter");
        let (device, queue) =
            pollster::block_on(adapter.request_device(&Default::default())).expect("a device");
        let made = VARIANTS.iter().map(|&variant| make(&device, variant)).collect();
        let on_cpu = adapter.get_info().device_type == wgpu::DeviceType::Cpu;
        Self { device, queue, on_cpu, made }
    }

    /// Floating-point operations per second of every variant, measured in turn.
    pub(crate) fn measure(&self) -> Vec<(Variant, f64)> {
        let run = |(variant, pipeline, bind_group): &(Variant, wgpu::ComputePipeline, wgpu::BindGroup)| {
            (*variant, variant.operations() / self.run(pipeline, bind_group, variant.workgroup))
        };
        self.made.iter().map(run).collect()
    }

    fn run(&self, pipeline: &wgpu::ComputePipeline, bind_group: &wgpu::BindGroup, workgroup: u32) -> f64 {
        let mut encoder = self.device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, bind_group, &[]);
            pass.dispatch_workgroups(THREADS / workgroup, 1, 1);
        }
        let commands = encoder.finish();
        let started = Stopwatch::start(self.on_cpu);
        self.queue.submit([commands]);
        self.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device");
        started.seconds()
    }
}

fn make(device: &wgpu::Device, variant: Variant) -> (Variant, wgpu::ComputePipeline, wgpu::BindGroup) {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(variant.text().into()),
    });
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: None,
        compilation_options: Default::default(),
        cache: None,
    });
    let operands = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: bytemuck::cast_slice(&[0.999_f32, 0.001]),
        usage: wgpu::BufferUsages::STORAGE,
    });
    let out = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(THREADS) * size_of::<f32>() as u64,
        usage: wgpu::BufferUsages::STORAGE,
        mapped_at_creation: false,
    });
    let entries = [
        wgpu::BindGroupEntry { binding: 0, resource: operands.as_entire_binding() },
        wgpu::BindGroupEntry { binding: 1, resource: out.as_entire_binding() },
    ];
    let layout = pipeline.get_bind_group_layout(0);
    let bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &layout,
        entries: &entries,
    });
    (variant, pipeline, bind_group)
}
