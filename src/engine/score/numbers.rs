//! The numbers of a score that requirements name.

use crate::interval::Interval;
use serde::{Deserialize, Serialize};
use std::fmt::{Display, Formatter};
use std::str::FromStr;

/// A number of a score by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub enum ScoreNumber {
    /// 1 for a candidate that is closed and oriented, has no copies of faces, and has no body that certainly meets
    /// itself; else 0.
    Valid,
    /// The smaller volume over the larger.
    VolumeRatio,
    /// The smaller area over the larger.
    AreaRatio,
    /// The distance of the centroids.
    CentroidDistance,
    /// The largest difference of extents along the axes.
    ExtentDifference,
    /// The part of the candidate's area within the smallest threshold of the truth.
    Precision,
    /// The part of the truth's area within the smallest threshold of the candidate.
    Recall,
    /// Their harmonic mean.
    F1,
    /// The part of the candidate's area with a like counterpart: a point of the truth within the smallest threshold
    /// whose tangent plane forms at most the permitted angle.
    NormalPrecision,
    /// The part of the truth's area with a like counterpart in the candidate.
    NormalRecall,
    /// Their harmonic mean.
    NormalF1,
    /// The part of the length of the candidate's feature edges within the smallest threshold of the truth's.
    EdgePrecision,
    /// The part of the length of the truth's feature edges within the smallest threshold of the candidate's.
    EdgeRecall,
    /// Their harmonic mean.
    EdgeF1,
    /// The sum of the mean distances of both directions.
    Chamfer,
    /// The sum of the mean squared distances of both directions.
    ChamferSquared,
    /// The Hausdorff distance, that of the farther direction.
    Hausdorff,
    /// The volume of the intersection over that of the union.
    Iou,
}

impl ScoreNumber {
    /// All numbers, in the order of the work.
    pub const ALL: [Self; 18] = [
        Self::Valid,
        Self::VolumeRatio,
        Self::AreaRatio,
        Self::CentroidDistance,
        Self::ExtentDifference,
        Self::Precision,
        Self::Recall,
        Self::F1,
        Self::NormalPrecision,
        Self::NormalRecall,
        Self::NormalF1,
        Self::EdgePrecision,
        Self::EdgeRecall,
        Self::EdgeF1,
        Self::Chamfer,
        Self::ChamferSquared,
        Self::Hausdorff,
        Self::Iou,
    ];

    /// Returns the name, in camelCase.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Valid => "valid",
            Self::VolumeRatio => "volumeRatio",
            Self::AreaRatio => "areaRatio",
            Self::CentroidDistance => "centroidDistance",
            Self::ExtentDifference => "extentDifference",
            Self::Precision => "precision",
            Self::Recall => "recall",
            Self::F1 => "f1",
            Self::NormalPrecision => "normalPrecision",
            Self::NormalRecall => "normalRecall",
            Self::NormalF1 => "normalF1",
            Self::EdgePrecision => "edgePrecision",
            Self::EdgeRecall => "edgeRecall",
            Self::EdgeF1 => "edgeF1",
            Self::Chamfer => "chamfer",
            Self::ChamferSquared => "chamferSquared",
            Self::Hausdorff => "hausdorff",
            Self::Iou => "iou",
        }
    }

    /// Whether the number is a part, from 0 to 1, and larger for a better candidate; else it is a length or
    /// its square, and smaller for a better one.
    #[must_use]
    pub fn is_part(self) -> bool {
        matches!(
            self,
            Self::Valid
                | Self::VolumeRatio
                | Self::AreaRatio
                | Self::Precision
                | Self::Recall
                | Self::F1
                | Self::NormalPrecision
                | Self::NormalRecall
                | Self::NormalF1
                | Self::EdgePrecision
                | Self::EdgeRecall
                | Self::EdgeF1
                | Self::Iou
        )
    }
}

impl Display for ScoreNumber {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.name())
    }
}

impl FromStr for ScoreNumber {
    type Err = String;

    /// Takes words with hyphens, too.
    fn from_str(text: &str) -> Result<Self, String> {
        let plain = |text: &str| text.replace('-', "").to_ascii_lowercase();
        let found = Self::ALL.into_iter().find(|number| plain(number.name()) == plain(text));
        found.ok_or_else(|| {
            let names: Vec<_> = Self::ALL.iter().map(|number| number.name()).collect();
            format!("found the number {text:?}, expected one of {}", names.join(", "))
        })
    }
}

/// What is known of the numbers while the work goes on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Known([Interval; ScoreNumber::ALL.len()]);

impl Known {
    /// What is known of any pair.
    pub(super) fn new() -> Self {
        let upper = |number: ScoreNumber| if number.is_part() { 1.0 } else { f64::INFINITY };
        Self(ScoreNumber::ALL.map(|number| Interval { lower: 0.0, upper: upper(number) }))
    }

    pub(super) fn of(&self, number: ScoreNumber) -> Interval {
        self.0[number as usize]
    }

    /// Narrows what is known of a number; nothing where there is no interval.
    pub(super) fn narrow(&mut self, number: ScoreNumber, found: Option<Interval>) {
        if let Some(found) = found {
            self.0[number as usize] = self.of(number).within(found);
        }
    }

    /// Derives each F1 from its precision and recall, and bounds those with normals by those without.
    pub(super) fn derive(&mut self) {
        let [precision, recall] = [ScoreNumber::Precision, ScoreNumber::Recall].map(|number| self.of(number));
        self.narrow(ScoreNumber::F1, Some(f1(precision, recall)));
        let at_most = |number: Interval| Some(Interval { lower: 0.0, upper: number.upper });
        self.narrow(ScoreNumber::NormalPrecision, at_most(precision));
        self.narrow(ScoreNumber::NormalRecall, at_most(recall));
        let of_normals = f1(self.of(ScoreNumber::NormalPrecision), self.of(ScoreNumber::NormalRecall));
        self.narrow(ScoreNumber::NormalF1, Some(of_normals));
        let of_edges = f1(self.of(ScoreNumber::EdgePrecision), self.of(ScoreNumber::EdgeRecall));
        self.narrow(ScoreNumber::EdgeF1, Some(of_edges));
    }
}

/// Returns the interval of 2 p r / (p + r), 0 for p = r = 0, which rises with both.
pub(super) fn f1(precision: Interval, recall: Interval) -> Interval {
    let at = |p: f64, r: f64| {
        if p > 0.0 && r > 0.0 {
            let [p, r] = [p, r].map(Interval::exactly);
            (Interval::exactly(2.0) * p * r).over(p + r)
        } else {
            Interval::exactly(0.0)
        }
    };
    let (low, high) = (at(precision.lower, recall.lower), at(precision.upper, recall.upper));
    // It is at most twice the smaller one, which holds where products underflow, too.
    let smaller = if recall.upper < precision.upper { recall.upper } else { precision.upper };
    let most = if 2.0 * smaller < 1.0 { 2.0 * smaller } else { 1.0 };
    Interval { lower: low.lower, upper: high.upper }.within(Interval { lower: 0.0, upper: most })
}
