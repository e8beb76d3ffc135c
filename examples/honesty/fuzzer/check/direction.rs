//! The check of one direction: its interval, its witnesses and its limit.

use super::super::pairs::Pair;
use crate::proof;
use crate::support::evaluator::point;
use fastrand::Rng;
use glam::DVec3;
use nurbs_hausdorff::SurfacePoint;
use nurbs_hausdorff::internals::engine::{DistanceOptions, DistanceResult};
use nurbs_hausdorff::{Model, RigidTransform};
use std::cell::{Cell, OnceCell};

/// The rounding error of coordinates, the transform's included, relative to the
/// largest one: 16 units of 2^-53.
const COORDINATE_ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The distance of a witness from the point at its parameters, in units of 2^-53 of the largest
/// coordinate: knots are removed where that moves points by less (R15 of docs/method.md).
const WITNESS_ROUNDING: f64 = 512.0 * f64::EPSILON;

/// The rounding error of points relative to the models' size, as each model is
/// evaluated relative to an origin near it.
const SIZE_ROUNDING: f64 = 1e-14;

/// What underflow adds to a distance or takes off it, as the models are scaled for the computation:
/// about the root of the smallest number.
const VANISHING_LENGTH: f64 = 1e-160;

/// The check of one direction; the models have these poses.
pub(super) struct Direction<'a> {
    pub(super) from: &'a Model,
    pub(super) to: &'a Model,
    pub(super) poses: [RigidTransform; 2],
    pub(super) result: &'a DistanceResult,
    pub(super) witness: [&'a SurfacePoint; 2],
    truth: Option<f64>,
    limit: Option<f64>,
    pub(super) rounding: f64,
    /// The deviations of the pieces of the trimmed faces of both models.
    deviations: [f64; 2],
    /// The models for proofs, once one is needed, and the points on which none succeeded.
    pub(super) proof: OnceCell<proof::Pair>,
    pub(super) undecided: Cell<usize>,
}

impl<'a> Direction<'a> {
    pub(super) fn new(
        pair: &'a Pair,
        result: &'a DistanceResult,
        options: &DistanceOptions,
        reversed: bool,
        deviations: [f64; 2],
    ) -> Self {
        let boxes = [pair.a.bounding_box(), pair.b.bounding_box()];
        let largest =
            boxes.iter().map(|aabb| aabb.min.abs().max(aabb.max.abs()).max_element()).fold(0.0, f64::max);
        let rounding = COORDINATE_ROUNDING * (largest + pair.transform.offset().length())
            + SIZE_ROUNDING * (result.diagonal + result.computed)
            + VANISHING_LENGTH * 2.0_f64.powi(-pair.exponent)
            // Validation moves loops next to the edge of the domain onto it, by this and no more; a
            // region moves by at most twice as much as its loops.
            + 2.0 * result.gap;
        let (models, poses) = ([&pair.a, &pair.b], [pair.transform, RigidTransform::IDENTITY]);
        let witness = [&result.witness.a, &result.witness.b];
        let [from, to] = if reversed { [1, 0] } else { [0, 1] };
        Self {
            from: models[from],
            to: models[to],
            poses: [poses[from], poses[to]],
            result,
            witness: [witness[from], witness[to]],
            truth: pair.truth.map(|both| both[from]).filter(|truth| !truth.is_nan()),
            limit: options.limit,
            rounding,
            deviations: [deviations[from], deviations[to]],
            proof: OnceCell::new(),
            undecided: Cell::new(0),
        }
    }

    pub(super) fn violations(&self, rng: &mut Rng) -> Vec<String> {
        let DistanceResult { lower, upper, computed, .. } = self.result;
        let mut violations = Vec::new();
        if !(*lower <= *computed && *computed <= *upper && upper.is_finite()) {
            violations.push(format!("lower {lower}, computed {computed}, upper {upper}"));
        }
        if let Some(truth) = self.truth
            && !(*lower <= truth + self.rounding && truth - self.rounding <= *upper)
        {
            violations.push(format!("{truth} is not in [{lower}, {upper}]"));
        }
        self.check_witness(&mut violations);
        self.check_distances(rng, &mut violations);
        let Some(details) = self.result.certified() else { return violations };
        let deviation: f64 = self.deviations.iter().sum();
        let wide = upper - lower > details.tolerance + 200.0 * self.rounding + 4.0 * deviation;
        if self.result.converged && self.limit.is_none() && wide {
            violations.push(format!("converged, but [{lower}, {upper}] is {} wide", upper - lower));
        }
        let decided = self
            .limit
            .and_then(|limit| if *upper <= limit { Some(true) } else { (*lower > limit).then_some(false) });
        if details.within != decided {
            violations
                .push(format!("within {:?}, [{lower}, {upper}], limit {:?}", details.within, self.limit));
        }
        violations
    }

    /// Checks that the witnesses lie at their parameters, and at the computed distance.
    fn check_witness(&self, violations: &mut Vec<String>) {
        let [start, end] = self.witness.map(|witness| DVec3::from_array(witness.point));
        let models = [self.from, self.to].into_iter().zip(&self.poses).zip(self.deviations);
        for (((model, pose), deviation), witness) in models.zip(self.witness) {
            let surface = &model.surfaces()[witness.face];
            let evaluate = |u: f64, v: f64| pose.apply(DVec3::from_array(point(surface, u, v)));
            // Rounding of the parameters moves the point.
            let [du, dv] = [witness.u, witness.v].map(|parameter| 2.0 * f64::EPSILON * parameter.abs());
            let at = evaluate(witness.u, witness.v);
            let [[u0, u1], [v0, v1]] = surface.domain().intervals();
            let parameter_error = [-1.0, 1.0].map(|sign| {
                let along_u = evaluate((witness.u + sign * du).clamp(u0, u1), witness.v).distance(at);
                along_u + evaluate(witness.u, (witness.v + sign * dv).clamp(v0, v1)).distance(at)
            });
            let error = at.distance(DVec3::from_array(witness.point));
            let witness_rounding = WITNESS_ROUNDING * at.abs().max_element();
            let allowed =
                self.rounding + witness_rounding + deviation + parameter_error[0] + parameter_error[1];
            if error > allowed {
                violations.push(format!("a witness is {error} from the point at its parameters"));
            }
            if model.is_trimmed() && self.is_off_face(model, witness, allowed) {
                violations.push(format!("a witness is not on face {}, to {allowed}", witness.face));
            }
        }
        let between = start.distance(end);
        if (between - self.result.computed).abs() > self.rounding {
            violations.push(format!("the witnesses are {between} apart, computed {}", self.result.computed));
        }
    }
}
