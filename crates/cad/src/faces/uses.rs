//! The curves of a wire's edges in the parameter plane of a face.

use super::found_curve::{FoundCurve, lifted};
use super::gap::Gap;
use super::inversion::invert;
use super::section::Section;
use crate::digits::three_digits;
use crate::nurbs::{Spline, Surface};
use crate::report::FaceFault;
use crate::topology::{Edge, Face, Orientation, PCurve, ShapeKind, SpaceCurve, Topology, Use};
use glam::{DAffine3, DVec3};

/// An edge as part of a loop.
#[derive(Debug, Clone)]
pub(super) struct TrimUse {
    /// The curve in the parameters of the file, along the loop.
    pub(super) curve: Spline,
    /// The number of the edge; `None` for curves that no edge of the file is.
    pub(super) edge: Option<u32>,
    /// Whether the wire uses the edge against its direction.
    pub(super) reversed: bool,
    /// The vertices at the start and the end, as indices of shapes.
    pub(super) vertices: [Option<usize>; 2],
    /// The tolerance of the edge, and that of the vertex at its end.
    pub(super) tolerance: f64,
    pub(super) end_tolerance: f64,
    /// The distance between the curve on the surface and the edge.
    pub(super) gap: Gap,
    /// Whether the curve is a fit, and not the file's or exact.
    pub(super) fitted: bool,
    /// Whether the edge is a point in space, as at a pole.
    pub(super) degenerate: bool,
    /// The plane whose section with the surface the edge is, between the curve's ends, and the
    /// distance between both.
    pub(super) section: Option<(Section, Gap)>,
    /// The distance in the parameters by which the curve deviates from the file's.
    pub(super) deviation: f64,
    /// Whether the file places the curve; one made from the edge may lie periods away.
    pub(super) is_placed: bool,
}

impl TrimUse {
    /// A segment that no edge of the file is.
    pub(super) fn segment(start: DVec3, end: DVec3) -> Self {
        let curve = Spline::segment([0.0, 1.0], start, end);
        Self {
            curve,
            edge: None,
            reversed: false,
            vertices: [None; 2],
            tolerance: 0.0,
            end_tolerance: 0.0,
            gap: Gap::default(),
            fitted: false,
            degenerate: false,
            section: None,
            deviation: 0.0,
            is_placed: true,
        }
    }

    /// Returns the box of the control points.
    pub(super) fn hull(&self) -> [DVec3; 2] {
        let points = || self.curve.points();
        [points().fold(DVec3::INFINITY, DVec3::min), points().fold(DVec3::NEG_INFINITY, DVec3::max)]
    }

    /// Returns a box that contains the curve, and little more.
    pub(super) fn bounds(&self) -> [DVec3; 2] {
        let pieces = self.curve.pieces();
        let ends = || pieces.iter().flat_map(|piece| [piece.start(), piece.end()]);
        let mut bounds =
            [ends().fold(DVec3::INFINITY, DVec3::min), ends().fold(DVec3::NEG_INFINITY, DVec3::max)];
        for piece in &pieces {
            let [low, high] = bounds;
            // Most curves stay within the box of the ends, as their control points show.
            if piece.points().all(|point| point.cmpge(low).all() && point.cmple(high).all()) {
                continue;
            }
            let [start, end] = piece.domain();
            let at = |index: usize| start + (end - start) * index as f64 / BOX_PARTS as f64;
            for part in 0..BOX_PARTS {
                for point in piece.sub_piece([at(part), at(part + 1)]).points() {
                    bounds = [bounds[0].min(point), bounds[1].max(point)];
                }
            }
        }
        bounds
    }
}

/// The number of parts of a piece whose control points bound it: they leave it by about
/// a 64th of what those of the whole do.
const BOX_PARTS: usize = 8;

/// The origin of curves in the parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Origin {
    /// The file, or the edge in space where the file has none.
    Stated,
    /// The edge in space wherever there is one.
    Made,
}

