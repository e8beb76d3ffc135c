//! A face against itself divided into several, which meet at lines and corners but for slits.

use super::super::partners::{cut, near};
use super::super::surfaces::magnitude;
use super::loops::{Ring, polygon};
use super::{DrawnFace, Faces};
use fastrand::Rng;
use glam::DVec2;
use nurbs_hausdorff::SurfaceArrays;

/// The corners of the unit square, counterclockwise.
const CORNERS: [DVec2; 4] = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];

/// Returns a face, a part of the surface or all of it, and the faces that it is divided into; of one in eight one of
/// these is missing.
pub(super) fn faces(rng: &mut Rng, surface: &SurfaceArrays) -> [Faces; 2] {
    let surfaces = std::slice::from_ref(surface);
    let size = if rng.bool() { 0.0 } else { magnitude(rng, -9.0, -3.0) };
    let whole = near(rng, surfaces, size).remove(0);
    if rng.u8(0..4) == 0 {
        let of = |surface| DrawnFace { surface, rings: None };
        return [vec![of(whole)], cut(rng, surfaces).into_iter().map(of).collect()];
    }
    let margin = if rng.bool() { 0.0 } else { 0.3 * rng.f64() };
    let place = |at: DVec2| DVec2::splat(margin) + (1.0 - 2.0 * margin) * at;
    let mut polygons = match rng.u8(0..3) {
        0 => grid(rng),
        1 => tee(rng),
        _ => sectors(rng),
    };
    if rng.u8(0..8) == 0 {
        polygons.remove(rng.usize(0..polygons.len()));
    }
    let slit = if rng.bool() { 0.0 } else { magnitude(rng, -9.0, -2.0) };
    let ring = |corners: &Vec<DVec2>| -> Ring {
        let middle = corners.iter().sum::<DVec2>() / corners.len() as f64;
        let corners: Vec<DVec2> = corners.iter().map(|corner| place(corner.lerp(middle, slit))).collect();
        polygon(&corners)
    };
    let of =
        |surface: &SurfaceArrays, ring: Ring| DrawnFace { surface: surface.clone(), rings: Some(vec![ring]) };
    let all = of(&whole, polygon(&CORNERS.map(place)));
    [vec![all], polygons.iter().map(|corners| of(surface, ring(corners))).collect()]
}

fn rectangle([x0, x1]: [f64; 2], [y0, y1]: [f64; 2]) -> Vec<DVec2> {
    vec![DVec2::new(x0, y0), DVec2::new(x1, y0), DVec2::new(x1, y1), DVec2::new(x0, y1)]
}

/// The ranges between 0, random numbers and 1.
fn ranges(rng: &mut Rng, count: usize) -> Vec<[f64; 2]> {
    let mut ends: Vec<f64> =
        (1..count).map(|line| (line as f64 + 0.6 * (rng.f64() - 0.5)) / count as f64).collect();
    ends.insert(0, 0.0);
    ends.push(1.0);
    ends.windows(2).map(|ends| [ends[0], ends[1]]).collect()
}

fn grid(rng: &mut Rng) -> Vec<Vec<DVec2>> {
    let [rows, columns] = [0; 2].map(|_| rng.usize(1..=4));
    let (x, y) = (ranges(rng, rows + 1), ranges(rng, columns));
    x.iter().flat_map(|x| y.iter().map(move |y| rectangle(*x, *y))).collect()
}

/// Strips that are divided at different heights.
fn tee(rng: &mut Rng) -> Vec<Vec<DVec2>> {
    let strips = rng.usize(2..=3);
    let mut polygons = Vec::new();
    for x in ranges(rng, strips) {
        let parts = rng.usize(1..=3);
        polygons.extend(ranges(rng, parts).into_iter().map(|y| rectangle(x, y)));
    }
    polygons
}

/// Sectors about a random point.
fn sectors(rng: &mut Rng) -> Vec<Vec<DVec2>> {
    let middle = DVec2::new(0.2 + 0.6 * rng.f64(), 0.2 + 0.6 * rng.f64());
    let count = rng.usize(2..=5);
    let mut ends: Vec<f64> = (0..count).map(|_| 4.0 * rng.f64()).collect();
    ends.sort_by(f64::total_cmp);
    let on_rim = |at: f64| {
        let side = at.floor();
        let corner = |index: f64| CORNERS[index as usize % CORNERS.len()];
        corner(side).lerp(corner(side + 1.0), at - side)
    };
    (0..count)
        .map(|index| {
            let from = ends[index];
            let to = if index + 1 < count { ends[index + 1] } else { ends[0] + 4.0 };
            let corners =
                (1..=8).map(f64::from).filter(|corner| (from..to).contains(corner) && *corner > from);
            let rim = std::iter::once(from).chain(corners).chain([to]);
            std::iter::once(middle).chain(rim.map(on_rim)).collect()
        })
        .collect()
}
