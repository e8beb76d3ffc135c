//! Pairs that lie on each other, or nearly so, in other parameters: with poles, with ends that are lines of
//! vanishing derivatives, with ends that one of both goes beyond, and divided into several surfaces.

use super::partners::near;
use super::surfaces::{direction, magnitude};
use fastrand::Rng;
use glam::{DMat3, DQuat, DVec3};
use nurbs_hausdorff::shapes::operations::{part, refit_surface, transformed};
use nurbs_hausdorff::shapes::{disc, shape, sphere};
use nurbs_hausdorff::{NurbsSurface, ParamBox, RigidTransform, SurfaceArrays};

/// The degree of the polynomial surfaces, and that of their composition with maps of the same degree.
const DEGREE: usize = 2;
const COMPOSED: usize = DEGREE * DEGREE;

/// Returns both models of a pair in either order.
pub(crate) fn reparametrized(rng: &mut Rng) -> [Vec<SurfaceArrays>; 2] {
    let [mut a, mut b] = match rng.u8(0..5) {
        0 => ellipsoids(rng).map(|surface| vec![surface]),
        1 => discs(rng).map(|surface| vec![surface]),
        2 => divided(rng),
        _ => compositions(rng).map(|surface| vec![surface]),
    };
    let columns = [0, 1, 2].map(|axis| DVec3::AXES[axis] + 0.4 * direction(rng));
    let map = DMat3::from_cols(columns[0], columns[1], columns[2]);
    for surface in a.iter_mut().chain(&mut b) {
        for point in &mut surface.control_points {
            let mapped = map * DVec3::from_slice(&point[..3]);
            point[..3].copy_from_slice(&mapped.to_array());
        }
    }
    if rng.bool() {
        let size = magnitude(rng, -12.0, -2.0);
        a = near(rng, &a, size);
    }
    if rng.bool() { [a, b] } else { [b, a] }
}

/// A unit sphere or a part of it, turned, and a sphere or its interpolation, whose poles stay.
fn ellipsoids(rng: &mut Rng) -> [SurfaceArrays; 2] {
    let whole = sphere(DVec3::ZERO, 1.0).unwrap();
    let turn = match rng.u8(0..3) {
        0 => DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2),
        1 => DQuat::from_rotation_z(rng.f64()),
        _ => DQuat::from_axis_angle(direction(rng), 3.0 * rng.f64()),
    };
    let turned = transformed(&whole, &RigidTransform::new(turn, DVec3::ZERO).unwrap()).unwrap();
    let mut a = turned.surfaces()[0].clone();
    if rng.bool() {
        let mut range = || {
            let [start, end] = [0.6 * rng.f64(), 0.2 + 0.2 * rng.f64()];
            [start, start + end]
        };
        a = part(&a, ParamBox::new(range(), range())).unwrap();
    }
    let mut b = whole.surfaces()[0].clone();
    if rng.u8(0..3) == 0 {
        b = refit_surface(&b, [rng.usize(9..20), rng.usize(6..14)]).unwrap();
    }
    [a.into_arrays(), b.into_arrays()]
}

/// A surface of revolution, turned so that it lies on itself, or a part of it, and the same divided at some of its
/// parameter lines, with slits or without, and seldom without one of the pieces.
fn divided(rng: &mut Rng) -> [Vec<SurfaceArrays>; 2] {
    let name = ["sphere", "torus", "cylinder", "cone"][rng.usize(0..4)];
    let model = shape(name).unwrap();
    let turn = match rng.u8(0..3) {
        0 if name == "sphere" => DQuat::from_axis_angle(direction(rng), 3.0 * rng.f64()),
        1 => DQuat::IDENTITY,
        _ => DQuat::from_rotation_z(3.0 * rng.f64()),
    };
    let turned = transformed(&model, &RigidTransform::new(turn, DVec3::ZERO).unwrap()).unwrap();
    let mut a = turned.surfaces()[0].clone();
    if rng.bool() {
        let mut range = || {
            let [start, end] = [0.6 * rng.f64(), 0.1 + 0.3 * rng.f64()];
            [start, start + end]
        };
        a = part(&a, ParamBox::new(range(), range())).unwrap();
    }
    let mut ranges = || {
        let mut ranges = Vec::new();
        let mut start = 0.0;
        for _ in 0..rng.u8(0..3) {
            let end = start + (0.1 + 0.7 * rng.f64()) * (1.0 - start);
            let slit = if rng.bool() { 0.0 } else { magnitude(rng, -12.0, -2.0) * (1.0 - end) };
            ranges.push([start, end]);
            start = end + slit;
        }
        ranges.push([start, 1.0]);
        ranges
    };
    let [u, v] = [ranges(), ranges()];
    let boxes = u.iter().flat_map(|u| v.iter().map(|v| ParamBox::new(*u, *v)));
    let mut b: Vec<_> = boxes.map(|range| part(&model.surfaces()[0], range).unwrap().into_arrays()).collect();
    if b.len() > 1 && rng.u8(0..4) == 0 {
        b.swap_remove(rng.usize(0..b.len()));
    }
    [vec![a.into_arrays()], b]
}

