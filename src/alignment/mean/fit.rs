//! The fit in the mean near a pose: damped Newton steps (Levenberg–Marquardt) on the distances.

use super::loss::Loss;
use super::system::System;
use crate::alignment::field::{Field, Place, Residual, residuals};
use crate::alignment::freedoms::Freedoms;
use crate::alignment::samples::Samples;
use crate::model::RigidTransform;
use glam::DVec3;

/// The damping of the first step, relative to unit weights, and how it changes.
const FIRST_DAMPING: f64 = 1e-3;
const DAMPING_FACTOR: f64 = 10.0;

/// The smallest damping: directions from feet are off by 1e-8, and where the samples determine
/// nothing, a step is that error over the damping.
const MIN_DAMPING: f64 = 1e-6;

/// The damping beyond which no shorter step is tried: rounding then decides.
const MAX_DAMPING: f64 = 1e12;

/// The part of the mean square by which a step has to lower it: above its rounding.
const MIN_GAIN: f64 = 1e-12;

/// The least scale of robust weights, in radii of gyration: residuals below it are rounding.
const LEAST_SCALE: f64 = 1e-9;

/// The way in which one step ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Step {
    /// The pose is better.
    Better,
    /// The pose stays, and the next step is shorter.
    Shorter,
    /// A step would be below the tolerance, or has nothing to gain.
    Converged,
}

/// A sample that counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CountedSample {
    /// Where it is in A's own file.
    pub(crate) point: DVec3,
    pub(crate) distance: f64,
    pub(crate) weight: f64,
}

/// The state of a fit.
pub(crate) struct LocalFit<'a, F> {
    field: F,
    samples: &'a Samples,
    freedoms: Freedoms,
    loss: Loss,
    /// The length of a step that ends the fit.
    smallest: f64,
    extent: f64,
    pub(crate) motion: RigidTransform,
    residuals: Vec<Residual>,
    distances: Vec<f64>,
    places: Vec<Place>,
    /// The weights of the samples, 0 of those that do not count where their feet are.
    weights: Vec<f64>,
    damping: f64,
}

impl<'a, F: Field> LocalFit<'a, F> {
    /// Starts from a pose; `None` for a field without points. O(samples) feet.
    pub(crate) fn new(
        field: F,
        samples: &'a Samples,
        loss: Loss,
        smallest: f64,
        motion: RigidTransform,
    ) -> Option<Self> {
        let places = vec![None; samples.points.len()];
        let mut fit = Self {
            field,
            samples,
            freedoms: Freedoms::all(),
            loss,
            smallest,
            extent: samples.extent(),
            motion,
            residuals: Vec::new(),
            distances: Vec::new(),
            places,
            weights: Vec::new(),
            damping: FIRST_DAMPING,
        };
        (fit.residuals, fit.places) = fit.at(&motion)?;
        fit.distances = fit.residuals.iter().map(Residual::distance).collect();
        fit.weights = fit.counted_weights();
        Some(fit)
    }

    fn counted_weights(&self) -> Vec<f64> {
        let of = |(weight, place): (&f64, &Place)| if self.field.is_counted(place) { *weight } else { 0.0 };
        self.samples.weights.iter().zip(&self.places).map(of).collect()
    }

    /// Moves A in these freedoms only.
    pub(crate) fn within(self, freedoms: &Freedoms) -> Self {
        Self { freedoms: freedoms.clone(), ..self }
    }

    /// Returns the point that turns keep.
    fn center(&self) -> DVec3 {
        self.freedoms.center_of(&self.motion, self.samples.center)
    }

    fn at(&self, motion: &RigidTransform) -> Option<(Vec<Residual>, Vec<Place>)> {
        residuals(&self.field, &self.samples.points, &self.places, motion)
    }

    /// The distance beyond which a sample counts as left out here.
    pub(crate) fn scale(&self) -> f64 {
        let least = LEAST_SCALE * self.samples.gyration;
        self.loss.scale(&self.distances, &self.weights, least)
    }

