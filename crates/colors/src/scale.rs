//! The scale: which colour a deviation has.

use crate::maps::{ColorMap, ROUNDING, UNFOCUSED, UNSIGNED, WITHIN, bytes};

/// The numbers of the deviation that a scale is for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// The lowest signed deviation.
    pub lowest: f64,
    /// The highest one.
    pub highest: f64,
    /// The largest distance, of points with and without a sign.
    pub largest: f64,
    /// Deviations up to this cannot be distinguished from 0.
    pub floor: f64,
}

/// What deviations are allowed to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Allowed {
    /// How far above 0, at least 0.
    pub above: f64,
    /// How far below 0, at least 0.
    pub below: f64,
}

impl Allowed {
    /// Returns whether a deviation is allowed; one without a sign, if it is with either.
    fn has(self, deviation: f64, is_signed: bool) -> bool {
        match is_signed {
            true => deviation <= self.above && deviation >= -self.below,
            false => deviation.abs() <= self.above && deviation.abs() <= self.below,
        }
    }
}

/// The choices of who looks at a scale.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ScaleOptions {
    /// The colours.
    pub map: ColorMap,
    /// Whether distances are shown instead of signed deviations.
    pub absolute: bool,
    /// The upper end of the scale; `None` sets it to the largest distance.
    pub range: Option<f64>,
    /// The extent of the scale below 0; `None` makes it equal to the extent above 0.
    pub range_below: Option<f64>,
    /// The number of steps of one colour each; 0 for a continuous scale.
    pub steps: usize,
    /// Deviations within this are of one colour.
    pub allowed: Option<Allowed>,
    /// The only deviations that keep their colours, from and to.
    pub focus: Option<[f64; 2]>,
}

/// The colours from `low` to `high`.
#[derive(Debug, Clone, PartialEq)]
pub struct Scale {
    low: f64,
    high: f64,
    pub(crate) extent: Extent,
    pub(crate) options: ScaleOptions,
}

impl Scale {
    /// Makes the scale of an extent. Both ends are on one side of 0 if all deviations are.
    #[must_use]
    pub fn new(extent: Extent, options: ScaleOptions) -> Self {
        let Extent { lowest, highest, largest, floor } = extent;
        let found = if largest > floor { largest } else { floor };
        let end = options.range.unwrap_or(if found > 0.0 { found } else { f64::MIN_POSITIVE });
        let is_none = highest <= floor && lowest >= -floor;
        let is_above = options.absolute || (lowest >= -floor && !is_none);
        let is_below = !options.absolute && highest <= floor && !is_none;
        let low = if is_above { 0.0 } else { -options.range_below.unwrap_or(end) };
        Self { low, high: if is_below { 0.0 } else { end }, extent, options }
    }

    /// The lower end.
    #[must_use]
    pub fn low(&self) -> f64 {
        self.low
    }

    /// The upper end.
    #[must_use]
    pub fn high(&self) -> f64 {
        self.high
    }

    /// What is allowed, which has one colour.
    #[must_use]
    pub fn allowed(&self) -> Option<Allowed> {
        self.options.allowed
    }

    /// Deviations up to this cannot be distinguished from 0.
    #[must_use]
    pub fn floor(&self) -> f64 {
        self.extent.floor
    }

    /// Whether distances are shown instead of signed deviations.
    #[must_use]
    pub fn is_absolute(&self) -> bool {
        self.options.absolute
    }

    /// Returns the colour, red, green and blue, of a deviation, whose sign is known or not.
    #[must_use]
    pub fn color(&self, deviation: f64, is_signed: bool) -> [u8; 3] {
        let ScaleOptions { map, absolute, allowed, focus, .. } = self.options;
        let size = deviation.abs();
        let shown = if absolute { size } else { deviation };
        if focus.is_some_and(|[from, to]| shown < from || shown > to) {
            return bytes(UNFOCUSED);
        }
        // An allowed deviation has the colour of allowed ones on all parts, even if it is below the floor of rounding.
        if allowed.is_some_and(|allowed| allowed.has(deviation, is_signed)) {
            return bytes(WITHIN);
        }
        if size <= self.extent.floor {
            return bytes(ROUNDING);
        }
        if !is_signed && !absolute {
            return bytes(UNSIGNED);
        }
        let value = self.stepped(shown);
        // Each side of 0 has all colours of its half, whichever way the scale reaches farther.
        let end = if value < 0.0 { -self.low } else { self.high };
        map.color(if end > 0.0 { value / end } else { value }, absolute)
    }

    /// Returns the middle of the step that contains a value. The outermost steps have the colours of the ends.
    fn stepped(&self, value: f64) -> f64 {
        let inside = value.max(self.low).min(self.high);
        let steps = if self.options.steps == 0 { self.options.map.own_steps() } else { self.options.steps };
        if steps < 2 {
            return inside;
        }
        let width = self.high - self.low;
        let index = ((inside - self.low) / (width / steps as f64)) as usize;
        self.low + index.min(steps - 1) as f64 / (steps - 1) as f64 * width
    }

