use super::super::assert_measured;
use super::super::models::{shelf, swept};
use super::{HOOK, from_parabola_to_hook, parabola_and_shelf};

/// The same where a straight line from below ends at the hook's start at a crease.
pub(crate) async fn ulp_crease() {
    let curve: Vec<_> = [[0.0, -2.0], [0.0, -1.0]].into_iter().chain(HOOK).collect();
    let knots = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0 + f64::EPSILON, 1.0 + f64::EPSILON, 1.0 + f64::EPSILON];
    let b = vec![swept(2, &knots, &curve), shelf(-5.0)];
    // The end (-0.0609, 0.0009) of the parabola is above the line's end.
    assert_measured(parabola_and_shelf(), b, from_parabola_to_hook(), "ulp_crease").await;
}
