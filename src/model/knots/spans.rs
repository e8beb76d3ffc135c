//! The non-empty spans of knot vectors, with the maps to Bézier controls.

use crate::limits::MAX_ORDER;

/// A non-empty knot span with the linear map from its degree + 1 control
/// points to its Bézier controls.
pub(crate) struct Span {
    pub(crate) first_control: usize,
    pub(crate) ends: [f64; 2],
    /// `operator[k][i]` is the coefficient of control point `first_control + i` in Bézier control k.
    pub(crate) operator: Vec<[f64; MAX_ORDER]>,
}

/// Returns the non-empty spans of the domain.
pub(crate) fn spans(knots: &[f64], degree: usize, count: usize) -> Vec<Span> {
    (degree..count)
        .filter(|&index| knots[index] < knots[index + 1])
        .map(|index| Span {
            first_control: index - degree,
            ends: [knots[index], knots[index + 1]],
            operator: (0..=degree)
                .map(|k| blossom_coefficients(knots, degree, index, [knots[index], knots[index + 1]], k))
                .collect(),
        })
        .collect()
}

/// Returns the ends of consecutive spans, each once.
pub(crate) fn breaks(spans: &[Span]) -> Vec<f64> {
    let starts = spans.iter().map(|span| span.ends[0]);
    starts.chain(spans.last().map(|span| span.ends[1])).collect()
}

/// Returns the multiplicities of the ends of consecutive spans, with degree + 1 for the first and the last.
///
/// From one span to the next the first control point moves by the multiplicity of the knot between them.
pub(crate) fn multiplicities(spans: &[Span], degree: usize) -> Vec<u8> {
    let inner = spans.windows(2).map(|pair| pair[1].first_control - pair[0].first_control);
    // Valid knots are repeated at most degree + 1 times, 16.
    std::iter::once(degree + 1)
        .chain(inner)
        .chain([degree + 1])
        .map(|multiplicity| multiplicity as u8)
        .collect()
}

/// Returns the coefficients of a span's control points in the blossom at the first
/// argument, degree - k times, and the second, k times, both in the span.
///
/// Both factors of a level are quotients of differences of knots, so each has a
/// relative error of three roundings (lemma R3 of docs/rounding.md). `1 - fraction`
/// would not: near 1 the fraction's error is as large as the complement, and a
/// control of small weight then moves by its whole weight ratio.
pub(crate) fn blossom_coefficients(
    knots: &[f64],
    degree: usize,
    span: usize,
    arguments: [f64; 2],
    k: usize,
) -> [f64; MAX_ORDER] {
    let mut coefficients = [[0.0; MAX_ORDER]; MAX_ORDER];
    for (index, row) in coefficients.iter_mut().enumerate().take(degree + 1) {
        row[index] = 1.0;
    }
    for level in 1..=degree {
        let argument = if level <= k { arguments[1] } else { arguments[0] };
        for index in 0..=degree - level {
            let (low, high) = (knots[span - degree + level + index], knots[span + 1 + index]);
            let fraction = (argument - low) / (high - low);
            let complement = (high - argument) / (high - low);
            let next = coefficients[index + 1];
            for (coefficient, next) in coefficients[index].iter_mut().zip(next) {
                *coefficient = complement * *coefficient + fraction * next;
            }
        }
    }
    coefficients[0]
}
