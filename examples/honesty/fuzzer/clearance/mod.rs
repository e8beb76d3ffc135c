//! The check of clearances: random models and real parts at random poses.

mod cloud;
mod inside;
mod poses;
mod subjects;

use super::check::Outcome;
use crate::proof::{self, LeastClaim, Motion, Settings, Verdict, Witness};
use crate::support::evaluator::point;
use fastrand::Rng;
use glam::DVec3;
pub(crate) use inside::Triangles;
use nurbs_hausdorff::internals::engine::Engine;
use nurbs_hausdorff::{ClearanceOptions, ClearanceResult, Overlap, RigidTransform, SurfacePoint};
use poses::Posed;
use std::time::{Duration, Instant};
pub(crate) use subjects::{Subjects, triangles_of};

/// The rounding error of coordinates, the motion's included, relative to the largest one.
const COORDINATE_ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The distance of a witness from the point at its parameters, relative to the largest coordinate:
/// knots are removed where that moves points by less (R15 of docs/rounding.md).
const WITNESS_ROUNDING: f64 = 1024.0 * f64::EPSILON;

/// The time given to the proof of an interval, and its slack relative to the diagonal.
const SETTINGS: Settings = Settings { time: Duration::from_secs(2), slack: 1e-4 };

/// The seeds between two that are proved in interval arithmetic. A proof takes ten times as long as the rest.
const PROVED_EVERY: u64 = 8;

/// The points of each model's faces whose sides are compared.
const SIDES: usize = 4;

/// Checks the clearance of a seed: half are random models, half are shapes and parts.
pub(crate) fn check_clearance(seed: u64, subjects: &Subjects) -> Outcome {
    let rng = &mut Rng::with_seed(seed);
    let posed =
        if seed.is_multiple_of(2) { poses::random(seed, rng) } else { poses::of_subjects(rng, subjects) };
    let Some(posed) = posed else {
        return Outcome { refusal: Some("NOT_DRAWN"), ..Outcome::default() };
    };
    let started = Instant::now();
    let engine = Engine::cpu();
    let result = engine.clearance(&posed.a.prepared, &posed.b.prepared, &posed.options).wait();
    let result = match result {
        Ok(result) => result,
        Err(error) => {
            let violations = vec![format!("seed {seed} ({}): {error}", posed.name())];
            return Outcome { refusal: Some(error.code()), violations, ..Outcome::default() };
        }
    };
    let seconds = started.elapsed().as_secs_f64();
    let mut check = Check { posed: &posed, result: &result, violations: Vec::new(), undecided: false };
    check.interval();
    check.witness();
    check.nearest();
    check.overlap(rng);
    if seed % PROVED_EVERY < 2 {
        check.proof();
    }
    Outcome {
        converged: result.converged,
        cells: result.cells,
        seconds,
        undecided: usize::from(check.undecided),
        violations: check
            .violations
            .into_iter()
            .map(|what| format!("seed {seed} ({}): {what}", posed.name()))
            .collect(),
        ..Outcome::default()
    }
}

struct Check<'a> {
    posed: &'a Posed,
    result: &'a ClearanceResult,
    violations: Vec<String>,
    undecided: bool,
}

