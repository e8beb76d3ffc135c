//! From a face of the file to a surface and closed loops in its parameters.
//!
//! The stages: [`uses`] finds the curve of each edge in the parameter plane, made by
//! [`inversion`] and [`projection`] where the file has none, or the plane
//! [`section`] that it is; [`loops`] makes closed loops of them, with the material on their
//! left; [`mapping`] takes the curves to the parameters of the exact NURBS; [`joints`] makes
//! the loops meet in equal floats.

mod fit;
mod found_curve;
mod gap;
mod inversion;
mod joints;
mod loops;
mod mapping;
mod metric;
mod projection;
mod section;
mod uses;

use super::nurbs::{Surface, SurfaceNet};
use super::report::{FaceFault, Remark};
use super::topology::{Face, ShapeKind, Topology};
use glam::DVec3;
use loops::Loops;
use mapping::Mapped;
use metric::Metric;
use nurbs_hausdorff::trim::{FaceArrays, TrimCurveArrays};
use std::borrow::Cow;
use uses::TrimUse;

/// A face in the form of the interchange.
pub(super) struct Converted {
    pub(super) face: FaceArrays,
    /// The number of trimming curves that are exact.
    pub(super) exact: usize,
    /// The number of fitted trimming curves.
    pub(super) fitted: usize,
    /// What the report says of the face.
    pub(super) remarks: Vec<Remark>,
    /// Whether the rest of the closed surface is a face with the same edges.
    pub(super) complement_fits: bool,
}

/// The longest range of a periodic parameter that loops may cover, in periods. A loop of
/// one period may begin anywhere, so that one more is enough.
const MAX_PERIODS: f64 = 2.0;

/// Converts a face.
///
/// # Errors
/// The reason for which it cannot be read.
pub(super) fn convert(file: &Topology, shape: usize) -> Result<Converted, FaceFault> {
    let ShapeKind::Face(face) = &file.shapes[shape].kind else {
        return Err(FaceFault::new("BREP_FACE", "the shape is not a face"));
    };
    let stated = &file.surfaces[*face.surface.as_ref().map_err(FaceFault::clone)?];
    let (surface, Loops { loops, remarks, complement_fits }, turned) =
        on_either_side(file, shape, face, stated)?;
    let surface = surface.as_ref();
    let remarks = face.remarks.iter().cloned().chain(remarks).chain(turned).collect();
    let scale = face.location.matrix3.determinant().abs().cbrt();
    let arrays = |net: SurfaceNet, trim, is_measured: bool| FaceArrays {
        gap: scale * net.error,
        gap_measured: is_measured || net.is_measured,
        surface: net.into_arrays(&face.location),
        trim,
        reversed: false,
        face_name: None,
        kind: Some(surface.kind().to_owned()),
        color: None,
        shell: None,
        solid: None,
    };
    if loops.is_empty() {
        let [Some(u), Some(v)] = surface.natural_ranges() else {
            return Err(FaceFault::new("BREP_UNBOUNDED", "the face has no loops and its surface no bounds"));
        };
        let net = net(surface, [u, v])?;
        // A B-spline keeps its domain; the surface may be a part of it.
        let net = if matches!(surface.elementary(), Surface::Spline(_)) { net.within([u, v]) } else { net };
        return Ok(Converted {
            face: arrays(net, None, false),
            exact: 0,
            fitted: 0,
            remarks,
            complement_fits,
        });
    }
    let net = net(surface, ranges(surface, &loops)?)?;
    let metric = Metric::of(&net)?;
    let mut mapped: Vec<Vec<Mapped>> = loops
        .into_iter()
        .map(|uses| uses.into_iter().flat_map(|trim_use| mapping::map(trim_use, &net, &metric)).collect())
        .collect();
    joints::join(&mut mapped, &net, &metric);
    let curves = || mapped.iter().flatten();
    // On a surface that is approximated every curve is.
    let fitted = curves().filter(|curve| curve.fitted || net.error > 0.0).count();
    let exact = curves().count() - fitted;
    let is_measured = curves().any(|curve| curve.gap.is_measured);
    let trim = mapped.iter().map(|curves| curves.iter().map(curve_arrays).collect()).collect();
    Ok(Converted { face: arrays(net, Some(trim), is_measured), exact, fitted, remarks, complement_fits })
}

