//! Random pairs of trimmed models.

mod divided;
mod levels;
mod loops;
mod region;
mod seams;

pub(crate) use region::{Region, Rim};

use super::pairs::{BUDGETS, Pair, random_limit};
use super::partners::{near, scale_and_shift};
use super::surfaces::{Weights, direction, magnitude, surface, surface_of_degree, weights};
use fastrand::Rng;
use glam::{DQuat, DVec2, DVec3};
use loops::Ring;
use nurbs_hausdorff::internals::engine::{Backend, MethodName};
use nurbs_hausdorff::shapes::{lateral, sphere, torus};
use nurbs_hausdorff::trim::FaceArrays;
use nurbs_hausdorff::{Model, ModelArrays, NurbsSurface, RigidTransform, SurfaceArrays};
use std::f64::consts::TAU;

/// The numbers of attempts to draw a face whose loops do not cross.
const ATTEMPTS: usize = 12;

/// Seeds with these remainders by the divisor are of divided faces and of holes over seams; those of the other
/// families stay the same.
const DIVISOR: u64 = 7;
const DIVIDED: u64 = 3;
const OVER_SEAMS: u64 = 5;

/// A face: its surface, and its loops in fractions of the domain.
#[derive(Clone)]
struct DrawnFace {
    surface: SurfaceArrays,
    rings: Option<Vec<Ring>>,
}

/// Returns the pair of a seed, deterministically; `None` where no valid face was drawn.
pub(crate) fn pair(seed: u64) -> Option<Pair> {
    let rng = &mut Rng::with_seed(seed);
    let weights = weights(rng);
    let (kind, mut a, mut b, truth) = if seed % DIVISOR == OVER_SEAMS {
        let [strips, rest] = seams::faces(rng);
        ("strips in holes over seams", strips, rest, None)
    } else if seed % DIVISOR == DIVIDED {
        let surface = any_surface(rng, weights);
        let [whole, parts] = divided::faces(rng, &surface);
        let (a, b) = if rng.u8(0..4) == 0 { (parts, whole) } else { (whole, parts) };
        ("divided faces", a, b, None)
    } else {
        let a = faces(rng, weights)?;
        partner(rng, a, weights)?
    };
    if rng.u8(0..4) == 0 {
        let (scale, shift) = (magnitude(rng, -3.0, 3.0), direction(rng) * magnitude(rng, 0.0, 4.0));
        for face in a.iter_mut().chain(&mut b) {
            scale_and_shift(std::slice::from_mut(&mut face.surface), scale, shift.to_array());
        }
    }
    let turns = truth.is_none() && rng.bool();
    let rotation =
        if turns { DQuat::from_axis_angle(direction(rng), rng.f64() * 0.2) } else { DQuat::IDENTITY };
    let corner = DVec3::from_slice(&a[0].surface.control_points[0][..3]);
    let method = match rng.u8(0..16) {
        0 => MethodName::Iteration,
        1 => MethodName::Hierarchy,
        _ => MethodName::Certified,
    };
    Some(Pair {
        kind,
        transform: RigidTransform::new(rotation, corner - rotation * corner).ok()?,
        a: model(&a)?,
        b: model(&b)?,
        truth,
        tolerance: magnitude(rng, -6.0, -2.0),
        max_cells: BUDGETS[rng.usize(0..BUDGETS.len())],
        symmetric: rng.u8(0..4) == 0,
        limit: random_limit(rng),
        method,
        backend: Backend::Cpu,
        exponent: 0,
    })
}