    fn cost(&self, distances: &[f64], scale: f64) -> f64 {
        let parts = distances.iter().zip(&self.weights);
        parts.map(|(&distance, weight)| weight * self.loss.cost(distance, scale)).sum()
    }

    fn system(&self, scale: f64) -> System<'_> {
        let mut system = System::new(&self.freedoms, self.center(), self.samples.gyration);
        for ((residual, &distance), weight) in self.residuals.iter().zip(&self.distances).zip(&self.weights) {
            system.add(residual, weight * self.loss.weight(distance, scale));
        }
        system
    }

    /// Takes one step. No step raises the sum of the loss at the scale of the step, over the samples that count before it.
    pub(crate) fn advance(&mut self) -> Step {
        let scale = self.scale();
        let cost = self.cost(&self.distances, scale);
        let system = self.system(scale);
        let step = system.step(self.damping);
        let length = step.shift.length() + self.extent * step.vector.length();
        if !(length > self.smallest) || !(step.gain > MIN_GAIN * cost) || self.damping > MAX_DAMPING {
            return Step::Converged;
        }
        let motion = self.motion.followed(step.vector, self.center(), step.shift);
        let next = self.at(&motion).map(|(residuals, places)| {
            let distances: Vec<f64> = residuals.iter().map(Residual::distance).collect();
            (residuals, places, distances)
        });
        match next {
            Some((residuals, places, distances)) if self.cost(&distances, scale) < cost => {
                (self.motion, self.residuals) = (motion, residuals);
                (self.places, self.distances) = (places, distances);
                self.weights = self.counted_weights();
                self.damping = (self.damping / DAMPING_FACTOR).max(MIN_DAMPING);
                Step::Better
            }
            _ => {
                self.damping *= DAMPING_FACTOR;
                Step::Shorter
            }
        }
    }

    /// Takes steps until the fit has converged or has taken this many; returns whether it has.
    pub(crate) fn run(&mut self, steps: usize) -> bool {
        (0..steps).any(|_| self.advance() == Step::Converged)
    }

    /// Returns the root mean square of the distances of the samples that count and are not left out, weighted; infinite
    /// where there are none.
    pub(crate) fn rms(&self) -> f64 {
        let scale = self.scale();
        let kept = || self.distances.iter().zip(&self.weights).filter(|(distance, _)| **distance <= scale);
        let total: f64 = kept().map(|(_, weight)| weight).sum();
        let squares: f64 = kept().map(|(distance, weight)| weight * distance * distance).sum();
        if total > 0.0 { (squares / total).sqrt() } else { f64::INFINITY }
    }

    /// Returns the residual by which poses are compared. If a largest distance is set, it is the root mean square of the
    /// distances, each truncated at that distance, so that a pose gains nothing by more samples beyond it. Otherwise it is
    /// [`Self::rms`].
    pub(crate) fn residual(&self) -> f64 {
        let total: f64 = self.weights.iter().sum();
        match self.loss.max_distance {
            Some(most) if total > 0.0 => {
                let squares = self.distances.iter().zip(&self.weights);
                let squares = squares.map(|(&distance, weight)| weight * distance.min(most).powi(2));
                (squares.sum::<f64>() / total).sqrt()
            }
            _ => self.rms(),
        }
    }

    /// Returns the samples.
    pub(crate) fn samples(&self) -> &'a Samples {
        self.samples
    }

    /// Returns the samples that count, with their distances and weights.
    pub(crate) fn counted(&self) -> impl Iterator<Item = CountedSample> + '_ {
        let all = self.samples.points.iter().zip(&self.distances).zip(&self.weights);
        let of = |((&point, &distance), &weight)| CountedSample { point, distance, weight };
        all.map(of).filter(|one| one.weight > 0.0)
    }

    /// Returns the number of independent motions that change no distance to first order.
    pub(crate) fn freedoms(&self) -> usize {
        self.system(self.scale()).freedoms()
    }
}
