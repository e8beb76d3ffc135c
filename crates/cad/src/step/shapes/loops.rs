//! Loops of faces as wires.

use super::edges::Segment;
use super::{Shapes, used};
use crate::report::FaceFault;
use crate::step::geometry::point;
use crate::topology::{ShapeKind, Use};
use glam::DVec3;

/// The kinds of oriented uses, with the attribute that is the element; the one behind it is the orientation.
pub(super) const ORIENTED_EDGE: (&str, usize) = ("ORIENTED_EDGE", 3);
pub(super) const ORIENTED_FACE: (&str, usize) = ("ORIENTED_FACE", 2);

/// The most uses of uses: more are damage.
const MAX_USES: usize = 8;

impl Shapes<'_> {
    /// Returns the wire of a bound of a face, oriented with the material on its left seen along
    /// the normal of the face; none for the bound that is a vertex.
    pub(super) fn bound(&mut self, instance: u64) -> Result<Option<Use>, FaceFault> {
        let bound = self.file.entity(instance)?;
        if !matches!(bound.kind.as_str(), "FACE_BOUND" | "FACE_OUTER_BOUND") {
            return Err(bound.unknown("a bound of a face"));
        }
        let path = self.file.entity(bound.reference(1)?)?;
        let edges = match path.kind.as_str() {
            "EDGE_LOOP" => self.oriented_edges(&path.references(1)?)?,
            "POLY_LOOP" => self.polygon(&path.references(1)?)?,
            "VERTEX_LOOP" => return Ok(None),
            _ => return Err(path.unknown("a loop")),
        };
        if edges.is_empty() {
            return Err(path.fault(1, "a list of edges"));
        }
        let wire = self.push(ShapeKind::Wire, edges)?;
        Ok(Some(used(wire, bound.flag(2)?)))
    }

    fn oriented_edges(&mut self, instances: &[u64]) -> Result<Vec<Use>, FaceFault> {
        let mut uses = Vec::with_capacity(instances.len());
        for &instance in instances {
            let (edge, forward) = self.oriented(instance, ORIENTED_EDGE)?;
            if edge == instance {
                return Err(self.file.entity(instance)?.unknown("an oriented edge"));
            }
            let segments = self.edge(edge)?;
            let along = |segment: &Segment| used(segment.shape, segment.forward == forward);
            if forward {
                uses.extend(segments.iter().map(along));
            } else {
                uses.extend(segments.iter().rev().map(along));
            }
        }
        Ok(uses)
    }

    /// Returns the edge or face of an oriented use, and whether it is used as it is. The standard has no use of a
    /// use, but some writers do; an instance of another kind is itself.
    ///
    /// # Errors
    /// `STEP_NESTING` for uses of each other, and those of entities.
    pub(super) fn oriented(
        &self,
        instance: u64,
        (kind, element): (&str, usize),
    ) -> Result<(u64, bool), FaceFault> {
        let (mut at, mut forward) = (instance, true);
        for _ in 0..MAX_USES {
            let entity = self.file.entity(at)?;
            if entity.kind != kind {
                return Ok((at, forward));
            }
            forward ^= !entity.flag(element + 1)?;
            at = entity.reference(element)?;
        }
        let why = format!("#{instance}, {kind}, is a use of more than {MAX_USES} uses of each other");
        Err(FaceFault::new("STEP_NESTING", why))
    }

    fn polygon(&mut self, points: &[u64]) -> Result<Vec<Use>, FaceFault> {
        let next = points.iter().cycle().skip(1);
        let mut uses = Vec::with_capacity(points.len());
        for (&from, &to) in points.iter().zip(next) {
            uses.extend(self.straight([from, to])?.map(|segment| used(segment.shape, segment.forward)));
        }
        Ok(uses)
    }

    /// Returns the points of the first polygon among the bounds of a face.
    pub(super) fn corners(&self, bounds: &[u64]) -> Result<Vec<DVec3>, FaceFault> {
        for &instance in bounds {
            let path = self.file.entity(self.file.entity(instance)?.reference(1)?)?;
            if path.kind == "POLY_LOOP" {
                return path.references(1)?.iter().map(|&at| point(self.file, at, &self.scale())).collect();
            }
        }
        Ok(Vec::new())
    }
}
