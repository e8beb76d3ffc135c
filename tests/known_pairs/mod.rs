//! Pairs on which an interval was false or a search did not end, each with its
//! exact distance: from analysis, or from exact arithmetic where so stated.
//!
//! Every pair is an asynchronous function, so that the same tests run natively and
//! in a browser's wasm module.

mod models;

use models::{bilinear, model, nets, repeated, shelf, surface, swept};
use nurbs_hausdorff::internals::engine::{
    Backend, DistanceOptions, DistanceResult, Engine, PreparedModel, Stop,
};
use nurbs_hausdorff::{CertifiedOptions, HierarchyOptions, Method, Model, SurfaceArrays};

/// Applies a macro that declares tests to the names of all pairs.
macro_rules! for_each_pair {
    ($declare:ident) => {
        $declare! {
            ulp_gap ulp_crease ulp_gap_1e5 ulp_spiral extract_weights overflow underflow
            plane_1e7 points far split_copies gpu_deep
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

/// A parabola near the origin and a rectangle 0.02 below B's.
fn parabola_and_shelf() -> Vec<SurfaceArrays> {
    let parabola = [[-0.060_899_999_999_999_996, 0.0009], [0.0009, -0.0009], [0.0591, 0.0009]];
    vec![swept(2, &repeated(2, &[0.0, 1.0]), &parabola), shelf(-5.02)]
}

/// The quarter of a curve that B has near the origin: no point of it is left
/// of x = 0, so that the parabola's end at x = -0.0609 is far from it.
const HOOK: [[f64; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];

/// From the parabola's end to the hook's start, exactly.
fn from_parabola_to_hook() -> f64 {
    0.060_899_999_999_999_996_f64.hypot(0.0009)
}

/// The hook's span is one unit in the last place wide, so that the middle of the
/// span is its end, and nothing of the surface precedes the hook.
pub(crate) async fn ulp_gap() {
    let curve: Vec<_> = [[10.0, -5.0], [10.5, -5.0], [11.0, -5.0]].into_iter().chain(HOOK).collect();
    let knots = repeated(2, &[0.0, 1.0, 1.0 + f64::EPSILON]);
    let b = vec![swept(2, &knots, &curve)];
    assert_measured(parabola_and_shelf(), b, from_parabola_to_hook(), "ulp_gap").await;
}

/// The same where a straight line from below ends at the hook's start at a crease.
pub(crate) async fn ulp_crease() {
    let curve: Vec<_> = [[0.0, -2.0], [0.0, -1.0]].into_iter().chain(HOOK).collect();
    let knots = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0 + f64::EPSILON, 1.0 + f64::EPSILON, 1.0 + f64::EPSILON];
    let b = vec![swept(2, &knots, &curve), shelf(-5.0)];
    // The end (-0.0609, 0.0009) of the parabola is above the line's end.
    assert_measured(parabola_and_shelf(), b, from_parabola_to_hook(), "ulp_crease").await;
}

/// The same at knots of 1e5, whose units in the last place are larger.
pub(crate) async fn ulp_gap_1e5() {
    let curve: Vec<_> = [[0.0, -2.0], [0.0, -1.0]].into_iter().chain(HOOK).collect();
    let next = 1e5_f64.next_up();
    let knots = [0.0, 0.0, 0.0, 1e5, 1e5, next, next, next];
    let b = vec![swept(2, &knots, &curve), shelf(-5.0)];
    assert_measured(parabola_and_shelf(), b, from_parabola_to_hook(), "ulp_gap_1e5").await;
}

/// A spiral of degree 7 on a span of one unit in the last place. A is the
/// spiral continued beyond its start, whose end is the farthest point.
pub(crate) async fn ulp_spiral() {
    let continued = [
        [-0.051_383_897_261_747_837, 0.001_666_372_358_768_960_5],
        [-0.036_400_652_972_513_214, 0.000_702_969_772_742_361_8],
        [-0.021_616_083_257_311_913, 7.190_711_712_931_5e-5],
        [-0.007_033_592_961_969_45, -0.000_235_804_920_397_541_16],
        [0.007_343_633_961_518_793, -0.000_229_120_467_017_883_84],
        [0.021_512_629_509_533_573, 8.304_664_529_090_977e-5],
        [0.035_470_636_715_911_26, 0.000_691_827_789_310_762_7],
        [0.049_215_104_777_078_86, 0.001_588_404_255_574_316_1],
    ];
    let spiral =
        [[0.0, 0.0], [1.0, 0.0], [1.0, 1.5], [-1.0, 1.5], [-1.0, -2.0], [2.0, -2.0], [2.0, 3.0], [-2.0, 3.0]];
    let line = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0].map(|k| [10.0 + k / 7.0, -5.0]);
    let curve: Vec<_> = line.into_iter().chain(spiral).collect();
    let a = vec![swept(7, &repeated(7, &[0.0, 1.0]), &continued), shelf(-5.020_564_364_107_432)];
    let b = vec![swept(7, &repeated(7, &[0.0, 1.0, 1.0 + f64::EPSILON]), &curve)];
    let [x, z] = continued[0];
    assert_measured(a, b, x.hypot(z), "ulp_spiral").await;
}

/// An interior knot at a relative distance of 2.8e-7 from the end, and a control
/// point whose weight is as small: the complement of a rounded knot fraction
/// moved it. The truth is from rational arithmetic.
pub(crate) async fn extract_weights() {
    let [start, knot, end] = [0.052_036_619_925_780_125, 0.505_936_081_034_358_2, 0.505_936_206_947_746_2];
    let curve = [
        [0.918_263_803_056_892_5, 0.811_789_578_021_936, 1.0],
        [0.890_291_369_205_598, 0.925_483_101_592_807_9, 1.0],
        [0.082_774_642_530_100_36, 0.361_758_560_767_773_35, 2.774_036_188_324_563e-7],
        [0.592_452_791_377_739_4, 0.331_222_517_787_882_36, 1.0],
    ];
    let points: Vec<_> = curve.iter().flat_map(|&[x, y, w]| [[x, y, 0.0, w], [x, y, 0.001, w]]).collect();
    let knots = [start, start, start, knot, end, end, end];
    let a = model(vec![surface([2, 1], [&knots, &[0.0, 0.0, 1.0, 1.0]], &points)]);
    let b = model(vec![bilinear([[1.613_619_770_716_730_4, -0.008_802_270_046_754_157, 0.0, 1.0]; 4])]);
    let truth = 1.302_298_531_963_835_4;
    let result = measure(&a, &b, &DistanceOptions { relative_tolerance: Some(1e-12), ..budgeted() }).await;
    assert!(
        result.lower <= truth && truth <= result.upper,
        "{truth} in [{}, {}]",
        result.lower,
        result.upper
    );
}

/// Weight times coordinate is 1e170, whose square is beyond float64. The upper
/// end is from samples: no distance exceeds it.
pub(crate) async fn overflow() {
    let [a, b] = nets!(overflow);
    let options = DistanceOptions { relative_tolerance: Some(1e-4), ..budgeted() };
    let result = measure(&a, &b, &options).await;
    assert!(result.lower <= 6.575e68, "{:e}", result.lower);
    assert!(result.upper.is_finite() && result.upper >= result.lower, "{:e}", result.upper);
}

/// All weights are 1e-80, whose fourth powers are 0 in float64. The cubic
/// z = 0.0005 + 0.001 cos-like arc rises to 0.001 above the plane.
pub(crate) async fn underflow() {
    const WEIGHT: f64 = 1e-80;
    let heights = [0.0005, 0.002_232_050_8, -0.001_232_050_8, 0.0005];
    let points: Vec<_> =
        (0..8).map(|k| [(k / 2) as f64 / 3.0, (k % 2) as f64, heights[k / 2], WEIGHT]).collect();
    let wave = surface([3, 1], [&repeated(3, &[0.0, 1.0]), &[0.0, 0.0, 1.0, 1.0]], &points);
    let rectangle = |[x0, x1]: [f64; 2], [y0, y1]: [f64; 2], z: f64| {
        bilinear([[x0, y0], [x0, y1], [x1, y0], [x1, y1]].map(|[x, y]| [x, y, z, WEIGHT]))
    };
    let a = vec![wave, rectangle([2.9, 3.0], [-0.1, 0.1], 0.0006)];
    let b = vec![rectangle([0.0, 3.0], [-0.2, 1.5], 0.0)];
    // The cubic's maximum, at which its derivative 3(h1 - h0)(1-t)² + … vanishes.
    let height = |t: f64| {
        let r = 1.0 - t;
        heights[0] * r * r * r
            + 3.0 * heights[1] * r * r * t
            + 3.0 * heights[2] * r * t * t
            + heights[3] * t * t * t
    };
    let truth = (0..=1_000_000).map(|k| height(f64::from(k) / 1e6)).fold(0.0, f64::max);
    assert_measured(a, b, truth, "underflow").await;
}

/// Method `hierarchy` on the GPU where B is a point. The truth is the largest
/// distance of a fine sampling of A from it, up to the sampling.
pub(crate) async fn hierarchy_point(engine: &Engine) {
    let [a, b] = nets!(hierarchy_point);
    let options = DistanceOptions {
        method: Method::Hierarchy(HierarchyOptions { grid: 48, ..Default::default() }),
        backend: Backend::Gpu,
        ..DistanceOptions::default()
    };
    let result = measure_by(engine, &a, &b, &options).await;
    assert!(result.lower <= 1.517_852 && 1.517_851 <= result.upper, "[{}, {}]", result.lower, result.upper);
}

/// Two planes 1e7 from the origin, 0.1 apart up to the rounding of 1e7 + 0.1.
pub(crate) async fn plane_1e7() {
    const FAR: f64 = 1e7;
    let plane = |height: f64| {
        let corner = |i: f64, j: f64| [FAR + i, FAR + j, height, 1.0];
        model(vec![bilinear([corner(0.0, 0.0), corner(0.0, 1.0), corner(1.0, 0.0), corner(1.0, 1.0)])])
    };
    assert_ends(&plane(FAR + 0.1), &plane(FAR), Some(FAR + 0.1 - FAR), "plane_1e7").await;
}

/// Two points: the models' diagonals are 0, and so is a relative tolerance.
pub(crate) async fn points() {
    let point = |x: f64, y: f64, z: f64| model(vec![bilinear([[x, y, z, 1.0]; 4])]);
    let [a, b] = [point(0.3, 0.2, 0.1), point(1.3, 0.6, 0.1)];
    let truth = 1.0_f64.hypot(0.4);
    assert_ends(&a, &b, Some(truth), "points").await;
    // No interval is 0 wide: the result says so, and which tolerance can be reached.
    let result = measure(&a, &b, &budgeted()).await;
    let details = result.certified().unwrap();
    assert_eq!((details.tolerance, details.stop, result.converged), (0.0, Stop::Precision, false));
    assert!(result.notice.unwrap().contains("single points"));
    let absolute = DistanceOptions { tolerance: Some(details.min_tolerance), ..budgeted() };
    let result = measure(&a, &b, &absolute).await;
    assert_contains(&result, truth, "points");
    assert!(result.converged && result.notice.is_none());
}

/// A sheet and a sphere 2.5e8 from the origin, where 1e-6 of their size is a
/// few roundings of their coordinates.
pub(crate) async fn far() {
    let [a, b] = nets!(far);
    assert_ends(&a, &b, None, "far").await;
}

/// Two cuts of one sheet; no bound holds across pieces that are cut elsewhere.
pub(crate) async fn split_copies() {
    let [a, b] = nets!(split_copies);
    let options = |tolerance| DistanceOptions {
        method: Method::Certified(CertifiedOptions { max_cells: Some(MAX_CELLS), max_seconds: Some(5.0) }),
        relative_tolerance: Some(tolerance),
        ..budgeted()
    };
    let fine = measure(&a, &b, &options(1e-9)).await;
    let coarse = measure(&a, &b, &options(1e-4)).await;
    assert!(coarse.converged, "[{:e}, {:e}]", coarse.lower, coarse.upper);
    assert!(fine.lower <= coarse.upper && coarse.lower <= fine.upper, "{:e} {:e}", fine.lower, coarse.lower);
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

/// A patch of bidegree (5, 5) against the same with its numbers changed by 1e-4.
pub(crate) async fn gpu_deep() {
    let [a, b] = nets!(gpu_deep);
    let result = measure(&a, &b, &DistanceOptions { relative_tolerance: Some(1e-5), ..budgeted() }).await;
    assert!(result.converged, "[{}, {}]", result.lower, result.upper);
}

/// The same with kernels, which must not take cells 2^-25 of a patch wide: float32
/// does not hold them exactly.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) async fn gpu_deep_with_kernels(engine: &Engine) {
    let [a, b] = nets!(gpu_deep);
    let options = DistanceOptions { relative_tolerance: Some(1e-5), ..budgeted() };
    let on_cpu = measure(&a, &b, &options).await;
    let on_gpu = measure_by(engine, &a, &b, &DistanceOptions { backend: Backend::Gpu, ..options }).await;
    assert!(on_cpu.converged && on_gpu.converged, "[{}, {}]", on_gpu.lower, on_gpu.upper);
    assert!(on_cpu.lower <= on_gpu.upper && on_gpu.lower <= on_cpu.upper);
}
