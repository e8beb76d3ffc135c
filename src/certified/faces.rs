//! The trimmed faces of a model as they are before they are cut: whole surfaces with regions.

use super::sheets::{Chart, SheetCache, Sheets};
use crate::axis::Axis;
use crate::bezier::{BezierModel, extract};
use crate::flatness::Places;
use crate::model::Model;
use crate::model::trim::{Rim, Winding};
use crate::param_box::ParamBox;
use crate::untrim::ParameterMap;
use std::sync::{Arc, OnceLock};

/// The trimmed faces of a model, with the way to them from the pieces that they are cut into.
///
/// A piece ends where the cut has put a line, the face goes on beyond it.
#[derive(Debug)]
pub(crate) struct TrimmedFaces {
    model: Model,
    /// The face of each piece, with the map to its parameters.
    origins: Arc<[(usize, ParameterMap)]>,
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
pub(super) struct FaceChart<'a> {
    pub(super) chart: Chart<'a>,
    region: &'a Winding,
    /// The largest distance of the surface's computed points from the exact ones.
    pub(super) point_error: f64,
}

impl TrimmedFaces {
    /// Keeps the model for the first use.
    pub(crate) fn new(model: Model, origins: Arc<[(usize, ParameterMap)]>) -> Self {
        Self { model, origins, whole: OnceLock::new() }
    }

    /// Returns the face of a point of a piece, about that point; `None` if the face is not trimmed.
    pub(super) fn chart(&self, pieces: &Chart<'_>) -> Option<FaceChart<'_>> {
        let (face, map) = self.origins.get(pieces.surface())?;
        let whole = self.whole.get_or_init(|| WholeFaces::new(&self.model)).as_ref()?;
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

/// Where a face has no boundary, in the parameters of a chart: each point of a box with
/// `±η_v < a + b η_u + c η_u²`, η relative to the chart's point and v along `axis`, belongs to it, and so does
/// the whole side of the box towards which ±v falls.
pub(super) struct FaceRim {
    pub(super) axis: Axis,
    pub(super) is_upwards: bool,
    /// a, b and c.
    pub(super) coefficients: [f64; 3],
    /// The box.
    pub(super) parameters: [[f64; 2]; 2],
}

impl FaceChart<'_> {
    /// Returns the rim of the face in a box of the chart's parameters or a larger one, if it is found there.
    /// O(arcs of the loops).
    pub(super) fn rim(&self, [s, t]: [[f64; 2]; 2]) -> Option<FaceRim> {
        let [us, vs] = [(Axis::U, s), (Axis::V, t)].map(|(axis, range)| {
            let mut ranges = self.chart.surface_ranges(axis, range)?;
            // A box that goes on at the other end of the domain is two.
            ranges.next().filter(|_| ranges.next().is_none())
        });
        let origin = self.chart.surface_parameters();
        let Rim { axis, is_upwards, coefficients: [a, b, c], region } =
            self.region.rim(&ParamBox::new(us?, vs?), origin)?;
        let scales = Axis::BOTH.map(|axis| self.chart.own_width(axis) * self.region.scale(axis));
        let [across, along] = [scales[axis.index()], scales[axis.other().index()]];
        let origin = self.region.place(origin);
        let parameters = [0, 1].map(|axis| {
            [region.low()[axis], region.high()[axis]]
                .map(|end| self.chart.parameters[axis] + (end - origin[axis]) / scales[axis])
        });
        let coefficients = [a / across, b * along / across, c * along * along / across];
        Some(FaceRim { axis, is_upwards, coefficients, parameters })
    }

    /// Returns true only if all points of the surface at a box of the chart's parameters belong to the face.
    /// O(arcs of the loops).
    pub(super) fn holds(&self, [s, t]: [[f64; 2]; 2]) -> bool {
        let Some(us) = self.chart.surface_ranges(Axis::U, s) else { return false };
        let Some(vs) = self.chart.surface_ranges(Axis::V, t) else { return false };
        let vs: Vec<[f64; 2]> = vs.collect();
        us.into_iter().all(|u| vs.iter().all(|&v| self.region.encloses(&ParamBox::new(u, v))))
    }
}
