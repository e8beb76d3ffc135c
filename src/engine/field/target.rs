//! The model that samples are measured to.

use crate::closest::{Target, closest_above};
use crate::engine::PreparedModel;
use crate::engine::direction::Direction;
use crate::engine::prepared::PreparedTarget;
use crate::engine::signs::{self, SignFoot, SignRule, SignSource, Signs};
use crate::error::{Error, Result};
use crate::facets::{PreparedFacets, facet_rounding};
use glam::DVec3;
use std::sync::Arc;

/// The width of the certified interval of a sample's distance, relative to the models'
/// diagonal: below what any colour or statistic shows.
const FIELD_GAP: f64 = 1e-9;

/// The patches of the model, none of facets, and its signs, which a [`FieldTarget`] borrows.
pub(super) struct Held<'a> {
    target: Option<Arc<PreparedTarget>>,
    signs: SignSource<'a>,
}

/// Patches or facets.
#[derive(Clone, Copy)]
pub(in crate::engine) enum FieldTarget<'a> {
    Patches { target: &'a Target, signs: SignRule<'a>, gap: f64 },
    Facets { facets: &'a PreparedFacets, signs: SignRule<'a> },
}

/// The place of the last foot, near which the next one may lie.
#[derive(Default)]
pub(super) struct Known {
    pub(super) place: Option<(u32, [f64; 2])>,
    side: signs::Known,
}

/// The closest point of a sample.
pub(super) struct Foot {
    pub(super) point: DVec3,
    pub(super) distance: f64,
    pub(super) signed: f64,
}

impl<'a> Held<'a> {
    pub(super) fn new(model: &'a PreparedModel) -> Self {
        let target = model.facets().is_none().then(|| model.certified_target());
        Self { target, signs: SignSource::new(model, 0.0) }
    }
}

impl Direction<'_> {
    /// Returns what the samples are measured to; `held` is that of the same model.
    ///
    /// # Errors
    /// [`Error::EmptyModel`].
    pub(super) fn field_target<'b>(&'b self, held: &'b Held<'_>) -> Result<FieldTarget<'b>> {
        let signs = held.signs.rule();
        match (self.to.facets(), &held.target) {
            (Some(facets), _) => Ok(FieldTarget::Facets { facets, signs }),
            (None, Some(target)) => Ok(FieldTarget::of_patches(&target.target, signs, self.diagonal())),
            (None, None) => Err(Error::EmptyModel),
        }
    }
}

impl<'a> FieldTarget<'a> {
    /// The patches of a model, of a pair with this diagonal.
    pub(in crate::engine) fn of_patches(target: &'a Target, signs: SignRule<'a>, diagonal: f64) -> Self {
        Self::Patches { target, signs, gap: FIELD_GAP * diagonal }
    }

    /// Returns what the signs stand for.
    pub(super) fn signs(&self) -> Signs {
        match self {
            Self::Patches { signs, .. } | Self::Facets { signs, .. } => signs.signs(),
        }
    }

    /// Returns the closest point up to the gap and rounding; `None` for a target without patches.
    pub(super) fn closest(&self, point: DVec3, known: &mut Known) -> Option<Foot> {
        match self {
            Self::Patches { target, signs, gap } => {
                let closest = closest_above(target, point, *gap, known.place, 0.0, None)?;
                known.place = Some((closest.patch as u32, closest.parameters));
                let of_patch = SignFoot::Patch(&closest, target);
                let signed = signs.signed(point, closest.lower, &of_patch, &mut known.side);
                Some(Foot { point: closest.point, distance: point.distance(closest.point), signed })
            }
            Self::Facets { facets: PreparedFacets { target, error, .. }, signs } => {
                let (foot, nearest, lower) =
                    target.certified(point, known.place.map_or(0, |(place, _)| place));
                known.place = Some((foot.facet, [0.0; 2]));
                let length = target.bounding_box().farthest_from_origin().max(point.length());
                let clear = lower - error - facet_rounding(length);
                let of_facet = SignFoot::Facet(target, foot.facet, &nearest);
                Some(Foot {
                    point: target.facet(foot.facet).point(nearest.weights),
                    distance: foot.distance_squared.sqrt(),
                    signed: signs.signed(point, clear, &of_facet, &mut known.side),
                })
            }
        }
    }
}
