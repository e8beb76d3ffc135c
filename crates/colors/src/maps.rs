//! The colours themselves, and what lies between two of them.

use std::array;

/// From negative to positive: ColorBrewer's diverging scale RdBu, which is safe for colour-blind readers.
const DIVERGING: [u32; 9] =
    [0x2166ac, 0x4393c3, 0x92c5de, 0xd1e5f0, 0xf7f7f7, 0xfddbc7, 0xf4a582, 0xd6604d, 0xb2182b];

/// From negative to positive, as metrologists expect: Tol's discrete rainbow, whose steps are distinct for
/// colour-blind readers.
const RAINBOW: [u32; 11] = [
    0x1965b0, 0x5289c7, 0x7bafde, 0x4eb265, 0x90c987, 0xcae0ab, 0xf7f056, 0xf6c141, 0xf1932d, 0xe8601c,
    0xdc050c,
];

/// From zero to the largest distance: ColorBrewer's scale YlOrRd.
const SEQUENTIAL: [u32; 6] = [0xfffff0, 0xffeda0, 0xfeb24c, 0xfc4e2a, 0xb10026, 0x67001f];

/// For points whose closest point has no normal, so that the deviation has no sign.
pub(crate) const UNSIGNED: u32 = 0x808890;
/// For deviations that are allowed, and for those that rounding may have made.
pub(crate) const WITHIN: u32 = 0x79b98a;
pub(crate) const ROUNDING: u32 = 0xf2f3f4;
/// For deviations that the user did not ask to see.
pub(crate) const UNFOCUSED: u32 = 0xc3cad1;

/// The colours of a scale.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ColorMap {
    /// From blue over white to red; from white to red for distances.
    #[default]
    Diverging,
    /// A rainbow in steps: its order is not that of brightness.
    Rainbow,
}

impl ColorMap {
    /// Returns the number of steps in place of a continuous scale, of a map that has none.
    pub(crate) fn own_steps(self) -> usize {
        if self == Self::Rainbow { RAINBOW.len() } else { 0 }
    }

    /// Returns the colour at a part of a side of 0, from -1 to 1; of distances from 0 to 1.
    pub(crate) fn color(self, part: f64, absolute: bool) -> [u8; 3] {
        let over_both = 0.5 + 0.5 * part;
        match (self, absolute) {
            (Self::Diverging, true) => at(&SEQUENTIAL, part),
            (Self::Diverging, false) => at(&DIVERGING, over_both),
            (Self::Rainbow, true) => at(&RAINBOW, part),
            (Self::Rainbow, false) => at(&RAINBOW, over_both),
        }
    }
}

/// Returns the colour at a fraction of a list; between two entries it interpolates linearly in light.
fn at(all: &[u32], fraction: f64) -> [u8; 3] {
    let place = fraction.clamp(0.0, 1.0) * (all.len() - 1) as f64;
    let step = (place as usize).min(all.len() - 2);
    let [from, to] = [all[step], all[step + 1]].map(bytes);
    let part = place - step as f64;
    array::from_fn(|channel| {
        let [from, to] = [from[channel], to[channel]].map(|value| linear(f64::from(value) / 255.0));
        (255.0 * encoded(from + part * (to - from))).round() as u8
    })
}

pub(crate) fn bytes(color: u32) -> [u8; 3] {
    let [_, red, green, blue] = color.to_be_bytes();
    [red, green, blue]
}

/// Returns the linear light of an sRGB value (IEC 61966-2-1).
fn linear(value: f64) -> f64 {
    if value < 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

/// Returns the sRGB value of a linear light.
fn encoded(light: f64) -> f64 {
    if light < 0.0031308 { 12.92 * light } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn light_is_mixed_rather_than_its_codes() {
        // The middle of black and white has half of the light, whose code is 188 in IEC 61966-2-1.
        assert_eq!(at(&[0x000000, 0xffffff], 0.5), [188; 3]);
    }

    #[test]
    fn a_side_of_0_has_half_of_the_colours() {
        for map in [ColorMap::Diverging, ColorMap::Rainbow] {
            assert_ne!(map.color(-1.0, false), map.color(1.0, false));
            assert_ne!(map.color(0.0, true), map.color(0.0, false));
        }
        assert_eq!(ColorMap::Rainbow.color(1.0, true), [0xdc, 0x05, 0x0c]);
        assert_eq!(ColorMap::Rainbow.color(-0.8, false), [0x52, 0x89, 0xc7]);
        assert_eq!(ColorMap::Diverging.color(1.0, true), [0x67, 0x00, 0x1f]);
    }
}
