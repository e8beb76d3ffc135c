//! Copies of models on a GPU, uploaded at first use and kept.

use super::Gpu;
use crate::error::Result;
use std::cell::RefCell;
use std::rc::Rc;

/// Holds the copy of a value on the device that used it last.
#[derive(Debug)]
pub(crate) struct Resident<T> {
    /// The device's id and the copy.
    copy: RefCell<Option<(u64, Rc<T>)>>,
}

impl<T> Default for Resident<T> {
    fn default() -> Self {
        Self { copy: RefCell::new(None) }
    }
}

impl<T> Resident<T> {
    /// Returns the copy on `gpu`, made by `upload` unless it already exists.
    ///
    /// # Errors
    /// [`crate::Error::GpuFailed`] if a buffer exceeds the limits,
    /// [`crate::Error::DeviceLost`].
    pub(crate) fn on(&self, gpu: &Gpu, upload: impl FnOnce(&Gpu) -> T) -> Result<Rc<T>> {
        let mut copy = self.copy.borrow_mut();
        if let Some((id, uploaded)) = copy.as_ref()
            && *id == gpu.id
        {
            return Ok(Rc::clone(uploaded));
        }
        let uploaded = Rc::new(upload(gpu));
        gpu.check()?;
        *copy = Some((gpu.id, Rc::clone(&uploaded)));
        Ok(uploaded)
    }
}
