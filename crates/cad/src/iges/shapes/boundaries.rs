//! Boundaries of trimmed and bounded surfaces as wires.

use super::pairing::{Ground, Piece, area};
use super::{Shapes, Sheet, used};
use crate::iges::file::{Entity, Found};
use crate::iges::geometry::{Leaf, Scale, leaves, over, placed, spline};
use crate::nurbs::Spline;
use crate::report::{FaceFault, Remark};
use crate::topology::{ShapeKind, Use};
use glam::{DAffine3, DVec2, DVec3};

/// A wire, and about the signed area within it, if its curves in the parameters are known.
struct Wire {
    shape: usize,
    area: Option<f64>,
}

/// The boundaries of a face.
#[derive(Default)]
pub(super) struct Boundaries {
    wires: Vec<Wire>,
    /// What the report says of them.
    pub(super) remarks: Vec<Remark>,
}

/// The curves of a boundary.
struct Curves {
    parameters: Vec<Spline>,
    space: Vec<Leaf>,
    prefers_space: bool,
}

/// The preference of a curve on a surface for its curves in space.
const PREFERS_SPACE: f64 = 2.0;

impl Shapes<'_> {
    /// Adds the wire of a curve on a surface, type 142.
    pub(super) fn curve_on_surface(
        &mut self,
        number: u64,
        sheet: &Sheet,
        above: &DAffine3,
        boundaries: &mut Boundaries,
    ) -> Found<()> {
        let entity = self.file.entity(number)?;
        if entity.entry.kind != 142 {
            return Err(entity.unknown("a curve on a surface, type 142"));
        }
        let above_curves = *above * placed(self.file, &entity.entry, self.scale)?;
        if entity.pointer(3)? == 0 && entity.pointer(4)? == 0 {
            let why = format!("the boundary {number} states no curve, and bounds nothing");
            boundaries.remarks.push(Remark::new("IGES_BOUNDARY", why));
            return Ok(());
        }
        let parameters = self.in_parameters(entity.pointer(3)?, sheet)?;
        let space = self.in_space(entity.pointer(4)?, &above_curves)?;
        let prefers_space = entity.optional_real(5)? == Some(PREFERS_SPACE);
        self.boundary(&entity, sheet, above, Curves { parameters, space, prefers_space }, boundaries)
    }

    /// Adds the wire of a boundary, type 141.
    pub(super) fn listed_boundary(
        &mut self,
        number: u64,
        sheet: &Sheet,
        above: &DAffine3,
        boundaries: &mut Boundaries,
    ) -> Found<()> {
        let entity = self.file.entity(number)?;
        if entity.entry.kind != 141 {
            return Err(entity.unknown("a boundary, type 141"));
        }
        let above_curves = *above * placed(self.file, &entity.entry, self.scale)?;
        let (mut parameters, mut space) = (Vec::new(), Vec::new());
        let mut at = 5;
        for _ in 0..entity.items(4, 3)? {
            let mut curves = self.in_space(entity.reference(at)?, &above_curves)?;
            if entity.count(at + 1, 2)? == 2 {
                curves = curves.into_iter().rev().map(reversed).collect();
            }
            space.extend(curves);
            let in_parameters = entity.references(at + 2)?;
            at += 3 + in_parameters.len();
            for curve in in_parameters {
                parameters.extend(self.in_parameters(curve, sheet)?);
            }
        }
        let prefers_space = entity.optional_real(2)? == Some(PREFERS_SPACE);
        self.boundary(&entity, sheet, above, Curves { parameters, space, prefers_space }, boundaries)
    }

    /// Adds the wire of the rectangle of a whole surface.
    pub(super) fn whole_boundary(
        &mut self,
        entity: &Entity,
        sheet: &Sheet,
        above: &DAffine3,
        boundaries: &mut Boundaries,
    ) -> Found<()> {
        let [Some([u0, u1]), Some([v0, v1])] = self.topology.surfaces[sheet.surface].natural_ranges() else {
            return Err(entity.fault(3, "the number of holes of a surface with an end"));
        };
        let corners = [[u0, v0], [u1, v0], [u1, v1], [u0, v1]].map(|[u, v]| DVec3::new(u, v, 0.0));
        let side = |index: usize| Spline::segment([0.0, 1.0], corners[index], corners[(index + 1) % 4]);
        let parameters = (0..4).map(side).collect();
        let curves = Curves { parameters, space: Vec::new(), prefers_space: false };
        self.boundary(entity, sheet, above, curves, boundaries)
    }

    /// Adds the wire of the curve around a plane, whose matrix places both.
    pub(super) fn curve_in_plane(
        &mut self,
        plane: &Entity,
        curve: u64,
        sheet: &Sheet,
        boundaries: &mut Boundaries,
    ) -> Found<()> {
        let space = self.in_space(curve, &sheet.location)?;
        let curves = Curves { parameters: Vec::new(), space, prefers_space: true };
        self.boundary(plane, sheet, &DAffine3::IDENTITY, curves, boundaries)
    }

    /// Adds the wire of some curves: of those in space alone if those in the parameters are not
    /// theirs, so that they are made anew.
    fn boundary(
        &mut self,
        entity: &Entity,
        sheet: &Sheet,
        above: &DAffine3,
        curves: Curves,
        boundaries: &mut Boundaries,
    ) -> Found<()> {
        let location = *above * sheet.location;
        let surface = &self.topology.surfaces[sheet.surface];
        let ground = Ground { surface, location, tolerance: self.tolerance };
        let Curves { mut parameters, space, prefers_space } = curves;
        if self.is_elementary(sheet) && !space.is_empty() {
            parameters.clear();
        }
        let found = (!parameters.is_empty()).then(|| ground.pieces(&parameters, &space, prefers_space));
        let pieces = found.flatten().unwrap_or_else(|| {
            if !parameters.is_empty() {
                let why = format!(
                    "the curves in the parameters of the boundary {} are not those of its curves in \
                     space, and are made anew from these",
                    entity.number()
                );
                boundaries.remarks.push(Remark::new("IGES_P_CURVES", why));
            }
            space.into_iter().map(Piece::Space).collect()
        });
        if pieces.is_empty() {
            let why = format!("the boundary {} has no curves that are read", entity.number());
            return Err(FaceFault::new("IGES_BOUNDARY", why));
        }
        let area = area(&pieces);
        let seams = ground.seams(&pieces);
        let mut edges: Vec<Use> = Vec::with_capacity(pieces.len());
        for (piece, seam) in pieces.into_iter().zip(seams) {
            let edge = match seam {
                Some((first, same)) => self.other_side(edges[first], piece, same)?,
                None => self.piece(piece, sheet, location)?,
            };
            edges.push(edge);
        }
        boundaries.wires.push(Wire { shape: self.push(ShapeKind::Wire, edges)?, area });
        Ok(())
    }

    /// Reads the curves in the parameters of a surface, each over [0, 1] in our parameters; none
    /// where the file has none.
    pub(super) fn in_parameters(&self, number: u64, sheet: &Sheet) -> Found<Vec<Spline>> {
        let Some(to_ours) = sheet.parameters.filter(|_| number != 0) else { return Ok(Vec::new()) };
        let mut curves = Vec::new();
        for leaf in leaves(self.file, number, Scale(1.0))? {
            let mut curve = over(spline(&leaf)?, [0.0, 1.0]);
            for control in &mut curve.controls {
                let weight = control.w;
                let at = to_ours.transform_point2(DVec2::new(control.x, control.y) / weight);
                *control = (weight * at.extend(0.0)).extend(weight);
            }
            let start = curve.start();
            if curve.points().any(|point| point != start) {
                curves.push(curve);
            }
        }
        Ok(curves)
    }

    /// Reads curves in space; none where the file has none.
    fn in_space(&self, number: u64, above: &DAffine3) -> Found<Vec<Leaf>> {
        if number == 0 {
            return Ok(Vec::new());
        }
        let mut curves = leaves(self.file, number, self.scale)?;
        for leaf in &mut curves {
            leaf.location = *above * leaf.location;
        }
        Ok(curves)
    }
}

fn reversed(leaf: Leaf) -> Leaf {
    let [start, end] = leaf.range;
    Leaf { curve: leaf.curve.reversed(), range: [-end, -start], location: leaf.location }
}

impl Boundaries {
    /// Returns the uses of the wires in their face: the largest one turns counter-clockwise in the
    /// parameters, others clockwise, as some writers list a hole first. Wires whose curves in the
    /// parameters are not known keep their direction.
    pub(super) fn directed(&self) -> Vec<Use> {
        let size = |index: &usize| self.wires[*index].area.map_or(0.0, f64::abs);
        let outer = (0..self.wires.len()).max_by(|a, b| size(a).total_cmp(&size(b)));
        let wires = self.wires.iter().enumerate();
        let directed = wires.map(|(index, wire)| {
            let forward = wire.area.is_none_or(|area| (area > 0.0) == (Some(index) == outer));
            used(wire.shape, forward)
        });
        directed.collect()
    }
}
