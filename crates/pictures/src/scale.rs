//! The colours of deviations: those of the page, `www/src/scene/colors/scale.ts`.

use std::array;

/// From negative to positive: ColorBrewer's diverging scale RdBu, which is safe for colour-blind readers.
const DIVERGING: [u32; 9] =
    [0x2166ac, 0x4393c3, 0x92c5de, 0xd1e5f0, 0xf7f7f7, 0xfddbc7, 0xf4a582, 0xd6604d, 0xb2182b];

/// From zero to the largest distance: ColorBrewer's scale YlOrRd.
const SEQUENTIAL: [u32; 6] = [0xfffff0, 0xffeda0, 0xfeb24c, 0xfc4e2a, 0xb10026, 0x67001f];

/// For points whose closest point has no normal, so that the deviation has no sign.
const UNSIGNED: u32 = 0x808890;
/// For deviations within the limit, and for those that rounding may have made.
const WITHIN: u32 = 0x79b98a;
const ROUNDING: u32 = 0xf2f3f4;

/// The numbers of the deviation that a scale is for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Extent {
    pub(crate) lowest: f64,
    pub(crate) highest: f64,
    /// The largest distance, of points with and without a sign.
    pub(crate) largest: f64,
    /// Deviations up to this cannot be distinguished from 0.
    pub(crate) floor: f64,
    /// Whether distances are shown instead of signed deviations.
    pub(crate) absolute: bool,
}

/// The colours from `low` to `high`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scale {
    /// The ends of the scale: on one side of 0 if all deviations are.
    pub(crate) low: f64,
    pub(crate) high: f64,
    pub(crate) extent: Extent,
    pub(crate) allowed: Option<f64>,
}

impl Scale {
    /// The scale of an extent, with deviations up to `allowed` in one colour.
    pub(crate) fn new(extent: Extent, allowed: Option<f64>) -> Self {
        let Extent { lowest, highest, largest, floor, absolute } = extent;
        let end = largest.max(floor);
        let end = if end > 0.0 { end } else { f64::MIN_POSITIVE };
        let none = highest <= floor && lowest >= -floor;
        let low = if absolute || (lowest >= -floor && !none) { 0.0 } else { -end };
        let high = if !absolute && highest <= floor && !none { 0.0 } else { end };
        Self { low, high, extent, allowed }
    }

    /// Returns the colour of a signed deviation, NaN without a sign, and its distance.
    pub(crate) fn color(&self, [signed, distance]: [f64; 2]) -> [u8; 3] {
        let Extent { floor, absolute, .. } = self.extent;
        // Allowed deviations have one colour on all parts, also where rounding cannot be told from 0.
        if self.allowed.is_some_and(|allowed| distance <= allowed) {
            return bytes(WITHIN);
        }
        if distance <= floor {
            return bytes(ROUNDING);
        }
        if signed.is_nan() && !absolute {
            return bytes(UNSIGNED);
        }
        let shown = if absolute { distance } else { signed };
        let end = self.high.max(-self.low);
        let part = shown.max(self.low).min(self.high) / end;
        if absolute { at(&SEQUENTIAL, part) } else { at(&DIVERGING, 0.5 + 0.5 * part) }
    }

    /// Returns the colours of equal parts of the scale, the lowest first.
    pub(crate) fn stops(&self, count: usize) -> impl Iterator<Item = [u8; 3]> + '_ {
        (0..count).map(move |index| {
            let value = self.low + (index as f64 + 0.5) / count as f64 * (self.high - self.low);
            self.color([value, value.abs()])
        })
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

fn bytes(color: u32) -> [u8; 3] {
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

    const EXTENT: Extent = Extent { lowest: -2.0, highest: 4.0, largest: 4.0, floor: 1e-3, absolute: false };

    #[test]
    fn ends_zero_and_classes_have_the_colours_of_the_page() {
        let scale = Scale::new(EXTENT, Some(0.5));
        let color = |value: f64| scale.color([value, value.abs()]);
        assert_eq!([scale.low, scale.high], [-4.0, 4.0]);
        assert_eq!(color(4.0), [0xb2, 0x18, 0x2b]);
        assert_eq!(color(-4.0), [0x21, 0x66, 0xac]);
        // An eighth of all colours is from one to the next.
        assert_eq!(color(2.0), [0xf4, 0xa5, 0x82]);
        assert_eq!(color(-2.0), [0x92, 0xc5, 0xde]);
        assert_eq!(color(0.5), [0x79, 0xb9, 0x8a]);
        assert_eq!(color(-1e-3), [0x79, 0xb9, 0x8a]);
        assert_eq!(Scale::new(EXTENT, None).color([-1e-3, 1e-3]), [0xf2, 0xf3, 0xf4]);
        assert_eq!(scale.color([f64::NAN, 3.0]), [0x80, 0x88, 0x90]);
        assert_eq!(scale.color([f64::NAN, 0.4]), [0x79, 0xb9, 0x8a]);
        // Beyond the end is the end.
        assert_eq!(color(9.0), color(4.0));
    }

    #[test]
    fn light_is_mixed_rather_than_its_codes() {
        // The middle of black and white has half of the light, whose code is 188 in IEC 61966-2-1.
        assert_eq!(at(&[0x000000, 0xffffff], 0.5), [188; 3]);
        let scale = Scale::new(Extent { absolute: true, ..EXTENT }, None);
        assert_eq!([scale.low, scale.high], [0.0, 4.0]);
        assert_eq!(scale.color([f64::NAN, 4.0]), [0x67, 0x00, 0x1f]);
    }

    #[test]
    fn deviations_on_one_side_have_the_half_of_the_scale() {
        let positive = Scale::new(Extent { lowest: 0.0, ..EXTENT }, None);
        let negative = Scale::new(Extent { highest: 0.0, ..EXTENT }, None);
        assert_eq!([positive.low, positive.high, negative.low, negative.high], [0.0, 4.0, -4.0, 0.0]);
        let none = Scale::new(Extent { lowest: 0.0, highest: 0.0, largest: 0.0, ..EXTENT }, None);
        assert_eq!([none.low, none.high], [-1e-3, 1e-3]);
        assert!(none.stops(9).all(|color| color == [0xf2, 0xf3, 0xf4]));
    }
}
