//! Figures as SVG: panels of curves, one below the other.

mod legend;
mod panel;
mod series;

pub(crate) use panel::{Axis, Panel};
pub(crate) use series::{Series, Style};

use plotters::prelude::*;
use std::error::Error;
use std::path::Path;

/// The width of a figure and the height of one of its panels, in pixels.
const WIDTH: u32 = 860;
const PANEL_HEIGHT: u32 = 330;

/// The width of the legend, to the right of the curves.
const LEGEND_WIDTH: u32 = 250;

/// Attributes that equal SVG's defaults, a quarter of a figure's bytes.
const DEFAULTS: [&str; 3] = [" opacity=\"1\"", " stroke=\"none\"", " stroke-width=\"1\""];

/// Draws `panels` from top to bottom into the file `path`.
pub(crate) fn save(path: &Path, panels: &[Panel]) -> Result<(), Box<dyn Error>> {
    let size = (WIDTH, PANEL_HEIGHT * panels.len() as u32);
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
        root.fill(&WHITE)?;
        for (area, panel) in root.split_evenly((panels.len(), 1)).iter().zip(panels) {
            let (curves, legend) = area.split_horizontally(WIDTH - LEGEND_WIDTH);
            panel.draw(&curves)?;
            legend::draw(&legend, &panel.series)?;
        }
        root.present()?;
    }
    for default in DEFAULTS {
        text = text.replace(default, "");
    }
    std::fs::write(path, text)?;
    Ok(())
}
