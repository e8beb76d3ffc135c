//! Pairs on which an interval was false or a search did not end, a file each, with the
//! exact distance: from analysis, or from exact arithmetic where so stated. All bounds are audited.
//!
//! Every pair is an asynchronous function, so that the same tests run natively and
//! in a browser's wasm module.

mod kernels;
mod knots;
mod magnitudes;
mod models;
mod seams;

pub(crate) use kernels::*;
pub(crate) use knots::*;
pub(crate) use magnitudes::*;
pub(crate) use seams::*;

use models::model;
use nurbs_hausdorff::internals::engine::{Backend, DistanceOptions, DistanceResult, Engine, PreparedModel};
use nurbs_hausdorff::options::Audit;
use nurbs_hausdorff::{CertifiedOptions, Method, Model, SurfaceArrays};

/// Applies a macro that declares tests to the names of all pairs.
macro_rules! for_each_pair {
    ($declare:ident) => {
        $declare! {
            ulp_gap ulp_crease ulp_gap_1e5 ulp_spiral extract_weights overflow underflow
            plane_1e7 points far split_copies gpu_deep rim_beyond_a_seam
        }
    };
}
pub(crate) use for_each_pair;

/// The part of an exact distance by which it is rounded where it is stated here.
const TRUTH_ROUNDING: f64 = 1e-9;

/// The cells after which a search may end; the largest search of a pair that
/// ends by itself takes a tenth of them.
const MAX_CELLS: usize = 200_000;

/// The seconds after which a search counts as endless.
const MAX_SECONDS: f64 = 60.0;

/// The distance of two models on the CPU.
async fn measure(a: &Model, b: &Model, options: &DistanceOptions) -> DistanceResult {
    let engine = Engine::new(Backend::Cpu).await.unwrap();
    measure_by(&engine, a, b, options).await
}

async fn measure_by(engine: &Engine, a: &Model, b: &Model, options: &DistanceOptions) -> DistanceResult {
    let [a, b] = [a, b].map(|model| PreparedModel::new(model).unwrap());
    engine.distance(&a, &b, options).await.unwrap()
}

fn budgeted() -> DistanceOptions {
    DistanceOptions {
        method: Method::Certified(CertifiedOptions {
            max_cells: Some(MAX_CELLS),
            max_seconds: Some(MAX_SECONDS),
            audit: Audit::All,
        }),
        backend: Backend::Cpu,
        ..DistanceOptions::default()
    }
}

/// Asserts that the interval contains the exact distance.
fn assert_contains(result: &DistanceResult, truth: f64, name: &str) {
    let (lower, upper, rounding) = (result.lower, result.upper, TRUTH_ROUNDING * truth);
    assert!(
        lower <= truth + rounding && truth - rounding <= upper,
        "{name}: {truth:e} in [{lower:e}, {upper:e}]"
    );
}

/// Asserts the same of a search to the default tolerance, and that it converges.
async fn assert_measured(a: Vec<SurfaceArrays>, b: Vec<SurfaceArrays>, truth: f64, name: &str) {
    let [a, b] = [a, b].map(model);
    let result = measure(&a, &b, &budgeted()).await;
    assert_contains(&result, truth, name);
    assert!(result.converged, "{name}: [{:e}, {:e}]", result.lower, result.upper);
    // A limit on the side of the false upper bound must not be accepted.
    let limit = Some(0.5 * truth);
    let decided = measure(&a, &b, &DistanceOptions { limit, ..budgeted() }).await;
    assert_contains(&decided, truth, name);
    assert!(decided.upper > 0.5 * truth, "{name}: {}", decided.upper);
}

/// Asserts that a search ends long before its budgets, with an interval that
/// contains the truth.
async fn assert_ends(a: &Model, b: &Model, truth: Option<f64>, name: &str) {
    let result = measure(a, b, &budgeted()).await;
    if let Some(truth) = truth {
        assert_contains(&result, truth, name);
    }
    let cells = result.certified().unwrap().cells;
    assert!(
        result.lower <= result.upper && cells < MAX_CELLS,
        "{name}: {cells} cells, [{}, {}]",
        result.lower,
        result.upper
    );
}