/// Returns the curves of a wire in the order of the file, each along the loop.
pub(super) fn of_wire(
    file: &Topology,
    face_shape: usize,
    wire: &Use,
    surface: &Surface,
    origin: Origin,
) -> Result<Vec<TrimUse>, FaceFault> {
    let ShapeKind::Face(face) = &file.shapes[face_shape].kind else { return Ok(Vec::new()) };
    let mut uses = Vec::new();
    for child in &file.shapes[wire.shape].children {
        let ShapeKind::Edge(edge) = &file.shapes[child.shape].kind else { continue };
        let reversed = match child.orientation {
            Orientation::Forward => wire.orientation == Orientation::Reversed,
            Orientation::Reversed => wire.orientation == Orientation::Forward,
            // Edges within the face do not bound it.
            Orientation::Internal | Orientation::External => continue,
        };
        let location = wire.location * child.location;
        let found = of_edge(file, (face, surface), edge, &location, (origin, reversed));
        let found = found.map_err(|FaceFault { code, why }| FaceFault {
            code,
            why: format!("edge {}: {why}", child.shape),
        })?;
        let Some(FoundCurve { curve, gap, fitted, section, deviation, is_placed }) = found else { continue };
        let mut vertices = vertices(file, child.shape);
        if reversed {
            vertices.reverse();
        }
        uses.push(TrimUse {
            curve: if reversed { curve.reversed() } else { curve },
            edge: u32::try_from(child.shape).ok(),
            reversed,
            vertices,
            tolerance: edge.tolerance,
            end_tolerance: vertices[1].map_or(0.0, |vertex| match file.shapes[vertex].kind {
                ShapeKind::Vertex(tolerance) => tolerance,
                _ => 0.0,
            }),
            gap,
            fitted,
            degenerate: edge.degenerate,
            section,
            deviation,
            is_placed,
        });
    }
    if wire.orientation == Orientation::Reversed {
        uses.reverse();
    }
    Ok(uses)
}

/// Returns the vertices at the start and end of an edge.
fn vertices(file: &Topology, edge: usize) -> [Option<usize>; 2] {
    [Orientation::Forward, Orientation::Reversed].map(|orientation| {
        let children = &file.shapes[edge].children;
        children.iter().find(|child| child.orientation == orientation).map(|child| child.shape)
    })
}

/// Returns the curve of an edge in the direction of the edge. `None` for an edge of no
/// length.
fn of_edge(
    file: &Topology,
    (face, surface): (&Face, &Surface),
    edge: &Edge,
    location: &DAffine3,
    (origin, reversed): (Origin, bool),
) -> Result<Option<FoundCurve>, FaceFault> {
    let Ok(index) = face.surface else { return Ok(None) };
    if let Some(SpaceCurve { curve, range, .. }) = &edge.curve {
        check_whole(file.curves[*curve].jumps(*range), edge.tolerance)?;
    }
    let stated = p_curve(edge, index, location, &face.location);
    let Some(p_curve) = stated.filter(|_| origin == Origin::Stated || edge.curve.is_none()) else {
        if edge.degenerate {
            return Ok(None);
        }
        return invert(file, face, surface, edge, location, reversed).map(Some);
    };
    let curve = &file.p_curves[p_curve.curves[usize::from(reversed)]];
    let [start, end] = p_curve.range;
    if start >= end {
        return Ok(None);
    }
    let jumps = curve.jumps(p_curve.range);
    check_whole(jumps.iter().map(|jump| jump.map(|at| surface.point(at.x, at.y))).collect(), edge.tolerance)?;
    let (spline, _, deviation) = curve.spline(p_curve.range)?;
    if !spline.points().all(DVec3::is_finite) {
        return Err(FaceFault::new("BREP_NUMBER_TOO_LARGE", "the curve's control points overflow"));
    }
    let lifted = lifted(file, (face, surface), edge, location, (curve, p_curve.range));
    let gap = lifted.as_ref().map_or_else(Gap::default, Gap::of);
    let found =
        FoundCurve { curve: spline, gap, fitted: deviation > 0.0, section: None, deviation, is_placed: true };
    Ok(Some(match lifted.filter(|_| surface.is_ruled_by_angles()) {
        Some(lifted) => {
            let to_face = face.location.inverse() * lifted.edge_location;
            found.with_section(&to_face, &lifted)
        }
        None => found,
    }))
}

/// Checks that a curve does not jump farther than the tolerance of its edge.
fn check_whole(jumps: Vec<[DVec3; 2]>, tolerance: f64) -> Result<(), FaceFault> {
    let lengths = jumps.iter().map(|[before, behind]| before.distance(*behind));
    match lengths.fold(0.0, f64::max) {
        longest if longest <= tolerance => Ok(()),
        longest => {
            let why = format!("its curve is torn by {} at an inner knot", three_digits(longest));
            Err(FaceFault::new("BREP_EDGE_TORN", why))
        }
    }
}

/// Returns the curve of an edge on a surface. An edge moved by `location` lies on the
/// surface moved by `surface_location` if its own entry states the surface moved by the
/// quotient; where none does, any entry of the surface is taken.
fn p_curve<'a>(
    edge: &'a Edge,
    surface: usize,
    location: &DAffine3,
    surface_location: &DAffine3,
) -> Option<&'a PCurve> {
    let mut entries = edge.p_curves.iter().filter(|entry| entry.surface == surface);
    let same = |entry: &&PCurve| (*location * entry.location).abs_diff_eq(*surface_location, SAME_LOCATION);
    entries.clone().find(same).or_else(|| entries.next())
}

/// The largest difference of entries of equal locations, which products round differently.
const SAME_LOCATION: f64 = 1e-9;
