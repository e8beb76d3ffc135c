//! One line of the input: two files, a command and its options.

use crate::output::json::Asked;
use crate::reports::Verdict;
use glam::{DQuat, DVec3};
use nurbs_hausdorff::{
    ClearanceOptions, DiffOptions, DistanceOptions, Error, NamedOptions, Result, RigidTransform, ScoreOptions,
};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use std::path::PathBuf;

/// A pair to be compared.
pub(super) struct Request {
    pub(super) a: PathBuf,
    pub(super) b: PathBuf,
    pub(super) question: Question,
}

/// The command, with its checked options.
pub(super) enum Question {
    Distance(Box<DistanceOptions>),
    Diff(DiffOptions),
    Clearance(ClearanceOptions),
    Score(Box<ScoreOptions>),
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
        };
        let is_judged = match self {
            Self::Diff(_) => true,
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
    a: PathBuf,
    b: PathBuf,
    #[serde(default)]
    command: CommandName,
    #[serde(default)]
    transform: Motion,
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

/// Parses a line: its id, null if it has none, and the pair. `max_seconds` is the budget of searches
/// that state none.
pub(super) fn parse(text: &str, max_seconds: Option<f64>) -> (Value, Result<Request>) {
    match serde_json::from_str::<Line>(text) {
        Ok(line) => (line.id.clone(), request(line, max_seconds)),
        Err(error) => {
            let value: Map<String, Value> = serde_json::from_str(text).unwrap_or_default();
            let found = format!("the line is no pair: {error}");
            (value.get("id").cloned().unwrap_or_default(), Err(Error::OptionInvalid { found }))
        }
    }
}

fn request(line: Line, max_seconds: Option<f64>) -> Result<Request> {
    let Line { a, b, command, transform, options, .. } = line;
    let Motion { rotation, translation } = transform;
    let transform = RigidTransform::new(DQuat::from_array(rotation), DVec3::from_array(translation))?;
    let question = match command {
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
    };
    Ok(Request { a, b, question })
}

/// Returns options by their names.
///
/// # Errors
/// [`Error::OptionInvalid`] for an unknown name or another type.
fn named<T: DeserializeOwned>(options: Map<String, Value>) -> Result<T> {
    serde_json::from_value(Value::Object(options))
        .map_err(|error| Error::OptionInvalid { found: error.to_string() })
}
