//! What a GPU holds of a model, made at first use on each device.

use crate::error::Result;
use crate::gpu::Gpu;
use std::cell::RefCell;
use std::rc::Rc;

/// A place for one device's copy; a new device's copy replaces it.
#[derive(Debug)]
pub(crate) struct Resident<T> {
    copy: RefCell<Option<(u64, Rc<T>)>>,
}

impl<T> Default for Resident<T> {
    fn default() -> Self {
        Self { copy: RefCell::new(None) }
    }
}

impl<T> Resident<T> {
    /// The copy on `gpu`, uploaded by `upload` if it is not there yet.
    ///
    /// # Errors
    /// [`crate::Error::GpuFailed`] if a buffer exceeds the limits,
    /// [`crate::Error::DeviceLost`].
    pub(crate) fn on(&self, gpu: &Gpu, upload: impl FnOnce(&Gpu) -> T) -> Result<Rc<T>> {
        let mut copy = self.copy.borrow_mut();
        if let Some((id, kept)) = copy.as_ref()
            && *id == gpu.id
        {
            return Ok(Rc::clone(kept));
        }
        let made = Rc::new(upload(gpu));
        gpu.check()?;
        *copy = Some((gpu.id, Rc::clone(&made)));
        Ok(made)
    }
}
