//! The closest points of a model to given points.

use super::order::along_curve;
use super::query::{Foot, Found, Known, Measured, PointQuery};
use crate::closest::Located;
use crate::engine::{Backend, Computation, Engine, PreparedModel, Signs};
use crate::error::{Error, Result};
use crate::gpu::Gpu;
use crate::limits::is_in_range;
use crate::model::RigidTransform;
use crate::progress::{Monitor, Progress};
use crate::threads::parallel::map_ranges;
use crate::tolerance::{PermittedWidth, not_negative};
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The number of points between two checkpoints: some tens of milliseconds of work on
/// all cores, and in WebAssembly, on one thread, fewer than a frame of a display takes.
const POINTS_AT_ONCE: usize = if cfg!(target_arch = "wasm32") { 1024 } else { 8192 };

/// The number of points that the GPU locates at once, a multiple of [`POINTS_AT_ONCE`]: enough for hardware, and few
/// megabytes.
const LOCATED_AT_ONCE: usize = 1 << 16;

/// The excess of a distance, as a fraction of the diagonal, unless the options state one.
const DEFAULT_RELATIVE_TOLERANCE: f64 = 1e-9;

/// Options of [`Engine::closest_points`]; names in camelCase when deserialized.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct ClosestPointOptions {
    /// The permitted excess of a distance over the least one, in model units, positive.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// The same as a fraction of the diagonal of the model's control-net box; 1e-9 if
    /// neither is given. Both at once are an error.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relative_tolerance: Option<f64>,
    /// Distances up to this, in model units, have the sign 0, which is then not decided: beside the
    /// faces of a solid a sign takes many times as long as the distance. 0, the default, decides all.
    pub sign_tolerance: f64,
    /// Where feet are looked for. On a GPU every point gets a foot and a bound in float32, and the CPU searches where these
    /// do not decide the distance. [`Backend::Cpu`] unless stated, as no hardware was measured. [`Backend::Auto`] takes a
    /// GPU that is no software. Meshes and clouds are searched on the CPU.
    pub backend: Backend,
    /// Moves the points before they are measured. It is neither serialized nor deserialized, because only
    /// [`RigidTransform::new`] makes one.
    #[serde(skip)]
    pub transform: RigidTransform,
}

impl Default for ClosestPointOptions {
    fn default() -> Self {
        let transform = RigidTransform::IDENTITY;
        let backend = Backend::Cpu;
        Self { tolerance: None, relative_tolerance: None, sign_tolerance: 0.0, backend, transform }
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
    /// The number of points that the GPU's feet and bounds decided; the CPU searched for the others.
    pub decided_on_gpu: usize,
}

impl Engine {
    /// Returns the closest points of a model to `points`, x, y, z each, moved by the
    /// options' transform.
    ///
    /// Guarantee: the true distance of every point is within its bound of the one
    /// returned. The search is best first over the model's tree in float64, from the
    /// foot of a point nearby: points are measured along a Morton curve, in whichever
    /// order they are given. Results do not depend on the number of threads.
    /// O(points log patches) in general position.
    ///
    /// With a GPU the guarantee is the same (lemmas P2 to P4 of docs/points.md), and results may depend on the device
    /// within the bounds.
    ///
    /// # Errors
    /// [`Error::PointOutOfRange`] for a coordinate that is not finite or above 1e100 in
    /// size, and for a last point of fewer than three; [`Error::OptionOutOfRange`];
    /// [`Error::NoAdapter`] or [`Error::DeviceLost`] with [`Backend::Gpu`] only; [`Error::GpuFailed`];
    /// [`Error::Cancelled`].
    pub fn closest_points<'a>(
        &'a self,
        model: &'a PreparedModel,
        points: &'a [f64],
        options: &'a ClosestPointOptions,
    ) -> Computation<'a, ClosestPoints> {
        Computation::new(move |mut watched| {
            Box::pin(async move { self.closest_points_on(model, points, options, watched.monitor()).await })
        })
    }
}

