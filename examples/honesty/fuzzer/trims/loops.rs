//! Random loops in the unit square: lines, arcs, cubics and splines, holes, slivers, loops that
//! touch.

use super::super::surfaces::magnitude;
use fastrand::Rng;
use glam::DVec2;
use nurbs_hausdorff::trim::TrimCurveArrays;
use std::f64::consts::{PI, TAU};

/// A loop, head to tail, in fractions of the domain.
pub(crate) type Ring = Vec<TrimCurveArrays>;

/// The gaps between loops that nearly touch; those below 0 are overlaps, and validation
/// refuses the larger ones.
const GAPS: [f64; 9] = [0.0, 0.0, 1e-13, 1e-9, 1e-6, 1e-4, -1e-8, -1e-5, -1e-3];

/// Returns the loops of a face.
pub(crate) fn rings(rng: &mut Rng) -> Vec<Ring> {
    let center = DVec2::new(0.4 + 0.2 * rng.f64(), 0.4 + 0.2 * rng.f64());
    let radius = 0.15 + 0.24 * rng.f64();
    match rng.u8(0..16) {
        0 => vec![rectangle(DVec2::ZERO, DVec2::ONE)],
        1 => {
            let low = DVec2::new(0.4 * rng.f64(), 0.4 * rng.f64());
            let size = DVec2::new(0.1 + 0.4 * rng.f64(), 0.1 + 0.4 * rng.f64());
            vec![rectangle(low, low + size)]
        }
        2 => vec![sliver(rng)],
        3 => tangent_from_within(rng, center, radius),
        4 => tangent_holes(rng, center, radius),
        5 => shared_vertex(rng, center, radius),
        // A frame as thin as a sliver.
        6 => {
            let start = TAU * rng.f64();
            let inner = radius - magnitude(rng, -6.0, -2.0);
            vec![circle(center, radius, start, 4), reversed(circle(center, inner, start + rng.f64(), 5))]
        }
        // A hole, or several, in the whole domain.
        7 | 8 => with_holes(rng, rectangle(DVec2::ZERO, DVec2::ONE), center, radius),
        // Two parts.
        9 => {
            let offset = DVec2::new(0.25, 0.2 * rng.f64());
            let parts = [-1.0, 1.0].map(|side| DVec2::splat(0.5) + side * offset);
            parts.into_iter().flat_map(|at| one(rng, at, 0.2)).collect()
        }
        10..13 => one(rng, center, radius),
        _ => {
            let outer = outline(rng, center, radius);
            with_holes(rng, outer, center, 0.4 * radius)
        }
    }
}

/// Returns the loops moved about the middle of the square by about this much.
pub(crate) fn shifted(rings: &[Ring], by: DVec2) -> Vec<Ring> {
    let mut rings = rings.to_vec();
    for point in rings.iter_mut().flatten().flat_map(|curve| &mut curve.control_points) {
        for axis in 0..2 {
            point[axis] = (point[axis] + by[axis]).clamp(0.0, 1.0);
        }
    }
    rings
}

/// Returns the loops with each Bézier curve halved.
pub(crate) fn halved(rings: &[Ring]) -> Vec<Ring> {
    let halves = |curve: &TrimCurveArrays| -> Vec<TrimCurveArrays> {
        let count = curve.control_points.len();
        if curve.knots.len() != 2 * count {
            return vec![curve.clone()];
        }
        let homogeneous = |&[u, v, w]: &[f64; 3]| [w * u, w * v, w];
        let mut second: Vec<[f64; 3]> = curve.control_points.iter().map(homogeneous).collect();
        let mut first = second.clone();
        for (level, control) in first.iter_mut().enumerate().skip(1) {
            for k in 0..count - level {
                second[k] = [0, 1, 2].map(|axis| 0.5 * (second[k][axis] + second[k + 1][axis]));
            }
            *control = second[0];
        }
        let mut halves: Vec<TrimCurveArrays> = [first, second]
            .into_iter()
            .map(|controls| bezier(controls.iter().map(|&[u, v, w]| [u / w, v / w, w]).collect()))
            .collect();
        // Ends stay the floats that they are.
        let [start, end] = [curve.control_points[0], curve.control_points[count - 1]];
        halves[0].control_points[0][..2].copy_from_slice(&start[..2]);
        halves[1].control_points[count - 1][..2].copy_from_slice(&end[..2]);
        halves
    };
    rings.iter().map(|ring| ring.iter().flat_map(halves).collect()).collect()
}

