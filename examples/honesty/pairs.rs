//! Random pairs of models of every awkward kind.

use fastrand::Rng;
use glam::{DQuat, DVec3};
use nurbs_hausdorff::shapes::operations::{elevate_degree, insert_knot};
use nurbs_hausdorff::{Model, NurbsSurface, RigidTransform, SurfaceArrays};

/// What is measured.
pub(crate) struct Pair {
    pub(crate) a: Model,
    pub(crate) b: Model,
    pub(crate) transform: RigidTransform,
    pub(crate) tolerance: f64,
    pub(crate) symmetric: bool,
    pub(crate) kind: &'static str,
}

/// The pair of a seed, always the same.
pub(crate) fn pair(seed: u64) -> Pair {
    let rng = &mut Rng::with_seed(seed);
    let polynomial = rng.u8(0..3) == 0;
    let mut a: Vec<SurfaceArrays> = (0..rng.usize(1..=4)).map(|_| surface(rng, polynomial)).collect();
    let (mut b, kind) = match rng.u8(0..6) {
        0 => (near(rng, &a, 0.0), "the same"),
        1 => {
            let size = 10_f64.powf(rng.f64() * 5.0 - 6.0);
            (near(rng, &a, size), "near-coincident")
        }
        2 => (moved(rng, &a), "moved"),
        3 => (refined(rng, &a), "refined"),
        _ => ((0..rng.usize(1..=4)).map(|_| surface(rng, polynomial)).collect(), "unrelated"),
    };
    if rng.u8(0..4) == 0 {
        let (scale, far) =
            (10_f64.powf(rng.f64() * 6.0 - 3.0), direction(rng) * 10_f64.powf(rng.f64() * 6.0));
        for model in [&mut a, &mut b] {
            place(model, scale, far);
        }
    }
    let rotation =
        if rng.bool() { DQuat::IDENTITY } else { DQuat::from_axis_angle(direction(rng), rng.f64() * 0.2) };
    // About A's own corner, so that far models stay near each other.
    let corner = DVec3::from_slice(&a[0].control_points[0][..3]);
    let translation = corner - rotation * corner;
    Pair {
        transform: RigidTransform::new(rotation, translation).unwrap(),
        a: Model::from_arrays(None, a).unwrap(),
        b: Model::from_arrays(None, b).unwrap(),
        tolerance: 10_f64.powf(-2.0 - 4.0 * rng.f64()),
        symmetric: rng.u8(0..4) == 0,
        kind,
    }
}

fn direction(rng: &mut Rng) -> DVec3 {
    loop {
        let inside = DVec3::new(rng.f64(), rng.f64(), rng.f64()) * 2.0 - DVec3::ONE;
        if inside.length() > 0.1 {
            return inside.normalize();
        }
    }
}

/// Degrees 1 to 7, weights 0.2 to 5, knots clamped or not, sometimes a collapsed edge.
fn surface(rng: &mut Rng, polynomial: bool) -> SurfaceArrays {
    let degree = [rng.usize(1..=7), rng.usize(1..=7)];
    let counts = degree.map(|degree| degree + 1 + rng.usize(0..=3));
    let knots = [0, 1].map(|axis| knots(rng, degree[axis], counts[axis]));
    let (height, noise) = (rng.f64(), rng.f64() * 0.3);
    let shift = direction(rng) * rng.f64();
    let mut control_points = Vec::with_capacity(counts[0] * counts[1]);
    for i in 0..counts[0] {
        for j in 0..counts[1] {
            let at = |k: usize, count: usize| k as f64 / (count - 1) as f64;
            let (x, y) = (at(i, counts[0]), at(j, counts[1]));
            let z = height * (x * 5.0).sin() * (y * 4.0).cos();
            let point = DVec3::new(x, y, z) + direction(rng) * noise * rng.f64() + shift;
            let weight = if polynomial { 1.0 } else { 0.2 * 25_f64.powf(rng.f64()) };
            control_points.push([point.x, point.y, point.z, weight]);
        }
    }
    if rng.u8(0..4) == 0 {
        let pole = control_points[0];
        for (index, point) in control_points.iter_mut().enumerate() {
            if index % counts[1] == 0 {
                point[..3].copy_from_slice(&pole[..3]);
            }
        }
    }
    SurfaceArrays { degree, knots, counts, control_points }
}

fn knots(rng: &mut Rng, degree: usize, count: usize) -> Vec<f64> {
    let clamped = rng.u8(0..4) != 0;
    let mut knots: Vec<f64> = Vec::with_capacity(count + degree + 1);
    let (mut last, mut run) = (rng.f64() * 4.0 - 2.0, 0);
    for index in 0..count + degree + 1 {
        let at_end = clamped && (1..=degree).contains(&(index % count));
        // Inside, a knot is repeated up to its degree: a crease, not a gap.
        let repeated = at_end || (run < degree && index > degree + 1 && index < count && rng.u8(0..6) == 0);
        if !repeated {
            last += 0.05 + rng.f64();
            run = 0;
        }
        run += 1;
        knots.push(last);
    }
    knots
}

/// The same nets with control points moved by up to `size`.
fn near(rng: &mut Rng, a: &[SurfaceArrays], size: f64) -> Vec<SurfaceArrays> {
    let mut b = a.to_vec();
    for point in b.iter_mut().flat_map(|surface| &mut surface.control_points) {
        let shift = direction(rng) * size;
        point[0] += shift.x;
        point[1] += shift.y;
        point[2] += shift.z;
    }
    b
}

fn moved(rng: &mut Rng, a: &[SurfaceArrays]) -> Vec<SurfaceArrays> {
    let mut b = a.to_vec();
    let shift = direction(rng) * 10_f64.powf(-3.0 * rng.f64());
    place(&mut b, 1.0, shift);
    b
}

/// The same surfaces with a knot more and a degree more, as far as degrees go.
fn refined(rng: &mut Rng, a: &[SurfaceArrays]) -> Vec<SurfaceArrays> {
    a.iter()
        .map(|arrays| {
            let surface = NurbsSurface::new(0, arrays.clone()).unwrap();
            let [[start, end], _] = surface.domain();
            let knot = start + (0.1 + 0.8 * rng.f64()) * (end - start);
            let refined = insert_knot(&surface, 0, knot, 1).unwrap_or(surface);
            elevate_degree(&refined, 1).unwrap_or(refined).into_arrays()
        })
        .collect()
}

fn place(model: &mut [SurfaceArrays], scale: f64, shift: DVec3) {
    for point in model.iter_mut().flat_map(|surface| &mut surface.control_points) {
        for axis in 0..3 {
            point[axis] = point[axis] * scale + shift[axis];
        }
    }
}
