//! Subdivision of Bézier patches until each is flat enough for an iteration
//! that starts at its nearest control point.
//!
//! Flatness by the angle between normals is the criterion of I. Hanniel, A.
//! Krishnamurthy and S. McMains, *Computing the Hausdorff distance between NURBS
//! surfaces using numerical iteration on the GPU*, Graphical Models 74 (2012),
//! 255–264, "the 2012 paper" below.

mod curvature;
mod extension;
mod normal_cone;
mod place;

pub use place::{Place, Places};

use crate::axis::Axis;
use crate::bezier::{GridBasis, Patch, PatchSet, center_grid};
use crate::threads::parallel::map_ranges;
use extension::extension;
use serde::Deserialize;

/// The criterion by which a patch counts as flat.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Flatness {
    /// Every patch is flat: Bézier extraction alone (the 2012 paper's "knots only").
    None,
    /// The angle between any two sampled normals is at most 45°.
    #[default]
    Loose,
    /// The angle between any two sampled normals is at most 25°.
    Tight,
    /// The largest sampled curvature of every parameter line, times its length,
    /// is at most 45°.
    Curvature,
}

/// The largest number of halvings of a patch, along both axes together: 256
/// pieces. Where normals jump at a point, as at a cone's apex, no number suffices.
pub(crate) const MAX_HALVINGS: u32 = 8;

/// The number of samples of normals and curvatures along each axis of a patch.
/// They only steer the subdivision; no bound depends on them.
const SAMPLES: usize = 4;

/// The angles, in degrees, of the three criteria.
const LOOSE_DEGREES: f64 = 45.0;
const TIGHT_DEGREES: f64 = 25.0;
const CURVATURE_DEGREES: f64 = 45.0;

impl Flatness {
    /// Returns the axis along which to halve `patch`, or `None` if it is flat.
    fn split_axis(self, patch: &Patch<'_>, basis: &GridBasis<SAMPLES>) -> Option<Axis> {
        let excess = match self {
            Self::None => return None,
            Self::Loose => normal_cone::excess(patch, basis, LOOSE_DEGREES.to_radians())?,
            Self::Tight => normal_cone::excess(patch, basis, TIGHT_DEGREES.to_radians())?,
            Self::Curvature => curvature::excess(patch, CURVATURE_DEGREES.to_radians())?,
        };
        Some(Axis::of_larger(excess))
    }
}

/// Flat pieces of patches.
#[derive(Debug, Clone)]
pub struct FlatPatches {
    /// The pieces.
    pub patches: PatchSet,
    /// Where the pieces are in the patches that they were cut from.
    pub places: Places,
    /// The cuts that made them, for [`recut`].
    pub cuts: Cuts,
}

/// The cuts of a set of patches, each patch's in depth-first order.
#[derive(Debug, Clone, Default)]
pub struct Cuts {
    /// The axis of every cut, `None` for a piece that is kept.
    axes: Vec<Option<Axis>>,
    /// The position in `axes` of every patch's first entry.
    starts: Vec<usize>,
}

impl Cuts {
    fn append(&mut self, other: &Self) {
        let offset = self.axes.len();
        self.axes.extend_from_slice(&other.axes);
        self.starts.extend(other.starts.iter().map(|start| start + offset));
    }
}

/// Returns `patches` with each replaced, in place, by flat pieces that together
/// are the same surface, of at most [`MAX_HALVINGS`] halvings each. O(pieces p q (p + q)).
#[must_use]
pub fn flatten(patches: &PatchSet, flatness: Flatness) -> FlatPatches {
    if flatness == Flatness::None {
        let places = Places::Whole(patches.len());
        return FlatPatches { patches: patches.clone(), places, cuts: Cuts::default() };
    }
    cut(patches, &Rule::Flat(flatness))
}

/// Returns `patches` cut as others were by [`flatten`]; both have the same number of patches of the
/// same degrees. The pieces are the same surface; how flat they are depends on how much
/// the patches differ from those. O(pieces p q (p + q)).
#[must_use]
pub fn recut(patches: &PatchSet, cuts: &Cuts) -> FlatPatches {
    if cuts.starts.is_empty() {
        return flatten(patches, Flatness::None);
    }
    cut(patches, &Rule::Recorded(cuts))
}

/// The rule by which patches are cut.
enum Rule<'a> {
    /// Where a piece is not flat.
    Flat(Flatness),
    /// Where others were.
    Recorded(&'a Cuts),
}

