//! The command `summary`: means and medians of the scores of a data set, as intervals that hold them.
//!
//! A mean of numbers lies between the means of their lower and of their upper bounds, and so does a median:
//! both rise with each number.

use crate::arguments::score::{SummaryArguments, SummaryFormat};
use crate::failure::Failure;
use crate::input::STANDARD_STREAM;
use crate::output::digits::{interval, number};
use crate::output::json::{Head, print_json};
use crate::output::print;
use nurbs_hausdorff::{Error, Interval, ScoreNumber};
use serde::{Deserialize, Serialize};
use std::fmt::Write;
use std::io::{BufRead, BufReader, Read};

/// A line of the answers, with what a summary takes of it.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Answer {
    error: Option<serde::de::IgnoredAny>,
    candidate: Option<OfModel>,
    volume: Option<Compared>,
    area: Option<Compared>,
    centroid_distance: Option<Ends>,
    extent_differences: Option<[Ends; 3]>,
    #[serde(default)]
    thresholds: Vec<AtThreshold>,
    chamfer: Option<Ends>,
    chamfer_squared: Option<Ends>,
    hausdorff: Option<Hausdorff>,
    iou: Option<Ends>,
}

#[derive(Deserialize)]
struct OfModel {
    valid: Ends,
}

#[derive(Deserialize)]
struct Compared {
    ratio: Ends,
}

#[derive(Deserialize)]
struct AtThreshold {
    precision: Ends,
    recall: Ends,
    f1: Ends,
    #[serde(rename = "normalPrecision")]
    normal_precision: Option<Ends>,
    #[serde(rename = "normalRecall")]
    normal_recall: Option<Ends>,
    #[serde(rename = "normalF1")]
    normal_f1: Option<Ends>,
    #[serde(rename = "edgePrecision")]
    edge_precision: Option<Ends>,
    #[serde(rename = "edgeRecall")]
    edge_recall: Option<Ends>,
    #[serde(rename = "edgeF1")]
    edge_f1: Option<Ends>,
}

#[derive(Deserialize)]
struct Hausdorff {
    distance: Ends,
}

/// The ends of an interval; null stands for infinity, which JSON does not have.
#[derive(Clone, Copy, Deserialize)]
struct Ends {
    lower: Option<f64>,
    upper: Option<f64>,
}

impl From<Ends> for Interval {
    fn from(Ends { lower, upper }: Ends) -> Self {
        Self { lower: lower.unwrap_or(f64::NEG_INFINITY), upper: upper.unwrap_or(f64::INFINITY) }
    }
}

impl Answer {
    /// Returns a number at the least threshold, if the answer has it.
    fn number(&self, number: ScoreNumber) -> Option<Interval> {
        let at = self.thresholds.first();
        let found = match number {
            ScoreNumber::Valid => self.candidate.as_ref()?.valid,
            ScoreNumber::VolumeRatio => self.volume.as_ref()?.ratio,
            ScoreNumber::AreaRatio => self.area.as_ref()?.ratio,
            ScoreNumber::CentroidDistance => self.centroid_distance?,
            ScoreNumber::ExtentDifference => largest(self.extent_differences?),
            ScoreNumber::Precision => at?.precision,
            ScoreNumber::Recall => at?.recall,
            ScoreNumber::F1 => at?.f1,
            ScoreNumber::NormalPrecision => at?.normal_precision?,
            ScoreNumber::NormalRecall => at?.normal_recall?,
            ScoreNumber::NormalF1 => at?.normal_f1?,
            ScoreNumber::EdgePrecision => at?.edge_precision?,
            ScoreNumber::EdgeRecall => at?.edge_recall?,
            ScoreNumber::EdgeF1 => at?.edge_f1?,
            ScoreNumber::Chamfer => self.chamfer?,
            ScoreNumber::ChamferSquared => self.chamfer_squared?,
            ScoreNumber::Hausdorff => self.hausdorff.as_ref()?.distance,
            ScoreNumber::Iou => self.iou?,
            _ => return None,
        };
        Some(found.into())
    }
}

/// Returns the interval of the largest of numbers.
fn largest(of: [Ends; 3]) -> Ends {
    let largest = |ends: [Option<f64>; 3]| {
        ends.into_iter().reduce(|one, other| Some(if one? > other? { one? } else { other? })).flatten()
    };
    Ends { lower: largest(of.map(|one| one.lower)), upper: largest(of.map(|one| one.upper)) }
}

/// What a data set says.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Summary {
    #[serde(flatten)]
    head: Head,
    command: &'static str,
    /// The number of pairs.
    pairs: usize,
    /// The number of pairs without a score.
    errors: usize,
    /// The part of all pairs without a score or whose candidate is not valid.
    invalid_ratio: Interval,
    numbers: Vec<OfNumber>,
}

/// The mean and the median of a number over the pairs that have it.
#[derive(Serialize)]
struct OfNumber {
    number: ScoreNumber,
    pairs: usize,
    mean: Interval,
    median: Interval,
}

/// Summarizes the answers and prints that.
pub(crate) fn run(arguments: &SummaryArguments) -> Result<(), Failure> {
    let answers = answers(arguments)?;
    let summary = Summary::new(&answers);
    match arguments.format {
        SummaryFormat::Json => print_json(&summary),
        SummaryFormat::Text => print(&summary.text()),
        SummaryFormat::Csv => print(&summary.csv()),
        SummaryFormat::Latex => print(&summary.latex()),
    }
}

