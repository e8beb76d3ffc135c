//! The lines of the output, in the order of the input.

use crate::failure::Failure;
use crate::output::is_unread;
use serde_json::Value;
use std::collections::{BTreeMap, HashMap};
use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, ErrorKind, Seek, SeekFrom, Write};
use std::path::Path;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// The most answers that wait for an earlier one: their memory is bounded, and one slow pair does not
/// stop the others at once.
const MAX_WAITING: usize = 256;

/// Answers that are written as soon as all earlier ones are.
pub(super) struct Answers<'a> {
    state: Mutex<State<'a>>,
    written: Condvar,
}

struct State<'a> {
    output: Box<dyn Write + Send + 'a>,
    /// The index of the next answer to be written.
    next: usize,
    waiting: BTreeMap<usize, Option<String>>,
    end: Option<Result<(), std::io::Error>>,
}

impl<'a> Answers<'a> {
    pub(super) fn new(output: Box<dyn Write + Send + 'a>) -> Self {
        let state = State { output, next: 0, waiting: BTreeMap::new(), end: None };
        Self { state: Mutex::new(state), written: Condvar::new() }
    }

    /// Writes a line, or none for a pair that was answered before, after those with smaller indices.
    /// Waits while too many others wait.
    pub(super) fn answer(&self, index: usize, line: Option<String>) {
        let mut state = self.locked();
        state.waiting.insert(index, line);
        state.write();
        self.written.notify_all();
        while state.end.is_none() && state.waiting.len() > MAX_WAITING {
            state = self.written.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Returns whether nobody reads the output any more.
    pub(super) fn has_ended(&self) -> bool {
        self.locked().end.is_some()
    }

    /// # Errors
    /// Of the output, but not that its reader has gone, as `head` does.
    pub(super) fn finish(self) -> Result<(), std::io::Error> {
        self.state.into_inner().unwrap_or_else(PoisonError::into_inner).end.unwrap_or(Ok(()))
    }

    fn locked(&self) -> MutexGuard<'_, State<'a>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl State<'_> {
    fn write(&mut self) {
        while self.end.is_none() {
            let Some(line) = self.waiting.remove(&self.next) else { return };
            self.next += 1;
            let Some(line) = line else { continue };
            // One call a line, so that a process that is killed leaves whole ones.
            let written = self.output.write_all(line.as_bytes()).and_then(|()| self.output.flush());
            self.end = written.err().map(|error| if is_unread(&error) { Ok(()) } else { Err(error) });
        }
    }
}

/// The answers of an earlier run.
#[derive(Default)]
pub(super) struct Earlier {
    /// The number of answers to each id.
    pub(super) answered: HashMap<String, usize>,
    /// The number of pairs that have an error.
    pub(super) failures: usize,
}

/// Opens an earlier output to go on with it, or a new one: returns the file at its end, without a
/// line that was cut off, and what it answers.
///
/// # Errors
/// [`Failure::File`], also for a file with other lines, which is left as it is.
pub(super) fn resumed(path: &Path) -> Result<(File, Earlier), Failure> {
    let failed = |error| Failure::File { path: path.to_owned(), error };
    let mut file =
        OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path).map_err(failed)?;
    let mut earlier = Earlier::default();
    let mut reader = BufReader::new(&file);
    let (mut end, mut line) = (0, Vec::new());
    loop {
        line.clear();
        let length = reader.read_until(b'\n', &mut line).map_err(failed)?;
        if !line.ends_with(b"\n") {
            break;
        }
        let answer: Value = serde_json::from_slice(&line).map_err(|_| failed(no_answers()))?;
        *earlier.answered.entry(key(&answer["id"])).or_default() += 1;
        earlier.failures += usize::from(answer.get("error").is_some());
        end += length as u64;
    }
    file.set_len(end).and_then(|()| file.seek(SeekFrom::End(0))).map_err(failed)?;
    Ok((file, earlier))
}

fn no_answers() -> std::io::Error {
    std::io::Error::new(ErrorKind::InvalidData, "it is no output of `batch`")
}

/// Returns the text by which ids are compared.
pub(super) fn key(id: &Value) -> String {
    id.to_string()
}
