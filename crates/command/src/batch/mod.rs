//! The command `batch`: many pairs, one line of JSON each.
//!
//! Threads take lines in turn, share prepared models through a [`Cache`], and give their answers to
//! [`Answers`], which writes them in the order of the input.

mod answers;
mod cache;
mod request;

use crate::arguments::batch::BatchArguments;
use crate::commands::align::{Aligned, judged};
use crate::commands::check::{levels, named};
use crate::commands::distance::of_limit;
use crate::commands::gaps::is_known;
use crate::commands::info::{InfoOptions, Stated};
use crate::failure::Failure;
use crate::input::{Input, STANDARD_STREAM};
use crate::output::json::{OfAllFiles, OfFile, OfFiles, Reason, line};
use crate::reports::Verdict;
use answers::{Answers, Earlier, key, resumed};
use cache::Cache;
use nurbs_hausdorff::{Backend, CheckOptions, Engine, Error, Monitor, Query};
use request::{FileInUnit, Question, Request};
use serde::Serialize;
use serde_json::Value;
use std::collections::HashMap;
use std::fs::OpenOptions;
use std::io::{BufRead, BufReader, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, sync_channel};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::Duration;

/// Exit statuses: all pairs have a result; a pair has an error; ended by SIGINT, as shells count it.
const ANSWERED: u8 = 0;
const FAILED: u8 = 1;
const INTERRUPTED: u8 = 130;

/// The largest number of lines that are read before a thread has time for them.
const READ_AHEAD: usize = 64;

/// The time after which a thread that waits for a line looks whether the batch is over.
const PATIENCE: Duration = Duration::from_millis(100);

/// Answers all pairs, and returns the exit status.
pub(crate) fn run(arguments: &BatchArguments) -> Result<u8, Failure> {
    let lines = lines(arguments)?;
    let (output, earlier) = output(arguments)?;
    let interrupted = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&interrupted);
    // Without a handler the process ends between two lines as well, but at once.
    let _ = ctrlc::set_handler(move || flag.store(true, Ordering::Relaxed));
    let batch = Batch {
        lines: Mutex::new(Lines { received: numbered(lines), answered: earlier.answered }),
        answers: Answers::new(output),
        cache: Cache::new(arguments.cache),
        max_seconds: arguments.max_seconds,
        interrupted: &interrupted,
        unread: AtomicBool::new(false),
        failures: AtomicUsize::new(earlier.failures),
        cpu: Engine::cpu(),
        gpu: OnceLock::new(),
    };
    let jobs = arguments.jobs.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from));
    std::thread::scope(|scope| {
        for _ in 0..jobs.max(1) {
            scope.spawn(|| batch.work());
        }
    });
    batch.answers.finish().map_err(Failure::Output)?;
    Ok(match batch.failures.into_inner() {
        _ if interrupted.load(Ordering::Relaxed) => INTERRUPTED,
        0 => ANSWERED,
        _ => FAILED,
    })
}

fn lines(arguments: &BatchArguments) -> Result<Box<dyn BufRead + Send>, Failure> {
    let path = &arguments.pairs;
    if path.as_os_str() == STANDARD_STREAM {
        return Ok(Box::new(BufReader::new(std::io::stdin())));
    }
    let unreadable = |found: String| Error::FileUnreadable { path: path.display().to_string(), found };
    let file = std::fs::File::open(path).map_err(|error| unreadable(error.to_string()))?;
    // A directory can be opened, and each of its lines is an error.
    if path.is_dir() {
        return Err(unreadable("it is a directory".to_owned()).into());
    }
    Ok(Box::new(BufReader::new(file)))
}

/// Returns where answers go, and what is answered there already.
fn output(arguments: &BatchArguments) -> Result<(Box<dyn Write + Send>, Earlier), Failure> {
    let Some(path) = &arguments.output else {
        return Ok((Box::new(std::io::stdout()), Earlier::default()));
    };
    if let [Ok(pairs), Ok(output)] = [&arguments.pairs, path].map(std::fs::canonicalize)
        && pairs == output
    {
        let found = "found the file of the pairs as the output, expected another file".to_owned();
        return Err(Error::OptionInvalid { found }.into());
    }
    if arguments.resume {
        let (file, earlier) = resumed(path)?;
        return Ok((Box::new(file), earlier));
    }
    let file = match arguments.overwrite {
        true => std::fs::File::create(path),
        false => OpenOptions::new().write(true).create_new(true).open(path),
    };
    let file = file.map_err(|error| match error.kind() {
        ErrorKind::AlreadyExists => Failure::Exists(path.clone()),
        _ => Failure::File { path: path.clone(), error },
    })?;
    Ok((Box::new(file), Earlier::default()))
}

/// The lines of the input with their indices.
type Numbered = Receiver<(usize, std::io::Result<String>)>;

/// The lines that no thread took yet.
struct Lines {
    received: Numbered,
    /// The number of answers of an earlier run to each id that were not passed over yet.
    answered: HashMap<String, usize>,
}