    /// Returns the colours of equal parts of the scale, the lowest first.
    pub fn stops(&self, count: usize) -> impl Iterator<Item = [u8; 3]> + '_ {
        (0..count).map(move |index| {
            let part = (index as f64 + 0.5) / count as f64;
            self.color(self.low + part * (self.high - self.low), true)
        })
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    const EXTENT: Extent = Extent { lowest: -2.0, highest: 4.0, largest: 4.0, floor: 1e-3 };

    fn within(allowed: f64) -> ScaleOptions {
        let allowed = Some(Allowed { above: allowed, below: allowed });
        ScaleOptions { allowed, ..ScaleOptions::default() }
    }

    #[test]
    fn ends_zero_and_classes_have_their_colours() {
        let scale = Scale::new(EXTENT, within(0.5));
        let color = |value: f64| scale.color(value, true);
        assert_eq!([scale.low(), scale.high()], [-4.0, 4.0]);
        assert_eq!(color(4.0), [0xb2, 0x18, 0x2b]);
        assert_eq!(color(-4.0), [0x21, 0x66, 0xac]);
        // An eighth of all colours is from one to the next.
        assert_eq!(color(2.0), [0xf4, 0xa5, 0x82]);
        assert_eq!(color(-2.0), [0x92, 0xc5, 0xde]);
        assert_eq!(color(0.5), [0x79, 0xb9, 0x8a]);
        assert_eq!(color(-1e-3), [0x79, 0xb9, 0x8a]);
        assert_eq!(Scale::new(EXTENT, ScaleOptions::default()).color(-1e-3, true), [0xf2, 0xf3, 0xf4]);
        assert_eq!(scale.color(3.0, false), [0x80, 0x88, 0x90]);
        assert_eq!(scale.color(0.4, false), [0x79, 0xb9, 0x8a]);
        // Beyond the end is the end.
        assert_eq!(color(9.0), color(4.0));
    }

    #[test]
    fn deviations_on_one_side_have_the_half_of_the_scale() {
        let scale = |extent| Scale::new(extent, ScaleOptions::default());
        let positive = scale(Extent { lowest: 0.0, ..EXTENT });
        let negative = scale(Extent { highest: 0.0, ..EXTENT });
        assert_eq!([positive.low(), positive.high(), negative.low(), negative.high()], [0.0, 4.0, -4.0, 0.0]);
        let none = scale(Extent { lowest: 0.0, highest: 0.0, largest: 0.0, ..EXTENT });
        assert_eq!([none.low(), none.high()], [-1e-3, 1e-3]);
        assert!(none.stops(9).all(|color| color == [0xf2, 0xf3, 0xf4]));
        let absolute = Scale::new(EXTENT, ScaleOptions { absolute: true, ..ScaleOptions::default() });
        assert_eq!([absolute.low(), absolute.high()], [0.0, 4.0]);
        assert_eq!(absolute.color(4.0, false), [0x67, 0x00, 0x1f]);
    }

    /// Above 0 the scale ends at 1, and below at -4: each half has all its colours.
    #[test]
    fn an_uneven_scale_has_all_colours_on_both_sides() {
        let options = ScaleOptions { range: Some(1.0), range_below: Some(4.0), ..ScaleOptions::default() };
        let scale = Scale::new(EXTENT, options);
        assert_eq!(scale.color(1.0, true), [0xb2, 0x18, 0x2b]);
        assert_eq!(scale.color(0.5, true), [0xf4, 0xa5, 0x82]);
        assert_eq!(scale.color(-2.0, true), [0x92, 0xc5, 0xde]);
        assert_eq!(scale.color(-4.0, true), [0x21, 0x66, 0xac]);
    }

    #[test]
    fn steps_are_of_one_colour_and_the_focus_keeps_its_own() {
        let options = ScaleOptions { steps: 4, ..ScaleOptions::default() };
        let scale = Scale::new(EXTENT, options);
        assert_eq!(scale.color(2.1, true), scale.color(4.0, true));
        assert_eq!(scale.color(-3.9, true), [0x21, 0x66, 0xac]);
        assert_ne!(scale.color(1.9, true), scale.color(2.1, true));
        let rainbow = Scale::new(EXTENT, ScaleOptions { map: ColorMap::Rainbow, ..ScaleOptions::default() });
        // Eleven steps of 8 / 11.
        assert_eq!(rainbow.color(3.3, true), [0xdc, 0x05, 0x0c]);
        assert_eq!(rainbow.color(3.2, true), [0xe8, 0x60, 0x1c]);
        let focus = Some([1.0, 2.0]);
        let focused = Scale::new(EXTENT, ScaleOptions { focus, ..ScaleOptions::default() });
        assert_eq!(focused.color(3.0, true), [0xc3, 0xca, 0xd1]);
        assert_eq!(focused.color(2.0, true), [0xf4, 0xa5, 0x82]);
    }

    #[test]
    fn what_is_allowed_may_be_uneven() {
        let allowed = Some(Allowed { above: 1.0, below: 0.5 });
        let scale = Scale::new(EXTENT, ScaleOptions { allowed, ..ScaleOptions::default() });
        let is_within = |deviation, is_signed| scale.color(deviation, is_signed) == [0x79, 0xb9, 0x8a];
        assert!(is_within(1.0, true) && is_within(-0.5, true) && is_within(0.5, false));
        assert!(!is_within(-0.6, true) && !is_within(0.6, false) && !is_within(1.1, true));
    }
}
