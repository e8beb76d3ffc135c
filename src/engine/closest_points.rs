//! The closest points of a model to given points.

use super::signs::{Known, SignFoot, SignRule, SignSource, Signs};
use super::{Computation, Engine, PreparedModel};
use crate::closest::{Target, closest_above, newton};
use crate::error::{Error, Result};
use crate::facets::{PreparedFacets, facet_rounding};
use crate::flatness::{Flatness, MAX_HALVINGS};
use crate::limits::is_in_range;
use crate::model::RigidTransform;
use crate::progress::{Monitor, Progress};
use crate::rounding::{VANISHING_LENGTH, gamma};
use crate::threads::parallel::map_ranges;
use crate::tolerance::{PermittedWidth, not_negative};
use glam::DVec3;
use serde::Deserialize;

/// The number of points between two checkpoints: some tens of milliseconds of work on
/// all cores, and in WebAssembly, on one thread, fewer than a frame of a display takes.
const POINTS_AT_ONCE: usize = if cfg!(target_arch = "wasm32") { 1024 } else { 8192 };

/// The largest number of Newton steps from the foot of the point before: near it a few suffice.
const MAX_ITERATIONS: u32 = 16;

/// The excess of a distance, as a fraction of the diagonal, unless the options state one.
const DEFAULT_RELATIVE_TOLERANCE: f64 = 1e-9;

/// The roundings of a distance of two points, relative to it: three differences,
/// their squares, two sums and a root.
const DISTANCE_ROUNDINGS: f64 = 7.0;

/// Options of [`Engine::closest_points`]; names in camelCase when deserialized.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct ClosestPointOptions {
    /// The permitted excess of a distance over the least one, in model units, positive.
    pub tolerance: Option<f64>,
    /// The same as a fraction of the diagonal of the model's control-net box; 1e-9 if
    /// neither is given. Both at once are an error.
    pub relative_tolerance: Option<f64>,
    /// Distances up to this, in model units, have the sign 0, which is then not decided: beside the
    /// faces of a solid a sign takes many times as long as the distance. 0, the default, decides all.
    pub sign_tolerance: f64,
    /// Moves the points before they are measured. It is not deserialized, because only
    /// [`RigidTransform::new`] makes one.
    #[serde(skip)]
    pub transform: RigidTransform,
}

impl Default for ClosestPointOptions {
    fn default() -> Self {
        let transform = RigidTransform::IDENTITY;
        Self { tolerance: None, relative_tolerance: None, sign_tolerance: 0.0, transform }
    }
}

/// The closest points of a model to given points, one entry a point in each list.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct ClosestPoints {
    /// The distances from the points to their feet.
    pub distances: Vec<f64>,
    /// The bounds: the distance from point i to the model is in
    /// `[distances[i] - bounds[i], distances[i] + bounds[i]]`.
    pub bounds: Vec<f64>,
    /// The distances with the signs that [`ClosestPoints::signs`] names.
    pub signed: Vec<f64>,
    /// The feet, the points of the model that were found: x, y, z each.
    pub feet: Vec<f64>,
    /// The indices of the feet's faces; of a mesh or a cloud, those of their triangles or points.
    pub faces: Vec<u32>,
    /// The feet's parameters there: u, v each; of a triangle, the weights of its second and
    /// third corner.
    pub parameters: Vec<f64>,
    /// What the signs stand for.
    pub signs: Signs,
}

