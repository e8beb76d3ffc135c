//! Method `certified` with its cells on the GPU, against truths and float64.

use crate::support::gpu::{engine, measure};
use nurbs_hausdorff::internals::engine::{Backend, DistanceOptions, Processor, Stop};
use nurbs_hausdorff::shapes::operations::{cut_model, elevate_degree};
use nurbs_hausdorff::shapes::sphere_parts;
use nurbs_hausdorff::{Axis, CertifiedOptions, Method, Model, RigidTransform};

/// Rounding of the truths below, of size 0 to 1.
const ROUNDING: f64 = 1e-12;

/// Both backends converge, to the truth, and the GPU does most of the work.
fn both(name: &str, a: &Model, b: &Model, transform: RigidTransform, tolerance: f64, truth: f64) {
    let Some(engine) = engine(name) else { return };
    for backend in [Backend::Cpu, Backend::Gpu] {
        let options = DistanceOptions {
            relative_tolerance: Some(tolerance),
            transform,
            backend,
            ..DistanceOptions::default()
        };
        let result = measure(&engine, a, b, &options);
        let details = result.certified().unwrap();
        println!(
            "{name}, {backend:?}: [{:.9}, {:.9}], {} cells, {} of them on the CPU, {} levels, {:.3} s",
            result.lower,
            result.upper,
            details.cells,
            details.cpu_cells,
            details.levels,
            result.seconds.solve
        );
        assert!(result.converged, "{name}: {:?}", details.stop);
        assert!(result.upper - result.lower <= details.tolerance + ROUNDING, "{name}");
        assert!(result.lower <= truth + ROUNDING && truth - ROUNDING <= result.upper, "{name}");
        match backend {
            Backend::Gpu => assert!(2 * details.cpu_cells < details.cells, "{name}"),
            _ => assert_eq!(details.cpu_cells, details.cells, "{name}"),
        }
        assert_eq!(result.backend, if backend == Backend::Gpu { Processor::Gpu } else { Processor::Cpu });
        assert_eq!(result.adapter.is_some(), backend == Backend::Gpu);
    }
}

#[test]
fn exact_offsets() {
    let [one, larger] = sphere_parts([1.0, 1.1]).unwrap();
    both("parts of spheres of 1 and 1.1", &one, &larger, RigidTransform::IDENTITY, 1e-6, 0.1);
}

/// A quadric in other parameters is at no distance by its heights, which are bounded in float64, so
/// that kernels find too little to do.
#[test]
fn a_copy_by_other_parameters_takes_few_cells_on_either() {
    let [part, sphere] = sphere_parts([1.0, 1.0]).unwrap();
    let Some(engine) = engine("a part of a sphere") else { return };
    for backend in [Backend::Cpu, Backend::Gpu] {
        let options =
            DistanceOptions { relative_tolerance: Some(1e-6), backend, ..DistanceOptions::default() };
        let result = measure(&engine, &part, &sphere, &options);
        let details = result.certified().unwrap();
        assert!(result.converged && result.lower <= ROUNDING, "{:?}", details.stop);
        assert!(result.upper <= details.tolerance + ROUNDING, "{}", result.upper);
        assert!(details.cells < 100, "{}", details.cells);
    }
}

#[test]
fn degrees_of_several_kinds() {
    // An exact offset, in pieces of several degrees on either side.
    let raised = |part: &Model, by: &[Axis]| {
        let pieces = cut_model(part, [&[0.37], &[0.61]]).unwrap();
        let surfaces = pieces.surfaces().iter().zip(by);
        let surfaces = surfaces.map(|(surface, &by)| elevate_degree(surface, by).unwrap_or(surface.clone()));
        Model::new(None, surfaces.collect()).unwrap()
    };
    let [a, b] = sphere_parts([1.0, 1.05]).unwrap();
    let (a, b) = (
        raised(&a, &[Axis::U, Axis::V, Axis::V, Axis::U]),
        raised(&b, &[Axis::V, Axis::U, Axis::U, Axis::V]),
    );
    both("of several degrees", &a, &b, RigidTransform::IDENTITY, 1e-6, 0.05);
}

#[test]
fn float64_does_what_float32_is_too_coarse_for() {
    let test = "float64_does_what_float32_is_too_coarse_for";
    let Some(engine) = engine(test) else { return };
    let [one, larger] = sphere_parts([1.0, 1.5]).unwrap();
    let options = DistanceOptions {
        method: Method::Certified(CertifiedOptions { max_cells: Some(40_000), ..Default::default() }),
        relative_tolerance: Some(3e-8),
        backend: Backend::Gpu,
        ..DistanceOptions::default()
    };
    let result = measure(&engine, &one, &larger, &options);
    let details = result.certified().unwrap();
    assert_eq!((details.cells, details.stop), (details.cpu_cells, Stop::Cells));
    assert!(result.lower <= 0.5 && 0.5 <= result.upper);
}
