//! Solids, shells, faces and loops, types 186 and 508 to 514.

use super::edges::Segment;
use super::pairing::Ground;
use super::{Shapes, Sheet, used};
use crate::brep::iges::file::Found;
use crate::brep::iges::geometry::Leaf;
use crate::brep::nurbs::{Curve, Spline};
use crate::brep::topology::{PCurve, ShapeKind, Use};
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
        let mut wires = Vec::new();
        // The flag of the outer loop stands between the count and the loops.
        for index in 0..entity.items(2, 1)? {
            wires.extend(self.loop_of(entity.reference(4 + index)?, &sheet)?);
        }
        self.push_face_of(&entity.entry, &sheet, &DAffine3::IDENTITY, wires, Vec::new())
    }

    /// Returns the wire of a loop, type 508, with the material on its left seen along the normal
    /// of the surface; none for a vertex.
    fn loop_of(&mut self, number: u64, sheet: &Sheet) -> Found<Option<Use>> {
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
        self.attach(&uses, sheet)?;
        let edges = uses.iter().map(|one| used(one.segment.shape, one.along)).collect();
        Ok(Some(used(self.push(ShapeKind::Wire, edges)?, true)))
    }

    /// Gives edges their curves in the parameters where these lie on them: to a seam, which the
    /// loop uses once each way, both or none.
    fn attach(&mut self, uses: &[LoopUse], sheet: &Sheet) -> Found<()> {
        let mut curves: HashMap<usize, Vec<(bool, Option<Spline>)>> = HashMap::new();
        for one in uses {
            let curve =
                one.curve.as_ref().and_then(|curve| self.in_direction(one.segment.shape, curve, sheet));
            curves.entry(one.segment.shape).or_default().push((one.along, curve));
        }
        for (shape, mut found) in curves {
            found.sort_by_key(|&(along, _)| !along);
            let both = match found.as_slice() {
                [(_, Some(one))] => [one, one],
                [(true, Some(forward)), (false, Some(reversed))] => [forward, reversed],
                _ => continue,
            };
            let mut indices = [0; 2];
            for (index, curve) in indices.iter_mut().zip(both) {
                self.spend(curve.controls.len())?;
                self.topology.p_curves.push(Curve::Spline(curve.clone().into()));
                *index = self.topology.p_curves.len() - 1;
            }
            let (surface, location) = (sheet.surface, sheet.location);
            if let ShapeKind::Edge(edge) = &mut self.topology.shapes[shape].kind {
                edge.p_curves.push(PCurve { curves: indices, surface, location, range: [0.0, 1.0] });
            }
        }
        Ok(())
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
