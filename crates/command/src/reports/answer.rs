//! The answer to one pair, in words and as JSON.

use nurbs_hausdorff::FaceState;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;

/// How a pair was judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Verdict {
    /// Within the limit, or there was none to judge by.
    Passed,
    /// Beyond the limit.
    Failed,
    /// Neither is certain.
    Undecided,
    /// There is no answer: bad input, bad arguments or a failed machine.
    Error,
}

impl Verdict {
    /// Returns the verdict on what is certainly within a limit, certainly not, or neither.
    pub(crate) fn of(within: Option<bool>) -> Self {
        match within {
            Some(true) => Self::Passed,
            Some(false) => Self::Failed,
            None => Self::Undecided,
        }
    }

    /// The exit status.
    pub(crate) fn status(self) -> u8 {
        match self {
            Self::Passed => 0,
            Self::Failed => 1,
            Self::Error => 2,
            Self::Undecided => 3,
        }
    }
}

impl From<FaceState> for Verdict {
    fn from(state: FaceState) -> Self {
        Self::of(match state {
            FaceState::Unchanged => Some(true),
            FaceState::Changed => Some(false),
            _ => None,
        })
    }
}

/// The answer to one pair.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct Answer {
    pub(crate) verdict: Verdict,
    /// What the verdict is about; without it nothing was judged, unless `judged` says so.
    #[serde(default)]
    pub(crate) limit: Option<f64>,
    /// Whether it was judged without a limit, as clashes are.
    #[serde(default)]
    pub(crate) judged: bool,
    /// The verdict in the command's word, such as `unchanged`.
    pub(crate) word: String,
    /// The answer in one line, without the verdict.
    pub(crate) summary: String,
    /// A line for each place that matters, such as a face that changed.
    pub(crate) findings: Vec<String>,
    /// The lines for people who compare one pair.
    pub(crate) text: String,
    /// Seconds of preparing and searching.
    pub(crate) seconds: f64,
    /// Whether the same call on another machine gives the same verdict: no budget ended the search.
    pub(crate) repeatable: bool,
    /// What `--format json` prints.
    pub(crate) json: Box<RawValue>,
    /// The pictures of the page for browsers, as HTML; empty without any.
    #[serde(default)]
    pub(crate) figures: String,
}
