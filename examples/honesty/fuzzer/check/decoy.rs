//! The decoy: an unrelated deviation that must hide nothing.
//!
//! A false upper bound is seen in the result of a pair only where it is the largest. With far squares that deviate
//! by less than the lower bound, the search need not look at what the bound hides: if `upper` falls, it has lied.

use super::super::pairs::Pair;
use super::super::surfaces::direction;
use super::measurement::measure;
use fastrand::Rng;
use glam::DVec3;
use nurbs_hausdorff::internals::engine::{Backend, DistanceOptions};
use nurbs_hausdorff::options::Audit;
use nurbs_hausdorff::trim::FaceArrays;
use nurbs_hausdorff::{CertifiedOptions, Method, Model, ModelArrays, RigidTransform, SurfaceArrays};

/// The distances of the squares, relative to the lower bound.
const PARTS: [f64; 2] = [0.2, 0.999];

/// How far the squares are, in diagonals of both models and their distance, and half their side in diagonals.
const FAR: f64 = 8.0;
const HALF: f64 = 0.01;

/// Roundings of the coordinates of the squares, relative to their size.
const ROUNDING: f64 = 1e-13;

/// Returns in words what a decoy changed that it must not; `None` also where the pair has no lower bound.
pub(super) fn violation(seed: u64, pair: &Pair) -> Option<String> {
    let rng = &mut Rng::with_seed(seed ^ 0x00de_c0f5);
    let boxes = [pair.a.bounding_box(), pair.b.bounding_box()];
    let diagonal = boxes[0].diagonal().max(boxes[1].diagonal());
    if pair.exponent != 0 || pair.backend != Backend::Cpu || diagonal == 0.0 {
        return None;
    }
    let options = |limit: Option<f64>| DistanceOptions {
        tolerance: Some(pair.tolerance * diagonal),
        transform: pair.transform,
        limit,
        method: Method::Certified(CertifiedOptions {
            max_cells: Some(pair.max_cells),
            audit: Audit::Share,
            ..Default::default()
        }),
        ..DistanceOptions::default()
    };
    let (alone, _) = measure(pair, &options(None)).ok()?;
    if alone.lower <= 0.0 {
        return None;
    }
    let part = PARTS[0] + (PARTS[1] - PARTS[0]) * rng.f64();
    // Farther from A than B is, also where the models are many diagonals apart.
    let far = FAR * (diagonal + alone.upper);
    let away = far * direction(rng);
    let middle = boxes[0].center() + away;
    let moved = |at: DVec3| pair.transform.apply(at);
    let normal = direction(rng);
    let shift = part * alone.lower * normal;
    let a = with_square(&pair.a, pair.transform.inverse(), moved(middle), normal, HALF * diagonal)?;
    let b = with_square(&pair.b, RigidTransform::IDENTITY, moved(middle) + shift, normal, HALF * diagonal)?;
    let with_decoy = Pair { a, b, ..copy_of(pair) };
    let size = boxes[1].farthest_from_origin() + far + 2.0 * diagonal + pair.transform.offset().length();
    let least = alone.lower - ROUNDING * size;
    // A limit between the decoy and the distance is exceeded.
    let limit =
        rng.bool().then(|| alone.lower * (part + (1.0 - part) * rng.f64())).filter(|limit| *limit < least);
    let (result, _) = measure(&with_decoy, &options(limit)).ok()?;
    let within = result.certified().and_then(|details| details.within);
    if result.upper < least || within == Some(true) {
        return Some(format!(
            "with a decoy at {part} of the lower bound {:e}, upper is {:e} and within {limit:?} is {within:?}",
            alone.lower, result.upper
        ));
    }
    None
}

/// The pair without its models' faces being drawn again.
fn copy_of(pair: &Pair) -> Pair {
    Pair { a: pair.a.clone(), b: pair.b.clone(), ..*pair }
}

/// The model with a square that this motion puts at a place.
fn with_square(
    model: &Model,
    motion: RigidTransform,
    middle: DVec3,
    normal: DVec3,
    half: f64,
) -> Option<Model> {
    let (x, y) = normal.any_orthonormal_pair();
    let corner = |u: f64, v: f64| motion.apply(middle + half * (u * x + v * y)).extend(1.0).to_array();
    let surface = SurfaceArrays {
        degree: [1, 1],
        knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
        counts: [2, 2],
        control_points: vec![corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, -1.0), corner(1.0, 1.0)],
    };
    let square = FaceArrays::new(surface, None);
    let faces = model.faces().map(|face| face.to_arrays()).chain([square]).collect();
    Model::from_faces(ModelArrays { faces, ..ModelArrays::default() }).ok()
}
