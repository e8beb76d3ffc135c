//! The interval of the least largest distance of A's points over a box of motions.

use super::clear::ToModel;
use super::one_side::OneSide;
use crate::alignment::{
    BoxSearch, Cell, Chart, Clearance, Contacts, Field, Freedoms, Goal, LargestFit, Reach, Step, contacts,
};
use crate::engine::options::at_least_zero;
use crate::engine::section::Section;
use crate::engine::{CertifiedOptions, DistanceOptions, Engine, Method, PreparedModel};
use crate::error::{Error, Result};
use crate::facets::facet_rounding;
use crate::flatness::MAX_HALVINGS;
use crate::model::RigidTransform;
use crate::progress::Progress;
use crate::rounding::{upper_max, upper_min};
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// The width of a zone that counts as proven, as a part of its upper bound.
const PROVEN_WIDTH: f64 = 0.01;

/// The width of the distance of the pose found, as a part of the largest distance of the samples.
const DISTANCE_WIDTH: f64 = 0.005;

/// The part by which the distance of all of A has to exceed that of the samples for its farthest point to join them.
const BEYOND_SAMPLES: f64 = 0.01;

/// The largest number of farthest points that join the samples.
const MAX_JOINED: usize = 6;

/// The cells that the distance of a pose may take: that of the pose found is an upper bound with any.
const DISTANCE_CELLS: usize = 2_000_000;

/// The largest number of points whose distances bound those of other poses.
const MOST_CONTACTS: usize = 96;

/// The angle of the box unless the options name another, in degrees.
const DEFAULT_DEGREES: f64 = 1.0;

/// The shift of the box unless the options name another, as a part of the diagonal.
const DEFAULT_TRANSLATION: f64 = 0.01;

/// The largest angle: what curved motions take off is then many times what they move.
const MAX_DEGREES: f64 = 45.0;

/// The largest number of boxes unless the options name another: some seconds.
const DEFAULT_BOXES: usize = 5000;

/// The motions over which the least largest distance is bounded; names in camelCase when deserialized.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct ZoneOptions {
    /// The largest shift from the pose found, in model units, 0 or more; a hundredth of the larger diagonal if
    /// none is given.
    pub translation: Option<f64>,
    /// The largest angle from the pose found, in degrees, 0 to 45; 1 by default.
    pub degrees: f64,
    /// The distance that the verdict is about, in model units; 0 or more unless the norm is of one side.
    pub limit: Option<f64>,
    /// The largest number of boxes of motions that are bounded, at least 1.
    pub max_boxes: usize,
}

impl Default for ZoneOptions {
    fn default() -> Self {
        Self { translation: None, degrees: DEFAULT_DEGREES, limit: None, max_boxes: DEFAULT_BOXES }
    }
}

impl ZoneOptions {
    /// Returns the bounds on a fit on one side that starts from a fit in the mean with this largest distance.
    ///
    /// The shift is that of the box and twice the largest distance, because the fit in the mean of points within a body may
    /// be off by that. The angle is the largest one that a box may have, because the fit in the mean may turn such points
    /// to the boundary.
    pub(super) fn reach(&self, from: RigidTransform, largest: f64, diagonal: f64) -> Reach {
        let shift = self.shift(diagonal) + 2.0 * largest;
        Reach { from, radians: MAX_DEGREES.to_radians(), shift }
    }

    /// Returns the largest shift of the box.
    fn shift(&self, diagonal: f64) -> f64 {
        self.translation.unwrap_or(DEFAULT_TRANSLATION * diagonal)
    }

    /// `signed` distances may have a limit below 0.
    pub(super) fn validate(&self, signed: bool) -> Result<()> {
        match self.limit {
            Some(limit) if signed && limit.is_finite() => {}
            limit => at_least_zero("limit", limit.unwrap_or(0.0))?,
        }
        at_least_zero("translation", self.translation.unwrap_or(0.0))?;
        at_least_zero("degrees", self.degrees)?;
        if self.degrees > MAX_DEGREES {
            return Err(Error::out_of_range("degrees", self.degrees, "0 to 45"));
        }
        if self.max_boxes == 0 {
            return Err(Error::out_of_range("maxBoxes", 0, "at least 1"));
        }
        Ok(())
    }
}