/// A biquadratic surface in the plane of a disc of polar parameters, within it or beyond its end.
fn discs(rng: &mut Rng) -> [SurfaceArrays; 2] {
    let round = disc(1.0, 0.0, rng.bool()).unwrap().into_arrays();
    let size = 0.2 + rng.f64();
    let middle = [0, 1].map(|_| 0.6 * (rng.f64() - 0.5));
    let bend = 0.3 * rng.f64();
    let net = (0..=DEGREE).flat_map(|i| (0..=DEGREE).map(move |j| [i, j])).map(|place| {
        let [x, y] =
            [0, 1].map(|axis| middle[axis] + size * (place[axis] as f64 - 1.0 + bend * (rng.f64() - 0.5)));
        DVec3::new(x, y, 0.0)
    });
    [bezier(DEGREE, &net.collect::<Vec<_>>()), round]
}

/// A quadratic surface and its composition with quadratic functions of either parameter, which have a vanishing
/// derivative at an end or lead a little beyond it.
fn compositions(rng: &mut Rng) -> [SurfaceArrays; 2] {
    let bend = magnitude(rng, -3.0, -0.3);
    let net: Vec<DVec3> = (0..=DEGREE)
        .flat_map(|i| (0..=DEGREE).map(move |j| DVec3::new(i as f64, j as f64, 0.0)))
        .map(|point| point + bend * direction(rng))
        .collect();
    let mut map = || {
        let beyond = if rng.bool() { magnitude(rng, -9.0, -1.0) } else { 0.0 };
        let [start, end] = [-beyond, 1.0 + beyond * f64::from(rng.u8(0..2))];
        match rng.u8(0..4) {
            0 => [start, start, end],
            1 => [start, end, end],
            2 => [start, start + (end - start) * rng.f64(), end],
            _ => [start, start + 0.1 * rng.f64(), 0.3 + 0.3 * rng.f64()],
        }
    };
    let [u, v] = [map(), map()];
    // Rows by v, then columns by u.
    let rows: Vec<[DVec3; COMPOSED + 1]> =
        net.chunks_exact(DEGREE + 1).map(|row| composed([row[0], row[1], row[2]], v)).collect();
    let columns: Vec<[DVec3; COMPOSED + 1]> =
        (0..=COMPOSED).map(|j| composed([rows[0][j], rows[1][j], rows[2][j]], u)).collect();
    let composition: Vec<DVec3> =
        (0..=COMPOSED).flat_map(|i| columns.iter().map(move |column| column[i])).collect();
    [bezier(COMPOSED, &composition), bezier(DEGREE, &net)]
}

/// The control points of `f(φ(s))`, f and φ quadratic: mean values of the blossom of f at two controls of φ.
fn composed(f: [DVec3; DEGREE + 1], map: [f64; DEGREE + 1]) -> [DVec3; COMPOSED + 1] {
    let blossom =
        |x: f64, y: f64| (1.0 - x) * (1.0 - y) * f[0] + (x * (1.0 - y) + y * (1.0 - x)) * f[1] + x * y * f[2];
    const FACTORS: [f64; DEGREE + 1] = [1.0, 2.0, 1.0];
    const BINOMIALS: [f64; COMPOSED + 1] = [1.0, 4.0, 6.0, 4.0, 1.0];
    let mut controls = [DVec3::ZERO; COMPOSED + 1];
    for i in 0..=DEGREE {
        for j in 0..=DEGREE {
            controls[i + j] += FACTORS[i] * FACTORS[j] / BINOMIALS[i + j] * blossom(map[i], map[j]);
        }
    }
    controls
}

fn bezier(degree: usize, net: &[DVec3]) -> SurfaceArrays {
    let count = degree + 1;
    let knots: Vec<f64> = (0..2 * count).map(|knot| f64::from(u8::from(knot >= count))).collect();
    let arrays = SurfaceArrays {
        degree: [degree; 2],
        knots: [knots.clone(), knots],
        counts: [count; 2],
        control_points: net.iter().map(|point| [point.x, point.y, point.z, 1.0]).collect(),
    };
    NurbsSurface::new(0, arrays).unwrap().into_arrays()
}
