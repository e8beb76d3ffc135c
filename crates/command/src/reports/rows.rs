//! The rows of a report, a pair of files each.

use super::{Answer, Verdict};
use crate::output::json::{Head, Reason};
use serde::Serialize;
use serde::ser::{SerializeStruct, Serializer};

/// All pairs of a call.
#[derive(Debug, Serialize)]
pub(crate) struct Rows {
    #[serde(flatten)]
    head: Head,
    /// The command that compared them.
    pub(crate) command: &'static str,
    /// That of all pairs, by which the call ends.
    #[serde(skip)]
    pub(crate) verdict: Verdict,
    /// The same; none where nothing was judged.
    #[serde(rename = "verdict")]
    stated: Option<Verdict>,
    /// What was compared, as given.
    pub(crate) a: String,
    /// What it was compared with, as given; empty where bodies of one side are compared with each other.
    pub(crate) b: String,
    #[serde(rename = "pairs")]
    pub(crate) rows: Vec<Row>,
    /// What the caller states of the comparison, for people: terms with their texts.
    #[serde(skip)]
    pub(crate) fields: Vec<(&'static str, String)>,
}

/// A pair of files, or a file without a partner.
#[derive(Debug)]
pub(crate) struct Row {
    /// The path relative to both directories, with `/` between its parts; or the path of B.
    pub(crate) path: String,
    pub(crate) outcome: Outcome,
}

/// The end of a comparison.
#[derive(Debug)]
pub(crate) enum Outcome {
    /// It was answered.
    Answered(Box<Answer>),
    /// It failed.
    Failed { code: String, message: String },
    /// The file is in B alone.
    Added,
    /// The file is in A alone.
    Removed,
}

impl Serialize for Row {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut row = serializer.serialize_struct("Row", 3)?;
        row.serialize_field("path", &self.path)?;
        row.serialize_field("state", self.word())?;
        match &self.outcome {
            Outcome::Answered(answer) => row.serialize_field("result", &answer.json)?,
            Outcome::Failed { code, message } => row.serialize_field("error", &Reason { code, message })?,
            Outcome::Added | Outcome::Removed => {}
        }
        row.end()
    }
}

impl Row {
    /// The outcome in a word.
    pub(crate) fn word(&self) -> &str {
        match &self.outcome {
            Outcome::Answered(answer) => &answer.word,
            Outcome::Failed { .. } => "error",
            Outcome::Added => "added",
            Outcome::Removed => "removed",
        }
    }

    /// The outcome in a line.
    pub(crate) fn summary(&self) -> String {
        match &self.outcome {
            Outcome::Answered(answer) => answer.summary.clone(),
            Outcome::Failed { code, message } => format!("{code}: {message}"),
            Outcome::Added => "the file is in B alone".to_owned(),
            Outcome::Removed => "the file is in A alone".to_owned(),
        }
    }

    /// The lines on places.
    pub(crate) fn findings(&self) -> &[String] {
        match &self.outcome {
            Outcome::Answered(answer) => &answer.findings,
            _ => &[],
        }
    }

    /// The verdict on this pair alone.
    pub(crate) fn verdict(&self) -> Verdict {
        match &self.outcome {
            Outcome::Answered(answer) => answer.verdict,
            Outcome::Failed { .. } => Verdict::Error,
            Outcome::Added | Outcome::Removed => Verdict::Failed,
        }
    }

    fn is_judged(&self) -> bool {
        match &self.outcome {
            Outcome::Answered(answer) => answer.judged || answer.limit.is_some(),
            _ => true,
        }
    }

    /// The exit status of this pair alone.
    pub(crate) fn status(&self) -> u8 {
        self.verdict().status()
    }
}

impl Rows {
    pub(crate) fn new(
        command: &'static str,
        [a, b]: [String; 2],
        rows: Vec<Row>,
        fields: [(&'static str, Option<String>); 2],
    ) -> Self {
        let fields = fields.into_iter().filter_map(|(term, text)| Some((term, text?))).collect();
        let verdict = of_all(&rows);
        let stated = (verdict != Verdict::Passed || rows.iter().any(Row::is_judged)).then_some(verdict);
        Self { head: Head::new(), command, verdict, stated, a, b, rows, fields }
    }

    /// The words of all rows with their numbers, in the order of their first row: `3 unchanged, 1 added`.
    pub(crate) fn counts(&self) -> String {
        let mut counts: Vec<(&str, usize)> = Vec::new();
        for row in &self.rows {
            match counts.iter_mut().find(|(word, _)| *word == row.word()) {
                Some((_, count)) => *count += 1,
                None => counts.push((row.word(), 1)),
            }
        }
        let counts: Vec<String> = counts.iter().map(|(word, count)| format!("{count} {word}")).collect();
        counts.join(", ")
    }
}

/// Returns the verdict on a pair that has no answer, else on one that is beyond the limit, was added or
/// removed, else on one that is undecided.
fn of_all(rows: &[Row]) -> Verdict {
    let has = |verdict: &Verdict| rows.iter().any(|row| row.verdict() == *verdict);
    [Verdict::Error, Verdict::Failed, Verdict::Undecided].into_iter().find(has).unwrap_or(Verdict::Passed)
}
