//! The closest point of a model to one point.

use crate::closest::{
    Closest, Located, NearbyPatches, Target, closest_above, closest_beside, closest_located, newton,
};
use crate::engine::PreparedModel;
use crate::engine::prepared::PreparedTarget;
use crate::engine::signs::{self, SignFoot, SignRule, SignSource, Signs};
use crate::error::Result;
use crate::facets::{Nearest, PreparedFacets, facet_rounding};
use crate::flatness::{Flatness, MAX_HALVINGS};
use crate::gpu::{Gpu, GpuPoints};
use crate::pieces::FacePieces;
use crate::rounding::{VANISHING_LENGTH, gamma};
use glam::DVec3;
use std::sync::Arc;

/// The largest number of Newton steps from the foot of the point before: near it a few suffice.
const MAX_ITERATIONS: u32 = 16;

/// The roundings of a distance of two points, relative to it: three differences,
/// their squares, two sums and a root.
const DISTANCE_ROUNDINGS: f64 = 7.0;

/// The reach of a list of patches beyond the distance at the middle of a ball, in radii of the ball. A point of it is at most
/// a radius farther from the model than the middle, and its list reaches a radius less far.
const LISTED_RADII: f64 = 2.0;

/// A model to which points are measured, held while they are.
pub(super) struct Measured<'a> {
    model: &'a PreparedModel,
    /// The patches, none of a mesh or a cloud.
    flat: Option<Arc<PreparedTarget>>,
    signs: SignSource<'a>,
    /// The permitted excess of a distance.
    gap: f64,
}

/// The same, to be shared by threads.
#[derive(Clone, Copy)]
pub(super) struct PointQuery<'a> {
    kind: Kind<'a>,
    rule: SignRule<'a>,
}

#[derive(Clone, Copy)]
enum Kind<'a> {
    Patches {
        target: &'a Target,
        pieces: &'a FacePieces,
        point_error: f64,
        gap: f64,
    },
    /// Facets, and the largest length of their corners.
    Facets(&'a PreparedFacets, f64),
}

/// The foot and the space about the point before, near which the next one may lie, and the patches near both.
#[derive(Default)]
pub(super) struct Known {
    place: Option<(u32, [f64; 2])>,
    nearby: Option<NearbyPatches>,
    side: signs::Known,
}

/// A closest point.
pub(super) struct Found<'a> {
    pub(super) distance: f64,
    /// The distance of the model is within it of `distance`.
    pub(super) bound: f64,
    /// Whether the foot and the bound of a kernel decided it.
    pub(super) located: bool,
    /// Whether it is nearer than a kernel's bounds permit: these do not hold on the device.
    pub(super) is_refuting: bool,
    /// A lower bound on the distance to the model as its boundary is known to the signs.
    clear: f64,
    place: Place<'a>,
}

/// The place of a foot.
enum Place<'a> {
    Patch { closest: Closest, target: &'a Target, pieces: &'a FacePieces },
    Facet { facets: &'a PreparedFacets, facet: u32, nearest: Nearest },
}

/// A foot, with its face and its parameters there.
pub(super) struct Foot {
    pub(super) point: DVec3,
    pub(super) face: usize,
    pub(super) parameters: [f64; 2],
}

impl<'a> Measured<'a> {
    /// Cuts the model and joins its edges at first use. Distances up to `sign_tolerance` have the sign 0.
    pub(super) fn new(model: &'a PreparedModel, gap: f64, sign_tolerance: f64) -> Self {
        let flat = model.facets().is_none().then(|| model.target(Flatness::Loose));
        Self { model, flat, signs: SignSource::new(model, sign_tolerance), gap }
    }

    /// Returns the kernels of closest points on the model's patches, with room for `capacity` points. `None` for a mesh, a
    /// cloud, and patches that float32 cannot bound.
    ///
    /// # Errors
    /// [`crate::Error::GpuFailed`], [`crate::Error::DeviceLost`].
    pub(super) async fn on_gpu(&self, gpu: &Arc<Gpu>, capacity: usize) -> Result<Option<GpuPoints>> {
        let Some(flat) = &self.flat else { return Ok(None) };
        let target = flat.located.on(gpu, |gpu| gpu.upload_point_target(&flat.target))?;
        GpuPoints::new(gpu, target, self.gap, capacity).await
    }

