//! The histogram of a report: faces by how far they are at most.

use super::details::full;
use std::fmt::Write;

/// The number of bins, and the width of each, in pixels.
const BINS: usize = 20;
const BIN_WIDTH: usize = 30;
/// The height of the highest bar, in pixels.
const HEIGHT: usize = 100;

/// Returns the histogram with what is allowed, if that is stated; nothing where all faces coincide.
pub(super) fn histogram(uppers: &[f64], limit: Option<f64>) -> String {
    let range = uppers.iter().copied().chain(limit).fold(0.0, f64::max);
    if uppers.is_empty() || !(range > 0.0 && range.is_finite()) {
        return String::new();
    }
    let width = BINS * BIN_WIDTH;
    let mut counts = [0_usize; BINS];
    for upper in uppers {
        let bin = (upper / range * BINS as f64).floor();
        counts[(bin as usize).min(BINS - 1)] += 1;
    }
    let most = counts.iter().copied().fold(1, usize::max);
    let mut text = format!(
        "<figure>\n<svg class=\"histogram\" viewBox=\"-10 -16 {} {}\" role=\"img\" \
         aria-label=\"Faces by how far they are at most\">\n",
        width + 20,
        HEIGHT + 50
    );
    // Writing to a string does not fail, here and below.
    for (bin, &count) in counts.iter().enumerate().filter(|&(_, &count)| count > 0) {
        let (height, left) = ((HEIGHT * count / most).max(1), bin * BIN_WIDTH);
        let top = HEIGHT - height;
        let _ = writeln!(
            text,
            "<rect x=\"{}\" y=\"{top}\" width=\"{}\" height=\"{height}\"/>\
             <text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{count}</text>",
            left + 1,
            BIN_WIDTH - 2,
            left + BIN_WIDTH / 2,
            top as isize - 3
        );
    }
    let _ = writeln!(
        text,
        "<path d=\"M0,{HEIGHT}H{width}\"/><text x=\"0\" y=\"{below}\">0</text>\
         <text x=\"{width}\" y=\"{below}\" text-anchor=\"end\">{}</text>",
        full(range),
        below = HEIGHT + 14
    );
    if let Some(limit) = limit.filter(|limit| limit.is_finite()) {
        let at = (limit / range * width as f64).floor();
        let anchor = if limit > range / 2.0 { "end" } else { "start" };
        let _ = writeln!(
            text,
            "<path class=\"limit\" d=\"M{at},-12V{HEIGHT}\"/>\
             <text x=\"{at}\" y=\"{}\" text-anchor=\"{anchor}\">allowed {}</text>",
            HEIGHT + 28,
            full(limit)
        );
    }
    text.push_str(
        "</svg>\n<figcaption>Faces of both models by how far they are at most</figcaption>\n</figure>\n",
    );
    text
}
