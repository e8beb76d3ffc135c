//! The pictures of maps, in the same colours.

use super::views::Scene;
use super::{Pictures, legend, numbers};
use nurbs_hausdorff::workspace::{FLOOR, SignedMap};
use nurbs_hausdorff_colors::{Allowed, Extent, Scale, ScaleOptions};

/// What pictures are made of.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Drawn<'a> {
    /// The maps of A and of B, of those that are shown.
    pub(crate) maps: [Option<&'a SignedMap>; 2],
    /// The larger diagonal of both models.
    pub(crate) diagonal: f64,
    /// Metres per unit of a result, if they are known.
    pub(crate) unit: Option<f64>,
    /// The deviation that is allowed.
    pub(crate) allowed: Option<f64>,
}

/// Draws maps. `deflate` makes a zlib stream of bytes.
///
/// # Errors
/// Those of `deflate`.
pub(crate) fn draw<E>(
    Drawn { maps, diagonal, unit, allowed }: Drawn<'_>,
    mut deflate: impl FnMut(&[u8]) -> Result<Vec<u8>, E>,
) -> Result<Pictures, E> {
    let shown = || maps.into_iter().flatten();
    let (extent, absolute) = extent(shown(), diagonal);
    let allowed = allowed.map(|allowed| Allowed { above: allowed, below: allowed });
    let scale = Scale::new(extent, ScaleOptions { absolute, allowed, ..ScaleOptions::default() });
    let unit = unit.map(numbers::unit_name);
    let of_all = shown().map(largest).fold(f64::NEG_INFINITY, f64::max);
    let mut figures = Vec::new();
    let mut is_marked = false;
    for (map, names) in maps.into_iter().zip([["A", "B"], ["B", "A"]]) {
        let Some(map) = map else { continue };
        // Of two equal places the first is the worst.
        let is_worst = !is_marked && largest(map) == of_all;
        is_marked |= is_worst;
        let SignedMap { map, signs } = map;
        let scene =
            Scene { names, map, signs: *signs, scale: &scale, diagonal, unit: unit.as_deref(), is_worst };
        figures.extend(scene.figures(&mut deflate)?);
    }
    Ok(Pictures { figures, legend: legend::drawing(&scale, diagonal) })
}

fn largest(map: &SignedMap) -> f64 {
    map.map.worst().map_or(f64::NEG_INFINITY, |worst| map.map.values[worst][1])
}

/// Returns the extremes of all maps, and whether distances are shown instead of signed deviations, as a model has no
/// signs.
fn extent<'a>(maps: impl Iterator<Item = &'a SignedMap>, diagonal: f64) -> (Extent, bool) {
    let mut extent = Extent { lowest: 0.0, highest: 0.0, largest: 0.0, floor: FLOOR * diagonal };
    let mut absolute = false;
    for map in maps {
        let mut has_signs = false;
        for &[signed, distance] in &map.map.values {
            has_signs |= !signed.is_nan();
            // NaN, which stands for no sign, is neither.
            extent.lowest = extent.lowest.min(signed);
            extent.highest = extent.highest.max(signed);
            extent.largest = extent.largest.max(distance);
        }
        absolute |= !has_signs;
    }
    (extent, absolute)
}
