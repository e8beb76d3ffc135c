//! Making buffers within the default limits.

use crate::gpu::Gpu;
use bytemuck::Pod;

/// Bytes of one binding, at most: the default limit of WebGPU.
pub(crate) const MAX_BINDING_BYTES: u64 = 128 << 20;

/// Bytes that a buffer's size is a multiple of.
const SIZE_MULTIPLE: u64 = 16;

impl Gpu {
    /// A storage buffer with this content; not empty even if the content is.
    pub(crate) fn upload<T: Pod>(&self, label: &str, content: &[T]) -> wgpu::Buffer {
        self.upload_bytes(label, bytemuck::cast_slice(content))
    }

    fn upload_bytes(&self, label: &str, content: &[u8]) -> wgpu::Buffer {
        let buffer = self.storage(label, content.len() as u64);
        if content.len() as u64 <= buffer.size() {
            self.queue.write_buffer(&buffer, 0, content);
        }
        buffer
    }

    /// A storage buffer of at least this size.
    pub(crate) fn storage(&self, label: &str, bytes: u64) -> wgpu::Buffer {
        use wgpu::BufferUsages as Usages;
        self.buffer(label, bytes, Usages::STORAGE | Usages::COPY_DST | Usages::COPY_SRC)
    }

    /// A buffer that the CPU can read.
    pub(crate) fn readable(&self, label: &str, bytes: u64) -> wgpu::Buffer {
        self.buffer(label, bytes, wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST)
    }

    /// Over [`MAX_BINDING_BYTES`] there is room for nothing in it, and the
    /// next [`Gpu::check`] fails, without which nothing is read back or kept.
    pub(crate) fn buffer(&self, label: &str, bytes: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let mut size = bytes.max(1).next_multiple_of(SIZE_MULTIPLE);
        if size > MAX_BINDING_BYTES {
            self.fail(format!("{label} wants {size} bytes, expected at most {MAX_BINDING_BYTES}"));
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
