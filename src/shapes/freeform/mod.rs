//! Models that are not surfaces of revolution: sheets, a hull and a wing.

mod wavy_sheet;
mod wigley;
mod wing;

#[cfg(all(test, not(target_arch = "wasm32")))]
pub(crate) use wavy_sheet::bicubic_patch;
pub use wavy_sheet::{WavySheet, wavy_sheet};
pub use wigley::wigley_hull;
pub use wing::{Wing, wing};