    pub(super) fn query(&self) -> Option<PointQuery<'_>> {
        let kind = match (self.model.facets(), &self.flat) {
            (Some(facets), _) => Kind::Facets(facets, facets.target.bounding_box().farthest_from_origin()),
            (None, Some(flat)) => Kind::Patches {
                target: &flat.target,
                pieces: self.model.pieces(),
                point_error: self.model.bezier().point_error.after(MAX_HALVINGS),
                gap: self.gap,
            },
            (None, None) => return None,
        };
        Some(PointQuery { kind, rule: self.signs.rule() })
    }
}

impl<'a> PointQuery<'a> {
    /// Returns what the signs stand for.
    pub(super) fn signs(&self) -> Signs {
        self.rule.signs()
    }

    /// Returns the closest point to a point that is known within `error`; `None` of a model without patches.
    pub(super) fn closest(&self, point: DVec3, error: f64, known: &mut Known) -> Option<Found<'a>> {
        self.closest_from(point, error, None, known)
    }

    /// Lists the patches to which points of a ball may be nearest, so that their searches need no tree; `None` of a model
    /// without patches. For a mesh it does nothing.
    pub(super) fn list_nearby(&self, center: DVec3, radius: f64, known: &mut Known) -> Option<()> {
        if let Kind::Patches { target, .. } = self.kind {
            let reach = self.closest(center, 0.0, known)?.distance + LISTED_RADII * radius;
            known.nearby = Some(NearbyPatches::new(target, center, reach));
        }
        Some(())
    }

    /// Returns whether a search finds a point of the model that is nearer than this.
    pub(super) fn is_nearer(&self, point: DVec3, error: f64, lower: f64) -> bool {
        let searched = self.closest(point, error, &mut Known::default());
        searched.is_some_and(|searched| searched.distance + searched.bound < lower)
    }

    /// Returns the closest point with a foot that a kernel found. Where its bound on all other patches does not decide the
    /// point, the foot is a start.
    pub(super) fn closest_from(
        &self,
        point: DVec3,
        error: f64,
        located: Option<&Located>,
        known: &mut Known,
    ) -> Option<Found<'a>> {
        match self.kind {
            Kind::Patches { target, pieces, point_error, gap } => {
                let decided = located.and_then(|located| decided(target, point, gap, located));
                let is_decided = decided.is_some();
                let nearby = known.nearby.as_ref();
                let searched = || {
                    let start = located.map(|located| (located.patch, located.parameters)).or(known.place);
                    let start = start.map(|start| foot_from(target, point, start));
                    closest_above(target, point, gap, start, 0.0, nearby)
                };
                let closest = decided.or_else(searched)?;
                known.place = Some((closest.patch as u32, closest.parameters));
                let rounding =
                    point_error + error + gamma(DISTANCE_ROUNDINGS) * closest.upper + VANISHING_LENGTH;
                Some(Found {
                    distance: closest.upper,
                    bound: closest.upper - closest.lower + rounding,
                    located: is_decided,
                    is_refuting: located.is_some_and(|one| one.is_refuted_by(closest.upper + rounding)),
                    clear: closest.lower,
                    place: Place::Patch { closest, target, pieces },
                })
            }
            Kind::Facets(facets, length) => {
                let rounding = facets.error + error + facet_rounding(length.max(point.length()));
                let start = known.place.map_or(0, |(facet, _)| facet);
                let (foot, nearest, lower) = facets.target.certified(point, start);
                known.place = Some((foot.facet, [0.0; 2]));
                let distance = foot.distance_squared.sqrt();
                let place = Place::Facet { facets, facet: foot.facet, nearest };
                let (bound, clear) = (distance - lower + rounding, lower - rounding);
                Some(Found { distance, bound, located: false, is_refuting: false, clear, place })
            }
        }
    }

    /// Returns the distance of a point with its sign, as [`Signs`] states.
    pub(super) fn signed(&self, point: DVec3, found: &Found<'_>, known: &mut Known) -> f64 {
        let foot = match &found.place {
            Place::Patch { closest, target, .. } => SignFoot::Patch(closest, target),
            Place::Facet { facets, facet, nearest } => SignFoot::Facet(&facets.target, *facet, nearest),
        };
        self.rule.signed(point, found.clear, &foot, &mut known.side)
    }

    /// Returns whether no point of the boundary of a solid is within a radius of the point that this was found for, so
    /// that all points there have its side (lemma S4 of docs/solids.md).
    pub(super) fn is_clear(&self, found: &Found<'_>, radius: f64) -> bool {
        self.rule.clear_radius(found.clear).is_some_and(|clear| clear > radius)
    }
}