fn one(rng: &mut Rng, center: DVec2, radius: f64) -> Vec<Ring> {
    vec![outline(rng, center, radius)]
}

/// Returns an outer loop about a disc.
fn outline(rng: &mut Rng, center: DVec2, radius: f64) -> Ring {
    match rng.u8(0..6) {
        0 => circle(center, radius, TAU * rng.f64(), rng.usize(3..=5)),
        1 => spline(rng, center, radius),
        _ => star(rng, center, radius),
    }
}

fn with_holes(rng: &mut Rng, outer: Ring, center: DVec2, radius: f64) -> Vec<Ring> {
    let mut rings = vec![outer];
    let (count, start) = (rng.usize(1..=3), TAU * rng.f64());
    for k in 0..count {
        let direction = DVec2::from_angle(start + TAU * k as f64 / count as f64);
        let (at, size) = if count == 1 {
            (center, 0.8 * radius)
        } else {
            (center + 0.6 * radius * direction, 0.4 * radius)
        };
        rings.push(reversed(outline(rng, at, size)));
        if rng.u8(0..4) == 0 {
            rings.push(outline(rng, at, 0.2 * size));
        }
    }
    rings
}

/// Returns a disc with a round hole that touches its edge, or nearly.
fn tangent_from_within(rng: &mut Rng, center: DVec2, radius: f64) -> Vec<Ring> {
    let (angle, turn) = (TAU * rng.f64(), if rng.bool() { 0.0 } else { rng.f64() });
    let angle = if rng.u8(0..3) == 0 { 0.25 * PI * rng.u8(0..8) as f64 } else { angle };
    let inner = radius * (0.2 + 0.7 * rng.f64());
    let gap = GAPS[rng.usize(0..GAPS.len())];
    let at = center + (radius - inner - gap) * DVec2::from_angle(angle);
    vec![circle(center, radius, angle + turn, 4), reversed(circle(at, inner, angle, 4))]
}

/// Returns a face with two round holes that touch each other, or nearly.
fn tangent_holes(rng: &mut Rng, center: DVec2, radius: f64) -> Vec<Ring> {
    let direction = DVec2::from_angle(TAU * rng.f64());
    let gap = GAPS[rng.usize(0..GAPS.len())];
    let start = TAU * rng.f64();
    let hole = |side: f64| {
        reversed(circle(center + side * (0.4 * radius + 0.5 * gap) * direction, 0.4 * radius, start, 4))
    };
    vec![circle(center, radius, 0.0, 4), hole(-1.0), hole(1.0)]
}

/// Returns a polygon with a hole that has a vertex in common with it.
fn shared_vertex(rng: &mut Rng, center: DVec2, radius: f64) -> Vec<Ring> {
    let start = TAU * rng.f64();
    let corner = |k: usize| center + radius * DVec2::from_angle(start + 0.2 * PI * (2 * k) as f64);
    let outer: Vec<DVec2> = (0..5).map(corner).collect();
    let towards = center - outer[0];
    let hole = [
        outer[0],
        outer[0] + 0.6 * towards + 0.2 * towards.perp(),
        outer[0] + 0.7 * towards - 0.1 * towards.perp(),
    ];
    vec![polygon(&outer), reversed(polygon(&hole).into_iter().collect())]
        .into_iter()
        .enumerate()
        .map(|(index, ring)| if index == 1 && is_clockwise(&hole) { reversed(ring) } else { ring })
        .collect()
}

fn is_clockwise(corners: &[DVec2]) -> bool {
    (corners[1] - corners[0]).perp_dot(corners[2] - corners[0]) < 0.0
}

/// Returns a loop of the width of a sliver, along an axis or askew.
fn sliver(rng: &mut Rng) -> Ring {
    let width = magnitude(rng, -6.5, -3.0);
    let from = DVec2::new(0.2 + 0.2 * rng.f64(), 0.2 + 0.2 * rng.f64());
    let along = match rng.u8(0..4) {
        0 => DVec2::X,
        1 => DVec2::Y,
        _ => DVec2::from_angle(0.5 * PI * rng.f64()),
    } * (0.2 + 0.3 * rng.f64());
    let across = width * along.perp().normalize();
    let mut corners = vec![from, from + along, from + along + across];
    if rng.bool() {
        corners.push(from + 0.5 * across);
    }
    polygon(&corners)
}