/// The least, over a box of motions, of the largest distance of A's points to B, as an interval. With a norm of one side
/// distances are signed, and the interval is below 0 if all points can lie on the other side.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct Zone {
    /// No motion of the box brings all of A's points nearer to B than this.
    pub lower: f64,
    /// In the pose found no point of A is farther from B than this.
    pub upper: f64,
    /// The box: turns by up to this angle about `center`, in degrees, from the pose found …
    pub degrees: f64,
    /// … followed by shifts of up to this length; both only in the freedoms that datums leave.
    pub translation: f64,
    /// The centre of the turns, in the frame of B.
    pub center: [f64; 3],
    /// The number of boxes of motions that were bounded.
    pub boxes: usize,
    /// The number of bounds that the audit refuted: points of A are nearer than that in a motion of the box. They were
    /// not relied on; there are none, unless the library has a fault.
    pub refuted: usize,
    /// Whether some motion of the box brings all of A within the limit; `None` without a limit, and where
    /// it lies between the bounds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub passes: Option<bool>,
}

impl Zone {
    /// Returns whether the interval is narrow; `exact` is a length that is rounding.
    pub(super) fn is_proven(&self, exact: f64) -> bool {
        self.upper - self.lower <= upper_max(PROVEN_WIDTH * self.upper.abs(), exact)
    }
}

/// The pair of a fit in the largest distance.
pub(super) struct ZonePair<'a> {
    pub(super) a: &'a PreparedModel,
    pub(super) b: &'a PreparedModel,
    pub(super) to: To<'a>,
    pub(super) diagonal: f64,
    pub(super) options: &'a ZoneOptions,
    pub(super) max_steps: usize,
}

/// The model from which distances are measured.
pub(super) enum To<'a> {
    Both(ToModel<'a>),
    /// One side, with the points of A.
    One(OneSide<'a>, Vec<DVec3>),
}

impl To<'_> {
    fn gap(&self) -> f64 {
        match self {
            Self::Both(to) | Self::One(OneSide { to, .. }, _) => to.gap,
        }
    }
}

/// A fit that has ended.
pub(super) struct LargestFound {
    pub(super) motion: RigidTransform,
    pub(super) zone: Zone,
    pub(super) steps: usize,
    pub(super) ended: bool,
}

