//! One panel of a figure: axes, a grid and curves.

use super::{Series, Style};
use plotters::coord::Shift;
use plotters::coord::ranged1d::{AsRangedCoord, ValueFormatter};
use plotters::prelude::*;
use std::error::Error;
use std::ops::Range;

/// The label and the scale of an axis.
#[derive(Debug, Clone)]
pub(crate) struct Axis {
    label: String,
    logarithmic: bool,
}

impl Axis {
    /// Makes an axis with a linear scale.
    pub(crate) fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), logarithmic: false }
    }

    /// Makes an axis with a logarithmic scale; numbers up to 0 are left out.
    pub(crate) fn logarithmic(label: impl Into<String>) -> Self {
        Self { label: label.into(), logarithmic: true }
    }

    /// Returns whether the scale contains a value.
    fn shows(&self, value: f64) -> bool {
        value.is_finite() && (!self.logarithmic || value > 0.0)
    }

    /// Returns the range of `values` with a margin at both ends.
    fn range(&self, values: impl Iterator<Item = f64>) -> Range<f64> {
        let (low, high) = values
            .filter(|&value| self.shows(value))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
        if low > high {
            return if self.logarithmic { 1.0..10.0 } else { 0.0..1.0 };
        }
        if self.logarithmic {
            let (low, high) = (low / LOGARITHMIC_MARGIN, high * LOGARITHMIC_MARGIN);
            // Ticks are at whole orders of magnitude; there must be two.
            let has_ticks = high.log10().floor() - low.log10().ceil() >= 1.0;
            let widened = 10_f64.powf(low.log10().floor())..10_f64.powf(high.log10().ceil());
            return if has_ticks { low..high } else { widened };
        }
        let margin =
            if high > low { LINEAR_MARGIN * (high - low) } else { LINEAR_MARGIN * high.abs().max(1.0) };
        low - margin..high + margin
    }
}

/// The margins at the ends of an axis: a fraction of its length, or a factor.
const LINEAR_MARGIN: f64 = 0.05;
const LOGARITHMIC_MARGIN: f64 = 1.15;

/// A title, two axes and the curves between them.
#[derive(Debug, Clone)]
pub(crate) struct Panel {
    pub(crate) title: String,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    pub(crate) series: Vec<Series>,
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

impl Panel {
    pub(super) fn draw(&self, area: &Area<'_>) -> Result<(), Box<dyn Error>> {
        let values = |axis: usize| {
            self.series.iter().flat_map(|series| &series.points).flatten().map(move |point| point[axis])
        };
        let (x, y) = (self.x.range(values(0)), self.y.range(values(1)));
        match (self.x.logarithmic, self.y.logarithmic) {
            (false, false) => self.draw_over(area, x, y),
            (false, true) => self.draw_over(area, x, y.log_scale()),
            (true, false) => self.draw_over(area, x.log_scale(), y),
            (true, true) => self.draw_over(area, x.log_scale(), y.log_scale()),
        }
    }

    fn draw_over<X, Y>(&self, area: &Area<'_>, x: X, y: Y) -> Result<(), Box<dyn Error>>
    where
        X: AsRangedCoord<Value = f64>,
        Y: AsRangedCoord<Value = f64>,
        X::CoordDescType: ValueFormatter<f64>,
        Y::CoordDescType: ValueFormatter<f64>,
    {
        let mut chart = ChartBuilder::on(area)
            .caption(&self.title, ("sans-serif", 15))
            .margin(8)
            .x_label_area_size(42)
            .y_label_area_size(72)
            .build_cartesian_2d(x, y)?;
        chart
            .configure_mesh()
            .x_desc(&self.x.label)
            .y_desc(&self.y.label)
            .axis_desc_style(("sans-serif", 13))
            .label_style(("sans-serif", 11))
            .x_label_formatter(&|&value| short(value))
            .y_label_formatter(&|&value| short(value))
            .x_labels(9)
            .y_labels(7)
            .max_light_lines(1)
            .bold_line_style(BLACK.mix(0.12))
            .light_line_style(TRANSPARENT)
            .draw()?;
        for series in &self.series {
            let width = if series.style == Style::Dashed { 1 } else { 2 };
            let line = series.color.stroke_width(width);
            for part in series.parts(|&[x, y]| self.x.shows(x) && self.y.shows(y)) {
                if series.style == Style::Marked || part.len() == 1 {
                    let mark = |&point: &(f64, f64)| Circle::new(point, 2, series.color.filled());
                    chart.draw_series(part.iter().map(mark))?;
                }
                if series.style == Style::Dashed {
                    chart.draw_series(DashedLineSeries::new(part, 10, 7, line))?;
                } else {
                    chart.draw_series(LineSeries::new(part, line))?;
                }
            }
        }
        Ok(())
    }
}

/// Writes numbers from 0.001 to 100,000 with the digits required, others with
/// exponents.
fn short(value: f64) -> String {
    let size = value.abs();
    // Rounding of the steps moves a tick at 0 slightly.
    const ZERO: f64 = 1e-12;
    if size < ZERO {
        return "0".to_owned();
    }
    if (1e-3..1e5).contains(&size) {
        let text = format!("{value:.4}");
        return text.trim_end_matches('0').trim_end_matches('.').to_owned();
    }
    let text = format!("{value:.1e}");
    text.replacen(".0e", "e", 1)
}
