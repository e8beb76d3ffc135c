//! The module of the page: its main thread colours without asking the worker, which may be measuring.

use crate::{Allowed, ColorMap, Extent, Scale, ScaleOptions, Tick, TickKind};
use wasm_bindgen::prelude::*;

/// A scale.
#[wasm_bindgen]
pub struct DeviationScale(Scale);

#[wasm_bindgen]
impl DeviationScale {
    /// Makes the scale of the lowest, the highest and the largest deviation found and of the floor of rounding. `range`
    /// is how far it reaches above 0 and below, `allowed` what is allowed above and below, `focus` from and to.
    #[wasm_bindgen(constructor)]
    pub fn new(
        lowest: f64,
        highest: f64,
        largest: f64,
        floor: f64,
        is_rainbow: bool,
        absolute: bool,
        steps: usize,
        range: Option<f64>,
        range_below: Option<f64>,
        allowed: Option<Box<[f64]>>,
        focus: Option<Box<[f64]>>,
    ) -> Self {
        let options = ScaleOptions {
            map: if is_rainbow { ColorMap::Rainbow } else { ColorMap::Diverging },
            absolute,
            range,
            range_below,
            steps,
            allowed: limits(allowed),
            focus: pair(focus),
        };
        Self(Scale::new(Extent { lowest, highest, largest, floor }, options))
    }

    /// The lower end.
    #[wasm_bindgen(getter)]
    pub fn low(&self) -> f64 {
        self.0.low()
    }

    /// The upper end.
    #[wasm_bindgen(getter)]
    pub fn high(&self) -> f64 {
        self.0.high()
    }

    /// The colour of a deviation as 0xrrggbb.
    pub fn color(&self, deviation: f64, is_signed: bool) -> u32 {
        number(self.0.color(deviation, is_signed))
    }

    /// The colours of equal parts of the scale, the lowest first.
    pub fn stops(&self, count: usize) -> Vec<u32> {
        self.0.stops(count).map(number).collect()
    }

    /// The ticks of the legend, the important ones first, with those of what is allowed above and below; labels are this
    /// fraction of the scale high.
    pub fn ticks(&self, least_gap: f64, allowed: Option<Box<[f64]>>) -> Vec<LegendTick> {
        self.0.ticks(least_gap, limits(allowed)).into_iter().map(LegendTick).collect()
    }
}

fn number([red, green, blue]: [u8; 3]) -> u32 {
    u32::from_be_bytes([0, red, green, blue])
}

fn pair(values: Option<Box<[f64]>>) -> Option<[f64; 2]> {
    values.and_then(|values| values[..].try_into().ok())
}

fn limits(values: Option<Box<[f64]>>) -> Option<Allowed> {
    pair(values).map(|[above, below]| Allowed { above, below })
}

/// A tick.
#[wasm_bindgen]
pub struct LegendTick(Tick);

#[wasm_bindgen]
impl LegendTick {
    /// The deviation there.
    #[wasm_bindgen(getter)]
    pub fn value(&self) -> f64 {
        self.0.value
    }

    /// What it marks.
    #[wasm_bindgen(getter, unchecked_return_type = "\"end\" | \"zero\" | \"allowed\" | \"least\" | \"most\"")]
    pub fn kind(&self) -> String {
        let name = match self.0.kind {
            TickKind::End => "end",
            TickKind::Zero => "zero",
            TickKind::Allowed => "allowed",
            TickKind::Least => "least",
            TickKind::Most => "most",
        };
        name.to_owned()
    }
}
