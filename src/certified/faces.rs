//! The trimmed faces of a model as they are before they are cut: whole surfaces with regions.

use super::sheets::{Chart, SheetCache, Sheets};
use crate::axis::Axis;
use crate::bezier::{BezierModel, extract};
use crate::flatness::Places;
use crate::model::Model;
use crate::model::trim::{Rim, RimSide, Winding};
use crate::param_box::ParamBox;
use crate::untrim::ParameterMap;
use std::sync::{Arc, OnceLock};

/// How far the ends of boxes may be apart by rounding, relative to their sizes in a patch's parameters.
const END_ROUNDING: f64 = 1e-9;

/// The index of the surface that a piece lies on, with the map to its parameters; none of a face that is not trimmed.
pub(crate) type OnSheet<'a> = Option<(usize, &'a ParameterMap)>;

/// The trimmed faces of a model, with the way to them from the pieces that they are cut into.
///
/// A piece ends where the cut has put a line, the face goes on beyond it.
#[derive(Debug)]
pub(crate) struct TrimmedFaces {
    model: Arc<LazyFaces>,
    /// The face of each piece, with the map to its parameters.
    origins: Arc<[(usize, ParameterMap)]>,
}

/// A model, and the surfaces of its trimmed faces from their first use on.
#[derive(Debug)]
struct LazyFaces {
    model: Model,
    whole: OnceLock<Option<WholeFaces>>,
}

/// The surfaces of the trimmed faces and their regions.
#[derive(Debug)]
struct WholeFaces {
    bezier: BezierModel,
    places: Places,
    cache: SheetCache,
    /// The index of each face among the surfaces, if it is trimmed.
    surfaces: Vec<Option<usize>>,
    regions: Vec<Winding>,
}

/// A face about the foot of a point.
#[derive(Clone, Copy)]
pub(super) struct FaceChart<'a> {
    pub(super) chart: Chart<'a>,
    region: &'a Winding,
    /// The largest distance of the surface's computed points from the exact ones.
    pub(super) point_error: f64,
}

impl TrimmedFaces {
    /// Keeps the model for the first use.
    pub(crate) fn new(model: Model, origins: Arc<[(usize, ParameterMap)]>) -> Self {
        Self { model: Arc::new(LazyFaces { model, whole: OnceLock::new() }), origins }
    }

    /// Returns the way from some of the pieces alone, in the order given, to the same faces.
    pub(crate) fn some(&self, pieces: &[u32]) -> Self {
        let origins = pieces.iter().map(|&piece| self.origins[piece as usize].clone()).collect();
        Self { model: Arc::clone(&self.model), origins }
    }

    /// Returns the Bézier patches of the surfaces of all trimmed faces, and for each piece the surface that it lies on, with
    /// the map to its parameters; none for pieces of faces that are not trimmed. Extracted at first use.
    pub(crate) fn sheets(&self) -> Option<(&BezierModel, Vec<OnSheet<'_>>)> {
        let LazyFaces { model, whole } = &*self.model;
        let whole = whole.get_or_init(|| WholeFaces::new(model)).as_ref()?;
        let pieces =
            self.origins.iter().map(|(face, map)| whole.surfaces[*face].map(|surface| (surface, map)));
        Some((&whole.bezier, pieces.collect()))
    }