impl Engine {
    /// Measures on the backend of the options, again if the device is lost.
    async fn closest_points_on(
        &self,
        model: &PreparedModel,
        points: &[f64],
        options: &ClosestPointOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<ClosestPoints> {
        require_in_range(points)?;
        let order = along_curve(points);
        loop {
            let device = self.gpu_for(options.backend)?;
            // A software adapter takes longer than the search that it saves.
            let helps = |gpu: &&Arc<Gpu>| options.backend == Backend::Gpu || !gpu.is_software();
            let gpu = device.as_ref().filter(helps);
            let found = closest_points_along(model, points, &order, options, gpu, monitor).await;
            match (found, gpu) {
                (Err(Error::DeviceLost { found }), Some(lost)) => {
                    self.replace(lost, &found, options.backend).await?;
                }
                (found, _) => return found,
            }
        }
    }
}

/// Returns the closest points of a model to `points`, as [`Engine::closest_points`] does on the CPU.
///
/// # Errors
/// Those of [`Engine::closest_points`].
pub(in crate::engine) async fn closest_points_of(
    model: &PreparedModel,
    points: &[f64],
    options: &ClosestPointOptions,
    monitor: &mut dyn Monitor,
) -> Result<ClosestPoints> {
    closest_points_along(model, points, &along_curve(points), options, None, monitor).await
}

/// Returns the same, in the order of these indices of all points. The foot of one point is the start of the next,
/// up to the end of a range of [`RANGE_LENGTH`](crate::threads::parallel::RANGE_LENGTH) points; on a GPU, each point has
/// its own start, and the first one of each range is searched as well: if what is found of any point refutes the kernel's
/// bounds, all points are searched without it.
///
/// # Errors
/// Those of [`Engine::closest_points`].
pub(super) async fn closest_points_along(
    model: &PreparedModel,
    points: &[f64],
    order: &[u32],
    options: &ClosestPointOptions,
    gpu: Option<&Arc<Gpu>>,
    monitor: &mut dyn Monitor,
) -> Result<ClosestPoints> {
    let ClosestPointOptions { tolerance, relative_tolerance, sign_tolerance, transform, .. } = *options;
    let permitted = PermittedWidth { tolerance, relative_tolerance };
    permitted.validate()?;
    not_negative("sign tolerance", sign_tolerance)?;
    require_in_range(points)?;
    let gap = permitted.in_units(model.bounding_box().diagonal(), DEFAULT_RELATIVE_TOLERANCE);
    let measured = Measured::new(model, gap, sign_tolerance);
    let query = measured.query().ok_or(Error::EmptyModel)?;
    let mut progress = Progress::new(monitor, false);
    let mut found = ClosestPoints::of_count(order.len(), query.signs());
    let stage = match gpu {
        Some(gpu) => measured.on_gpu(gpu, LOCATED_AT_ONCE.min(order.len())).await?,
        None => None,
    };
    let mut done = 0;
    for page in order.chunks(LOCATED_AT_ONCE) {
        let located = match (&stage, gpu) {
            (Some(stage), Some(gpu)) => {
                let _turn = gpu.turn().await;
                let point = |&index: &u32| transform.apply(DVec3::from_slice(&points[3 * index as usize..]));
                stage.locate(&page.iter().map(point).collect::<Vec<_>>()).await?
            }
            _ => Vec::new(),
        };
        for (block, indices) in page.chunks(POINTS_AT_ONCE).enumerate() {
            let located = located.get(block * POINTS_AT_ONCE..).unwrap_or_default();
            let parts = map_ranges(indices.len(), |range| {
                let mut known = Known::default();
                let of_point = |place: usize| {
                    measure(&query, points, indices[place], &transform, located.get(place), &mut known)
                };
                range.map(of_point).collect::<Option<Vec<_>>>()
            });
            let parts: Vec<Vec<Entries>> =
                parts.into_iter().collect::<Option<_>>().ok_or(Error::EmptyModel)?;
            let is_refuted = |first: &Entries| {
                let (point, error) = moved(points, first.index as u32, &transform);
                query.is_nearer(point, error, first.distance - first.bound)
            };
            let mut searched = parts.iter().filter_map(|part| part.first()).filter(|first| first.located);
            if parts.iter().flatten().any(|one| one.is_refuting) || searched.any(is_refuted) {
                // The kernels' bounds do not hold on this device: nothing rests on them.
                let search = closest_points_along(model, points, order, options, None, progress.monitor());
                return Box::pin(search).await;
            }
            parts.iter().flatten().for_each(|entries| found.set(entries));
            done += indices.len();
            progress.checkpoint(done as f64 / order.len() as f64).await?;
        }
    }
    progress.finish();
    Ok(found)
}

/// The entries of one point.
struct Entries {
    index: usize,
    distance: f64,
    bound: f64,
    signed: f64,
    foot: Foot,
    located: bool,
    is_refuting: bool,
}

/// Measures the point of an index, moved; `None` of a model without patches.
fn measure(
    query: &PointQuery<'_>,
    points: &[f64],
    index: u32,
    transform: &RigidTransform,
    located: Option<&Located>,
    known: &mut Known,
) -> Option<Entries> {
    let (point, error) = moved(points, index, transform);
    let found = query.closest_from(point, error, located, known)?;
    let signed = query.signed(point, &found, known);
    let Found { distance, bound, located, is_refuting, .. } = found;
    let foot = found.foot();
    Some(Entries { index: index as usize, distance, bound, signed, foot, located, is_refuting })
}

/// Returns the image of the point of an index, and its error.
fn moved(points: &[f64], index: u32, transform: &RigidTransform) -> (DVec3, f64) {
    let local = DVec3::from_slice(&points[3 * index as usize..]);
    (transform.apply(local), transform.rounding(local.length()))
}

/// Accepts points, x, y, z each, whose coordinates are of at most 1e100 in size.
///
/// # Errors
/// [`Error::PointOutOfRange`].
pub(in crate::engine) fn require_in_range(points: &[f64]) -> Result<()> {
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
    /// Returns the lists of this many points, all zeros.
    fn of_count(count: usize, signs: Signs) -> Self {
        Self {
            distances: vec![0.0; count],
            bounds: vec![0.0; count],
            signed: vec![0.0; count],
            feet: vec![0.0; 3 * count],
            faces: vec![0; count],
            parameters: vec![0.0; 2 * count],
            signs,
            decided_on_gpu: 0,
        }
    }

    fn set(&mut self, &Entries { index, distance, bound, signed, ref foot, located, .. }: &Entries) {
        self.distances[index] = distance;
        self.bounds[index] = bound;
        self.signed[index] = signed;
        self.feet[3 * index..][..3].copy_from_slice(&foot.point.to_array());
        self.decided_on_gpu += usize::from(located);
        self.faces[index] = foot.face as u32;
        self.parameters[2 * index..][..2].copy_from_slice(&foot.parameters);
    }
}
