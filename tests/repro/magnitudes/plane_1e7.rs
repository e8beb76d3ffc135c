use super::super::assert_ends;
use super::super::models::{bilinear, model};

/// Two planes 1e7 from the origin, 0.1 apart up to the rounding of 1e7 + 0.1.
pub(crate) async fn plane_1e7() {
    const FAR: f64 = 1e7;
    let plane = |height: f64| {
        let corner = |i: f64, j: f64| [FAR + i, FAR + j, height, 1.0];
        model(vec![bilinear([corner(0.0, 0.0), corner(0.0, 1.0), corner(1.0, 0.0), corner(1.0, 1.0)])])
    };
    assert_ends(&plane(FAR + 0.1), &plane(FAR), Some(FAR + 0.1 - FAR), "plane_1e7").await;
}
