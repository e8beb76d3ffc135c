//! The engine that tests of the kernels run on.

use nurbs_hausdorff::internals::engine::{Backend, DistanceOptions, DistanceResult, Engine, PreparedModel};
use nurbs_hausdorff::{Error, Model};
use std::io::Write;

/// The variable that turns a missing GPU adapter from a failure into a skipped test.
const ALLOW_NO_GPU: &str = "NURBS_HAUSDORFF_ALLOW_NO_GPU";

/// An engine on the GPU; without an adapter a failure, or `None` and a visible
/// line if the environment allows it.
pub fn engine(test: &str) -> Option<Engine> {
    match Engine::new_blocking(Backend::Gpu) {
        Ok(engine) => Some(engine),
        Err(error @ Error::NoAdapter { .. }) if std::env::var_os(ALLOW_NO_GPU).is_some() => {
            let line = format!("\nSKIPPED {test}: {error}\n");
            std::io::stderr().write_all(line.as_bytes()).unwrap();
            None
        }
        Err(error) => panic!("{test}: {error}"),
    }
}

/// The distance of two models, prepared for this once.
pub fn measure(engine: &Engine, a: &Model, b: &Model, options: &DistanceOptions) -> DistanceResult {
    let (a, b) = (PreparedModel::new(a).unwrap(), PreparedModel::new(b).unwrap());
    engine.distance(&a, &b, options).wait().unwrap()
}
