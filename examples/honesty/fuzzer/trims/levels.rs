//! Random loops whose ends and extremes lie on one parameter line, or a few units in the last
//! place off it: a cut along parameter lines has slabs there that are as high as rounding.

use super::super::surfaces::magnitude;
use super::loops::{Ring, circle, polygon, reversed};
use fastrand::Rng;
use glam::{DMat2, DVec2, Vec2Swizzles};
use std::f64::consts::{PI, TAU};

/// The units in the last place by which what should be equal differs.
const UNITS: [i64; 7] = [0, 1, -1, 1, -1, 2, -3];

/// Returns the loops of a face.
pub(super) fn rings(rng: &mut Rng) -> Vec<Ring> {
    let center = DVec2::new(0.4 + 0.2 * rng.f64(), 0.4 + 0.2 * rng.f64());
    match rng.u8(0..8) {
        0..3 => vec![disc(rng, center, 1.0)],
        3 => {
            let seed = rng.u64(..);
            let [outer, inner] = [1.0, 1.0 - magnitude(rng, -6.0, -0.5)]
                .map(|scale| disc(&mut Rng::with_seed(seed), center, scale));
            vec![outer, reversed(inner)]
        }
        4 | 5 => vec![comb(rng)],
        _ => beside_extreme(rng, center),
    }
}

/// Returns the number this many units in the last place away.
fn nudged(number: f64, units: i64) -> f64 {
    let step = |number: f64| if units < 0 { number.next_down() } else { number.next_up() };
    (0..units.abs()).fold(number, |number, _| step(number))
}

fn units(rng: &mut Rng) -> i64 {
    UNITS[rng.usize(0..UNITS.len())]
}

/// Returns the image of a circle of three arcs under an affine map, as CAD systems write discs that
/// were scaled in one direction; an arc often begins where u or v is extreme, but for rounding.
fn disc(rng: &mut Rng, center: DVec2, scale: f64) -> Ring {
    let start = if rng.u8(0..4) > 0 { 0.5 * PI * f64::from(rng.u8(0..4)) } else { TAU * rng.f64() };
    let size = DVec2::new(0.05 + 0.25 * rng.f64(), 0.05 + 0.25 * rng.f64());
    let shear = if rng.bool() { 0.0 } else { 0.8 * (rng.f64() - 0.5) };
    let turn = if rng.u8(0..4) > 0 { 0.5 * PI * f64::from(rng.u8(0..4)) } else { TAU * rng.f64() };
    let map = DMat2::from_angle(turn)
        * DMat2::from_cols(DVec2::new(size.x, 0.0), DVec2::new(shear * size.x, size.y));
    let mut ring = circle(DVec2::ZERO, 1.0, start, 3);
    for point in ring.iter_mut().flat_map(|curve| &mut curve.control_points) {
        let [u, v] = (center + scale * (map * DVec2::new(point[0], point[1]))).to_array();
        (point[0], point[1]) = (u, v);
    }
    ring
}

/// Returns a polygon along two lines of constant u or v with teeth between, whose corners on one
/// line differ by units in the last place.
fn comb(rng: &mut Rng) -> Ring {
    let [low, high] = [0.1 + 0.3 * rng.f64(), 0.6 + 0.3 * rng.f64()];
    let count = rng.usize(1..=4);
    let at = |k: usize| 0.1 + 0.8 * k as f64 / (2 * count) as f64;
    let mut corners = vec![DVec2::new(at(0), nudged(low, units(rng)))];
    corners.push(DVec2::new(at(2 * count), nudged(low, units(rng))));
    for k in (0..=2 * count).rev() {
        let tooth = if k % 2 == 0 { high } else { 0.5 * (low + high) };
        corners.push(DVec2::new(at(k), nudged(tooth, units(rng))));
    }
    if rng.bool() {
        corners = corners.iter().rev().map(|corner| corner.yx()).collect();
    }
    polygon(&corners)
}

/// Returns a polygon with a round hole whose lowest or highest point is units in the last place off
/// the level of a corner.
fn beside_extreme(rng: &mut Rng, center: DVec2) -> Vec<Ring> {
    let radius = 0.05 + 0.1 * rng.f64();
    let arcs = rng.usize(3..=5);
    let start = PI / 6.0 * f64::from(rng.u8(0..12));
    let [below, above] = [-1.0, 1.0].map(|side| nudged(center.y + side * radius, units(rng)));
    let corners = [
        DVec2::new(0.15, 0.1),
        DVec2::new(0.85, 0.1),
        DVec2::new(0.9, below),
        DVec2::new(0.8, above),
        DVec2::new(0.85, 0.95),
        DVec2::new(0.1, 0.9),
    ];
    let mut rings = vec![polygon(&corners), reversed(circle(center, radius, start, arcs))];
    if rng.bool() {
        for point in rings.iter_mut().flatten().flat_map(|curve| &mut curve.control_points) {
            point.swap(0, 1);
        }
        // Exchanged parameters turn loops around.
        rings = rings.into_iter().map(reversed).collect();
    }
    rings
}
