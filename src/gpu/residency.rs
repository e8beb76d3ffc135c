//! Copies of models on a GPU, uploaded at first use and kept.

use super::Gpu;
use crate::error::Result;
use crate::threads::locked;
use std::sync::{Arc, Mutex};

/// Holds the copy of a value on the device that used it last.
#[derive(Debug)]
pub(crate) struct Resident<T> {
    /// The device's id and the copy.
    copy: Mutex<Option<(u64, Arc<T>)>>,
}

impl<T> Default for Resident<T> {
    fn default() -> Self {
        Self { copy: Mutex::new(None) }
    }
}

impl<T> Resident<T> {
    /// Returns the copy on `gpu`, made by `upload` unless it already exists.
    ///
    /// # Errors
    /// [`crate::Error::GpuFailed`] if a buffer exceeds the limits,
    /// [`crate::Error::DeviceLost`].
    pub(crate) fn on(&self, gpu: &Gpu, upload: impl FnOnce(&Gpu) -> T) -> Result<Arc<T>> {
        let kept = locked(&self.copy).clone();
        if let Some((_, uploaded)) = kept.filter(|(id, _)| *id == gpu.id) {
            return Ok(uploaded);
        }
        let uploaded = Arc::new(upload(gpu));
        gpu.check()?;
        *locked(&self.copy) = Some((gpu.id, Arc::clone(&uploaded)));
        Ok(uploaded)
    }
}
