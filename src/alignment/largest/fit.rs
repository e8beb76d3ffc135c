//! The fit in the largest distance near a pose: linear programs within a distance that adapts.

use super::program::{Row, solve, without_idle};
use crate::alignment::field::{Field, Place, Residual, residuals};
use crate::alignment::freedoms::{COORDINATES, Coordinates, Freedoms};
use crate::alignment::mean::Step;
use crate::alignment::samples::Samples;
use crate::model::RigidTransform;
use crate::rounding::upper_max;
use crate::sorting::sort_by_number;
use glam::DVec3;

/// The number of samples that a step is computed from at first; the farthest of the others join them.
const FIRST_SAMPLES: usize = 1000;

/// The number of samples that join at a time.
const JOINING: usize = 64;

/// The largest number of times that samples join.
const MAX_ROUNDS: usize = 12;

/// The part by which a sample has to be farther than those that count to join them.
const FARTHER: f64 = 1e-4;

/// The first step, in parts of the radius of the samples.
const FIRST_TRUST: f64 = 0.05;

/// The parts of the predicted decrease below and above which steps become shorter and longer.
const POOR: f64 = 0.25;
const GOOD: f64 = 0.75;

/// The predicted decrease that is nothing, as a part of the largest distance.
const LEAST_GAIN: f64 = 1e-7;

/// Bounds on the motion of a fit. A signed distance has no minimum over all motions if A can leave B.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reach {
    /// The pose from which angle and shift are measured.
    pub(crate) from: RigidTransform,
    /// The largest angle.
    pub(crate) radians: f64,
    /// The largest shift of A's centre.
    pub(crate) shift: f64,
}

impl Reach {
    fn contains(&self, motion: &RigidTransform, center: DVec3) -> bool {
        self.from.rotation().angle_between(motion.rotation()) <= self.radians
            && self.from.apply(center).distance(motion.apply(center)) <= self.shift
    }
}

/// The state of a fit.
pub(crate) struct LargestFit<F> {
    field: F,
    pub(crate) points: Vec<DVec3>,
    counted: Vec<DVec3>,
    center: DVec3,
    pub(crate) radius: f64,
    freedoms: Freedoms,
    pub(crate) motion: RigidTransform,
    reach: Option<Reach>,
    residuals: Vec<Residual>,
    places: Vec<Place>,
    largest: f64,
    trust: f64,
    smallest: f64,
    rounds: usize,
}

impl<F: Field> LargestFit<F> {
    const ROWS_OF_A_SAMPLE: usize = if F::SIGNED { 1 } else { 2 };

    /// Starts from a pose; `None` for a field or samples without points. A step below `smallest` ends the fit.
    pub(crate) fn new(
        field: F,
        samples: &Samples,
        freedoms: &Freedoms,
        smallest: f64,
        motion: RigidTransform,
    ) -> Option<Self> {
        let extent = samples.extent();
        let radius = if extent > 0.0 { extent } else { 1.0 };
        let mut fit = Self {
            field,
            points: samples.points.clone(),
            counted: samples.thinned(FIRST_SAMPLES).points,
            center: samples.center,
            radius,
            freedoms: freedoms.clone(),
            motion,
            reach: None,
            residuals: Vec::new(),
            places: Vec::new(),
            largest: f64::INFINITY,
            trust: FIRST_TRUST * radius,
            smallest,
            rounds: 0,
        };
        fit.join()?;
        Some(fit)
    }

    /// Takes no step out of these bounds.
    pub(crate) fn within(self, reach: Reach) -> Self {
        Self { reach: Some(reach), ..self }
    }

    /// Returns the centre of turns.
    pub(crate) fn center(&self) -> DVec3 {
        self.freedoms.center_of(&self.motion, self.center)
    }

    /// Returns the largest distance of the samples that count, or their largest height.
    pub(crate) fn largest(&self) -> f64 {
        self.largest
    }

    /// Lets points of A, in its own frame, count from now on.
    pub(crate) fn add(&mut self, point: DVec3) -> Option<()> {
        self.points.push(point);
        self.counted.push(point);
        self.trust = FIRST_TRUST * self.radius;
        self.rounds = 0;
        self.measure()
    }

