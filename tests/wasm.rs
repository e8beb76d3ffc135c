//! The crate in a browser: WebGPU against float64 on the CPU.
#![cfg(target_arch = "wasm32")]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

#[path = "repro/mod.rs"]
mod pairs;

use glam::DVec3;
use nurbs_hausdorff::internals::engine::{
    Backend, DistanceOptions, DistanceResult, Engine, MethodName, PreparedModel, Processor,
};
use nurbs_hausdorff::{RigidTransform, shapes};
use wasm_bindgen_test::{wasm_bindgen_test, wasm_bindgen_test_configure};

wasm_bindgen_test_configure!(run_in_browser);

/// Few: Chromium's software adapter is slow.
const SAMPLES: usize = 8;

/// The largest difference of the two backends, relative to the diagonal.
const AGREEMENT: f64 = 1e-5;

async fn measure(engine: &Engine, a: &str, b: &str, options: &DistanceOptions) -> DistanceResult {
    let [a, b] = [a, b].map(|name| PreparedModel::new(&shapes::shape(name).unwrap()).unwrap());
    engine.distance(&a, &b, options).await.unwrap()
}

fn options(backend: Backend) -> DistanceOptions {
    DistanceOptions {
        method: MethodName::Iteration.into(),
        samples: SAMPLES,
        symmetric: true,
        backend,
        ..DistanceOptions::default()
    }
}

#[wasm_bindgen_test]
async fn the_browser_has_a_gpu() {
    assert!(Engine::new(Backend::Gpu).await.unwrap().has_gpu());
    let engine = Engine::new(Backend::Cpu).await.unwrap();
    assert!(!engine.has_gpu());
    assert_eq!(engine.notice(), None);
}

#[wasm_bindgen_test]
async fn gpu_and_cpu_agree() {
    let engine = Engine::new(Backend::Gpu).await.unwrap();
    for [a, b] in [["sphere", "torus"], ["wavy-sheet", "wavy-sheet-b"]] {
        let gpu = measure(&engine, a, b, &options(Backend::Gpu)).await;
        let cpu = measure(&engine, a, b, &options(Backend::Cpu)).await;
        assert_eq!((gpu.backend, cpu.backend), (Processor::Gpu, Processor::Cpu));
        let off = (gpu.computed - cpu.computed).abs() / cpu.diagonal;
        assert!(off < AGREEMENT, "{a} and {b}: {} and {}", gpu.computed, cpu.computed);
    }
}

#[wasm_bindgen_test]
async fn concentric_spheres_are_the_difference_of_their_radii_apart() {
    let engine = Engine::new(Backend::Auto).await.unwrap();
    let result = measure(&engine, "sphere", "sphere-larger", &options(Backend::Auto)).await;
    assert_eq!(result.backend, Processor::Gpu);
    assert!((result.computed - 0.2).abs() < 1e-12, "{}", result.computed);
    assert!(result.lower <= 0.2 && 0.2 <= result.upper);
}

#[wasm_bindgen_test]
async fn a_transform_moves_a() {
    let engine = Engine::new(Backend::Auto).await.unwrap();
    let transform = RigidTransform::translation(DVec3::new(0.0, 0.0, 3.0)).unwrap();
    let options = DistanceOptions { transform, symmetric: false, ..options(Backend::Gpu) };
    let result = measure(&engine, "sphere", "sphere", &options).await;
    // The farthest point of a sphere of radius 2 moved by 3, its top, is 3 away.
    assert!((result.computed - 3.0).abs() < 1e-12, "{}", result.computed);
}

/// Tests of the pairs on which an interval was once false or a search did not end.
mod known_pairs {
    use super::{pairs, wasm_bindgen_test};

    macro_rules! declare {
        ($($name:ident)*) => {
            $(
                #[wasm_bindgen_test]
                async fn $name() {
                    pairs::$name().await;
                }
            )*
        };
    }
    pairs::for_each_pair!(declare);
}

#[wasm_bindgen_test]
async fn a_point_by_method_hierarchy() {
    pairs::hierarchy_point(&Engine::new(Backend::Gpu).await.unwrap()).await;
}
