//! The GPU: one device, its queue, and whether it is still there.

use crate::error::{Error, Result};
use crate::gpu::kernel::Pipelines;
use crate::gpu::slot::slot;
use crate::gpu::submission::Pace;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// A device with default WebGPU limits, its queue and its pipelines.
#[derive(Debug)]
pub struct Gpu {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    pub(crate) pipelines: Pipelines,
    pub(crate) pace: Pace,
    /// Tells this device from those before it.
    pub(crate) id: u64,
    adapter: Option<String>,
    software: bool,
    trouble: Arc<Mutex<Trouble>>,
}

/// What the device's callbacks reported.
#[derive(Debug, Default)]
struct Trouble {
    lost: Option<String>,
    error: Option<String>,
}

impl Gpu {
    /// The platform's preferred adapter, whatever it is, on the limits that
    /// WebGPU guarantees everywhere.
    ///
    /// # Errors
    /// [`Error::NoAdapter`] if there is none or it gives no device.
    pub async fn new() -> Result<Self> {
        static NEXT_ID: AtomicU64 = AtomicU64::new(1);
        let no_adapter = |found: String| Error::NoAdapter { found };
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let adapter = instance
            .request_adapter(&wgpu::RequestAdapterOptions {
                power_preference: wgpu::PowerPreference::HighPerformance,
                ..Default::default()
            })
            .await
            .map_err(|error| no_adapter(why_none(&error)))?;
        let (device, queue) = adapter
            .request_device(&wgpu::DeviceDescriptor {
                required_limits: wgpu::Limits::default(),
                ..Default::default()
            })
            .await
            .map_err(|error| no_adapter(error.to_string()))?;
        let trouble = Arc::new(Mutex::new(Trouble::default()));
        let on_loss = Arc::clone(&trouble);
        device.set_device_lost_callback(move |reason, message| {
            let mut trouble = on_loss.lock().unwrap_or_else(PoisonError::into_inner);
            trouble.lost = Some(format!("{reason:?}: {message}"));
        });
        let on_error = Arc::clone(&trouble);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            let mut trouble = on_error.lock().unwrap_or_else(PoisonError::into_inner);
            trouble.error.get_or_insert(error.to_string());
        }));
        let info = adapter.get_info();
        let name = info.name;
        Ok(Self {
            pipelines: Pipelines::new(&device),
            pace: Pace::default(),
            device,
            queue,
            id: NEXT_ID.fetch_add(1, Ordering::Relaxed),
            adapter: (!name.is_empty()).then_some(name),
            software: info.device_type == wgpu::DeviceType::Cpu,
            trouble,
        })
    }

    /// The adapter's name, which browsers keep to themselves.
    #[must_use]
    pub fn adapter(&self) -> Option<String> {
        self.adapter.clone()
    }

    /// Whether its kernels run on the processor, as far as the platform tells.
    pub(crate) fn is_software(&self) -> bool {
        self.software
    }

    /// Takes the device away, as a driver's reset does.
    #[cfg(all(test, not(target_arch = "wasm32")))]
    pub(crate) fn destroy(&self) {
        self.device.destroy();
        let mut trouble = self.trouble.lock().unwrap_or_else(PoisonError::into_inner);
        trouble.lost.get_or_insert_with(|| "destroyed".to_owned());
    }

    /// The same device as if it were no processor, whose help `auto` declines.
    #[cfg(all(test, not(target_arch = "wasm32")))]
    pub(crate) fn taken_for_hardware(self) -> Self {
        Self { software: false, ..self }
    }

    /// Asks the device for what it must refuse, of which its callback hears.
    #[cfg(all(test, not(target_arch = "wasm32")))]
    pub(crate) fn offend(&self) {
        let size = 2 * self.device.limits().max_buffer_size;
        let usage = wgpu::BufferUsages::STORAGE;
        drop(self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("offence"),
            size,
            usage,
            mapped_at_creation: false,
        }));
    }

    /// What the next check fails with, unless it has something before.
    pub(crate) fn fail(&self, found: String) {
        let mut trouble = self.trouble.lock().unwrap_or_else(PoisonError::into_inner);
        trouble.error.get_or_insert(found);
    }

    /// # Errors
    /// [`Error::DeviceLost`] or [`Error::GpuFailed`] if a callback said so or
    /// a buffer was wanted larger than the limits.
    pub(crate) fn check(&self) -> Result<()> {
        let mut trouble = self.trouble.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = trouble.lost.clone() {
            return Err(Error::DeviceLost { found });
        }
        // Told once: it ends the work that met it, not all that comes after.
        match trouble.error.take() {
            Some(found) => Err(Error::GpuFailed { found }),
            None => Ok(()),
        }
    }

    /// Waits until everything submitted is done.
    pub(crate) async fn finish(&self) -> Result<()> {
        let (sender, receiver) = slot();
        self.queue.on_submitted_work_done(move || sender.send(()));
        self.wait()?;
        receiver.await;
        self.check()
    }

    /// Natively, lets the callbacks of all submitted work run; browsers do so
    /// by themselves.
    fn wait(&self) -> Result<()> {
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map(|_| ())
            .map_err(|error| Error::GpuFailed { found: error.to_string() })
            .or_else(|error| self.check().and(Err(error)))
    }

    /// The bytes of a mappable buffer, once all submitted work is done.
    pub(crate) async fn read(&self, buffer: &wgpu::Buffer, bytes: u64) -> Result<Vec<u8>> {
        self.check()?;
        let (sender, receiver) = slot();
        buffer.map_async(wgpu::MapMode::Read, ..bytes, move |result| sender.send(result));
        self.wait()?;
        let mapped = receiver.await;
        self.check()?;
        mapped.map_err(|error| Error::GpuFailed { found: error.to_string() })?;
        let range = buffer
            .get_mapped_range(..bytes)
            .map_err(|error| Error::GpuFailed { found: error.to_string() })?;
        let content = range.to_vec();
        drop(range);
        buffer.unmap();
        Ok(content)
    }
}

/// What was tried without finding an adapter.
#[cfg(not(target_arch = "wasm32"))]
fn why_none(error: &wgpu::RequestAdapterError) -> String {
    error.to_string()
}

/// Browsers tell no more, and of the other platforms that the error's own text
/// goes through there is none.
#[cfg(target_arch = "wasm32")]
fn why_none(error: &wgpu::RequestAdapterError) -> String {
    match error {
        wgpu::RequestAdapterError::NotFound { no_adapter_backends, .. } if no_adapter_backends.is_empty() => {
            "the browser has no WebGPU"
        }
        _ => "the browser found none",
    }
    .to_owned()
}
