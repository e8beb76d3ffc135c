//! Grid samples of A, each projected on B by BREP_kernel's global closest point.
//!
//! `peer-brep-kernel A.json B.json SAMPLES`: prints the largest distance and the
//! seconds from the arrays in memory to it, on as many threads as there are cores.

use brep_kernel::{NurbsSurface, Vec3, Vec4, project_point_to_surface};
use serde::Deserialize;
use std::time::Instant;

#[derive(Deserialize)]
struct Model {
    surfaces: Vec<Arrays>,
}

#[derive(Deserialize)]
struct Arrays {
    degree: [usize; 2],
    knots_u: Vec<f64>,
    knots_v: Vec<f64>,
    ctrl: Vec<Vec<[f64; 4]>>,
}

/// A surface and the box around its control points, which contains it.
struct Boxed {
    surface: NurbsSurface,
    low: [f64; 3],
    high: [f64; 3],
}

type Failure = Box<dyn std::error::Error + Send + Sync>;

fn main() -> Result<(), Failure> {
    let [a, b, samples] = &std::env::args().skip(1).collect::<Vec<_>>()[..] else {
        return Err("expected A.json B.json SAMPLES".into());
    };
    let (a, b, samples) = (read(a)?, read(b)?, samples.parse()?);
    let start = Instant::now();
    let distance = distance(&a, &b, samples)?;
    println!("{{\"value\":{distance:e},\"seconds\":{:e}}}", start.elapsed().as_secs_f64());
    Ok(())
}

fn read(path: &str) -> Result<Model, Failure> {
    Ok(serde_json::from_str(&std::fs::read_to_string(path)?)?)
}

fn distance(a: &Model, b: &Model, samples: usize) -> Result<f64, Failure> {
    let mut points = Vec::new();
    for arrays in &a.surfaces {
        sample(&boxed(arrays)?.surface, samples, &mut points)?;
    }
    let threads = std::thread::available_parallelism()?.get();
    let share = points.len().div_ceil(threads);
    std::thread::scope(|scope| {
        let workers: Vec<_> = points
            .chunks(share)
            // A surface caches what projection needs, so each thread has its own.
            .map(|points| scope.spawn(move || farthest(points, b)))
            .collect();
        let mut most = 0.0_f64;
        for worker in workers {
            most = most.max(worker.join().map_err(|_| "a thread panicked")??);
        }
        Ok(most)
    })
}

fn boxed(arrays: &Arrays) -> Result<Boxed, Failure> {
    // Vec4 is homogeneous: the point is (x, y, z)/w.
    let row = |row: &Vec<[f64; 4]>| {
        row.iter().map(|&[x, y, z, w]| Vec4 { x: x * w, y: y * w, z: z * w, w }).collect()
    };
    let surface = NurbsSurface::new(
        arrays.degree[0],
        arrays.degree[1],
        arrays.knots_u.clone(),
        arrays.knots_v.clone(),
        arrays.ctrl.iter().map(row).collect(),
    )?;
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for point in arrays.ctrl.iter().flatten() {
        for axis in 0..3 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    Ok(Boxed { surface, low, high })
}

fn sample(surface: &NurbsSurface, samples: usize, points: &mut Vec<Vec3>) -> Result<(), Failure> {
    let ([u0, u1], [v0, v1]) = (surface.domain_u()?, surface.domain_v()?);
    let step = |index: usize| index as f64 / (samples - 1) as f64;
    for i in 0..samples {
        for j in 0..samples {
            points.push(surface.evaluate(u0 + (u1 - u0) * step(i), v0 + (v1 - v0) * step(j))?);
        }
    }
    Ok(())
}

fn farthest(points: &[Vec3], b: &Model) -> Result<f64, Failure> {
    let surfaces = b.surfaces.iter().map(boxed).collect::<Result<Vec<_>, _>>()?;
    let mut most = 0.0_f64;
    for &point in points {
        most = most.max(nearest(point, &surfaces)?);
    }
    Ok(most)
}

/// Surfaces in the order of their boxes' distances, until no box is near enough.
fn nearest(point: Vec3, surfaces: &[Boxed]) -> Result<f64, Failure> {
    let mut order: Vec<(f64, &Boxed)> =
        surfaces.iter().map(|boxed| (box_distance(point, boxed), boxed)).collect();
    order.sort_by(|left, right| left.0.total_cmp(&right.0));
    let mut best = f64::INFINITY;
    for (bound, boxed) in order {
        if bound >= best {
            break;
        }
        best = best.min(project_point_to_surface(&boxed.surface, point)?.distance);
    }
    Ok(best)
}

fn box_distance(point: Vec3, boxed: &Boxed) -> f64 {
    let outside = |axis: usize, value: f64| (boxed.low[axis] - value).max(value - boxed.high[axis]).max(0.0);
    let [x, y, z] = [outside(0, point.x), outside(1, point.y), outside(2, point.z)];
    (x * x + y * y + z * z).sqrt()
}
