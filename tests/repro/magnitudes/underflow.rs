use super::super::assert_measured;
use super::super::models::{bilinear, repeated, surface};

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
