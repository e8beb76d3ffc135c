//! One line of the input: files, a command and its options.

use crate::arguments::models::Unit;
use crate::commands::info::InfoOptions;
use crate::output::json::Asked;
use crate::reports::Verdict;
use glam::{DQuat, DVec3};
use nurbs_hausdorff::{
    BestFitOptions, CheckOptions, ClearanceOptions, DiffOptions, DistanceOptions, Error, GapOptions,
    NamedOptions, OverlapOptions, Query, Result, RigidTransform, ScoreOptions, StatisticsOptions,
};
use serde::de::{DeserializeOwned, Error as _, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::{Map, Value};
use std::fmt::Formatter;
use std::path::PathBuf;

/// What is to be compared.
pub(super) enum Request {
    Pair { files: [FileInUnit; 2], question: Question },
    Check { files: Vec<PathBuf>, options: Box<CheckOptions> },
    Info { file: PathBuf, options: InfoOptions },
}

/// A file, and the unit of its coordinates, if that is given, whatever the file states.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(super) struct FileInUnit {
    pub(super) path: PathBuf,
    pub(super) unit: Option<Unit>,
}

/// The command of a pair, with its checked options.
pub(super) enum Question {
    Distance(Box<DistanceOptions>),
    Diff(DiffOptions),
    Clearance(ClearanceOptions),
    Score(Box<ScoreOptions>),
    Align(Box<BestFitOptions>),
    Statistics(StatisticsOptions),
    Overlap(OverlapOptions),
    Gaps(GapOptions),
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
            // The result states the limit, by which nothing is judged.
            Self::Statistics(_) => ("statistics", None, None),
            Self::Overlap(_) => ("overlap", None, None),
            Self::Gaps(_) => ("gaps", None, None),
        };
        let is_judged = match self {
            Self::Diff(_) | Self::Align(_) => true,
            Self::Score(options) => !options.at_least.is_empty() || !options.at_most.is_empty(),
            _ => limit.is_some(),
        };
        let verdict = if is_whole { verdict } else { Verdict::Undecided };
        let is_judged =
            is_judged || matches!(self, Self::Overlap(_) | Self::Gaps(_)) && verdict == Verdict::Undecided;
        Asked { command, verdict: is_judged.then_some(verdict), limit, symmetric }
    }
}

/// The keys of a line that are no options.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Line {
    id: Value,
    a: Option<PathBuf>,
    b: Option<PathBuf>,
    unit_of_a: Option<Unit>,
    unit_of_b: Option<Unit>,
    files: Option<Vec<PathBuf>>,
    #[serde(default)]
    command: CommandName,
    transform: Option<Motion>,
    #[serde(flatten)]
    options: Named,
}

/// Options by their names, each given once.
struct Named(Map<String, Value>);

impl<'de> Deserialize<'de> for Named {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        struct Once;

        impl<'de> Visitor<'de> for Once {
            type Value = Named;

            fn expecting(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("options by their names")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut given: A) -> std::result::Result<Named, A::Error> {
                let mut options = Map::new();
                while let Some((name, value)) = given.next_entry::<String, Value>()? {
                    if options.contains_key(&name) {
                        return Err(A::Error::custom(format!("duplicate field `{name}`")));
                    }
                    options.insert(name, value);
                }
                Ok(Named(options))
            }
        }

        deserializer.deserialize_map(Once)
    }
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
    Statistics,
    Overlap,
    Gaps,
    Check,
    Info,
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
    let question: fn(PairOptions) -> Result<Question> = match line.command {
        CommandName::Check => return check(line, max_seconds),
        CommandName::Info => return info(line),
        CommandName::Distance => distance,
        CommandName::Align => |options| Ok(Question::Align(Box::new(options.placed()?))),
        CommandName::Diff => |options| Ok(Question::Diff(options.placed()?)),
        CommandName::Clearance => |options| Ok(Question::Clearance(options.placed()?)),
        CommandName::Score => |options| Ok(Question::Score(Box::new(options.placed()?))),
        CommandName::Statistics => |options| Ok(Question::Statistics(options.placed()?)),
        CommandName::Overlap => |options| Ok(Question::Overlap(options.placed()?)),
        CommandName::Gaps => |options| Ok(Question::Gaps(options.placed()?)),
    };
    pair(line, max_seconds, question)
}

fn check(line: Line, max_seconds: Option<f64>) -> Result<Request> {
    let Some(files) = line.files_alone() else { return Err(no_files("check", "`files`")) };
    let mut options: CheckOptions = named(line.options.0)?;
    options.max_seconds = options.max_seconds.or(max_seconds);
    options.validate()?;
    Ok(Request::Check { files, options: Box::new(options) })
}

fn info(line: Line) -> Result<Request> {
    match line.files_alone().map(<[PathBuf; 1]>::try_from) {
        Some(Ok([file])) => Ok(Request::Info { file, options: named(line.options.0)? }),
        _ => Err(no_files("info", "one of `files`")),
    }
}

impl Line {
    /// Whether a unit of a file is given.
    fn has_unit(&self) -> bool {
        self.unit_of_a.is_some() || self.unit_of_b.is_some()
    }

    /// Returns `files`, if nothing of a pair is given.
    fn files_alone(&self) -> Option<Vec<PathBuf>> {
        let is_of_pair = self.a.is_some() || self.b.is_some() || self.transform.is_some() || self.has_unit();
        self.files.clone().filter(|_| !is_of_pair)
    }
}

fn pair(
    mut line: Line,
    max_seconds: Option<f64>,
    question: fn(PairOptions) -> Result<Question>,
) -> Result<Request> {
    if line.files.is_some() {
        return Err(no_pair("`files` are of `check` and `info`"));
    }
    if line.has_unit() {
        // A line with a unit asks for lengths in it.
        line.options.0.entry("scaleUnits").or_insert(Value::Bool(true));
    }
    let file = |path: Option<PathBuf>, unit, name| {
        let path = path.ok_or_else(|| no_pair(format!("missing field `{name}`")))?;
        Ok(FileInUnit { path, unit })
    };
    let files = [file(line.a, line.unit_of_a, "a")?, file(line.b, line.unit_of_b, "b")?];
    let Motion { rotation, translation } = line.transform.unwrap_or_default();
    let transform = RigidTransform::new(DQuat::from_array(rotation), DVec3::from_array(translation))?;
    Ok(Request::Pair {
        files,
        question: question(PairOptions { transform, named: line.options.0, max_seconds })?,
    })
}

/// The options of a line with two files.
struct PairOptions {
    /// The motion of A.
    transform: RigidTransform,
    named: Map<String, Value>,
    /// The budget of searches that state none.
    max_seconds: Option<f64>,
}

impl PairOptions {
    /// Returns the checked options of a command.
    ///
    /// # Errors
    /// Those of [`named`], and of each range.
    fn placed<Q: Query + DeserializeOwned>(self) -> Result<Q> {
        let Self { transform, named: given, max_seconds } = self;
        let question = named::<Q>(given)?.moved(transform).within(max_seconds);
        question.validate()?;
        Ok(question)
    }
}

fn distance(PairOptions { transform, named: given, max_seconds }: PairOptions) -> Result<Question> {
    let named: NamedOptions = named(given)?;
    let options = DistanceOptions::try_from(NamedOptions { transform, ..named })?.within(max_seconds);
    options.validate()?;
    Ok(Question::Distance(Box::new(options)))
}

fn no_files(command: &str, files: &str) -> Error {
    no_pair(format!("`{command}` has {files}, and neither `a`, `b`, their units nor `transform`"))
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
