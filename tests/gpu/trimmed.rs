//! Trimmed faces on the kernels: pieces with grids of different sizes.

use crate::support::fixtures::with_grid;
use crate::support::gpu::{engine, measure};
use crate::support::trims::{circle, face, plane, rectangle, reversed};
use nurbs_hausdorff::{Backend, DistanceOptions, DistanceResult, MethodName, Model, ModelArrays};

/// A square of side 8 with a hole of radius 3 and an island of radius 1 in it, and one whole.
fn models() -> [Model; 2] {
    let square = plane([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [[0.0, 8.0]; 2]);
    let center = [4.0, 4.0];
    let loops = vec![rectangle([0.0; 2], [8.0; 2]), reversed(circle(center, 3.0)), circle(center, 1.0)];
    let trimmed = face(square.clone(), loops);
    let mut whole = trimmed.clone();
    whole.trim = None;
    [trimmed, whole]
        .map(|face| Model::from_faces(ModelArrays { faces: vec![face], ..ModelArrays::default() }).unwrap())
}

#[test]
fn all_methods_measure_trimmed_faces_on_the_gpu_as_on_the_cpu() {
    let Some(engine) = engine("all_methods_measure_trimmed_faces_on_the_gpu_as_on_the_cpu") else { return };
    let [trimmed, whole] = models();
    for method in [MethodName::Iteration, MethodName::Hierarchy, MethodName::Certified] {
        let run = |backend| {
            let options = DistanceOptions {
                method: with_grid(method, 24),
                backend,
                symmetric: true,
                samples: 30,
                deviations: true,
                ..DistanceOptions::default()
            };
            measure(&engine, &trimmed, &whole, &options)
        };
        let (gpu, cpu) = (run(Backend::Gpu), run(Backend::Cpu));
        // The ring's middle circle is 1 from the hole's and the island's edges.
        for result in [&gpu, &cpu] {
            let reverse = result.reverse.as_deref().unwrap();
            assert!(reverse.lower <= 1.0 && 1.0 <= reverse.upper, "{method:?} {reverse:?}");
            assert!(result.forward.as_deref().unwrap().lower < 1e-6, "{method:?}");
        }
        // The witness of `hierarchy` is a pair of middles, and many are as good; its boxes
        // on the GPU are rounded outwards.
        let (numbers, room): (fn(&DistanceResult) -> [f64; 2], f64) = match method {
            MethodName::Hierarchy => (|result| [result.lower, result.upper], 2e-4),
            _ => (|result| [result.computed; 2], 1e-5),
        };
        for (gpu, cpu) in numbers(&gpu).into_iter().zip(numbers(&cpu)) {
            assert!((gpu - cpu).abs() < room * trimmed.bounding_box().diagonal(), "{method:?}: {gpu} {cpu}");
        }
        for (gpu, cpu) in [(&gpu.forward, &cpu.forward), (&gpu.reverse, &cpu.reverse)] {
            let (gpu, cpu) = (gpu.as_deref().unwrap(), cpu.as_deref().unwrap());
            assert_eq!(gpu.deviations.len(), cpu.deviations.len());
            for (gpu, cpu) in gpu.deviations.iter().zip(&cpu.deviations) {
                assert_eq!((gpu.face, gpu.counts, &gpu.points), (cpu.face, cpu.counts, &cpu.points));
                let largest = gpu.distances.iter().zip(&cpu.distances).map(|(gpu, cpu)| (gpu - cpu).abs());
                assert!(largest.fold(0.0, f64::max) < 1e-6, "{method:?}");
            }
        }
    }
}
