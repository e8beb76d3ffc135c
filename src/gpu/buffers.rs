//! Making buffers within the default limits.

use super::Gpu;
use crate::error::{Error, Result};
use bytemuck::Pod;

/// Bytes of one binding, at most: the default limit of WebGPU.
pub(super) const MOST_BINDING_BYTES: u64 = 128 << 20;

/// Bytes that a buffer's size is a multiple of.
const SIZE_MULTIPLE: u64 = 16;

impl Gpu {
    /// A storage buffer with this content; not empty even if the content is.
    ///
    /// # Errors
    /// [`Error::GpuFailed`] over [`MOST_BINDING_BYTES`].
    pub(super) fn upload<T: Pod>(&self, label: &str, content: &[T]) -> Result<wgpu::Buffer> {
        let bytes: &[u8] = bytemuck::cast_slice(content);
        let buffer = self.storage(label, bytes.len() as u64)?;
        self.queue.write_buffer(&buffer, 0, bytes);
        Ok(buffer)
    }

    /// A storage buffer of at least this size.
    ///
    /// # Errors
    /// [`Error::GpuFailed`] over [`MOST_BINDING_BYTES`].
    pub(super) fn storage(&self, label: &str, bytes: u64) -> Result<wgpu::Buffer> {
        use wgpu::BufferUsages as Usages;
        self.buffer(label, bytes, Usages::STORAGE | Usages::COPY_DST | Usages::COPY_SRC)
    }

    /// A buffer that the CPU can read.
    ///
    /// # Errors
    /// [`Error::GpuFailed`] over [`MOST_BINDING_BYTES`].
    pub(super) fn readable(&self, label: &str, bytes: u64) -> Result<wgpu::Buffer> {
        self.buffer(label, bytes, wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST)
    }

    /// # Errors
    /// [`Error::GpuFailed`] over [`MOST_BINDING_BYTES`].
    pub(super) fn buffer(&self, label: &str, bytes: u64, usage: wgpu::BufferUsages) -> Result<wgpu::Buffer> {
        let size = bytes.max(1).next_multiple_of(SIZE_MULTIPLE);
        if size > MOST_BINDING_BYTES {
            let found = format!("{label} wants {size} bytes, expected at most {MOST_BINDING_BYTES}");
            return Err(Error::GpuFailed { found });
        }
        Ok(self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size,
            usage,
            mapped_at_creation: false,
        }))
    }
}
