use super::super::assert_measured;
use super::super::models::{repeated, shelf, swept};

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