impl Engine {
    /// Returns the closest points of a model to `points`, x, y, z each, moved by the
    /// options' transform.
    ///
    /// Guarantee: the true distance of every point is within its bound of the one
    /// returned. The search is best first over the model's tree in float64, from the
    /// foot of the previous point, so that neighbours should follow each other.
    /// O(points log patches) in general position.
    ///
    /// # Errors
    /// [`Error::PointOutOfRange`] for a coordinate that is not finite or above 1e100 in
    /// size, and for a last point of fewer than three; [`Error::OptionOutOfRange`];
    /// [`Error::Cancelled`].
    pub fn closest_points<'a>(
        &'a self,
        model: &'a PreparedModel,
        points: &'a [f64],
        options: &'a ClosestPointOptions,
    ) -> Computation<'a, ClosestPoints> {
        Computation::new(move |mut watched| {
            Box::pin(async move { self.closest_points_of(model, points, options, watched.monitor()).await })
        })
    }

    async fn closest_points_of(
        &self,
        model: &PreparedModel,
        points: &[f64],
        options: &ClosestPointOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<ClosestPoints> {
        let ClosestPointOptions { tolerance, relative_tolerance, sign_tolerance, transform } = *options;
        let permitted = PermittedWidth { tolerance, relative_tolerance };
        permitted.validate()?;
        not_negative("sign tolerance", sign_tolerance)?;
        validate(points)?;
        if let Some(facets) = model.facets() {
            let mut progress = Progress::new(monitor, false);
            let source = SignSource::new(model, sign_tolerance);
            return closest_facets((facets, source.rule()), points, &transform, &mut progress).await;
        }
        let flat = model.target(Flatness::Loose);
        let target = &flat.target;
        let pieces = model.pieces();
        let diagonal = model.bounding_box().diagonal();
        let gap = permitted.in_units(diagonal, DEFAULT_RELATIVE_TOLERANCE);
        let point_error = model.bezier().point_error.after(MAX_HALVINGS);
        let mut progress = Progress::new(monitor, false);
        let source = SignSource::new(model, sign_tolerance);
        let rule = source.rule();
        let mut found = ClosestPoints { signs: rule.signs(), ..ClosestPoints::default() };
        let count = points.len() / 3;
        for page in points.chunks(3 * POINTS_AT_ONCE) {
            let parts = map_ranges(page.len() / 3, |range| {
                let mut part = ClosestPoints::default();
                let (mut known, mut side) = (None, Known::default());
                for point in page[3 * range.start..3 * range.end].chunks_exact(3) {
                    let local = DVec3::new(point[0], point[1], point[2]);
                    let point = transform.apply(local);
                    let rounding = point_error + transform.rounding(local.length());
                    let start = known.map(|known| foot_from(target, point, known));
                    let closest = closest_above(target, point, gap, start, 0.0, None)?;
                    known = Some((closest.patch as u32, closest.parameters));
                    let patch = target.patches.patch(closest.patch);
                    let foot = patch.jet(closest.parameters);
                    part.distances.push(closest.upper);
                    part.bounds.push(
                        closest.upper - closest.lower
                            + rounding
                            + gamma(DISTANCE_ROUNDINGS) * closest.upper
                            + VANISHING_LENGTH,
                    );
                    part.signed.push(rule.signed(point, closest.lower, &SignFoot::Patch(&foot), &mut side));
                    part.feet.extend_from_slice(&foot.point.to_array());
                    part.faces.push(pieces.face(patch.surface) as u32);
                    let of_piece = patch.surface_parameters(closest.parameters);
                    part.parameters.extend_from_slice(&pieces.face_parameters(patch.surface, of_piece));
                }
                Some(part)
            });
            for part in parts {
                found.append(part.ok_or(Error::EmptyModel)?);
            }
            progress.checkpoint(found.distances.len() as f64 / count as f64).await?;
        }
        progress.finish();
        Ok(found)
    }
}

/// Returns the foot to which Newton's iteration comes on a patch from a foot of another point, the
/// point before: on the same patch it is often the closest point, and the search then has nothing to
/// examine. Wherever the iteration ends, it is a point of the model.
fn foot_from(target: &Target, point: DVec3, (patch, start): (u32, [f64; 2])) -> (u32, [f64; 2]) {
    (patch, newton(&target.patches.patch(patch as usize), point, start, MAX_ITERATIONS).parameters)
}

/// Returns the closest points of a mesh or a cloud, with bounds that only rounding makes positive:
/// the nearest facet is found exactly.
///
/// # Errors
/// [`Error::Cancelled`].
async fn closest_facets(
    (facets, rule): (&PreparedFacets, SignRule<'_>),
    points: &[f64],
    transform: &RigidTransform,
    progress: &mut Progress<'_>,
) -> Result<ClosestPoints> {
    let length = facets.target.bounding_box().farthest_from_origin();
    let mut found = ClosestPoints { signs: rule.signs(), ..ClosestPoints::default() };
    let count = points.len() / 3;
    for page in points.chunks(3 * POINTS_AT_ONCE) {
        let parts = map_ranges(page.len() / 3, |range| {
            let mut part = ClosestPoints::default();
            let (mut known, mut side) = (0, Known::default());
            for point in page[3 * range.start..3 * range.end].chunks_exact(3) {
                let local = DVec3::new(point[0], point[1], point[2]);
                let point = transform.apply(local);
                let rounding = facets.error
                    + transform.rounding(local.length())
                    + facet_rounding(length.max(point.length()));
                let (foot, nearest, lower) = facets.target.certified(point, known);
                known = foot.facet;
                let at = facets.target.facet(foot.facet).point(nearest.weights);
                let distance = foot.distance_squared.sqrt();
                part.distances.push(distance);
                part.bounds.push(distance - lower + rounding);
                let of_facet = SignFoot::Facet(&facets.target, foot.facet, &nearest);
                part.signed.push(rule.signed(point, lower - rounding, &of_facet, &mut side));
                part.feet.extend_from_slice(&at.to_array());
                part.faces.push(facets.target.index(foot.facet) as u32);
                part.parameters.extend_from_slice(&nearest.weights[1..]);
            }
            part
        });
        parts.into_iter().for_each(|part| found.append(part));
        progress.checkpoint(found.distances.len() as f64 / count as f64).await?;
    }
    progress.finish();
    Ok(found)
}

/// # Errors
/// [`Error::PointOutOfRange`].
fn validate(points: &[f64]) -> Result<()> {
    if let Some((index, &found)) = points.iter().enumerate().find(|(_, value)| !is_in_range(**value)) {
        return Err(Error::PointOutOfRange { index: index / 3, found });
    }
    if !points.len().is_multiple_of(3) {
        // The coordinate that is missing.
        return Err(Error::PointOutOfRange { index: points.len() / 3, found: f64::NAN });
    }
    Ok(())
}

impl ClosestPoints {
    fn append(&mut self, mut other: Self) {
        self.distances.append(&mut other.distances);
        self.bounds.append(&mut other.bounds);
        self.signed.append(&mut other.signed);
        self.feet.append(&mut other.feet);
        self.faces.append(&mut other.faces);
        self.parameters.append(&mut other.parameters);
    }
}
