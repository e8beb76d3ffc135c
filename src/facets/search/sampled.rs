//! The points of a triangle at which bounds are audited, and the rules of its mean.

/// The weights of the corners at sampled points: corners, points of the edges and of the interior.
pub(super) const WEIGHTS: [[f64; 3]; 12] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.5, 0.5, 0.0],
    [0.0, 0.25, 0.75],
    [0.61, 0.0, 0.39],
    [0.34, 0.33, 0.33],
    [0.92, 0.05, 0.03],
    [0.06, 0.9, 0.04],
    [0.02, 0.07, 0.91],
    [0.48, 0.17, 0.35],
    [0.21, 0.58, 0.21],
];

/// The points along each side of a triangle for its mean by a rule, and of the rule whose difference is its error.
pub(super) const RULES: [usize; 2] = [6, 3];

/// The error of the finer rule, in differences of both.
const RULE_DIFFERENCES: f64 = 4.0;

/// The steps of an additive sequence of low discrepancy in the square: powers of the inverse of the plastic number
/// (Roberts 2018).
const SEQUENCE: [f64; 2] = [0.754_877_666_246_693, 0.569_840_290_998_053];

/// The weights of corners and of `further` points: an additive sequence of low discrepancy, folded into the triangle.
pub(super) fn places(further: usize) -> impl Iterator<Item = [f64; 3]> {
    let inner = (1..=further).map(|index| {
        let [s, t] = SEQUENCE.map(|step| (index as f64 * step).fract());
        let [s, t] = if s + t > 1.0 { [1.0 - s, 1.0 - t] } else { [s, t] };
        [1.0 - s - t, s, t]
    });
    WEIGHTS[..3].iter().copied().chain(inner)
}

/// The weights of the middles of the triangles in which one is divided.
pub(super) fn middles(count: usize) -> impl Iterator<Item = [f64; 3]> {
    let of = move |row: usize, column: usize, third: f64| {
        let [s, t] = [row, column].map(|step| (step as f64 + third) / count as f64);
        [1.0 - s - t, s, t]
    };
    (0..count * count).map(move |index| {
        let (row, column) = (index / count, index % count);
        // Those of the square on this side of its diagonal, and the halves beyond theirs folded back.
        if row + column < count {
            of(row, column, 1.0 / 3.0)
        } else {
            of(count - 1 - row, count - 1 - column, 2.0 / 3.0)
        }
    })
}

/// The error of the finer of both rules, where distances are in a range of this width: a step between nearest facets
/// is the share of a row of triangles.
pub(super) fn rule_error(fine: f64, coarse: f64, range: f64) -> f64 {
    RULE_DIFFERENCES * (fine - coarse).abs() + range / (RULES[0] * RULES[0]) as f64
}