type Faces = Vec<DrawnFace>;
type Partners = (&'static str, Faces, Faces, Option<[f64; 2]>);

/// Returns A and its partner, with the directed distances where they are known.
fn partner(rng: &mut Rng, a: Faces, weights: Weights) -> Option<Partners> {
    let mut b = a.clone();
    let moved = |faces: &mut Faces, change: &dyn Fn(&[Ring]) -> Vec<Ring>| {
        for face in faces {
            face.rings = face.rings.as_deref().map(change);
        }
    };
    Some(match rng.u8(0..12) {
        0 => ("the same, trimmed", a, b, Some([0.0; 2])),
        1 | 2 => {
            let size = magnitude(rng, -9.0, -1.0);
            let surfaces: Vec<SurfaceArrays> = a.iter().map(|face| face.surface.clone()).collect();
            for (face, surface) in b.iter_mut().zip(near(rng, &surfaces, size)) {
                face.surface = surface;
            }
            ("near-coincident, trimmed", a, b, None)
        }
        3 => {
            moved(&mut b, &|rings| loops::halved(rings));
            ("loops in halves", a, b, None)
        }
        4 | 5 => {
            let by = DVec2::from_angle(rng.f64() * 7.0) * magnitude(rng, -8.0, -1.0);
            moved(&mut b, &|rings| loops::shifted(rings, by));
            ("loops moved", a, b, None)
        }
        6 | 7 => {
            for face in &mut b {
                *face = trimmed(rng, face.surface.clone())?;
            }
            ("trimmed otherwise", a, b, None)
        }
        8 => {
            b.iter_mut().for_each(|face| face.rings = None);
            ("a part of the whole", a, b, Some([0.0, f64::NAN]))
        }
        9 => {
            b.iter_mut().for_each(|face| face.rings = None);
            ("the whole and a part", b, a, Some([f64::NAN, 0.0]))
        }
        10 => {
            let shift = direction(rng) * magnitude(rng, -3.0, 0.0);
            for face in &mut b {
                scale_and_shift(std::slice::from_mut(&mut face.surface), 1.0, shift.to_array());
            }
            ("moved, trimmed", a, b, None)
        }
        _ => {
            let b = faces(rng, weights)?;
            ("unrelated, trimmed", a, b, None)
        }
    })
}

/// Returns one to three faces, most of them trimmed and at least the first.
fn faces(rng: &mut Rng, weights: Weights) -> Option<Faces> {
    (0..rng.usize(1..=3))
        .map(|index| {
            let surface = any_surface(rng, weights);
            let whole = index > 0 && rng.u8(0..4) == 0;
            if whole { Some(DrawnFace { surface, rings: None }) } else { trimmed(rng, surface) }
        })
        .collect()
}

/// Returns a surface with random loops that the library accepts.
fn trimmed(rng: &mut Rng, surface: SurfaceArrays) -> Option<DrawnFace> {
    (0..ATTEMPTS).find_map(|_| {
        let rings = if rng.u8(0..3) == 0 { levels::rings(rng) } else { loops::rings(rng) };
        let face = DrawnFace { surface: surface.clone(), rings: Some(rings) };
        model(std::slice::from_ref(&face)).map(|_| face)
    })
}

/// Returns a surface of CAD models, or one of any degrees and weights.
fn any_surface(rng: &mut Rng, weights: Weights) -> SurfaceArrays {
    let radius = 0.2 + rng.f64();
    match rng.u8(0..10) {
        0 | 1 => surface_of_degree(rng, Weights::Equal, [1, 1], [2, 2]),
        2 => plane(rng),
        3 => lateral([radius; 2], [0.0, 0.5 + rng.f64()]).unwrap().into_arrays(),
        4 => lateral([radius, radius * rng.f64()], [0.0, 0.5 + rng.f64()]).unwrap().into_arrays(),
        5 => first(&sphere(direction(rng), radius).unwrap()),
        6 => first(&torus(radius, radius * (0.1 + 0.8 * rng.f64())).unwrap()),
        7 => surface_of_degree(rng, Weights::Equal, [3, 3], [5, 6]),
        _ => surface(rng, weights),
    }
}

fn first(model: &Model) -> SurfaceArrays {
    model.surfaces()[0].clone().into_arrays()
}

fn plane(rng: &mut Rng) -> SurfaceArrays {
    let [origin, x] = [direction(rng), direction(rng)];
    let y = x.cross(direction(rng));
    let corner = |u: f64, v: f64| (origin + u * x + v * y).extend(1.0).to_array();
    let knots = vec![0.0, 0.0, 1.0, 1.0];
    SurfaceArrays {
        degree: [1, 1],
        knots: [knots.clone(), knots],
        counts: [2, 2],
        control_points: vec![corner(0.0, 0.0), corner(0.0, 1.0), corner(1.0, 0.0), corner(1.0, 1.0)],
    }
}

/// Returns the model of faces, if the library accepts it.
fn model(faces: &[DrawnFace]) -> Option<Model> {
    let face = |face: &DrawnFace| {
        let domain = NurbsSurface::new(0, face.surface.clone()).ok()?.domain();
        let mut trim = face.rings.clone();
        for point in trim.iter_mut().flatten().flatten().flat_map(|curve| &mut curve.control_points) {
            let [u, v] = domain.at([point[0].clamp(0.0, 1.0), point[1].clamp(0.0, 1.0)]);
            (point[0], point[1]) = (u, v);
        }
        let surface = face.surface.clone();
        Some(FaceArrays::new(surface, trim))
    };
    let faces = faces.iter().map(face).collect::<Option<Vec<_>>>()?;
    Model::from_faces(ModelArrays { faces, ..ModelArrays::default() }).ok()
}

/// The distances from loops at which accepted loops must have winding numbers 0 and 1, as
/// exponents of 10 relative to the domain, and the width over which another number is a fault:
/// beyond what validation accepts.
const FAULT_DISTANCES: [f64; 2] = [-5.3, -1.0];
const FAULT_WIDTH: f64 = 2e-6;

/// The number of points of each curve at which winding numbers on both sides are computed.
const FAULT_SAMPLES: usize = 16;

/// Returns in words where an accepted face has a winding number other than 0 and 1.
pub(crate) fn fault(model: &Model) -> Option<String> {
    let rng = &mut Rng::with_seed(1);
    for (index, face) in model.faces().enumerate() {
        let Some(loops) = face.to_arrays().trim else { continue };
        let domain = face.surface().domain();
        let region = Region::new(&loops, domain);
        let extent = DVec2::from(domain.lengths());
        for curve in 0..region.curves() {
            for _ in 0..FAULT_SAMPLES {
                let away = DVec2::from_angle(TAU * rng.f64())
                    * magnitude(rng, FAULT_DISTANCES[0], FAULT_DISTANCES[1]);
                let at = region.at(Rim { curve, t: rng.f64() }) + away * extent;
                let half = 0.5 * FAULT_WIDTH * extent;
                if let Some(found) =
                    region.number(at - half, at + half).filter(|found| !(0..=1).contains(found))
                {
                    return Some(format!("face {index} was accepted with winding number {found} at {at}"));
                }
            }
        }
    }
    None
}