impl Check<'_> {
    fn transform(&self) -> &RigidTransform {
        &self.posed.options.transform
    }

    /// What rounding, and the cut of trimmed faces, may add to a distance or take off it.
    fn rounding(&self) -> f64 {
        let [a, b] = [&self.posed.a, &self.posed.b];
        let largest = a.largest().max(b.largest()) + self.transform().offset().length();
        COORDINATE_ROUNDING * largest + 2.0 * (a.deviation() + b.deviation())
    }

    fn interval(&mut self) {
        if self.result.refuted > 0 {
            self.violations.push(format!("{} lower bounds are refuted by corners", self.result.refuted));
        }
        let ClearanceResult { lower, upper, tolerance, converged, at_least, .. } = *self.result;
        let ClearanceOptions { limit, .. } = self.posed.options;
        if !(0.0 <= lower && lower <= upper && upper.is_finite()) {
            self.violations.push(format!("lower {lower}, upper {upper}"));
        }
        if converged
            && limit.is_none()
            && upper - lower > tolerance * (1.0 + f64::EPSILON)
            && upper > tolerance
        {
            self.violations.push(format!("converged, but [{lower}, {upper}] is wider than {tolerance}"));
        }
        let overlaps = self.result.overlap.is_some_and(|overlap| overlap.is_overlap());
        let fits = match (limit, at_least) {
            (Some(limit), Some(true)) => lower >= limit && lower > 0.0 && !overlaps,
            (Some(limit), Some(false)) => upper < limit || overlaps,
            (Some(_), None) => !overlaps,
            (None, verdict) => verdict.is_none(),
        };
        if !fits {
            self.violations.push(format!("at least {at_least:?}, [{lower}, {upper}], limit {limit:?}"));
        }
    }

    /// The witnesses lie at their parameters, `upper` apart.
    fn witness(&mut self) {
        let witness = &self.result.witness;
        let sides = [
            (&self.posed.a, &witness.a, *self.transform()),
            (&self.posed.b, &witness.b, RigidTransform::IDENTITY),
        ];
        for (subject, SurfacePoint { face, u, v, point: stated, .. }, pose) in sides {
            let surface = &subject.model.surfaces()[*face];
            let evaluate = |u: f64, v: f64| pose.apply(DVec3::from_array(point(surface, u, v)));
            let [[u0, u1], [v0, v1]] = surface.domain().intervals();
            let at = evaluate(*u, *v);
            // Rounding of the parameters moves the point.
            let moved = [-2.0, 2.0].map(|units| {
                let step = |t: f64| t + units * f64::EPSILON * t.abs();
                evaluate(step(*u).clamp(u0, u1), *v).distance(at)
                    + evaluate(*u, step(*v).clamp(v0, v1)).distance(at)
            });
            let allowed = self.rounding()
                + WITNESS_ROUNDING * (subject.largest() + at.abs().max_element())
                + moved[0]
                + moved[1];
            let error = at.distance(DVec3::from_array(*stated));
            if !(error <= allowed) {
                self.violations.push(format!("a witness is {error} from the point at its parameters"));
            }
        }
        let between = DVec3::from_array(witness.a.point).distance(DVec3::from_array(witness.b.point));
        if !(between <= self.result.upper + self.rounding()) {
            self.violations.push(format!("the witnesses are {between} apart, upper {}", self.result.upper));
        }
    }

    /// No two points are found that are nearer than `lower`.
    fn nearest(&mut self) {
        let found = cloud::nearest([&self.posed.a, &self.posed.b], self.transform());
        if found + self.rounding() < self.result.lower {
            self.violations.push(format!("lower {}, but two points are {found} apart", self.result.lower));
        }
    }

    /// Both ends are proved in interval arithmetic, for models whose faces are not trimmed.
    fn proof(&mut self) {
        let at = |side: &SurfacePoint| Witness { surface: side.face, u: side.u, v: side.v };
        let ClearanceResult { lower, upper, ref witness, .. } = *self.result;
        let claim = LeastClaim { lower, upper, witness: [at(&witness.a), at(&witness.b)] };
        let transform = self.transform();
        let motion =
            Motion { rotation: transform.rotation().to_array(), translation: transform.offset().to_array() };
        let [a, b] = [&self.posed.a, &self.posed.b];
        let report = proof::check_least(a.definition(), &motion, b.definition(), &claim, &SETTINGS);
        let is_plain = !a.model.is_trimmed() && !b.model.is_trimmed();
        // The pieces of trimmed faces have parameters of their own, so that their witnesses are not
        // known to the proof.
        let verdict = if is_plain { report.verdict() } else { report.lower };
        match verdict {
            Verdict::Proved => {}
            Verdict::NotProved => self.undecided = true,
            Verdict::Refuted => self.violations.push(format!("refuted: {:?}", report.notes)),
        }
    }

    /// What is said of the solids agrees with the sides of their points.
    fn overlap(&mut self, rng: &mut Rng) {
        let Some(overlap) = self.result.overlap else { return };
        let [a, b] = [&self.posed.a, &self.posed.b];
        let transform = self.transform();
        match overlap {
            Overlap::None => {
                let is_inside = |_| {
                    let [of_a, of_b] = [a, b].map(|subject| subject.any_point(rng));
                    b.is_inside(transform.apply(of_a)) == Some(true)
                        || a.is_inside(transform.apply_inverse(of_b)) == Some(true)
                };
                if (0..SIDES).any(is_inside) {
                    self.violations
                        .push("a point of one is inside the other, said to overlap not".to_owned());
                }
            }
            Overlap::Intersecting { inside_both } | Overlap::Contained { inside_both } => {
                let point = DVec3::from_array(inside_both);
                let sides = [a.is_inside(transform.apply_inverse(point)), b.is_inside(point)];
                if sides.contains(&Some(false)) {
                    self.violations.push(format!("{point} is said to be inside both: {sides:?}"));
                }
            }
            _ => {}
        }
        let is_apart = matches!(overlap, Overlap::None | Overlap::Contained { .. });
        if is_apart && !(self.result.lower > 0.0) {
            self.violations.push(format!("{overlap:?}, but the boundaries may meet"));
        }
    }
}
