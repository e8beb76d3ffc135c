//! Cutting Bézier patches until each is flat enough for an iteration started
//! at its nearest control point.

mod curvature;
mod extension;
mod normal_cone;

pub use extension::rooms;

use crate::bezier::{GridBasis, Patch, PatchSet, center_grid};
use crate::parallel::map_ranges;
use serde::Deserialize;

/// When a patch counts as flat.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Flatness {
    /// Always: Bézier extraction alone (the 2012 paper's "knots only").
    None,
    /// Normals sampled on the patch span at most 45°.
    #[default]
    Loose,
    /// Normals sampled on the patch span at most 25°.
    Tight,
    /// No parameter line turns by more than 45°, by its largest sampled
    /// curvature times its length.
    Curvature,
}

/// Halvings of one patch along all directions together, at most: 256 pieces.
/// Where normals jump at a point, as at a cone's apex, no cut makes a patch flat.
const MAX_HALVINGS: u32 = 8;

/// Samples along each direction of a patch at which normals and curvatures are
/// taken. They steer the cutting only; no bound rests on them.
const SAMPLES: usize = 4;

impl Flatness {
    /// The direction to halve `patch` along, or `None` if it is flat.
    fn direction(self, patch: &Patch<'_>, basis: &GridBasis<SAMPLES>) -> Option<usize> {
        let [s, t] = match self {
            Self::None => return None,
            Self::Loose => normal_cone::excess(patch, basis, 45_f64.to_radians())?,
            Self::Tight => normal_cone::excess(patch, basis, 25_f64.to_radians())?,
            Self::Curvature => curvature::excess(patch, 45_f64.to_radians())?,
        };
        Some(usize::from(t > s))
    }
}

/// `patches`, each replaced by its flat pieces in place.
///
/// The pieces cover the same points. O(pieces p q).
#[must_use]
pub fn flatten(patches: &PatchSet, flatness: Flatness) -> PatchSet {
    if flatness == Flatness::None {
        return patches.clone();
    }
    let grid = center_grid(patches.bounding_box().diagonal());
    let mut flat = PatchSet::default();
    for part in map_ranges(patches.len(), |range| {
        let mut part = PatchSet::default();
        for index in range {
            let patch = patches.patch(index);
            let basis = GridBasis::new(patch.degree, sample_parameter);
            let cutting = Cutting { flatness, basis, grid };
            cutting.cut(&mut part, patch, MAX_HALVINGS);
        }
        part
    }) {
        flat.append(&part);
    }
    flat
}

/// How patches of one pair of degrees are cut.
struct Cutting {
    flatness: Flatness,
    basis: GridBasis<SAMPLES>,
    grid: f64,
}

impl Cutting {
    fn cut(&self, flat: &mut PatchSet, patch: Patch<'_>, halvings: u32) {
        let direction = if halvings > 0 { self.flatness.direction(&patch, &self.basis) } else { None };
        let Some(axis) = direction else {
            if halvings == MAX_HALVINGS {
                flat.push(patch)
            } else {
                flat.push_centered(patch, self.grid)
            }
            return;
        };
        for (controls, domain) in patch.halves(axis).iter().zip(patch.half_domains(axis)) {
            self.cut(flat, Patch { controls, domain, ..patch }, halvings - 1);
        }
    }
}

/// The parameter of sample `index` of a patch.
fn sample_parameter(index: usize) -> f64 {
    index as f64 / (SAMPLES - 1) as f64
}
