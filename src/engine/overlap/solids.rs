//! Two models as solids in one frame.

use crate::engine::prepared::BodyParts;
use crate::engine::{PreparedModel, PreparedTarget};
use crate::flatness::Flatness;
use crate::interval::Interval;
use crate::model::RigidTransform;
use crate::overlap::{BoundarySide, Known, PlacedSolid, Sides};
use crate::solid::{Enclosing, Side};
use glam::DVec3;
use serde::Serialize;
use std::sync::Arc;

/// Why the volumes that two models have in common are not stated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum VolumesUnknown {
    /// A is not closed: [`PreparedModel::solid`] has its free edges.
    AOpen,
    /// B is not closed.
    BOpen,
    /// Neither model is closed.
    BothOpen,
    /// A mesh has more triangles than are joined, 250,000.
    TooLarge,
    /// A body of A has no volume, as its facts say.
    AVolume,
    /// A body of B has no volume.
    BVolume,
    /// Bodies of A meet or overlap, or it is not known whether they do: the volume of all together is not known.
    ABodies,
    /// Bodies of B meet or overlap, or it is not known whether they do.
    BBodies,
    /// The boundary of a body of A certainly meets itself, so that its sides are not those of its faces.
    ACrossed,
    /// The boundary of a body of B certainly does.
    BCrossed,
    /// The volume found is certainly none of a common part: a boundary meets itself, or a fault of the library.
    Refuted,
}

/// Two closed models, the first one moved.
pub(super) struct Solids<'a> {
    models: [&'a PreparedModel; 2],
    targets: [Arc<PreparedTarget>; 2],
    transform: RigidTransform,
}

impl<'a> Solids<'a> {
    /// Joins the edges of both models and measures their bodies, at first use.
    ///
    /// # Errors
    /// Why the volumes are not known.
    pub(super) fn new(
        models: [&'a PreparedModel; 2],
        transform: RigidTransform,
    ) -> Result<Self, VolumesUnknown> {
        if models.iter().any(|model| model.facets().is_some_and(|mesh| !mesh.may_close())) {
            return Err(VolumesUnknown::TooLarge);
        }
        match models.map(|model| model.boundary().is_closed()) {
            [true, true] => {}
            [false, true] => return Err(VolumesUnknown::AOpen),
            [true, false] => return Err(VolumesUnknown::BOpen),
            [false, false] => return Err(VolumesUnknown::BothOpen),
        }
        for (model, why) in models.into_iter().zip([VolumesUnknown::AVolume, VolumesUnknown::BVolume]) {
            model.facts().volume.ok_or(why)?;
        }
        for (model, why) in models.into_iter().zip([VolumesUnknown::ABodies, VolumesUnknown::BBodies]) {
            if !are_bodies_apart(model) {
                return Err(why);
            }
        }
        for (model, why) in models.into_iter().zip([VolumesUnknown::ACrossed, VolumesUnknown::BCrossed]) {
            if model.self_overlap().is_some() {
                return Err(why);
            }
        }
        let targets = models.map(|model| model.target(Flatness::None));
        Ok(Self { models, targets, transform })
    }

    /// Returns one of the solids in the frame of B.
    pub(super) fn placed(&self, index: usize) -> PlacedSolid {
        let model = self.models[index];
        let moves = index == 0 && self.transform != RigidTransform::IDENTITY;
        let boundary = model.boundary();
        let joined = model.joined();
        let turned = turned_shells(model);
        let side = |surface: usize| match turned[joined.shells[surface] as usize] {
            None => BoundarySide::Unknown,
            Some(is_turned) if is_turned != joined.turned[surface] => BoundarySide::Inward,
            Some(_) => BoundarySide::Outward,
        };
        let known = Known {
            volume: model.facts().volume.unwrap_or_default(),
            area: model.facts().area.unwrap_or(Interval { lower: 0.0, upper: f64::INFINITY }),
            cracks: joined.of_shell.iter().map(|shell| shell.cracks).sum(),
            point_error: model.bezier().point_error,
            deviation: model.deviation(),
            rounding: boundary.rounding(),
        };
        PlacedSolid::new(
            &model.bezier().patches,
            boundary.strips(),
            moves.then_some(&self.transform),
            side,
            known,
        )
    }
}

/// Returns for each shell whether its surfaces are to be turned over; none where that is not known, and where the shell
/// has no volume.
fn turned_shells(model: &PreparedModel) -> Vec<Option<bool>> {
    let mut turned = vec![None; model.joined().of_shell.len()];
    for (parts, measured) in model.body_parts().iter().zip(model.measured_bodies()) {
        for (shell, &is_turned) in parts.shells.iter().zip(&measured.turned) {
            turned[shell.shell as usize] = is_turned;
        }
    }
    turned
}

/// Returns whether all bodies are certainly disjoint: their boundaries have no point in common, and no body lies within
/// another one.
fn are_bodies_apart(model: &PreparedModel) -> bool {
    let bodies = model.body_parts();
    bodies.iter().enumerate().all(|(index, body)| {
        bodies[..index].iter().filter(|other| body.aabb.meets(&other.aabb)).all(|other| {
            let pairs = body
                .shells
                .iter()
                .flat_map(|one| other.shells.iter().map(move |other| [one.shell, other.shell]));
            pairs.into_iter().all(|pair| model.shells().is_apart(pair) == Some(true))
                && is_outside(model, body, other)
                && is_outside(model, other, body)
        })
    })
}

/// Returns whether the first of two bodies with disjoint shells certainly lies outside the second one: outside its outer
/// shell, or in one of its voids.
fn is_outside(model: &PreparedModel, body: &BodyParts, other: &BodyParts) -> bool {
    let (Some(inner), Some((outer, voids))) = (body.shells.first(), other.shells.split_first()) else {
        return true;
    };
    let shells = model.shells();
    shells.has_within(outer.shell, inner.shell) == Some(false)
        || voids.iter().any(|void| shells.has_within(void.shell, inner.shell) == Some(true))
}

impl Sides for Solids<'_> {
    fn side(
        &self,
        solid: usize,
        point: DVec3,
        beside: Option<&(DVec3, Enclosing)>,
    ) -> Option<(Enclosing, Side)> {
        let place = |point: DVec3| if solid == 0 { self.transform.apply_inverse(point) } else { point };
        let (model, target) = (self.models[solid], &self.targets[solid].target);
        let boundary = model.boundary();
        let found = match beside {
            Some((other, enclosing)) => {
                boundary.enclosing_beside(target, place(point), (place(*other), enclosing))
            }
            None => boundary.enclosing(target, place(point), 0.0),
        };
        let enclosing = found?;
        let side = model.sides().side(&enclosing);
        Some((enclosing, side))
    }
}
