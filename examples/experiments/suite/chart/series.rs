//! Curves of a chart.

use plotters::style::RGBColor;

/// Colours that colour-blind readers can distinguish (Okabe and Ito 2008).
const COLORS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(70, 70, 70),
];

/// The style of a series.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Style {
    /// A line with a mark at every point.
    Marked,
    /// A line.
    Line,
    /// A dashed line, for bounds.
    Dashed,
}

/// Points (x, y) with a name; `None` breaks the line.
#[derive(Debug, Clone)]
pub(crate) struct Series {
    pub(crate) name: String,
    pub(crate) color: RGBColor,
    pub(crate) style: Style,
    pub(crate) points: Vec<Option<[f64; 2]>>,
}

impl Series {
    /// Makes a series; `color` is an index, and the colours repeat from 7 on.
    pub(crate) fn new(
        name: impl Into<String>,
        color: usize,
        style: Style,
        points: Vec<Option<[f64; 2]>>,
    ) -> Self {
        Self { name: name.into(), color: COLORS[color % COLORS.len()], style, points }
    }

    /// Returns the unbroken parts of the line that consist of points accepted by `keep`.
    pub(crate) fn parts(&self, keep: impl Fn(&[f64; 2]) -> bool) -> Vec<Vec<(f64, f64)>> {
        self.points
            .split(|point| !point.as_ref().is_some_and(&keep))
            .map(|part| part.iter().flatten().map(|&[x, y]| (x, y)).collect::<Vec<_>>())
            .filter(|part| !part.is_empty())
            .collect()
    }
}
