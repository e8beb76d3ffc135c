//! The legend, next to the curves so that it covers none.

use super::{Series, Style};
use plotters::coord::Shift;
use plotters::prelude::*;
use std::error::Error;

/// The pixels between two names, from the top to the first, and of a sample line.
const SPACING: i32 = 22;
const TOP: i32 = 52;
const SAMPLE: i32 = 26;

/// The dashes of a sample of a dashed line, from pixel to pixel.
const DASHES: &[(i32, i32)] = &[(0, 6), (10, 16), (20, SAMPLE)];

/// Draws a line and a name for each of `series`.
pub(super) fn draw(
    area: &DrawingArea<SVGBackend<'_>, Shift>,
    series: &[Series],
) -> Result<(), Box<dyn Error>> {
    for (index, series) in series.iter().enumerate() {
        let y = TOP + SPACING * index as i32;
        let line = series.color.stroke_width(2);
        let dashes = if series.style == Style::Dashed { DASHES } else { &[(0, SAMPLE)] };
        for &(start, end) in dashes {
            area.draw(&PathElement::new([(8 + start, y), (8 + end, y)], line))?;
        }
        if series.style == Style::Marked {
            area.draw(&Circle::new((8 + SAMPLE / 2, y), 3, series.color.filled()))?;
        }
        let style = ("sans-serif", 13).into_font().color(&BLACK);
        area.draw(&Text::new(series.name.clone(), (14 + SAMPLE, y - 6), style))?;
    }
    Ok(())
}