fn answers(arguments: &SummaryArguments) -> Result<Vec<Answer>, Failure> {
    let path = &arguments.answers;
    let unreadable = |error: std::io::Error| Error::FileUnreadable {
        path: path.display().to_string(),
        found: error.to_string(),
    };
    let input: Box<dyn Read> = match path.as_os_str() == STANDARD_STREAM {
        true => Box::new(std::io::stdin()),
        false => Box::new(std::fs::File::open(path).map_err(unreadable)?),
    };
    let mut answers = Vec::new();
    for (index, line) in BufReader::new(input).lines().enumerate() {
        let line = line.map_err(unreadable)?;
        if line.trim().is_empty() {
            continue;
        }
        let answer: Answer = serde_json::from_str(&line).map_err(|error| wrong(index, &error.to_string()))?;
        if answer.error.is_none() && answer.candidate.is_none() {
            return Err(wrong(index, "it is no score"));
        }
        answers.push(answer);
    }
    if answers.is_empty() {
        return Err(Error::OptionInvalid { found: "found no answers".to_owned() }.into());
    }
    Ok(answers)
}

fn wrong(index: usize, why: &str) -> Failure {
    let found = format!("line {} is no answer of command score: {why}", index + 1);
    Error::OptionInvalid { found }.into()
}

impl Summary {
    fn new(answers: &[Answer]) -> Self {
        let invalid: Vec<Interval> = answers.iter().map(invalid).collect();
        let numbers = ScoreNumber::ALL.into_iter().filter(|&number| number != ScoreNumber::Valid);
        let of_number = |number| {
            let found: Vec<Interval> = answers.iter().filter_map(|answer| answer.number(number)).collect();
            let pairs = found.len();
            (pairs > 0).then(|| OfNumber { number, pairs, mean: mean(&found), median: median(&found) })
        };
        Self {
            head: Head::new(),
            command: "summary",
            pairs: answers.len(),
            errors: answers.iter().filter(|answer| answer.error.is_some()).count(),
            invalid_ratio: mean(&invalid),
            numbers: numbers.filter_map(of_number).collect(),
        }
    }

    fn text(&self) -> String {
        let Self { pairs, errors, invalid_ratio, .. } = self;
        let mut out = format!("{pairs} pairs, {errors} without a score, invalid {}\n", ends(invalid_ratio));
        for OfNumber { number, pairs, mean, median } in &self.numbers {
            let (name, mean, median) = (number.name(), ends(mean), ends(median));
            // Writing to a string does not fail.
            let _ = writeln!(out, "{name:<17} mean {mean}, median {median}, of {pairs} pairs");
        }
        out
    }

    fn csv(&self) -> String {
        let mut out = "number,mean_lower,mean_upper,median_lower,median_upper,pairs\n".to_owned();
        let Interval { lower, upper, .. } = self.invalid_ratio;
        let _ = writeln!(out, "invalidRatio,{},{},,,{}", number(lower), number(upper), self.pairs);
        for OfNumber { number: name, pairs, mean, median } in &self.numbers {
            let ends = [mean.lower, mean.upper, median.lower, median.upper].map(number).join(",");
            let _ = writeln!(out, "{name},{ends},{pairs}");
        }
        out
    }

    fn latex(&self) -> String {
        let mut out =
            "\\begin{tabular}{lrrr}\n\\hline\nnumber & mean & median & pairs \\\\\n\\hline\n".to_owned();
        let _ = writeln!(out, "invalid ratio & {} & & {} \\\\", math(&self.invalid_ratio), self.pairs);
        for OfNumber { number, pairs, mean, median } in &self.numbers {
            let (mean, median) = (math(mean), math(median));
            let _ = writeln!(out, "{} & {mean} & {median} & {pairs} \\\\", words(number.name()));
        }
        out + "\\hline\n\\end{tabular}\n"
    }
}

/// Returns 1 for a pair without a score or with a candidate that is not valid, else 0.
fn invalid(answer: &Answer) -> Interval {
    // Each end is 0 or 1, so that its difference from 1 is exact.
    let not = |valid: Interval| Interval { lower: 1.0 - valid.upper, upper: 1.0 - valid.lower };
    answer.number(ScoreNumber::Valid).map_or(Interval::exactly(1.0), not)
}

fn mean(of: &[Interval]) -> Interval {
    let sum = of.iter().copied().reduce(|one, other| one + other).unwrap_or_default();
    sum.over(Interval::exactly(of.len() as f64))
}

fn median(of: &[Interval]) -> Interval {
    let sorted = |end: fn(&Interval) -> f64| {
        let mut ends: Vec<f64> = of.iter().map(end).collect();
        ends.sort_by(f64::total_cmp);
        ends
    };
    let (lowers, uppers) = (sorted(|one| one.lower), sorted(|one| one.upper));
    let at = |index: usize| Interval { lower: lowers[index], upper: uppers[index] };
    let middle = of.len() / 2;
    if of.len() % 2 == 1 { at(middle) } else { mean(&[at(middle - 1), at(middle)]) }
}

fn ends(of: &Interval) -> String {
    format!("({})", interval([of.lower, of.upper]))
}

/// Returns an interval in LaTeX, its ends rounded outwards.
fn math(of: &Interval) -> String {
    let text = interval([of.lower, of.upper]).replace(" … ", ", ").replace("inf", "\\infty");
    format!("$[{text}]$")
}

/// Returns a name in camelCase as words.
fn words(name: &str) -> String {
    name.chars()
        .flat_map(|one| [one.is_uppercase().then_some(' '), Some(one.to_ascii_lowercase())])
        .flatten()
        .collect()
}
