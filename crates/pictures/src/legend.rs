//! The legend of the colours, as the page draws it: an upright scale with ticks, in SVG.

use super::numbers::{distance_text, signed_text};
use nurbs_hausdorff_colors::{Scale, Tick, TickKind};
use std::fmt::Write;

/// The sizes of the drawing, in its own units.
const WIDTH: f64 = 150.0;
const HEIGHT: f64 = 260.0;
const BAR: f64 = 16.0;
const TOP: f64 = 12.0;

/// The number of colours drawn.
const BINS: usize = 48;

/// What each colour is higher than its part, so that none shows between two.
const OVERLAP: f64 = 0.3;

/// The least distance of two labels, as a fraction of the scale.
const LEAST_GAP: f64 = 0.075;

/// Returns the label of a tick.
fn label(Tick { value, kind }: Tick, scale: &Scale, diagonal: f64) -> String {
    let prefix = match kind {
        TickKind::End | TickKind::Zero => "",
        TickKind::Allowed => "allowed ",
        TickKind::Least => "least ",
        TickKind::Most => "most ",
    };
    let is_plain = value == 0.0 || scale.is_absolute();
    let text = if is_plain { distance_text(value, diagonal) } else { signed_text(value, diagonal) };
    format!("{prefix}{text}")
}

/// Returns the drawing.
pub(crate) fn drawing(scale: &Scale, diagonal: f64) -> String {
    let size = HEIGHT - 2.0 * TOP;
    let mut svg = format!(
        "<svg class=\"legend\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" \
         aria-label=\"Legend of the colours\">\n"
    );
    // Writing to a string does not fail, here and below.
    for (bin, [red, green, blue]) in scale.stops(BINS).enumerate() {
        let y = TOP + size * (BINS - 1 - bin) as f64 / BINS as f64;
        let height = size / BINS as f64 + OVERLAP;
        let _ = writeln!(
            svg,
            "<rect x=\"0\" y=\"{y:.2}\" width=\"{BAR}\" height=\"{height:.2}\" \
             fill=\"#{red:02x}{green:02x}{blue:02x}\"/>"
        );
    }
    for tick in scale.ticks(LEAST_GAP, scale.allowed()) {
        let y = TOP + size * (scale.high() - tick.value) / (scale.high() - scale.low());
        let text = label(tick, scale, diagonal);
        let _ = writeln!(
            svg,
            "<path d=\"M{BAR},{y:.2}h5\"/><text x=\"{}\" y=\"{:.2}\">{text}</text>",
            BAR + 8.0,
            y + 4.0
        );
    }
    svg.push_str("</svg>");
    svg
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use nurbs_hausdorff_colors::{Allowed, Extent, ScaleOptions};

    fn scale(lowest: f64, absolute: bool) -> Scale {
        let extent = Extent { lowest, highest: 4.0, largest: 4.0, floor: 1e-3 };
        let allowed = Some(Allowed { above: 1.0, below: 1.0 });
        Scale::new(extent, ScaleOptions { allowed, absolute, ..ScaleOptions::default() })
    }

    #[test]
    fn labels_say_what_a_tick_marks() {
        let of = |scale: &Scale| -> Vec<String> {
            scale
                .ticks(LEAST_GAP, scale.allowed())
                .into_iter()
                .map(|tick| label(tick, scale, 120.0))
                .collect()
        };
        let expected = ["+4.000", "−4.000", "allowed +1.000", "allowed −1.000", "least −2.000", "0.000"];
        assert_eq!(of(&scale(-2.0, false)), expected);
        assert_eq!(of(&scale(-2.0, true)), ["4.000", "0.000", "allowed 1.000"]);
    }

    #[test]
    fn a_tick_is_where_its_colour_is() {
        let svg = drawing(&scale(0.0, false), 120.0);
        // A quarter of 236 above the foot at 248.
        assert!(
            svg.contains("<path d=\"M16,189.00h5\"/><text x=\"24\" y=\"193.00\">allowed +1.000<"),
            "{svg}"
        );
        assert_eq!(svg.matches("<rect").count(), BINS);
        assert_eq!(svg.matches("fill=\"#79b98a\"").count(), BINS / 4);
    }
}
