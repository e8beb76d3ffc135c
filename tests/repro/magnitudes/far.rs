use super::super::assert_ends;
use super::super::models::nets;

/// A sheet and a sphere 2.5e8 from the origin, where 1e-6 of their size is a
/// few roundings of their coordinates.
pub(crate) async fn far() {
    let [a, b] = nets!(far);
    assert_ends(&a, &b, None, "far").await;
}