    fn measure(&mut self) -> Option<()> {
        (self.residuals, self.places) = residuals(&self.field, &self.counted, &self.places, &self.motion)?;
        self.largest = Self::largest_of(&self.residuals)?;
        Some(())
    }

    /// Measures all samples; the farthest count from now on. Returns whether any joined.
    fn join(&mut self) -> Option<bool> {
        self.rounds += 1;
        self.measure()?;
        let (all, _) = residuals(&self.field, &self.points, &[], &self.motion)?;
        let limit = self.largest + FARTHER * self.largest.abs() + self.smallest;
        let mut far: Vec<(f64, DVec3)> = all
            .iter()
            .zip(&self.points)
            .map(|(residual, &point)| (Self::length(residual), point))
            .filter(|(distance, _)| *distance > limit)
            .collect();
        sort_by_number(&mut far, |&(distance, _)| -distance);
        let joining = far.into_iter().take(JOINING).map(|(_, point)| point);
        let before = self.counted.len();
        self.counted.extend(joining);
        self.measure()?;
        Some(self.counted.len() > before)
    }

    /// Returns the rows of the program about the pose, two a sample: its distance, and the same with B passed; of a height
    /// the first one alone.
    pub(crate) fn rows(&self) -> Vec<Row> {
        let center = self.center();
        let row = |residual: &Residual| {
            let length = Self::length(residual);
            let direction = residual.direction.unwrap_or_else(|| residual.offset.normalize_or_zero());
            let slope = self.freedoms.slopes(residual.point - center, self.radius, direction);
            let passed = Row { value: -length, slope: slope.map(|value| -value) };
            [Row { value: length, slope }, passed].into_iter().take(Self::ROWS_OF_A_SAMPLE)
        };
        self.residuals.iter().flat_map(row).collect()
    }

    /// Returns what is made least.
    fn length(residual: &Residual) -> f64 {
        if F::SIGNED { residual.height() } else { residual.distance() }
    }

    fn largest_of(residuals: &[Residual]) -> Option<f64> {
        residuals.iter().map(Self::length).reduce(upper_max)
    }

    /// Returns the samples, in A's own frame, of rows, each once and in their order.
    pub(crate) fn points_of(&self, rows: &[usize]) -> Vec<DVec3> {
        let mut known = Vec::new();
        for index in rows.iter().map(|row| row / Self::ROWS_OF_A_SAMPLE) {
            if !known.contains(&index) {
                known.push(index);
            }
        }
        known.into_iter().map(|index| self.counted[index]).collect()
    }

    /// Takes one step; none raises the largest distance of the samples that count.
    pub(crate) fn advance(&mut self) -> Step {
        let mut half: Coordinates = [0.0; COORDINATES];
        half[..self.freedoms.count()].fill(self.trust);
        let rows = self.rows();
        let Some(solution) = solve(&rows, &half) else { return Step::Converged };
        let predicted = self.largest - solution.value;
        if !(predicted > LEAST_GAIN * self.largest.abs()) || self.trust < self.smallest {
            return match self.rounds < MAX_ROUNDS && self.join() == Some(true) {
                true => Step::Better,
                false => Step::Converged,
            };
        }
        let step = without_idle(&rows, solution.step);
        let motion = self.freedoms.followed(&self.motion, &step, (self.center(), self.radius));
        if self.reach.is_some_and(|reach| !reach.contains(&motion, self.center)) {
            self.trust *= 0.25;
            return Step::Shorter;
        }
        let next = residuals(&self.field, &self.counted, &self.places, &motion);
        let Some((found, places)) = next else { return Step::Converged };
        let gained = self.largest - Self::largest_of(&found).unwrap_or(f64::INFINITY);
        if gained < POOR * predicted {
            self.trust *= 0.25;
        } else if gained > GOOD * predicted {
            self.trust *= 2.0;
        }
        if !(gained > 0.0) {
            return Step::Shorter;
        }
        (self.motion, self.residuals, self.places) = (motion, found, places);
        self.largest -= gained;
        Step::Better
    }
}