    /// Returns the face of a point of a piece, about that point; `None` if the face is not trimmed.
    pub(super) fn chart(&self, pieces: &Chart<'_>) -> Option<FaceChart<'_>> {
        let (face, map) = self.origins.get(pieces.surface())?;
        let LazyFaces { model, whole } = &*self.model;
        let whole = whole.get_or_init(|| WholeFaces::new(model)).as_ref()?;
        let surface = whole.surfaces[*face]?;
        let parameters = map.face_parameters(pieces.surface_parameters());
        let sheets = Sheets { bezier: &whole.bezier, places: &whole.places, cache: &whole.cache };
        Some(FaceChart {
            chart: Chart::at(sheets, surface, parameters),
            region: &whole.regions[surface],
            point_error: whole.bezier.point_error.after(0),
        })
    }
}

impl WholeFaces {
    /// Extracts the surfaces; `None` if no face is trimmed.
    fn new(model: &Model) -> Option<Self> {
        let (mut surfaces, mut regions, mut kept) = (Vec::new(), Vec::new(), Vec::new());
        for face in model.faces() {
            surfaces.push(face.trim().map(|trim| {
                regions.push(trim.winding());
                kept.push(face.surface().clone());
                kept.len() - 1
            }));
        }
        let bezier = extract(&Model::new(None, kept).ok()?);
        let places = Places::Whole(bezier.patches.len());
        Some(Self { bezier, places, cache: SheetCache::default(), surfaces, regions })
    }
}

/// Where a face has no boundary, in the parameters of a chart: each point of a box within all sides belongs to
/// it, `±η_v < a + b η_u + c η_u² + d η_u η_v + f η_v²`, η relative to the chart's point and v along the side's axis.
#[derive(Clone)]
pub(super) struct FaceRim {
    /// One or two, with what holds of those of a [`Rim`].
    pub(super) sides: Vec<RimSide>,
    /// The box.
    pub(super) parameters: [[f64; 2]; 2],
}

impl FaceRim {
    /// Whether the rim is about a box, up to the rounding of the ends of both: one that is not about the feet of a
    /// cell says nothing of them.
    fn contains(&self, box_: [[f64; 2]; 2]) -> bool {
        let mut ends = self.parameters.into_iter().zip(box_);
        ends.all(|([low, high], [first, last])| {
            let margin = END_ROUNDING * (1.0 + low.abs() + high.abs());
            low - margin <= first && last <= high + margin
        })
    }
}

impl FaceChart<'_> {
    /// Returns rims of the face in boxes of the chart's parameters that contain the one given.
    /// O(arcs of the loops).
    ///
    /// A box beyond the seam of a closed surface is at the other end of its domain, and the chart's point is moved by
    /// the same period: rims are relative to the moved point.
    pub(super) fn rims(&self, box_: [[f64; 2]; 2]) -> Vec<FaceRim> {
        let [us, vs] = Axis::BOTH.map(|axis| {
            let mut parts = self.chart.surface_ranges(axis, box_[axis.index()])?;
            // A box that goes on at the other end of the domain is two.
            parts.next().filter(|_| parts.next().is_none())
        });
        let (Some(us), Some(vs)) = (us, vs) else { return Vec::new() };
        let [u, v] = self.chart.surface_parameters();
        let origin = [u + us.shift, v + vs.shift];
        let place = self.region.place(origin);
        let scales = Axis::BOTH.map(|axis| self.chart.own_width(axis) * self.region.scale(axis));
        let of_chart = |Rim { sides, region }: Rim| {
            let sides = sides.into_iter().map(|side| {
                let ([a, b, c, d, f], v, u) =
                    (side.coefficients, side.axis.index(), side.axis.other().index());
                let ratio = scales[u] / scales[v];
                let coefficients =
                    [a / scales[v], b * ratio, c * ratio * scales[u], d * scales[u], f * scales[v]];
                RimSide { coefficients, slope: side.slope * ratio, ..side }
            });
            let parameters = [0, 1].map(|axis| {
                [region.low()[axis], region.high()[axis]]
                    .map(|end| self.chart.parameters[axis] + (end - place[axis]) / scales[axis])
            });
            FaceRim { sides: sides.collect(), parameters }
        };
        let rims = self.region.rims(&ParamBox::new(us.range, vs.range), origin);
        rims.into_iter().map(of_chart).filter(|rim| rim.contains(box_)).collect()
    }

    /// Returns true only if all points of the surface at a box of the chart's parameters belong to the face.
    /// O(arcs of the loops).
    pub(super) fn holds(&self, [s, t]: [[f64; 2]; 2]) -> bool {
        let Some(us) = self.chart.surface_ranges(Axis::U, s) else { return false };
        let Some(vs) = self.chart.surface_ranges(Axis::V, t) else { return false };
        let vs: Vec<[f64; 2]> = vs.map(|part| part.range).collect();
        us.into_iter().all(|u| vs.iter().all(|&v| self.region.encloses(&ParamBox::new(u.range, v))))
    }
}
