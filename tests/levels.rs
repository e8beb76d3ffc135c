//! Method `certified` with its cells on the GPU, against truths and float64.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

mod support;

use glam::DVec3;
use nurbs_hausdorff::distance::{Backend, Options};
use nurbs_hausdorff::shapes::{sphere, torus};
use nurbs_hausdorff::{Model, RigidTransform};
use support::gpu::{engine, measure};

fn both(name: &str, a: &Model, b: &Model, transform: RigidTransform, tolerance: f64, truth: f64) {
    let Some(engine) = engine(name) else { return };
    for backend in [Backend::Cpu, Backend::Gpu] {
        let options = Options { tolerance, transform, backend, ..Options::default() };
        let result = measure(&engine, a, b, &options);
        let details = result.certified.unwrap();
        println!(
            "{name} {backend:?}: [{:.9}, {:.9}], {} cells, {} on the CPU, {} levels, {:?}, {:.3} s",
            result.lower,
            result.upper,
            details.cells,
            details.cpu_cells,
            details.levels,
            details.stop,
            result.seconds.solve
        );
        assert!(result.converged, "{name}: {:?}", details.stop);
        assert!(result.lower <= truth + 1e-12 && truth - 1e-12 <= result.upper, "{name}");
        assert_eq!(backend == Backend::Cpu, details.cells == details.cpu_cells, "{name}");
    }
}

#[test]
fn exact_offsets() {
    let [one, larger] = [1.0, 1.1].map(|radius| sphere(DVec3::ZERO, radius).unwrap());
    both("spheres of 1 and 1.1", &one, &larger, RigidTransform::IDENTITY, 1e-4, 0.1);
    both("spheres of 1 and 1.1", &one, &larger, RigidTransform::IDENTITY, 1e-5, 0.1);
    both("spheres of 1 and 1.1", &one, &larger, RigidTransform::IDENTITY, 1e-6, 0.1);
    let [thin, thick] = [1.0, 1.05].map(|tube| torus(3.0, tube).unwrap());
    both("tori of 1 and 1.05", &thin, &thick, RigidTransform::IDENTITY, 1e-5, 0.05);
    both("tori of 1 and 1.05", &thin, &thick, RigidTransform::IDENTITY, 1e-6, 0.05);
}