/// What a thread does with a line.
enum Taken {
    /// It is empty, or its pair was answered before.
    Nothing,
    Pair(Value, nurbs_hausdorff::Result<Box<Request>>),
    Unreadable(std::io::Error),
}

impl Lines {
    /// Takes the next line with its index. As many lines of an id are passed over as were answered before, the first ones,
    /// as answers come in the order of lines.
    fn take(&mut self, max_seconds: Option<f64>) -> Result<(usize, Taken), RecvTimeoutError> {
        let (index, text) = self.received.recv_timeout(PATIENCE)?;
        let text = match text {
            Ok(text) if text.trim().is_empty() => return Ok((index, Taken::Nothing)),
            // Editors of Windows begin a file with a mark of its bytes' order.
            Ok(text) => text.trim_start_matches('\u{feff}').to_owned(),
            Err(error) => return Ok((index, Taken::Unreadable(error))),
        };
        let (id, request) = request::parse(&text, max_seconds);
        Ok((
            index,
            match self.answered.get_mut(&key(&id)) {
                Some(count) if *count > 0 => {
                    *count -= 1;
                    Taken::Nothing
                }
                _ => Taken::Pair(id, request.map(Box::new)),
            },
        ))
    }
}

/// Reads lines on a thread of its own, which nobody waits for: an interrupt ends the batch while no line
/// comes. The first error that is no line of other bytes than text ends the input.
fn numbered(lines: Box<dyn BufRead + Send>) -> Numbered {
    let (sender, receiver) = sync_channel(READ_AHEAD);
    std::thread::spawn(move || {
        for (index, line) in lines.lines().enumerate() {
            let is_last = line.as_ref().is_err_and(|error| error.kind() != ErrorKind::InvalidData);
            if sender.send((index, line)).is_err() || is_last {
                break;
            }
        }
    });
    receiver
}

/// What the threads share.
struct Batch<'a> {
    lines: Mutex<Lines>,
    answers: Answers<'a>,
    cache: Cache,
    max_seconds: Option<f64>,
    interrupted: &'a AtomicBool,
    /// Whether nobody reads the answers any more.
    unread: AtomicBool,
    failures: AtomicUsize,
    cpu: Engine,
    gpu: OnceLock<Option<Engine>>,
}

/// An answer with the id of its pair.
#[derive(Serialize)]
struct OfPair<'a, T> {
    id: &'a Value,
    #[serde(flatten)]
    answer: T,
}

/// The answer to a pair that failed.
#[derive(Serialize)]
struct Failed<'a> {
    error: Reason<'a>,
}

