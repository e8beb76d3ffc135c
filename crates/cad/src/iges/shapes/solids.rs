//! Solids, shells, faces and loops, types 186 and 508 to 514.

use super::edges::Segment;
use super::pairing::Ground;
use super::{Shapes, Sheet, used};
use crate::iges::file::Found;
use crate::iges::geometry::Leaf;
use crate::nurbs::{Curve, Spline};
use crate::report::Remark;
use crate::topology::{PCurve, ShapeKind, Use};
use glam::DAffine3;
use std::collections::HashMap;

/// The use of an edge in a loop, with its curve in the parameters along the loop.
struct LoopUse {
    segment: Segment,
    along: bool,
    curve: Option<Spline>,
}

impl Shapes<'_> {
    /// Returns the shells of a solid: the outer one, and those of its voids.
    pub(super) fn shells(&mut self, number: u64) -> Found<Vec<Use>> {
        let entity = self.file.entity(number)?;
        let mut shells = vec![(entity.reference(1)?, entity.count(2, 1)? == 1)];
        for shell in 0..entity.items(3, 2)? {
            shells.push((entity.reference(4 + 2 * shell)?, entity.count(5 + 2 * shell, 1)? == 1));
        }
        shells.into_iter().map(|(shell, forward)| Ok(used(self.body(shell)?, forward))).collect()
    }

    /// Returns the faces of a shell, type 514.
    pub(super) fn shell_faces(&mut self, number: u64) -> Found<Vec<Use>> {
        let entity = self.file.entity(number)?;
        let mut faces = Vec::new();
        for index in 0..entity.items(1, 2)? {
            let (face, forward) = (entity.reference(2 + 2 * index)?, entity.count(3 + 2 * index, 1)? == 1);
            faces.push(used(self.body(face)?, forward));
        }
        Ok(faces)
    }

    /// Appends the face of a surface within loops, type 510.
    pub(super) fn face_of_loops(&mut self, number: u64) -> Found<usize> {
        let entity = self.file.entity(number)?;
        let sheet = self.sheet(entity.reference(1)?)?;
        let (mut wires, mut remarks) = (Vec::new(), Vec::new());
        // The flag of the outer loop stands between the count and the loops.
        for index in 0..entity.items(2, 1)? {
            wires.extend(self.loop_of(entity.reference(4 + index)?, &sheet, &mut remarks)?);
        }
        self.push_face_of(&entity.entry, &sheet, &DAffine3::IDENTITY, wires, remarks)
    }

    /// Returns the wire of a loop, type 508, with the material on its left seen along the normal
    /// of the surface; none for a vertex.
    fn loop_of(&mut self, number: u64, sheet: &Sheet, remarks: &mut Vec<Remark>) -> Found<Option<Use>> {
        let entity = self.file.entity(number)?;
        if entity.entry.kind != 508 {
            return Err(entity.unknown("a loop, type 508"));
        }
        let mut uses: Vec<LoopUse> = Vec::new();
        let mut at = 2;
        for _ in 0..entity.items(1, 5)? {
            let (is_vertex, list) = (entity.count(at, 1)? == 1, entity.reference(at + 1)?);
            let (index, forward) = (entity.count(at + 2, u32::MAX as usize)?, entity.count(at + 3, 1)? == 1);
            let count = entity.items(at + 4, 2)?;
            let curves =
                (0..count).map(|curve| entity.reference(at + 6 + 2 * curve)).collect::<Found<Vec<u64>>>()?;
            at += 5 + 2 * count;
            if is_vertex {
                continue;
            }
            let mut segments = self.listed_edge(list, index)?;
            if !forward {
                segments.reverse();
            }
            let mut in_parameters = Vec::new();
            for curve in curves {
                in_parameters.extend(self.in_parameters(curve, sheet)?);
            }
            let is_single = segments.len() == 1 && in_parameters.len() == 1;
            let mut curve = in_parameters.pop().filter(|_| is_single);
            for segment in segments {
                let along = segment.forward == forward;
                uses.push(LoopUse { segment, along, curve: curve.take() });
            }
        }
        if uses.is_empty() {
            return Ok(None);
        }
        let has_curves = uses.iter().any(|one| one.curve.is_some());
        if has_curves && !self.is_elementary(sheet) && !self.attach(&uses, sheet)? {
            let why = format!(
                "the curves in the parameters of the loop {number} are not those of its edges, and are made \
                 anew from these"
            );
            remarks.push(Remark::new("IGES_P_CURVES", why));
        }
        let edges = uses.iter().map(|one| used(one.segment.shape, one.along)).collect();
        Ok(Some(used(self.push(ShapeKind::Wire, edges)?, true)))
    }

    /// Gives the edges of a loop their curves in the parameters if all of these lie on them.
    fn attach(&mut self, uses: &[LoopUse], sheet: &Sheet) -> Found<bool> {
        let mut found: HashMap<usize, [Option<Spline>; 2]> = HashMap::new();
        for one in uses {
            let curve =
                one.curve.as_ref().and_then(|curve| self.in_direction(one.segment.shape, curve, sheet));
            let Some(curve) = curve else { return Ok(false) };
            found.entry(one.segment.shape).or_default()[usize::from(!one.along)] = Some(curve);
        }
        for (shape, curves) in found {
            // A seam has a curve for each of its two uses, another edge one for both.
            let (Some(forward), Some(reversed)) =
                (curves[0].as_ref().or(curves[1].as_ref()), curves[1].as_ref().or(curves[0].as_ref()))
            else {
                continue;
            };
            let mut indices = [0; 2];
            for (index, curve) in indices.iter_mut().zip([forward, reversed]) {
                self.spend(curve.controls.len())?;
                self.topology.p_curves.push(Curve::Spline(curve.clone().into()));
                *index = self.topology.p_curves.len() - 1;
            }
            let (surface, location) = (sheet.surface, sheet.location);
            if let ShapeKind::Edge(edge) = &mut self.topology.shapes[shape].kind {
                edge.p_curves.push(PCurve { curves: indices, surface, location, range: [0.0, 1.0] });
            }
        }
        Ok(true)
    }

    /// Returns a curve in the parameters in the direction of an edge, if it stands for it.
    fn in_direction(&self, shape: usize, curve: &Spline, sheet: &Sheet) -> Option<Spline> {
        let ShapeKind::Edge(edge) = &self.topology.shapes[shape].kind else { return None };
        let space = edge.curve.as_ref()?;
        let leaf = Leaf {
            curve: self.topology.curves[space.curve].clone(),
            range: space.range,
            location: space.location,
        };
        let surface = &self.topology.surfaces[sheet.surface];
        let ground = Ground { surface, location: sheet.location, tolerance: self.tolerance };
        let pair = ground.pair_of_edge(curve, &leaf)?;
        Some(if pair.along { curve.clone() } else { curve.clone().reversed() })
    }
}
