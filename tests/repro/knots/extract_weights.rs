use super::super::models::{bilinear, model, surface};
use super::super::{budgeted, measure};
use nurbs_hausdorff::internals::engine::DistanceOptions;

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
