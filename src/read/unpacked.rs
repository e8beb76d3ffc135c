//! Compressed content, whose size is bounded before memory is taken.

use crate::error::{Error, Result};
use std::io::Read;

/// Bytes that may still be unpacked of a file.
pub struct Budget {
    left: u64,
    whole: u64,
}

impl Budget {
    /// Returns a budget of this many bytes.
    #[must_use]
    pub fn new(whole: u64) -> Self {
        Self { left: whole, whole }
    }

    /// Reads to the end. Sizes that an archive states are not relied on.
    ///
    /// # Errors
    /// [`Error::FileTooLarge`] before more than what is left is in memory; `damaged` of what the
    /// reader says.
    pub fn read(&mut self, reader: impl Read, damaged: impl Fn(String) -> Error) -> Result<Vec<u8>> {
        let mut bytes = Vec::new();
        reader.take(self.left + 1).read_to_end(&mut bytes).map_err(|error| damaged(error.to_string()))?;
        match self.left.checked_sub(bytes.len() as u64) {
            Some(left) => {
                self.left = left;
                Ok(bytes)
            }
            None => Err(Error::FileTooLarge { found: self.whole + 1, expected: self.whole }),
        }
    }
}