impl ZonePair<'_> {
    /// Fits, then measures the distance of all of A; where that is beyond the samples', its farthest point joins
    /// them and the fit goes on. Then bounds all poses of the box.
    pub(super) async fn fit(
        &self,
        mut fit: LargestFit<impl Field>,
        freedoms: &Freedoms,
        progress: &mut Progress<'_>,
    ) -> Result<LargestFound> {
        let (mut steps, mut ended) = (0, false);
        let mut best: Option<(f64, RigidTransform)> = None;
        for _ in 0..=MAX_JOINED {
            ended = false;
            while !ended && steps < self.max_steps {
                ended = fit.advance() == Step::Converged;
                steps += usize::from(!ended);
                progress.checkpoint(0.0).await?;
            }
            let (upper, farthest) = match &self.to {
                To::Both(_) => self.distance(&fit, progress).await?,
                To::One(side, points) => self.on_one_side(side, points, &fit.motion)?,
            };
            if best.is_none_or(|(known, _)| upper < known) {
                best = Some((upper, fit.motion));
            }
            let largest = fit.largest();
            let is_beyond = upper > largest + BEYOND_SAMPLES * largest.abs() + self.to.gap();
            if !is_beyond || fit.add(farthest).is_none() {
                break;
            }
        }
        let (upper, motion) = best.ok_or(Error::EmptyModel)?;
        fit.motion = motion;
        let chart =
            Chart { base: motion, freedoms: freedoms.clone(), center: fit.center(), radius: fit.radius };
        let zone = match &self.to {
            To::Both(to) => self.bounded(to, &chart, &fit, upper, progress).await?,
            To::One(side, _) => self.bounded(side, &chart, &fit, upper, progress).await?,
        };
        Ok(LargestFound { motion, zone, steps, ended })
    }

    /// Returns an upper bound on the largest distance on one side of the points of A under a motion, and the point.
    fn on_one_side(
        &self,
        side: &OneSide<'_>,
        points: &[DVec3],
        motion: &RigidTransform,
    ) -> Result<(f64, DVec3)> {
        let (upper, index) = side.largest(points, motion).ok_or(Error::EmptyModel)?;
        Ok((upper + self.error_of(points, motion), points[index]))
    }

    /// Measures the distance of all of A in the pose of a fit; returns an upper bound, and the farthest point as A's own.
    async fn distance(
        &self,
        fit: &LargestFit<impl Field>,
        progress: &mut Progress<'_>,
    ) -> Result<(f64, DVec3)> {
        let budget = CertifiedOptions { max_cells: Some(DISTANCE_CELLS), ..CertifiedOptions::default() };
        let options = DistanceOptions {
            method: Method::Certified(budget),
            tolerance: Some(upper_max(self.to.gap(), DISTANCE_WIDTH * fit.largest())),
            transform: fit.motion,
            ..DistanceOptions::default()
        };
        let mut section = Section { whole: progress.monitor(), part: [super::SEARCH_SHARE, 0.0] };
        let found = Engine::cpu().distance_of(self.a, self.b, &options, &mut section).await?;
        Ok((found.upper, fit.motion.apply_inverse(found.witness.a.point.into())))
    }

    /// Bounds all poses of the box.
    async fn bounded<C: Clearance>(
        &self,
        clearance: &C,
        chart: &Chart,
        fit: &LargestFit<impl Field>,
        upper: f64,
        progress: &mut Progress<'_>,
    ) -> Result<Zone> {
        let ZoneOptions { degrees, limit, max_boxes, .. } = *self.options;
        let translation = self.options.shift(self.diagonal);
        let cell = chart.cell(degrees.to_radians() * (1.0 + f64::EPSILON), translation);
        let chosen = contacts(&fit.rows(), &cell.half);
        let mut points = fit.points_of(&chosen);
        points.truncate(MOST_CONTACTS);
        let width = PROVEN_WIDTH * upper.abs();
        let contacts = Contacts {
            chart,
            clearance,
            error: self.error_of(&points, &chart.base),
            points: &points,
            largest_ball: 4.0 * self.diagonal,
            width: upper_max(self.to.gap(), width),
        };
        let floor = if C::SIGNED { -self.farthest(&points, chart, &cell) } else { 0.0 };
        let narrow = upper - width;
        let decided = limit.filter(|&limit| upper > limit).map(f64::next_up);
        let goal = Goal { lower: decided.unwrap_or(narrow), most_cells: max_boxes };
        let mut search = BoxSearch::new(contacts, cell, floor);
        while upper > floor + self.to.gap() && !search.advance(goal) {
            progress.checkpoint(search.cells() as f64 / max_boxes as f64).await?;
        }
        search.audit();
        let lower = upper_min(upper, search.lower());
        let passes = limit.and_then(|limit| match () {
            () if upper <= limit => Some(true),
            () if lower > limit => Some(false),
            () => None,
        });
        let center = chart.center.to_array();
        let (boxes, refuted) = (search.cells(), search.refuted());
        Ok(Zone { lower, upper, degrees, translation, center, boxes, refuted, passes })
    }

    /// Returns a coarse upper bound on the distances of points from B under the motions of a cell: the distance from the
    /// middle of B's box, the diagonal of the box, and twice the movement.
    fn farthest(&self, points: &[DVec3], chart: &Chart, cell: &Cell) -> f64 {
        let of_b = self.b.bounding_box();
        let image = |&point: &DVec3| {
            let image = chart.base.apply(point);
            let arm = (image - chart.center).length() / chart.radius;
            let moved: f64 = cell.half.iter().map(|half| half * (1.0 + arm)).sum();
            (image - of_b.center()).length() + 2.0 * moved
        };
        points.iter().map(image).fold(0.0, upper_max) + of_b.diagonal()
    }

    /// Returns an upper bound on the distance of computed points from those of A that they stand for: samples,
    /// and points of the pose found that were moved back.
    fn error_of(&self, points: &[DVec3], motion: &RigidTransform) -> f64 {
        let length = points.iter().map(|point| point.length()).fold(0.0, upper_max);
        let of_points = match self.a.facets() {
            Some(facets) => facets.error + facets.point_error().after(MAX_HALVINGS) + facet_rounding(length),
            None => self.a.bezier().point_error.after(MAX_HALVINGS),
        };
        let moved = length + motion.offset().length();
        of_points + motion.rounding(length) + motion.rounding(moved)
    }
}
