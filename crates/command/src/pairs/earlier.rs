//! Answers of earlier calls, found by the content of both files.

use crate::failure::Failure;
use crate::input::{File, hexadecimal};
use crate::reports::Answer;
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};

/// A folder of answers, a file each.
pub(super) struct Earlier {
    folder: PathBuf,
}

/// Returns the name of an answer: a hash of the version, the command, its options, and the paths and
/// contents of both files.
pub(super) fn key(command: &str, options: &str, files: [&File; 2]) -> String {
    let mut hash = Sha256::new();
    let [a, b] = files.map(File::source).map(|source| [source.path(), source.sha256()].join("\n"));
    for text in [env!("CARGO_PKG_VERSION"), command, options, &a, &b] {
        hash.update((text.len() as u64).to_le_bytes());
        hash.update(text);
    }
    hexadecimal(&hash.finalize())
}

impl Earlier {
    /// Opens a folder, which is made if there is none.
    ///
    /// # Errors
    /// [`Failure::File`].
    pub(super) fn new(folder: &Path) -> Result<Self, Failure> {
        let failed = |error| Failure::File { path: folder.to_owned(), error };
        std::fs::create_dir_all(folder).map_err(failed)?;
        Ok(Self { folder: folder.to_owned() })
    }

    /// Returns the answer of this name; none if there is none that can be read.
    pub(super) fn find(&self, key: &str) -> Option<Answer> {
        let text = std::fs::read(self.path(key)).ok()?;
        serde_json::from_slice(&text).ok()
    }

    /// Keeps an answer that does not depend on the speed of the machine. A file of another name is
    /// renamed, so that no reader sees half of one.
    ///
    /// # Errors
    /// [`Failure::File`].
    pub(super) fn keep(&self, key: &str, answer: &Answer) -> Result<(), Failure> {
        if !answer.repeatable {
            return Ok(());
        }
        let (path, unfinished) = (self.path(key), self.folder.join(format!("{key}.{}", std::process::id())));
        let text = crate::output::json::line(answer)?;
        std::fs::write(&unfinished, text)
            .and_then(|()| std::fs::rename(&unfinished, &path))
            .map_err(|error| Failure::File { path, error })
    }

    fn path(&self, key: &str) -> PathBuf {
        self.folder.join(format!("{key}.json"))
    }
}