impl Batch<'_> {
    /// Answers pairs until there are no more, nobody reads the answers or the process is interrupted.
    fn work(&self) {
        loop {
            let next = self.lines.lock().unwrap_or_else(PoisonError::into_inner).take(self.max_seconds);
            let (index, taken) = match next {
                Ok(line) => line,
                Err(RecvTimeoutError::Timeout) if !self.is_over() => continue,
                Err(_) => return,
            };
            let answer = match taken {
                Taken::Nothing => None,
                Taken::Pair(id, request) => Some(self.answer(&id, request)),
                Taken::Unreadable(error) => {
                    let found = format!("the input cannot be read: {error}");
                    Some(self.failed(&Value::Null, &Error::OptionInvalid { found }.into()))
                }
            };
            if self.is_over() {
                return;
            }
            self.answers.answer(index, answer);
            if self.answers.has_ended() {
                self.unread.store(true, Ordering::Relaxed);
                return;
            }
        }
    }

    fn is_over(&self) -> bool {
        self.interrupted.load(Ordering::Relaxed) || self.unread.load(Ordering::Relaxed)
    }

    /// Returns the line that answers a pair.
    fn answer(&self, id: &Value, request: nurbs_hausdorff::Result<Box<Request>>) -> String {
        let answer = match request {
            Ok(request) => self.compare(id, &request),
            Err(error) => Err(Arc::new(Failure::Plain(error))),
        };
        answer.unwrap_or_else(|failure| self.failed(id, &failure))
    }

    fn failed(&self, id: &Value, failure: &Failure) -> String {
        self.failures.fetch_add(1, Ordering::Relaxed);
        let error = Reason { code: failure.code(), message: &failure.to_string() };
        // An id and two texts are JSON.
        line(&OfPair { id, answer: Failed { error } }).unwrap_or_default()
    }

    fn compare(&self, id: &Value, request: &Request) -> Result<String, Arc<Failure>> {
        match request {
            Request::Pair { files: [a, b], question } => {
                let (a, b) = (self.cache.get(a)?, self.cache.get(b)?);
                self.question(id, &a, &b, question).map_err(Arc::new)
            }
            Request::Check { files, options } => self.check(id, files, options),
            Request::Info { file, options } => self.info(id, file, options),
        }
    }

    /// Returns the model of a file, in the unit that it states.
    fn read(&self, path: &Path) -> Result<Arc<Input>, Arc<Failure>> {
        self.cache.get(&FileInUnit { path: path.to_owned(), unit: None })
    }

    fn info(&self, id: &Value, path: &Path, options: &InfoOptions) -> Result<String, Arc<Failure>> {
        let input = self.read(path)?;
        let stated = Stated::new(&input, options).map_err(Arc::new)?;
        let info = stated.with_report(&input);
        line(&OfPair { id, answer: OfFile::new("info", &info, &input.source) }).map_err(Arc::new)
    }

    fn check(&self, id: &Value, files: &[PathBuf], options: &CheckOptions) -> Result<String, Arc<Failure>> {
        let inputs = files.iter().map(|path| self.read(path)).collect::<Result<Vec<_>, _>>()?;
        let inputs: Vec<&Input> = inputs.iter().map(Arc::as_ref).collect();
        let levels = levels(files);
        let models = named(&levels, &inputs);
        let monitor = &mut Interrupt([self.interrupted, &self.unread]);
        let checked = self.cpu.check(&models, options).monitored(monitor).wait();
        let result = checked.map_err(|error| Arc::new(error.into()))?;
        let is_whole = inputs.iter().all(|input| input.report.read.skipped.is_empty());
        let verdict = Verdict::of(result.clean.filter(|_| is_whole));
        let answer = OfAllFiles::new("check", verdict, &result, &inputs);
        line(&OfPair { id, answer }).map_err(Arc::new)
    }

    fn question(&self, id: &Value, a: &Input, b: &Input, question: &Question) -> Result<String, Failure> {
        let is_whole = [a, b].iter().all(|input| input.report.read.skipped.is_empty());
        let of = OfQuestion { id, question, is_whole, a, b };
        match question {
            Question::Distance(options) => {
                let engine = if options.may_use_gpu() { self.with_gpu()? } else { &self.cpu };
                let result = self.ask(engine, &**options, [a, b])?;
                of.answered(options.limit.map_or(Verdict::Passed, |limit| of_limit(&result, limit)), &result)
            }
            Question::Diff(options) => {
                let result = self.ask(&self.cpu, options, [a, b])?;
                of.answered(result.state.into(), &result)
            }
            Question::Score(options) => {
                let result = self.ask(&self.cpu, &**options, [a, b])?;
                of.answered(Verdict::of(result.met), &result)
            }
            Question::Align(options) => {
                let result = self.ask(&self.cpu, &**options, [a, b])?;
                of.answered(Verdict::of(judged(&result, options.zone.limit)), &Aligned::new(&result))
            }
            // Nothing is judged by the next three, but the answer may not be known.
            Question::Gaps(options) => {
                let result = self.ask(&self.cpu, options, [a, b])?;
                let verdict = if is_known(&result) { Verdict::Passed } else { Verdict::Undecided };
                of.answered(verdict, &result)
            }
            Question::Statistics(options) => {
                let result = self.ask(&self.cpu, options, [a, b])?;
                of.answered(Verdict::Passed, &result)
            }
            Question::Overlap(options) => {
                let result = self.ask(&self.cpu, options, [a, b])?;
                let verdict = if result.volumes.is_some() { Verdict::Passed } else { Verdict::Undecided };
                of.answered(verdict, &result)
            }
            Question::Clearance(options) => {
                let result = self.ask(&self.cpu, options, [a, b])?;
                of.answered(Verdict::of(result.at_least), &result)
            }
        }
    }

    /// Answers a question about two models, unless nobody waits for the answer.
    fn ask<Q: Query>(
        &self,
        engine: &Engine,
        question: &Q,
        [a, b]: [&Input; 2],
    ) -> Result<Q::Answer, Failure> {
        let monitor = &mut Interrupt([self.interrupted, &self.unread]);
        Ok(question.ask(engine, [&a.prepared, &b.prepared]).monitored(monitor).wait()?)
    }

    /// Returns the engine with the GPU, if there is one.
    ///
    /// # Errors
    /// [`Error::NoAdapter`] if the GPU cannot be had.
    fn with_gpu(&self) -> Result<&Engine, Failure> {
        let engine = self.gpu.get_or_init(|| Engine::new_blocking(Backend::Auto).ok());
        engine.as_ref().ok_or_else(|| Error::NoAdapter { found: "no engine".to_owned() }.into())
    }
}

/// A question about two models, to be answered.
struct OfQuestion<'a> {
    id: &'a Value,
    question: &'a Question,
    /// Whether no faces were left out of the models.
    is_whole: bool,
    a: &'a Input,
    b: &'a Input,
}

impl OfQuestion<'_> {
    /// Returns the line that answers it; the verdict is stated only if something was judged.
    fn answered(&self, verdict: Verdict, result: &impl Serialize) -> Result<String, Failure> {
        let asked = self.question.asked(verdict, self.is_whole);
        line(&OfPair { id: self.id, answer: OfFiles::new(asked, result, self.a, self.b) })
    }
}

/// Cancels a computation whose answer nobody waits for.
struct Interrupt<'a>([&'a AtomicBool; 2]);

impl Monitor for Interrupt<'_> {
    fn progress(&mut self, _fraction: f64) {}

    fn cancelled(&self) -> bool {
        self.0.iter().any(|flag| flag.load(Ordering::Relaxed))
    }
}