fn cut(patches: &PatchSet, rule: &Rule<'_>) -> FlatPatches {
    let grid = center_grid(patches.bounding_box().diagonal());
    let parts = map_ranges(patches.len(), |range| {
        let mut part = FlatRange::default();
        let mut subdivision: Option<Subdivision> = None;
        for index in range {
            let patch = patches.patch(index);
            part.cuts.starts.push(part.cuts.axes.len());
            let mut of_degree = match subdivision.take() {
                Some(known) if known.degree == patch.degree => known,
                _ => Subdivision::new(rule, patch.degree, grid),
            };
            if let Rule::Recorded(cuts) = rule {
                of_degree.recorded = &cuts.axes[cuts.starts[index]..];
            }
            let place = Place::whole(index);
            of_degree.append_pieces(&mut part, patch, place, [[false; 2]; 2], MAX_HALVINGS);
            subdivision = Some(of_degree);
        }
        part
    });
    let mut cuts = Cuts::default();
    for part in &parts {
        cuts.append(&part.cuts);
    }
    if parts.iter().all(|part| part.places.iter().all(Place::is_whole)) {
        return FlatPatches { patches: patches.clone(), places: Places::Whole(patches.len()), cuts };
    }
    let flat = with_whole_patches(patches, &parts);
    let places = parts.into_iter().flat_map(|part| part.places).collect();
    FlatPatches { patches: flat, places: Places::Cut(places), cuts }
}

/// The flat pieces of a range of patches.
#[derive(Default)]
struct FlatRange {
    /// The pieces of the patches that were cut.
    patches: PatchSet,
    /// The places of all pieces.
    places: Vec<Place>,
    cuts: Cuts,
}

/// Returns the pieces of all parts: those of patches that were cut, and the patches that
/// were not, in order.
fn with_whole_patches(patches: &PatchSet, parts: &[FlatRange]) -> PatchSet {
    let controls = parts.iter().map(|part| part.patches.control_count()).sum::<usize>();
    let mut all = PatchSet::default();
    all.reserve(parts.iter().map(|part| part.places.len()).sum(), controls + patches.control_count());
    for part in parts {
        let mut next = 0;
        for place in &part.places {
            if place.is_whole() {
                all.push(patches.patch(place.patch as usize));
            } else {
                all.push(part.patches.patch(next));
                next += 1;
            }
        }
    }
    all
}

/// The subdivision of patches of one pair of degrees.
struct Subdivision<'a> {
    rule: &'a Rule<'a>,
    /// The recorded cuts that are left, if the rule is to repeat them.
    recorded: &'a [Option<Axis>],
    degree: [usize; 2],
    basis: GridBasis<SAMPLES>,
    grid: f64,
}

impl<'a> Subdivision<'a> {
    fn new(rule: &'a Rule<'a>, degree: [usize; 2], grid: f64) -> Self {
        Self { rule, recorded: &[], degree, basis: GridBasis::new(degree, sample_parameter), grid }
    }

    /// Returns the axis along which to halve a piece next, or `None` to keep it.
    fn split_axis(&mut self, patch: &Patch<'_>, halvings: u32) -> Option<Axis> {
        match self.rule {
            Rule::Flat(flatness) if halvings > 0 => flatness.split_axis(patch, &self.basis),
            Rule::Flat(..) => None,
            Rule::Recorded(_) => {
                let (&next, rest) = self.recorded.split_first()?;
                self.recorded = rest;
                next
            }
        }
    }

    /// Appends the flat pieces of a patch, or of a piece that was cut from one at the
    /// starts and ends that `cuts` states, cut at most `halvings` times.
    fn append_pieces(
        &mut self,
        flat: &mut FlatRange,
        patch: Patch<'_>,
        place: Place,
        cuts: [[bool; 2]; 2],
        halvings: u32,
    ) {
        let split_axis = self.split_axis(&patch, halvings);
        flat.cuts.axes.push(split_axis);
        let Some(axis) = split_axis else {
            if !place.is_whole() {
                flat.patches.push_centered(patch, self.grid);
            }
            flat.places.push(Place { extension: extension(patch.degree, cuts), ..place });
            return;
        };
        let places = place.halves(axis);
        for (half, (controls, domain)) in patch.halves(axis).iter().zip(patch.domain.halves(axis)).enumerate()
        {
            let mut cuts = cuts;
            // The first half ends at the cut, and the second starts there.
            cuts[axis][1 - half] = true;
            self.append_pieces(flat, Patch { controls, domain, ..patch }, places[half], cuts, halvings - 1);
        }
    }
}

/// Returns the parameter of sample `index` along an axis.
fn sample_parameter(index: usize) -> f64 {
    index as f64 / (SAMPLES - 1) as f64
}
