//! The proofs by interval arithmetic that a suspected point is one.

use super::super::brute::{RIM_ROUNDING, Target};
use super::super::sheet::{Sheet, sheets};
use super::direction::Direction;
use super::farther_points::Sample;
use crate::proof::{self, Motion, Side, Witness};
use glam::DVec2;
use nurbs_hausdorff::Model;
use nurbs_hausdorff::SurfacePoint;
use std::time::{Duration, Instant};

/// The time after which the proof that a point is farther than `upper` is given up, and the number
/// of points of a direction that are given up before the others are left out.
const PROOF_TIME: Duration = Duration::from_secs(5);
const MAX_UNDECIDED: usize = 3;

impl Direction<'_> {
    /// Whether a witness at its parameters is proved farther than `limit` from its trimmed model.
    pub(super) fn is_off_face(&self, model: &Model, witness: &SurfacePoint, limit: f64) -> bool {
        let origin = model.bounding_box().center();
        let sheets = sheets(model, origin);
        let parameters = DVec2::new(witness.u, witness.v);
        let point = sheets[witness.face].point(parameters);
        if Target::new(&sheets).is_within(point, limit, (witness.face, parameters)) {
            return false;
        }
        let definition = definition(model);
        let pair = proof::Pair::new(&definition, &Motion::IDENTITY, &definition);
        let side = |surface: usize, corners: [[f64; 2]; 2]| side(&sheets[surface], corners);
        let deadline = Instant::now() + PROOF_TIME;
        pair.is_farther_from_part(witness.face, [parameters.to_array(); 2], limit, deadline, &side)
            == Some(true)
    }

    /// Whether a point of A is proved farther than `limit` from all of B, in interval arithmetic.
    pub(super) fn is_proved_beyond(&self, at: Sample, limit: f64, to_sheets: &[Sheet]) -> bool {
        if self.undecided.get() >= MAX_UNDECIDED {
            return false;
        }
        let prepare = || {
            let [from, to] = &self.poses;
            let motion = Motion {
                rotation: (to.rotation().inverse() * from.rotation()).to_array(),
                translation: to.apply_inverse(from.offset()).to_array(),
            };
            proof::Pair::new(&definition(self.from), &motion, &definition(self.to))
        };
        let deadline = Instant::now() + PROOF_TIME;
        let proof = self.proof.get_or_init(prepare);
        let Sample { sheet: surface, parameters, is_rim } = at;
        let is_farther = if self.from.is_trimmed() || self.to.is_trimmed() {
            // A point of a loop lies within a few roundings of its parameters.
            let error = if is_rim { RIM_ROUNDING * parameters.abs() } else { DVec2::ZERO };
            let corners = [parameters - error, parameters + error].map(|corner| corner.to_array());
            let side = |surface: usize, corners: [[f64; 2]; 2]| side(&to_sheets[surface], corners);
            proof.is_farther_from_part(surface, corners, limit, deadline, &side)
        } else {
            proof.is_farther(Witness { surface, u: parameters.x, v: parameters.y }, limit, deadline)
        };
        self.undecided.set(self.undecided.get() + usize::from(is_farther.is_none()));
        is_farther == Some(true)
    }
}

/// Returns where a box of parameters is, compared with a face's region. A number other than 0 and
/// 1, of an overlap that validation accepts, counts as neither.
fn side(sheet: &Sheet, [low, high]: [[f64; 2]; 2]) -> Side {
    let Some(region) = &sheet.region else { return Side::Inside };
    match region.number(low.into(), high.into()) {
        Some(0) => Side::Outside,
        Some(1) => Side::Inside,
        _ => Side::Open,
    }
}

/// The model as the proofs read it: by its definition, without the library.
fn definition(model: &Model) -> proof::Model {
    proof::Model::from_json(&model.to_json().unwrap()).unwrap()
}
