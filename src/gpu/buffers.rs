//! Buffers within the default limits of WebGPU.

use super::Gpu;
use bytemuck::Pod;

/// The most bytes of one binding: `maxStorageBufferBindingSize` of WebGPU by default.
pub(crate) const MAX_BINDING_BYTES: u64 = 128 << 20;

/// Buffer sizes are multiples of this: no WGSL type is aligned to more.
const SIZE_MULTIPLE: u64 = 16;

impl Gpu {
    /// A storage buffer with this content. It is never empty, even if `content` is.
    pub(crate) fn upload<T: Pod>(&self, label: &str, content: &[T]) -> wgpu::Buffer {
        let content: &[u8] = bytemuck::cast_slice(content);
        let buffer = self.storage(label, content.len() as u64);
        if content.len() as u64 <= buffer.size() {
            self.queue.write_buffer(&buffer, 0, content);
        }
        buffer
    }

    /// A storage buffer of `bytes` bytes or more, filled with zeros.
    pub(crate) fn storage(&self, label: &str, bytes: u64) -> wgpu::Buffer {
        use wgpu::BufferUsages as Usages;
        self.buffer(label, bytes, Usages::STORAGE | Usages::COPY_DST | Usages::COPY_SRC)
    }

    /// A buffer that the CPU can map and read.
    pub(crate) fn readable(&self, label: &str, bytes: u64) -> wgpu::Buffer {
        self.buffer(label, bytes, wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST)
    }

    /// A buffer of `bytes` bytes or more.
    ///
    /// Over [`MAX_BINDING_BYTES`] the buffer has the least size instead and the
    /// next [`Gpu::check`] fails. Nothing is read back or kept without that
    /// check, so callers need not handle the error at every buffer.
    pub(crate) fn buffer(&self, label: &str, bytes: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let mut size = bytes.max(1).next_multiple_of(SIZE_MULTIPLE);
        if size > MAX_BINDING_BYTES {
            self.fail(format!("{label} requires {size} bytes, expected at most {MAX_BINDING_BYTES}"));
            size = SIZE_MULTIPLE;
        }
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size,
            usage,
            mapped_at_creation: false,
        })
    }
}
