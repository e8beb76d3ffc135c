//! The lines of a grid over the patches of a surface, and the pieces of patches between them.

/// Returns `samples` evenly spaced parameters from the first of `breaks` to the last.
pub(crate) fn uniform(breaks: &[f64], samples: usize) -> Vec<f64> {
    let (start, end) = (breaks[0], breaks[breaks.len() - 1]);
    (0..samples)
        .map(|index| {
            let fraction = index as f64 / (samples - 1) as f64;
            (1.0 - fraction) * start + fraction * end
        })
        .collect()
}

/// Returns, for every interval between two neighbouring locations, the patches
/// that it overlaps and its interval of parameters on each.
pub(crate) fn cell_pieces(locations: &[(usize, f64)]) -> Vec<Vec<(usize, [f64; 2])>> {
    let overlaps = |pair: &[(usize, f64)]| {
        let ((first, start), (last, end)) = (pair[0], pair[1]);
        (first..=last)
            .map(|patch| {
                (patch, [if patch == first { start } else { 0.0 }, if patch == last { end } else { 1.0 }])
            })
            .filter(|(_, [start, end])| start < end || first == last)
            .collect()
    };
    locations.windows(2).map(overlaps).collect()
}
