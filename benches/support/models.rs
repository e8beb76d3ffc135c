//! The models that the stages are measured on.

use nurbs_hausdorff::{Model, SurfaceArrays};

/// A net over the unit square with noise in height, whose weights lie between
/// 1 and `max_weight`.
pub(crate) fn rough(degree: [usize; 2], spans: [usize; 2], max_weight: f64, seed: u64) -> Model {
    let mut random = fastrand::Rng::with_seed(seed);
    let counts = [0, 1].map(|axis| degree[axis] + spans[axis]);
    let knots = [0, 1].map(|axis| {
        let inner = (1..spans[axis]).map(|knot| knot as f64);
        let start = std::iter::repeat_n(0.0, degree[axis] + 1);
        let end = std::iter::repeat_n(spans[axis] as f64, degree[axis] + 1);
        start.chain(inner).chain(end).collect()
    });
    let control_points = (0..counts[0] * counts[1])
        .map(|index| {
            let at = |k: usize, count: usize| k as f64 / (count - 1) as f64;
            let height = 0.3 / spans[0].max(spans[1]) as f64 * random.f64();
            let weight = 1.0 + (max_weight - 1.0) * random.f64();
            [at(index / counts[1], counts[0]), at(index % counts[1], counts[1]), height, weight]
        })
        .collect();
    let surface = SurfaceArrays { degree, knots, counts, control_points };
    Model::from_arrays(None, vec![surface]).expect("a valid net")
}
