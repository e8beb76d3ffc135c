use super::super::assert_measured;
use super::super::models::{repeated, swept};
use super::{HOOK, from_parabola_to_hook, parabola_and_shelf};

/// The hook's span is one unit in the last place wide, so that the middle of the
/// span is its end, and nothing of the surface precedes the hook.
pub(crate) async fn ulp_gap() {
    let curve: Vec<_> = [[10.0, -5.0], [10.5, -5.0], [11.0, -5.0]].into_iter().chain(HOOK).collect();
    let knots = repeated(2, &[0.0, 1.0, 1.0 + f64::EPSILON]);
    let b = vec![swept(2, &knots, &curve)];
    assert_measured(parabola_and_shelf(), b, from_parabola_to_hook(), "ulp_gap").await;
}
