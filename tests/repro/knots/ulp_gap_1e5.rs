use super::super::assert_measured;
use super::super::models::{shelf, swept};
use super::{HOOK, from_parabola_to_hook, parabola_and_shelf};

/// The same at knots of 1e5, whose units in the last place are larger.
pub(crate) async fn ulp_gap_1e5() {
    let curve: Vec<_> = [[0.0, -2.0], [0.0, -1.0]].into_iter().chain(HOOK).collect();
    let next = 1e5_f64.next_up();
    let knots = [0.0, 0.0, 0.0, 1e5, 1e5, next, next, next];
    let b = vec![swept(2, &knots, &curve), shelf(-5.0)];
    assert_measured(parabola_and_shelf(), b, from_parabola_to_hook(), "ulp_gap_1e5").await;
}