impl Found<'_> {
    /// Returns the foot.
    pub(super) fn foot(&self) -> Foot {
        match &self.place {
            Place::Patch { closest, target, pieces } => {
                let patch = target.patches.patch(closest.patch);
                let parameters = patch.surface_parameters(closest.parameters);
                Foot {
                    point: closest.point,
                    face: pieces.face(patch.surface),
                    parameters: pieces.face_parameters(patch.surface, parameters),
                }
            }
            Place::Facet { facets, facet, nearest } => Foot {
                point: facets.target.facet(*facet).point(nearest.weights),
                face: facets.target.index(*facet),
                parameters: [nearest.weights[1], nearest.weights[2]],
            },
        }
    }
}

/// Returns the closest point where a kernel's foot and bounds decide it: both bounds, or that on other patches with the
/// search of the foot's own one.
fn decided(target: &Target, point: DVec3, gap: f64, located: &Located) -> Option<Closest> {
    closest_located(target, point, gap, located).or_else(|| {
        let (patch, parameters) = foot_from(target, point, (located.patch, located.parameters));
        closest_beside(target, point, gap, Located { patch, parameters, ..*located })
    })
}

/// Returns the foot to which Newton's iteration comes on a patch from a foot of another point, the
/// point before: on the same patch it is often the closest point, and the search then has nothing to
/// examine. Wherever the iteration ends, it is a point of the model.
fn foot_from(target: &Target, point: DVec3, (patch, start): (u32, [f64; 2])) -> (u32, [f64; 2]) {
    (patch, newton(&target.patches.patch(patch as usize), point, start, MAX_ITERATIONS).parameters)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::shapes::sphere;

    /// Bounds as large as the distance of a foot that is not the nearest point decide it, and are wrong: a search finds a
    /// nearer point. Of bounds that hold it finds none. Larger bounds are refuted by what is found at once.
    #[test]
    fn bounds_that_leave_out_a_nearer_point_are_refuted() {
        let ball = PreparedModel::new(&sphere(DVec3::ZERO, 1.0).unwrap()).unwrap();
        let measured = Measured::new(&ball, 1e-6, 0.0);
        let query = measured.query().unwrap();
        let point = DVec3::new(0.3, 0.5, 0.4);
        let distance = 1.0 - point.length();
        let Kind::Patches { target, .. } = &query.kind else { unreachable!() };
        for (index, patch) in target.patches.iter().enumerate() {
            let foot = patch.point([0.5; 2]).distance(point);
            assert!(foot > 1.01 * distance);
            let lower = |bound: f64| {
                let located =
                    Located { patch: index as u32, parameters: [0.5; 2], own: bound, others: bound };
                let found = query.closest_from(point, 0.0, Some(&located), &mut Known::default()).unwrap();
                (found.located, found.is_refuting, found.distance - found.bound)
            };
            let (is_located, is_refuting, wrong) = lower(foot);
            assert!(is_located && !is_refuting && query.is_nearer(point, 0.0, wrong), "{index}");
            let (_, is_refuting, right) = lower(distance);
            assert!(!is_refuting && !query.is_nearer(point, 0.0, right), "{index}");
            assert!(lower(foot + 1e-9).1, "{index}");
        }
    }
}
