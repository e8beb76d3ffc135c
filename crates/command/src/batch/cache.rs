//! The models that were used last, prepared.

use super::request::FileInUnit;
use crate::failure::Failure;
use crate::input::{Input, read_in_unit};
use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// A prepared model, or the failure to read it; read by the first who needs it.
type Slot = Arc<OnceLock<Result<Arc<Input>, Arc<Failure>>>>;

/// A number of models by the paths of their files and the units given for them. Files that change meanwhile are not read again.
pub(super) struct Cache {
    capacity: usize,
    slots: Mutex<Slots>,
}

#[derive(Default)]
struct Slots {
    by_file: HashMap<FileInUnit, (u64, Slot)>,
    /// The number of uses so far.
    uses: u64,
}

impl Cache {
    pub(super) fn new(capacity: usize) -> Self {
        Self { capacity: capacity.max(1), slots: Mutex::default() }
    }

    /// Returns the model of a file; whoever needs one that is being read waits for it.
    pub(super) fn get(&self, file: &FileInUnit) -> Result<Arc<Input>, Arc<Failure>> {
        let read = || read_in_unit(&file.path, file.unit).map(Arc::new).map_err(Arc::new);
        self.slot(file).get_or_init(read).clone()
    }

    /// Returns the place of a model, and forgets the one whose last use is longest ago if there are
    /// more than the capacity.
    fn slot(&self, file: &FileInUnit) -> Slot {
        let mut slots = self.slots.lock().unwrap_or_else(PoisonError::into_inner);
        slots.uses += 1;
        let uses = slots.uses;
        let (used, slot) = slots.by_file.entry(file.clone()).or_default();
        *used = uses;
        let slot = Arc::clone(slot);
        if slots.by_file.len() > self.capacity {
            let oldest =
                slots.by_file.iter().min_by_key(|(_, (used, _))| *used).map(|(file, _)| file.clone());
            if let Some(oldest) = oldest {
                slots.by_file.remove(&oldest);
            }
        }
        slot
    }
}
