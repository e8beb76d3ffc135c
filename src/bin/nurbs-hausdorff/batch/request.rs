//! One line of the input: files, a command and its options.

use crate::output::json::Asked;
use crate::reports::Verdict;
use glam::{DQuat, DVec3};
use nurbs_hausdorff::{
    BestFitOptions, CheckOptions, ClearanceOptions, DiffOptions, DistanceOptions, Error, NamedOptions,
    Result, RigidTransform, ScoreOptions,
};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use std::path::PathBuf;

/// What is to be compared.
pub(super) enum Request {
    Pair { files: [PathBuf; 2], question: Question },
    Check { files: Vec<PathBuf>, options: Box<CheckOptions> },
}

/// The command of a pair, with its checked options.
pub(super) enum Question {
    Distance(Box<DistanceOptions>),
    Diff(DiffOptions),
    Clearance(ClearanceOptions),
    Score(Box<ScoreOptions>),
    Align(Box<BestFitOptions>),
}

impl Question {
    /// Returns what is echoed of the question, with the verdict where there is a limit. Of models from
    /// which faces were left out it is undecided.
    pub(super) fn asked(&self, verdict: Verdict, is_whole: bool) -> Asked {
        let (command, limit, symmetric) = match self {
            Self::Distance(options) => ("distance", options.limit, Some(options.symmetric)),
            // The result states the limit.
            Self::Diff(_) => ("diff", None, None),
            Self::Clearance(options) => ("clearance", options.limit, None),
            Self::Score(_) => ("score", None, None),
            Self::Align(options) => ("align", options.zone.limit, None),
        };
        let is_judged = match self {
            Self::Diff(_) | Self::Align(_) => true,
            Self::Score(options) => !options.at_least.is_empty() || !options.at_most.is_empty(),
            _ => limit.is_some(),
        };
        let verdict = if is_whole { verdict } else { Verdict::Undecided };
        Asked { command, verdict: is_judged.then_some(verdict), limit, symmetric }
    }
}

/// The keys of a line that are no options.
#[derive(Deserialize)]
struct Line {
    id: Value,
    a: Option<PathBuf>,
    b: Option<PathBuf>,
    files: Option<Vec<PathBuf>>,
    #[serde(default)]
    command: CommandName,
    transform: Option<Motion>,
    #[serde(flatten)]
    options: Map<String, Value>,
}

#[derive(Deserialize, Clone, Copy, Default)]
#[serde(rename_all = "kebab-case")]
enum CommandName {
    #[default]
    Distance,
    Diff,
    Clearance,
    Score,
    Align,
    Check,
}

/// A motion of A.
#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Motion {
    rotation: [f64; 4],
    translation: [f64; 3],
}

impl Default for Motion {
    fn default() -> Self {
        Self { rotation: DQuat::IDENTITY.to_array(), translation: [0.0; 3] }
    }
}

/// Parses a line: its id, null if it has none, and the request. `max_seconds` is the budget of searches
/// that state none.
pub(super) fn parse(text: &str, max_seconds: Option<f64>) -> (Value, Result<Request>) {
    match serde_json::from_str::<Line>(text) {
        Ok(line) => (line.id.clone(), request(line, max_seconds)),
        Err(error) => {
            let value: Map<String, Value> = serde_json::from_str(text).unwrap_or_default();
            (value.get("id").cloned().unwrap_or_default(), Err(no_pair(&error)))
        }
    }
}

fn request(line: Line, max_seconds: Option<f64>) -> Result<Request> {
    let Line { id: _, a, b, files, command, transform, options } = line;
    match (command, files) {
        (CommandName::Check, Some(files)) if a.is_none() && b.is_none() && transform.is_none() => {
            let mut options: CheckOptions = named(options)?;
            options.max_seconds = options.max_seconds.or(max_seconds);
            options.validate()?;
            Ok(Request::Check { files, options: Box::new(options) })
        }
        (CommandName::Check, _) => Err(no_check()),
        (_, Some(_)) => Err(no_pair("`files` are of `check`")),
        (command, None) => {
            let file =
                |path: Option<PathBuf>, name| path.ok_or_else(|| no_pair(format!("missing field `{name}`")));
            let files = [file(a, "a")?, file(b, "b")?];
            let question = question(command, transform.unwrap_or_default(), options, max_seconds)?;
            Ok(Request::Pair { files, question })
        }
    }
}

fn question(
    command: CommandName,
    Motion { rotation, translation }: Motion,
    options: Map<String, Value>,
    max_seconds: Option<f64>,
) -> Result<Question> {
    let transform = RigidTransform::new(DQuat::from_array(rotation), DVec3::from_array(translation))?;
    Ok(match command {
        CommandName::Distance => {
            let named: NamedOptions = named(options)?;
            let mut options = DistanceOptions::try_from(NamedOptions { transform, ..named })?;
            if let nurbs_hausdorff::Method::Certified(budgets) = &mut options.method {
                budgets.max_seconds = budgets.max_seconds.or(max_seconds);
            }
            options.validate()?;
            Question::Distance(Box::new(options))
        }
        CommandName::Diff => {
            let mut options = DiffOptions { transform, ..named(options)? };
            options.max_seconds = options.max_seconds.or(max_seconds);
            options.validate()?;
            Question::Diff(options)
        }
        CommandName::Clearance => {
            let mut options = ClearanceOptions { transform, ..named(options)? };
            options.max_seconds = options.max_seconds.or(max_seconds);
            options.validate()?;
            Question::Clearance(options)
        }
        CommandName::Score => {
            let mut options = ScoreOptions { transform, ..named(options)? };
            options.max_seconds = options.max_seconds.or(max_seconds);
            options.validate()?;
            Question::Score(Box::new(options))
        }
        CommandName::Align => {
            let options = BestFitOptions { transform, ..named(options)? };
            options.validate()?;
            Question::Align(Box::new(options))
        }
        CommandName::Check => return Err(no_check()),
    })
}

fn no_check() -> Error {
    no_pair("`check` has `files`, and neither `a`, `b` nor `transform`")
}

fn no_pair(found: impl std::fmt::Display) -> Error {
    Error::OptionInvalid { found: format!("the line is no pair: {found}") }
}

/// Returns options by their names.
///
/// # Errors
/// [`Error::OptionInvalid`] for an unknown name or another type.
fn named<T: DeserializeOwned>(options: Map<String, Value>) -> Result<T> {
    serde_json::from_value(Value::Object(options))
        .map_err(|error| Error::OptionInvalid { found: error.to_string() })
}
