//! Models of whole surfaces, as the search uses them.

use crate::bezier::{BezierModel, LocalDerivativeBounds, extract};
use crate::certified::{Block, Operand, SheetCache, Sheets};
use crate::closest::Target;
use crate::flatness::{Flatness, Places, flatten};
use crate::model::{Model, SurfaceArrays};

/// A model as the search uses it.
pub(in crate::certified) struct Surfaces {
    bezier: BezierModel,
    target: Target,
    bounds: Vec<LocalDerivativeBounds>,
    pub(in crate::certified) places: Places,
    cache: SheetCache,
}

impl Surfaces {
    pub(in crate::certified) fn new(surfaces: Vec<SurfaceArrays>, flatness: Flatness) -> Self {
        Self::flattened(&Model::from_arrays(None, surfaces).unwrap(), flatness)
    }

    /// The surfaces of a model as they are.
    pub(in crate::certified) fn of(model: &Model) -> Self {
        Self::flattened(model, Flatness::None)
    }

    fn flattened(model: &Model, flatness: Flatness) -> Self {
        let bezier = extract(model);
        let flat = flatten(&bezier.patches, flatness);
        Self {
            target: Target::new(flat.patches),
            bounds: flat.places.derivative_bounds(),
            places: flat.places,
            cache: SheetCache::default(),
            bezier,
        }
    }

    pub(in crate::certified) fn sheets(&self) -> Sheets<'_> {
        Sheets { bezier: &self.bezier, places: &self.places, cache: &self.cache }
    }

    pub(in crate::certified) fn operand(&self) -> Operand<'_> {
        Operand::new(&self.target, &self.bounds).with_sheets(self.sheets())
    }
}

/// All of a model's first surface.
pub(in crate::certified) fn whole_block(a: &Surfaces) -> Block {
    let [rows, columns] = a.sheets().bezier.grids[0].counts().map(|count| [0, count as u32]);
    Block { surface: 0, rows, columns }
}

/// The knots 0 and 1, each degree + 1 times, and the given ones between.
pub(in crate::certified) fn clamped(degree: usize, inner: &[f64]) -> Vec<f64> {
    let ends = |knot: f64| std::iter::repeat_n(knot, degree + 1);
    ends(0.0).chain(inner.iter().copied()).chain(ends(1.0)).collect()
}

/// A bicubic surface that is closed along u, of uniform knots, with random control points.
pub(in crate::certified) fn closed(seed: u64, rational: bool) -> SurfaceArrays {
    let (around, along) = (7, 6);
    let mut points = Vec::new();
    for i in 0..around + 3 {
        // The last three are the first ones.
        let mut random = fastrand::Rng::with_seed(seed + (i % around) as u64);
        let angle = std::f64::consts::TAU * (i % around) as f64 / around as f64;
        for j in 0..along {
            let radius = 1.0 + 0.3 * random.f64();
            let weight = if rational { 0.5 + random.f64() } else { 1.0 };
            points.push([radius * angle.cos(), radius * angle.sin(), 0.5 * j as f64, weight]);
        }
    }
    SurfaceArrays {
        degree: [3, 3],
        knots: [(0..around + 7).map(|knot| knot as f64).collect(), clamped(3, &[0.25, 0.6])],
        counts: [around + 3, along],
        control_points: points,
    }
}
