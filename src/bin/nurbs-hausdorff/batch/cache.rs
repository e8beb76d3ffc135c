//! The models that were used last, prepared.

use crate::failure::Failure;
use crate::input::{Input, read};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// A prepared model, or the failure to read it; read by the first who needs it.
type Slot = Arc<OnceLock<Result<Arc<Input>, Arc<Failure>>>>;

/// A number of models by the paths of their files. Files that change meanwhile are not read again.
pub(super) struct Cache {
    capacity: usize,
    slots: Mutex<Slots>,
}

#[derive(Default)]
struct Slots {
    by_path: HashMap<PathBuf, (u64, Slot)>,
    /// The number of uses so far.
    uses: u64,
}

impl Cache {
    pub(super) fn new(capacity: usize) -> Self {
        Self { capacity: capacity.max(1), slots: Mutex::default() }
    }

    /// Returns the model of a file; whoever needs one that is being read waits for it.
    pub(super) fn get(&self, path: &Path) -> Result<Arc<Input>, Arc<Failure>> {
        self.slot(path).get_or_init(|| read(path).map(Arc::new).map_err(Arc::new)).clone()
    }

    /// Returns the place of a model, and forgets the one whose last use is longest ago if there are
    /// more than the capacity.
    fn slot(&self, path: &Path) -> Slot {
        let mut slots = self.slots.lock().unwrap_or_else(PoisonError::into_inner);
        slots.uses += 1;
        let uses = slots.uses;
        let (used, slot) = slots.by_path.entry(path.to_owned()).or_default();
        *used = uses;
        let slot = Arc::clone(slot);
        if slots.by_path.len() > self.capacity {
            let oldest =
                slots.by_path.iter().min_by_key(|(_, (used, _))| *used).map(|(path, _)| path.clone());
            if let Some(oldest) = oldest {
                slots.by_path.remove(&oldest);
            }
        }
        slot
    }
}
