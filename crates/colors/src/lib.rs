//! The colours of deviations and the ticks of their legend: what the page and the pictures of reports show in colours is
//! coloured by this code alone.
//!
//! ```
//! use nurbs_hausdorff_colors::{Allowed, Extent, Scale, ScaleOptions};
//!
//! let extent = Extent { lowest: -2.0, highest: 4.0, largest: 4.0, floor: 1e-6 };
//! let allowed = Some(Allowed { above: 0.5, below: 0.5 });
//! let scale = Scale::new(extent, ScaleOptions { allowed, ..ScaleOptions::default() });
//! assert_eq!([scale.low(), scale.high()], [-4.0, 4.0]);
//! assert_eq!(scale.color(4.0, true), [0xb2, 0x18, 0x2b]);
//! ```

mod maps;
mod scale;
mod ticks;
#[cfg(target_arch = "wasm32")]
mod wasm;

pub use maps::ColorMap;
pub use scale::{Allowed, Extent, Scale, ScaleOptions};
pub use ticks::{Tick, TickKind};
