//! Engines and models shared between threads.

use crate::support::fixtures::with_grid;
use crate::support::gpu::engine;
use nurbs_hausdorff::shapes::shape;
use nurbs_hausdorff::{Backend, DistanceOptions, Engine, MethodName, PreparedModel};
use rayon::prelude::*;

#[test]
fn engines_models_and_computations_may_move_between_threads() {
    fn shared<T: Send + Sync>(_: &T) {}
    fn moved<T: Send>(_: &T) {}
    let engine = Engine::cpu();
    let model = PreparedModel::new(&shape("sphere").unwrap()).unwrap();
    shared(&engine);
    shared(&model);
    let options = DistanceOptions::default();
    moved(&engine.distance(&model, &model, &options));
    moved(&Engine::new(Backend::Auto));
}

/// Pairs on the thread pool whose models are cut and sampled at first use by several of them: the work
/// within a pair runs on the same pool, so that a lock held meanwhile would wait for itself.
#[test]
fn models_are_shared_by_pairs_on_the_thread_pool() {
    let engine = Engine::cpu();
    for method in [MethodName::Certified, MethodName::Iteration, MethodName::Hierarchy] {
        let options = DistanceOptions {
            method: with_grid(method, 16),
            samples: 24,
            symmetric: true,
            ..DistanceOptions::default()
        };
        let models =
            || ["sphere", "sphere-larger"].map(|name| PreparedModel::new(&shape(name).unwrap()).unwrap());
        let [a, b] = models();
        let expected = engine.distance(&a, &b, &options).wait().unwrap();
        let [a, b] = models();
        let computed: Vec<f64> = (0..16)
            .into_par_iter()
            .map(|_| engine.distance(&a, &b, &options).wait().unwrap().computed)
            .collect();
        for found in computed {
            assert!((found - expected.computed).abs() <= 1e-6, "{method:?}: {found} {}", expected.computed);
        }
    }
}

/// Threads that ask one GPU at the same time take turns.
#[test]
fn threads_share_a_gpu() {
    let Some(engine) = engine("threads_share_a_gpu") else { return };
    let [a, b] = ["sphere", "sphere-larger"].map(|name| PreparedModel::new(&shape(name).unwrap()).unwrap());
    for method in [MethodName::Iteration, MethodName::Hierarchy] {
        let options = DistanceOptions {
            method: with_grid(method, 16),
            samples: 24,
            backend: Backend::Gpu,
            ..DistanceOptions::default()
        };
        let run = || engine.distance(&a, &b, &options).wait().unwrap();
        let expected = run();
        std::thread::scope(|scope| {
            let threads: Vec<_> = (0..4).map(|_| scope.spawn(run)).collect();
            for thread in threads {
                let found = thread.join().unwrap();
                assert_eq!((found.lower, found.upper), (expected.lower, expected.upper));
            }
        });
    }
}
