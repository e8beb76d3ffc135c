//! The GPU: one device, its queue and the errors that it reports.

use super::kernel::Pipelines;
use super::submission::Throughput;
use crate::error::{Error, Result};
use futures_channel::oneshot;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// A device with the default limits of WebGPU, its queue and its pipelines.
#[derive(Debug)]
pub struct Gpu {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    pub(crate) pipelines: Pipelines,
    pub(crate) throughput: Throughput,
    /// Distinguishes this device from earlier ones.
    pub(crate) id: u64,
    adapter: Option<String>,
    software: bool,
    errors: Arc<Mutex<DeviceErrors>>,
    /// Held by the computation that uses the device.
    turn: Arc<async_lock::Mutex<()>>,
}

/// The right to use a device until it is dropped.
pub(crate) type Turn = async_lock::MutexGuardArc<()>;

/// The errors that the device's callbacks reported.
#[derive(Debug, Default)]
struct DeviceErrors {
    /// The reason of a loss, which is final.
    lost: Option<String>,
    /// The first error since the last check.
    uncaptured: Option<String>,
}

impl Gpu {
    /// Opens a device on the platform's preferred adapter, hardware or
    /// software, with the limits that WebGPU guarantees everywhere.
    ///
    /// # Errors
    /// [`Error::NoAdapter`] if there is no adapter or it provides no device.
    pub async fn new() -> Result<Self> {
        static NEXT_ID: AtomicU64 = AtomicU64::new(1);
        let no_adapter = |found: String| Error::NoAdapter { found };
        #[cfg(target_arch = "wasm32")]
        if !has_webgpu() {
            return Err(no_adapter("navigator.gpu does not exist".to_owned()));
        }
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let adapter = instance
            .request_adapter(&wgpu::RequestAdapterOptions {
                power_preference: wgpu::PowerPreference::HighPerformance,
                ..Default::default()
            })
            .await
            .map_err(|error| no_adapter(reason(&error)))?;
        let (device, queue) = adapter
            .request_device(&wgpu::DeviceDescriptor {
                required_limits: wgpu::Limits::default(),
                ..Default::default()
            })
            .await
            .map_err(|error| no_adapter(error.to_string()))?;
        let errors = Arc::new(Mutex::new(DeviceErrors::default()));
        let on_loss = Arc::clone(&errors);
        device.set_device_lost_callback(move |reason, message| {
            let mut errors = on_loss.lock().unwrap_or_else(PoisonError::into_inner);
            errors.lost = Some(format!("{reason:?}: {message}"));
        });
        let on_error = Arc::clone(&errors);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            let mut errors = on_error.lock().unwrap_or_else(PoisonError::into_inner);
            errors.uncaptured.get_or_insert(error.to_string());
        }));
        let info = adapter.get_info();
        let name = info.name;
        Ok(Self {
            pipelines: Pipelines::new(&device),
            throughput: Throughput::default(),
            device,
            queue,
            id: NEXT_ID.fetch_add(1, Ordering::Relaxed),
            adapter: (!name.is_empty()).then_some(name),
            software: info.device_type == wgpu::DeviceType::Cpu,
            errors,
            turn: Arc::default(),
        })
    }

    /// The adapter's name, which browsers do not disclose.
    #[must_use]
    pub fn adapter(&self) -> Option<String> {
        self.adapter.clone()
    }

    /// Whether the platform reports a software adapter, which runs kernels on the CPU.
    pub(crate) fn is_software(&self) -> bool {
        self.software
    }

    /// Destroys the device, with the effects of a driver's reset.
    #[cfg(all(test, not(target_arch = "wasm32")))]
    pub(crate) fn destroy(&self) {
        self.device.destroy();
        let mut errors = self.errors.lock().unwrap_or_else(PoisonError::into_inner);
        errors.lost.get_or_insert_with(|| "destroyed".to_owned());
    }

    /// The same device reported as hardware, which `auto` uses for method `certified`.
    #[cfg(all(test, not(target_arch = "wasm32")))]
    pub(crate) fn pretend_hardware(self) -> Self {
        Self { software: false, ..self }
    }

    /// Makes a request that the device must refuse, which its callback reports.
    #[cfg(all(test, not(target_arch = "wasm32")))]
    pub(crate) fn provoke_validation_error(&self) {
        let size = 2 * self.device.limits().max_buffer_size;
        let usage = wgpu::BufferUsages::STORAGE;
        drop(self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("deliberate validation error"),
            size,
            usage,
            mapped_at_creation: false,
        }));
    }

    /// Makes the next [`Gpu::check`] fail with `found`, unless it already has an earlier error.
    pub(crate) fn fail(&self, found: String) {
        let mut errors = self.errors.lock().unwrap_or_else(PoisonError::into_inner);
        errors.uncaptured.get_or_insert(found);
    }

    /// Waits until no other computation uses the device: its errors are reported to whoever
    /// asks first, so that computations must not mix.
    pub(crate) async fn turn(&self) -> Turn {
        self.turn.lock_arc().await
    }

    /// Fails if an error was reported since the last check.
    ///
    /// # Errors
    /// [`Error::DeviceLost`] or [`Error::GpuFailed`], as a callback reported, or
    /// as a buffer larger than the limits was requested.
    pub(crate) fn check(&self) -> Result<()> {
        let mut errors = self.errors.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = errors.lost.clone() {
            return Err(Error::DeviceLost { found });
        }
        // An error is reported once: it ends the work in progress, not all that follows.
        match errors.uncaptured.take() {
            Some(found) => Err(Error::GpuFailed { found }),
            None => Ok(()),
        }
    }

    /// Waits until everything submitted is done.
    pub(crate) async fn finish(&self) -> Result<()> {
        let (sender, receiver) = oneshot::channel();
        // The receiver is gone only if the caller cancelled this future.
        self.queue.on_submitted_work_done(move || {
            let _ = sender.send(());
        });
        self.poll()?;
        self.received(receiver).await
    }

    /// Runs the callbacks of all submitted work; browsers run them by themselves.
    fn poll(&self) -> Result<()> {
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map(|_| ())
            .map_err(|error| Error::GpuFailed { found: error.to_string() })
            .or_else(|error| self.check().and(Err(error)))
    }

    /// Returns the value that a callback sent, after checking for errors.
    async fn received<T>(&self, receiver: oneshot::Receiver<T>) -> Result<T> {
        let received = receiver.await;
        self.check()?;
        received.map_err(|_| Error::GpuFailed { found: "the device dropped a callback".to_owned() })
    }

    /// Returns the first `bytes` bytes of a mappable buffer, once all submitted work is done.
    pub(crate) async fn read(&self, buffer: &wgpu::Buffer, bytes: u64) -> Result<Vec<u8>> {
        self.check()?;
        let (sender, receiver) = oneshot::channel();
        buffer.map_async(wgpu::MapMode::Read, ..bytes, move |result| {
            let _ = sender.send(result);
        });
        self.poll()?;
        self.received(receiver).await?.map_err(|error| Error::GpuFailed { found: error.to_string() })?;
        let range = buffer
            .get_mapped_range(..bytes)
            .map_err(|error| Error::GpuFailed { found: error.to_string() })?;
        let content = range.to_vec();
        drop(range);
        buffer.unmap();
        Ok(content)
    }
}

/// Whether the host offers WebGPU. wgpu panics where there is neither the class
/// of a window nor that of a worker, as in Node.
#[cfg(target_arch = "wasm32")]
fn has_webgpu() -> bool {
    let global = js_sys::global();
    let has = |name: &str| js_sys::Reflect::has(&global, &name.into()).unwrap_or(false);
    let gpu = js_sys::Reflect::get(&global, &"navigator".into())
        .and_then(|navigator| js_sys::Reflect::get(&navigator, &"gpu".into()));
    (has("Window") || has("WorkerGlobalScope")) && gpu.is_ok_and(|gpu| gpu.is_object())
}

/// Why no adapter was found.
#[cfg(not(target_arch = "wasm32"))]
fn reason(error: &wgpu::RequestAdapterError) -> String {
    error.to_string()
}

/// Why no adapter was found. On the web wgpu knows no further reason; its
/// message would list native backends that do not exist there.
#[cfg(target_arch = "wasm32")]
fn reason(error: &wgpu::RequestAdapterError) -> String {
    match error {
        wgpu::RequestAdapterError::NotFound { no_adapter_backends, .. } if no_adapter_backends.is_empty() => {
            "the browser has no WebGPU"
        }
        _ => "the browser found none",
    }
    .to_owned()
}
