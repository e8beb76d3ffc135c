//! The legend of the colours, as the page draws it: an upright scale with ticks, in SVG.

use super::numbers::{distance_text, signed_text};
use super::scale::Scale;
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
const MIN_GAP: f64 = 0.075;

/// A labelled place of the scale.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tick {
    pub(crate) value: f64,
    pub(crate) text: String,
}

/// Returns the ticks, the important ones first, without those that would cover each other.
pub(crate) fn ticks(scale: &Scale, diagonal: f64) -> Vec<Tick> {
    let extent = scale.extent;
    let text = |value: f64| {
        if value == 0.0 || extent.absolute {
            distance_text(value, diagonal)
        } else {
            signed_text(value, diagonal)
        }
    };
    let mut all = vec![("", scale.high), ("", scale.low)];
    if let Some(allowed) = scale.allowed {
        all.push(("allowed ", allowed));
        if !extent.absolute {
            all.push(("allowed ", -allowed));
        }
    }
    if !extent.absolute {
        all.push(("least ", extent.lowest));
    }
    all.push(("most ", if extent.absolute { extent.largest } else { extent.highest }));
    all.push(("", 0.0));
    let gap = MIN_GAP * (scale.high - scale.low);
    let mut kept: Vec<Tick> = Vec::new();
    for (prefix, value) in all {
        let is_inside = value >= scale.low && value <= scale.high;
        if is_inside && kept.iter().all(|tick| (tick.value - value).abs() >= gap) {
            kept.push(Tick { value, text: format!("{prefix}{}", text(value)) });
        }
    }
    kept
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
    for Tick { value, text } in ticks(scale, diagonal) {
        let y = TOP + size * (scale.high - value) / (scale.high - scale.low);
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
    use crate::scale::Extent;

    #[test]
    fn ticks_are_at_the_ends_what_is_allowed_and_the_extremes_but_not_over_each_other() {
        let extent = Extent { lowest: -2.0, highest: 4.0, largest: 4.0, floor: 1e-3, absolute: false };
        let of = |allowed: f64, extent| {
            let ticks = ticks(&Scale::new(extent, Some(allowed)), 120.0);
            ticks.into_iter().map(|tick| (tick.text, tick.value)).collect::<Vec<_>>()
        };
        let expected = [
            ("+4.000", 4.0),
            ("−4.000", -4.0),
            ("allowed +1.000", 1.0),
            ("allowed −1.000", -1.0),
            ("least −2.000", -2.0),
            ("0.000", 0.0),
        ]
        .map(|(text, value)| (text.to_owned(), value));
        assert_eq!(of(1.0, extent), expected);
        // What is allowed hides 0, from which it is less than 7.5 % of the scale away.
        let near = of(0.3, extent);
        assert!(near.iter().any(|(text, _)| text == "allowed +0.300"), "{near:?}");
        assert!(near.iter().all(|&(_, value)| value != 0.0), "{near:?}");
        let absolute = of(1.0, Extent { absolute: true, ..extent });
        let texts: Vec<_> = absolute.iter().map(|(text, _)| text.as_str()).collect();
        assert_eq!(texts, ["4.000", "0.000", "allowed 1.000"]);
    }

    #[test]
    fn a_tick_is_where_its_colour_is() {
        let extent = Extent { lowest: 0.0, highest: 4.0, largest: 4.0, floor: 1e-3, absolute: false };
        let svg = drawing(&Scale::new(extent, Some(1.0)), 120.0);
        // A quarter of 236 above the foot at 248.
        assert!(
            svg.contains("<path d=\"M16,189.00h5\"/><text x=\"24\" y=\"193.00\">allowed +1.000<"),
            "{svg}"
        );
        assert_eq!(svg.matches("<rect").count(), BINS);
        assert_eq!(svg.matches("fill=\"#79b98a\"").count(), BINS / 4);
    }
}