fn bezier(control_points: Vec<[f64; 3]>) -> TrimCurveArrays {
    let degree = control_points.len() - 1;
    let knots = [vec![0.0; degree + 1], vec![1.0; degree + 1]].concat();
    TrimCurveArrays { degree, knots, control_points, gap: 0.0, edge: None }
}

fn weighted(point: DVec2, weight: f64) -> [f64; 3] {
    [point.x, point.y, weight]
}

fn rectangle(low: DVec2, high: DVec2) -> Ring {
    polygon(&[low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)])
}

pub(super) fn polygon(corners: &[DVec2]) -> Ring {
    let side = |k: usize| {
        let ends = [corners[k], corners[(k + 1) % corners.len()]];
        bezier(ends.map(|end| weighted(end, 1.0)).to_vec())
    };
    (0..corners.len()).map(side).collect()
}

/// Returns a circle of rational quadratic arcs, counterclockwise.
pub(super) fn circle(center: DVec2, radius: f64, start: f64, arcs: usize) -> Ring {
    let half = PI / arcs as f64;
    let at = |angle: f64, radius: f64| center + radius * DVec2::from_angle(angle);
    let corner = |k: usize| at(start + 2.0 * half * (k % arcs) as f64, radius);
    let arc = |k: usize| {
        let middle = at(start + half * (2 * k + 1) as f64, radius / half.cos());
        bezier(vec![weighted(corner(k), 1.0), weighted(middle, half.cos()), weighted(corner(k + 1), 1.0)])
    };
    (0..arcs).map(arc).collect()
}

/// Returns a loop around a disc of 0.6 times the radius or so, each side a line, a conic or a cubic.
fn star(rng: &mut Rng, center: DVec2, radius: f64) -> Ring {
    let count = rng.usize(3..=8);
    let start = TAU * rng.f64();
    let corners: Vec<DVec2> = (0..count)
        .map(|k| {
            let angle = start + TAU * (k as f64 + 0.3 * rng.f64()) / count as f64;
            center + radius * (0.75 + 0.25 * rng.f64()) * DVec2::from_angle(angle)
        })
        .collect();
    let kind = rng.u8(0..4);
    (0..count)
        .map(|k| {
            let [from, to] = [corners[k], corners[(k + 1) % count]];
            let bulge = |rng: &mut Rng| 0.25 * (rng.f64() - 0.35) * (from - to).perp();
            let middle = match if kind == 3 { rng.u8(0..3) } else { kind } {
                0 => Vec::new(),
                1 => vec![weighted(0.5 * (from + to) + bulge(rng), 0.4 + 1.5 * rng.f64())],
                _ => [1.0 / 3.0, 2.0 / 3.0].map(|t| weighted(from.lerp(to, t) + bulge(rng), 1.0)).to_vec(),
            };
            bezier([vec![weighted(from, 1.0)], middle, vec![weighted(to, 1.0)]].concat())
        })
        .collect()
}

/// Returns a loop that is one B-spline curve of degree 2 or 3 with knots, or a polyline, with a
/// corner where it closes.
fn spline(rng: &mut Rng, center: DVec2, radius: f64) -> Ring {
    let (degree, count) = (rng.usize(1..=3), rng.usize(7..=10));
    let mut points: Vec<[f64; 3]> = (0..count)
        .map(|k| {
            let angle = TAU * k as f64 / count as f64;
            weighted(center + radius * (0.8 + 0.2 * rng.f64()) * DVec2::from_angle(angle), 1.0)
        })
        .collect();
    points.push(points[0]);
    let inner = (1..points.len() - degree).map(|knot| knot as f64);
    let last = (points.len() - degree) as f64;
    let knots =
        std::iter::repeat_n(0.0, degree + 1).chain(inner).chain(std::iter::repeat_n(last, degree + 1));
    vec![TrimCurveArrays { degree, knots: knots.collect(), control_points: points, gap: 0.0, edge: None }]
}

pub(super) fn reversed(ring: Ring) -> Ring {
    let reverse = |mut curve: TrimCurveArrays| {
        curve.reverse();
        curve
    };
    ring.into_iter().rev().map(reverse).collect()
}
