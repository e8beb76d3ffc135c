//! Method `certified` where two models lie everywhere equally far apart.
//!
//! `cargo bench --bench offsets [-- NAME]`: pairs whose names contain NAME.
//! Prints a Markdown table of solve times and cells, in float64 and, where
//! there is an adapter, with the kernels. The pairs are those of
//! `tests/methods/certified/limits_and_reports.rs`, at the default tolerance.

#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

use glam::{DQuat, DVec3};
use nurbs_hausdorff::internals::engine::{Backend, DistanceOptions, Engine, PreparedModel};
use nurbs_hausdorff::shapes::operations::{cut_model, elevate_degree, insert_knot};
use nurbs_hausdorff::shapes::{shape, sphere, sphere_parts, torus};
use nurbs_hausdorff::{Axis, Model, RigidTransform};

/// The number of rounds; the fastest is printed.
const ROUNDS: usize = 3;

struct Pair {
    name: &'static str,
    a: Model,
    b: Model,
    transform: RigidTransform,
}

fn main() {
    let requested = std::env::args().skip(1).find(|argument| !argument.starts_with('-')).unwrap_or_default();
    let engine = Engine::new_blocking(Backend::Auto).expect("an engine");
    println!("Adapter: {}\n", engine.adapter().unwrap_or_else(|| "none, on the CPU".to_owned()));
    println!("| pair | float64, s | cells | with kernels, s | cells |");
    println!("|---|---|---|---|---|");
    for pair in pairs().into_iter().filter(|pair| pair.name.contains(&requested)) {
        let on_cpu = measure(&engine, &pair, Backend::Cpu);
        let with_kernels = match engine.adapter() {
            Some(_) => measure(&engine, &pair, Backend::Gpu),
            None => "no adapter |".to_owned(),
        };
        println!("| {} | {on_cpu} | {with_kernels} |", pair.name);
    }
}

/// The fastest solve time, and the cells.
fn measure(engine: &Engine, pair: &Pair, backend: Backend) -> String {
    let (a, b) = (
        PreparedModel::new(&pair.a).expect("valid trims"),
        PreparedModel::new(&pair.b).expect("valid trims"),
    );
    let options = DistanceOptions { backend, transform: pair.transform, ..DistanceOptions::default() };
    let (mut fastest, mut cells) = (f64::INFINITY, 0);
    for _ in 0..ROUNDS {
        let result = engine.distance(&a, &b, &options).wait().expect("a distance");
        assert!(result.converged, "{}", pair.name);
        fastest = fastest.min(result.seconds.solve);
        cells = result.certified().map_or(0, |details| details.cells);
    }
    format!("{fastest:.2} | {cells}")
}

fn pairs() -> Vec<Pair> {
    let ball = |radius| sphere(DVec3::ZERO, radius).expect("a sphere");
    let [offset, copy] = [1.1, 1.0].map(|radius| sphere_parts([1.0, radius]).expect("parts of spheres"));
    let ring = |tube| torus(3.0, tube).expect("a torus");
    let sheet = shape("wavy-sheet").expect("a sheet");
    let [[start, end], _] = sheet.surfaces()[0].domain().intervals();
    let refined =
        insert_knot(&sheet.surfaces()[0], Axis::U, start + 0.63 * (end - start), 1).expect("a knot");
    let elevated =
        Model::new(None, vec![elevate_degree(&refined, Axis::V).expect("a degree")]).expect("a model");
    let pieces = cut_model(&sheet, [&[0.21, 0.77], &[0.43]]).expect("pieces");
    let turned = |axis: DVec3, angle| {
        RigidTransform::new(DQuat::from_axis_angle(axis.normalize(), angle), DVec3::ZERO).expect("a rotation")
    };
    let askew = turned(DVec3::new(1.0, 2.0, 3.0), 0.7);
    let aside = turned(DVec3::Z, 1.0_f64.to_radians());
    let still = RigidTransform::IDENTITY;
    let pair = |name, a: &Model, b: &Model, transform| Pair { name, a: a.clone(), b: b.clone(), transform };
    vec![
        pair("concentric spheres of 1 and 1.1", &ball(1.0), &ball(1.1), still),
        pair("tori of tube 1 and 1.05", &ring(1.0), &ring(1.05), still),
        pair("a wavy sheet on itself", &sheet, &sheet, still),
        pair("on its refined, elevated copy", &sheet, &elevated, still),
        pair("on its pieces", &sheet, &pieces, still),
        pair("a sphere on itself turned", &ball(1.0), &ball(1.0), askew),
        pair("a sphere of 1 turned in one of 1.25", &ball(1.0), &ball(1.25), askew),
        pair("the other way", &ball(1.25), &ball(1.0), askew),
        pair("a torus on itself turned", &ring(1.0), &ring(1.0), aside),
        pair("a part of a sphere in one of 1.1", &offset[0], &offset[1], still),
        pair("a part of a sphere on a sphere", &copy[0], &copy[1], still),
    ]
}