/// Returns the surface and the loops of a face; if its edges lie on the offset to the other side alone, those
/// there and the remark on it.
fn on_either_side<'a>(
    file: &'a Topology,
    shape: usize,
    face: &Face,
    stated: &'a Surface,
) -> Result<(Cow<'a, Surface>, Loops, Option<Remark>), FaceFault> {
    let fault = match loops_of(file, shape, stated) {
        Ok((surface, loops)) => return Ok((surface, loops, None)),
        Err(fault) => fault,
    };
    let Some(other) = face.other_side else { return Err(fault) };
    match loops_of(file, shape, &file.surfaces[other]) {
        Ok((surface, loops)) => {
            let why = "the edges are not on the offset to the side that the file states, but on that to the other one";
            Ok((surface, loops, Some(Remark::new("BREP_OFFSET_SIDE", why))))
        }
        Err(_) => Err(fault),
    }
}

/// Returns the loops of a face, and its surface: as the file states it, or, if an edge crosses the seam of
/// a closed B-spline, with parameters that continue over the seam.
fn loops_of<'a>(
    file: &Topology,
    shape: usize,
    stated: &'a Surface,
) -> Result<(Cow<'a, Surface>, Loops), FaceFault> {
    let fault = match loops::of_face(file, shape, stated) {
        Ok(loops) => return Ok((Cow::Borrowed(stated), loops)),
        Err(fault) => fault,
    };
    let Some(continued) = stated.continued() else { return Err(fault) };
    match loops::of_face(file, shape, &continued) {
        Ok(loops) => Ok((Cow::Owned(continued), loops)),
        Err(_) => Err(fault),
    }
}

/// Returns the ranges of u and v that loops cover.
fn ranges(surface: &Surface, loops: &[Vec<TrimUse>]) -> Result<[[f64; 2]; 2], FaceFault> {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    // Control points inside of the domain need no cuts later; but beyond a pole, and where a
    // B-spline would have to be extended to them, the curves themselves are bounded.
    let bounded = matches!(surface.elementary(), Surface::Spline(_) | Surface::Offset { .. });
    let tight = bounded || !surface.poles().is_empty();
    for curve in loops.iter().flatten() {
        let [curve_low, curve_high] = if tight { curve.bounds() } else { curve.hull() };
        (low, high) = (low.min(curve_low), high.max(curve_high));
    }
    let periods = surface.periods();
    for axis in [0, 1] {
        let length = high[axis] - low[axis];
        if !(length > 0.0 && length.is_finite()) {
            return Err(FaceFault::new(
                "BREP_LOOP_NO_AREA",
                format!("the loops cover a range of {length:?}"),
            ));
        }
        if periods[axis].is_some_and(|period| length > MAX_PERIODS * period * (1.0 + 1e-9)) {
            let why = format!("the loops cover a range of {length:?}, expected at most two periods");
            return Err(FaceFault::new("BREP_TOO_MANY_PERIODS", why));
        }
    }
    Ok([[low.x, high.x], [low.y, high.y]])
}

fn net(surface: &Surface, ranges: [[f64; 2]; 2]) -> Result<SurfaceNet, FaceFault> {
    let net = surface.net(ranges)?;
    if !net.has_positive_weights() {
        let why = "the loops leave the surface so far that its continuation has weights below 0";
        return Err(FaceFault::new("BREP_OUTSIDE_DOMAIN", why));
    }
    Ok(net.of_accepted_degree()?)
}

fn curve_arrays(mapped: &Mapped) -> TrimCurveArrays {
    let control = |control: &glam::DVec4| {
        let point = super::nurbs::project(*control);
        [point.x, point.y, control.w]
    };
    TrimCurveArrays {
        degree: mapped.curve.degree,
        knots: mapped.curve.knots.clone(),
        control_points: mapped.curve.controls.iter().map(control).collect(),
        gap: mapped.gap.length,
        edge: mapped.edge,
    }
}
