//! Curves of edges in the parameters of their surfaces, where the file has them.

use super::Shapes;
use crate::gap::Lifted;
use crate::nurbs::{Curve, Surface};
use crate::report::FaceFault;
use crate::step::exchange::Entity;
use crate::step::geometry::{Scale, curve};
use crate::topology::{PCurve, SpaceCurve};
use glam::DAffine3;

/// The part of an edge's size by which its curve in the parameters may be off, or the uncertainty of the
/// file if that is more: the ends of less accurate ones miss each other.
const NEAR: f64 = 1e-5;

/// The parts of an edge's range at whose ends both curves are compared at equal parameters.
const PARTS: usize = 4;

impl Shapes<'_> {
    /// Returns the curves in the parameters that the file states for the curve `instance` of an edge and
    /// that run along it; others are made anew from the curve in space.
    pub(super) fn p_curves(&mut self, instance: u64, space: &SpaceCurve) -> Vec<PCurve> {
        let stated = self.stated(instance).unwrap_or_default();
        let mut found: Vec<PCurve> = Vec::new();
        for (surface, drawing) in stated {
            let Ok(surface) = self.surface(surface) else { continue };
            // The image of any curve in a plane is exact.
            if matches!(self.topology.surfaces[surface].elementary(), Surface::Plane(_)) {
                continue;
            }
            let scale = Scale::of_parameters(&self.topology.surfaces[surface], &self.units);
            let Ok(curve) = curve(self.file, drawing, &scale) else { continue };
            let side = found.iter().position(|known| known.surface == surface);
            let range = match side {
                // The other side of a seam.
                Some(known) => {
                    let range = found[known].range;
                    self.is_along(&curve, range, surface, space).then_some(range)
                }
                None => self.range_along(&curve, surface, space),
            };
            let Some(range) = range else { continue };
            self.topology.p_curves.push(curve);
            let index = self.topology.p_curves.len() - 1;
            match side {
                Some(known) => found[known].curves[1] = index,
                None => {
                    found.push(PCurve { curves: [index; 2], surface, location: DAffine3::IDENTITY, range });
                }
            }
        }
        found
    }

    /// Returns the surfaces of a curve on surfaces, each with the curve in its parameter plane.
    fn stated(&self, instance: u64) -> Result<Vec<(u64, u64)>, FaceFault> {
        let entity = self.file.entity(instance)?;
        let is_on_surfaces = matches!(
            entity.kind.as_str(),
            "SURFACE_CURVE" | "SEAM_CURVE" | "INTERSECTION_CURVE" | "BOUNDED_SURFACE_CURVE"
        );
        if !is_on_surfaces {
            return Ok(Vec::new());
        }
        let of_p_curve = |&instance: &u64| self.p_curve(&self.file.entity(instance)?);
        // An associated surface alone states no curve.
        Ok(entity.references(2)?.iter().filter_map(|instance| of_p_curve(instance).ok()).collect())
    }

    /// Returns the surface of a curve in parameters, and the curve in its plane.
    pub(super) fn p_curve(&self, p_curve: &Entity<'_>) -> Result<(u64, u64), FaceFault> {
        if p_curve.kind != "PCURVE" {
            return Err(p_curve.unknown("a curve in the parameters"));
        }
        let drawing = self.file.entity(p_curve.reference(2)?)?;
        let items = drawing.references(1)?;
        let curve = items.first().ok_or_else(|| drawing.fault(1, "a curve"))?;
        Ok((p_curve.reference(1)?, *curve))
    }

    /// Returns the range over which a curve on a surface runs along a curve in space: that of the latter, a
    /// period from it or, for straight lines, that of another speed; `None` if it does not.
    fn range_along(&self, p_curve: &Curve, surface: usize, space: &SpaceCurve) -> Option<[f64; 2]> {
        let period = self.topology.curves[space.curve].period().unwrap_or(0.0);
        let shifts: &[f64] = if period > 0.0 { &[0.0, 1.0, -1.0] } else { &[0.0] };
        let shifted = shifts.iter().map(|turns| space.range.map(|t| t + turns * period));
        let mut ranges = shifted.chain(self.range_of_line(p_curve, surface, space));
        ranges.find(|&range| self.is_along(p_curve, range, surface, space))
    }

    /// Returns the range between the ends of a straight edge on a line of parameters that is straight in space,
    /// as a generatrix: cones are written with lines of length 1 in either.
    fn range_of_line(&self, p_curve: &Curve, surface: usize, space: &SpaceCurve) -> Option<[f64; 2]> {
        let (surface, edge) = (&self.topology.surfaces[surface], &self.topology.curves[space.curve]);
        let (Curve::Line { .. }, Curve::Line { .. }) = (p_curve, edge) else { return None };
        let origin = lifted(surface, p_curve, 0.0);
        let step = lifted(surface, p_curve, 1.0) - origin;
        let [start, end] = space.range.map(|t| (edge.point(t) - origin).dot(step) / step.length_squared());
        (start < end).then_some([start, end])
    }

    fn is_along(&self, p_curve: &Curve, range: [f64; 2], surface: usize, space: &SpaceCurve) -> bool {
        let (surface, edge) = (&self.topology.surfaces[surface], &self.topology.curves[space.curve]);
        if !p_curve.natural_range().is_none_or(|natural| contains(natural, range)) {
            return false;
        }
        let ends = range.map(|t| p_curve.point(t));
        let (natural, periods) = (surface.natural_ranges(), surface.periods());
        let is_on_surface = (0..2).all(|axis| match natural[axis] {
            Some(natural) if periods[axis].is_none() => {
                ends.iter().all(|end| contains(natural, [end[axis]; 2]))
            }
            _ => true,
        });
        let allowed = (NEAR * edge.size(space.range)).max(self.units.uncertainty);
        let apart = |part: usize| {
            let [at, on_edge] =
                [range, space.range].map(|[start, end]| start + (end - start) * part as f64 / PARTS as f64);
            lifted(surface, p_curve, at).distance(edge.point(on_edge))
        };
        is_on_surface
            && (0..=PARTS).all(|part| apart(part) <= allowed)
            && Lifted {
                surface,
                surface_location: DAffine3::IDENTITY,
                curve: p_curve,
                range,
                edge,
                edge_location: space.location,
                edge_range: space.range,
            }
            .measured()
                <= allowed
    }
}

/// Returns whether a range contains another, up to their rounding in the file.
fn contains([low, high]: [f64; 2], [start, end]: [f64; 2]) -> bool {
    let margin = IN_FILE * (low.abs() + high.abs());
    low - margin <= start && end <= high + margin
}

/// The rounding of numbers of a file, relative to their size.
const IN_FILE: f64 = 1e-9;

fn lifted(surface: &Surface, p_curve: &Curve, t: f64) -> glam::DVec3 {
    let at = p_curve.point(t);
    surface.point(at.x, at.y)
}
