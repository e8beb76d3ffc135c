//! The curve of an edge in the parameters of a face.

use super::gap::Gap;
use super::section::Section;
use crate::gap::Lifted;
use crate::nurbs::{Curve, Spline, Surface};
use crate::topology::{Edge, Face, Topology};
use glam::DAffine3;

/// The curve of an edge, in its direction, with the fields of [`super::uses::TrimUse`].
pub(super) struct FoundCurve {
    pub(super) curve: Spline,
    pub(super) gap: Gap,
    pub(super) fitted: bool,
    pub(super) section: Option<(Section, Gap)>,
    pub(super) deviation: f64,
    pub(super) is_placed: bool,
}

impl FoundCurve {
    /// Adds the plane section of the surface that the edge is if it is nearer to the edge than
    /// the curve, whose ends it then takes. The edge's curve goes to the coordinates of
    /// the surface by `to_face`.
    pub(super) fn with_section(self, to_face: &DAffine3, lifted: &Lifted<'_>) -> Self {
        let Some(section) = Section::new(lifted.edge, to_face, lifted.surface) else { return self };
        match section.gap(&self.curve, lifted, self.gap.length) {
            Some(gap) => Self { section: Some((section, gap)), ..self },
            None => self,
        }
    }
}

/// Returns a curve on the surface, over a range, beside the edge; `None` if the edge has no curve.
pub(super) fn lifted<'a>(
    file: &'a Topology,
    (face, surface): (&Face, &'a Surface),
    edge: &'a Edge,
    location: &DAffine3,
    (curve, range): (&'a Curve, [f64; 2]),
) -> Option<Lifted<'a>> {
    let space = edge.curve.as_ref()?;
    Some(Lifted {
        surface,
        surface_location: face.location,
        curve,
        range,
        edge: &file.curves[space.curve],
        edge_location: *location * space.location,
        edge_range: space.range,
    })
}
