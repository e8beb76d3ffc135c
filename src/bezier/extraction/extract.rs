//! Bézier extraction: one patch per non-empty rectangle of knots.

use crate::axis::Axis;
use crate::bezier::patch::Entry;
use crate::bezier::patch::evaluate::contract;
use crate::bezier::{PatchSet, PointError};
use crate::bvh::Aabb;
use crate::model::{Model, NurbsSurface, Span, breaks, multiplicities, spans};
use crate::param_box::ParamBox;
use crate::rounding::upper_max;
use crate::threads::parallel::{map, map_items, ranges};
use bytemuck::zeroed_vec;
use glam::{DVec3, DVec4};
use std::ops::Range;

/// The number of steps, along the model's diagonal rounded up to a power of
/// two, of the grid on which patch centres lie.
///
/// Centres are multiples of a power of two 22 bits below it, so that the
/// difference of two of them is exact in float32, whose significand has 24
/// bits, one of them for the carry of the difference.
const CENTERS_ON_DIAGONAL: f64 = (1_u32 << 22) as f64;

/// The exponent bits of a float64. Without its other bits, a positive number
/// is the largest power of two not above it.
const EXPONENT_BITS: u64 = 0x7ff0_0000_0000_0000;

/// The grid of the patches of one surface.
#[derive(Debug, Clone, PartialEq)]
pub struct PatchGrid {
    /// Index of the surface's first patch; the others follow, v fastest.
    pub first: usize,
    /// The distinct knots of the domain in u and v, one more each than patches.
    pub breaks: [Vec<f64>; 2],
    /// How often each of them is repeated; degree + 1 times at the ends of the domain, where the surface
    /// ends. Across a knot of multiplicity m derivatives below degree + 1 - m are continuous.
    pub multiplicities: [Vec<u8>; 2],
    /// The parts of the numbers of samples and cells along u and v that this grid gets: 1
    /// for a whole surface, less for a piece of a trimmed face.
    pub shares: [f64; 2],
}

impl PatchGrid {
    /// Returns the numbers of patches along u and v.
    #[must_use]
    pub fn counts(&self) -> [usize; 2] {
        [self.breaks[0].len() - 1, self.breaks[1].len() - 1]
    }

    /// Returns whether neighbouring patches share their edges: no knot between them is repeated
    /// more often than the degree.
    pub(crate) fn is_continuous(&self, degree: [usize; 2]) -> bool {
        (0..2).all(|axis| {
            let inner = self.multiplicities[axis].iter().skip(1).take(self.counts()[axis] - 1);
            inner.into_iter().all(|&multiplicity| usize::from(multiplicity) <= degree[axis])
        })
    }

    /// Returns the number of parts along `axis` that is this grid's share where whole
    /// surfaces have `parts`; at least 1.
    #[must_use]
    pub fn share(&self, axis: Axis, parts: usize) -> usize {
        ((parts as f64 * self.shares[axis]).ceil() as usize).clamp(1, parts)
    }

    /// Returns the index along `axis` of the patch that contains the parameter,
    /// and the patch parameter in [0, 1]. Parameters outside the domain are
    /// moved to its nearer end.
    #[must_use]
    pub fn locate(&self, axis: Axis, parameter: f64) -> (usize, f64) {
        let breaks = &self.breaks[axis];
        let span = breaks.partition_point(|&knot| knot <= parameter).clamp(1, breaks.len() - 1) - 1;
        let local = (parameter - breaks[span]) / (breaks[span + 1] - breaks[span]);
        (span, local.clamp(0.0, 1.0))
    }
}

/// A model as a set of Bézier patches.
#[derive(Debug, Clone)]
pub struct BezierModel {
    /// The patches, in order of surface, u, v.
    pub patches: PatchSet,
    /// One grid a surface.
    pub grids: Vec<PatchGrid>,
    /// The rounding of extraction, subdivision and evaluation.
    pub point_error: PointError,
}

/// Returns the Bézier patches of every surface of `model`, each whole: trimmed faces are
/// to be replaced by their pieces before.
///
/// Exact up to rounding for every valid knot vector, clamped or not, with
/// repeated or almost coincident knots: Bézier control k of the span [a, b] is
/// the blossom at a (degree - k times) and b (k times) (Ramshaw, *Blossoms are
/// polar forms*, Computer Aided Geometric Design 6 (1989)). For arguments in the
/// span, the de Boor triangle forms convex combinations only, so no divisor is
/// smaller than the span. Knots one unit in the last place apart make a patch like
/// any others; only the parameters reported on it are rounded.
///
/// The weights of a surface are divided by a power of two, so that the largest is
/// in [1, 2): products of four of them are then normal numbers.
/// O(patches (p + q) p q).
#[must_use]
pub fn extract(model: &Model) -> BezierModel {
    let grid = center_grid(model.bounding_box().diagonal());
    let surfaces = model.surfaces();
    let extractions = map(surfaces.len(), |index| Extraction::new(index, &surfaces[index], grid));
    // Zeros of the system, which are written before they are read: the core that fills a part
    // of them gets its memory, and no page of zeros is mapped in between.
    let mut controls = zeroed_vec(extractions.iter().map(Extraction::size).sum());
    let mut entries = zeroed_vec(extractions.iter().map(Extraction::patch_count).sum());
    let (mut parts, mut grids) = (Vec::new(), Vec::with_capacity(extractions.len()));
    let mut rest = (&mut entries[..], &mut controls[..]);
    let (mut first, mut first_control) = (0, 0);
    for extraction in &extractions {
        let (breaks, multiplicities) = (extraction.breaks(), extraction.multiplicities());
        grids.push(PatchGrid { first, breaks, multiplicities, shares: [1.0; 2] });
        first += extraction.patch_count();
        for range in ranges(extraction.patch_count()) {
            let control_count = range.len() * extraction.patch_size();
            let (entries, other_entries) = rest.0.split_at_mut(range.len());
            let (controls, other_controls) = rest.1.split_at_mut(control_count);
            parts.push((extraction, PatchRange { range, entries, first_control, controls }));
            first_control += control_count;
            rest = (other_entries, other_controls);
        }
    }
    let errors = map_items(parts, |(extraction, part)| extraction.fill(part));
    let mut point_error = PointError::default();
    for error in &errors {
        point_error.include_all(error);
    }
    BezierModel { patches: PatchSet::new(entries, controls), grids, point_error }
}

/// Returns the ends of a span of knots as parameters of its own side: where no control point is shared with the next
/// span the surface jumps there, and takes the next one's points at the knot itself.
fn reported_ends(spans: &[Span], place: usize, degree: usize) -> [f64; 2] {
    let Span { ends: [low, high], first_control, .. } = spans[place];
    let jumps = spans.get(place + 1).is_some_and(|next| next.first_control > first_control + degree);
    [low, if jumps { high.next_down() } else { high }]
}

/// Returns the spacing of the grid of patch centres for a model of this diagonal;
/// 0 for a model that is a point, whose only centre is that point.
pub(crate) fn center_grid(diagonal: f64) -> f64 {
    let below = power_of_two_below(diagonal);
    let above = if below < diagonal { 2.0 * below } else { below };
    above / CENTERS_ON_DIAGONAL
}

/// Returns the point of the grid of this spacing that is nearest to `point`.
pub(crate) fn snapped(point: DVec3, grid: f64) -> DVec3 {
    if grid > 0.0 { (point / grid).round() * grid } else { point }
}

/// Returns the largest power of two not above a positive normal number.
pub(crate) fn power_of_two_below(number: f64) -> f64 {
    f64::from_bits(number.to_bits() & EXPONENT_BITS)
}

/// Returns the grid point nearest to the middle of the points' box.
pub(in crate::bezier) fn center_of(points: impl Iterator<Item = DVec3>, grid: f64) -> DVec3 {
    let middle = points.fold(Aabb::EMPTY, Aabb::with).center();
    snapped(middle, grid)
}

/// A part of the patches of one surface, to be filled in.
struct PatchRange<'a> {
    /// The positions of the patches in the surface's grid, v fastest.
    range: Range<usize>,
    entries: &'a mut [Entry],
    /// The position in the set of the first of the controls.
    first_control: usize,
    controls: &'a mut [DVec4],
}

/// The extraction of the patches of one surface.
struct Extraction<'a> {
    /// The surface's position in its model.
    index: usize,
    surface: &'a NurbsSurface,
    spans: [Vec<Span>; 2],
    weight_scale: f64,
    /// The spacing of the patches' centres.
    grid: f64,
}

impl<'a> Extraction<'a> {
    fn new(index: usize, surface: &'a NurbsSurface, grid: f64) -> Self {
        let degree = surface.degree();
        let weights = surface.control_points().iter().map(|point| point[3]);
        Self {
            index,
            surface,
            spans: Axis::BOTH.map(|axis| spans(surface.knots(axis), degree[axis], surface.counts()[axis])),
            weight_scale: power_of_two_below(weights.fold(0.0, upper_max)).recip(),
            grid,
        }
    }

    /// Returns the distinct knots of the domain in u and v.
    fn breaks(&self) -> [Vec<f64>; 2] {
        Axis::BOTH.map(|axis| breaks(&self.spans[axis]))
    }

    /// Returns the multiplicities of the distinct knots.
    fn multiplicities(&self) -> [Vec<u8>; 2] {
        let degree = self.surface.degree();
        Axis::BOTH.map(|axis| multiplicities(&self.spans[axis], degree[axis]))
    }

    fn patch_count(&self) -> usize {
        self.spans[0].len() * self.spans[1].len()
    }

    /// Returns the number of controls of one patch.
    fn patch_size(&self) -> usize {
        self.surface.degree().iter().map(|degree| degree + 1).product()
    }

    /// Returns the number of controls of all patches.
    fn size(&self) -> usize {
        self.patch_count() * self.patch_size()
    }

    /// Fills in a part of the surface's patches; returns the rounding of their controls.
    fn fill(&self, part: PatchRange<'_>) -> PointError {
        let Self { index, surface, spans: [in_u, in_v], weight_scale, grid } = self;
        let degree = surface.degree();
        let (rows, columns) = (degree[0] + 1, degree[1] + 1);
        let mut point_error = PointError::default();
        let mut net = vec![DVec4::ZERO; rows * columns];
        let mut partial = vec![DVec4::ZERO; rows * columns];
        let size = rows * columns;
        for (number, (place, (entry, controls))) in
            part.range.zip(part.entries.iter_mut().zip(part.controls.chunks_exact_mut(size))).enumerate()
        {
            let [place_in_u, place_in_v] = [place / in_v.len(), place % in_v.len()];
            let (u, v) = (&in_u[place_in_u], &in_v[place_in_v]);
            let corner = u.first_control * surface.counts()[1] + v.first_control;
            let row = |i: usize| &surface.control_points()[corner + i * surface.counts()[1]..][..columns];
            let position = |&[x, y, z, _]: &[f64; 4]| DVec3::new(x, y, z);
            let center = center_of((0..rows).flat_map(|i| row(i).iter().map(position)), *grid);
            let mut radius = 0.0_f64;
            for (i, controls) in net.chunks_exact_mut(columns).enumerate() {
                for (control, point) in controls.iter_mut().zip(row(i)) {
                    let weight = weight_scale * point[3];
                    let local = position(point) - center;
                    *control = (weight * local).extend(weight);
                    radius = radius.max(local.length());
                }
            }
            for (row, sums) in net.chunks_exact(columns).zip(partial.chunks_exact_mut(columns)) {
                for (sum, coefficients) in sums.iter_mut().zip(&v.operator) {
                    *sum = contract(row, coefficients);
                }
            }
            for (sums, coefficients) in controls.chunks_exact_mut(columns).zip(&u.operator) {
                for (i, (row, &coefficient)) in partial.chunks_exact(columns).zip(coefficients).enumerate() {
                    for (sum, &control) in sums.iter_mut().zip(row) {
                        let product = coefficient * control;
                        *sum = if i == 0 { product } else { *sum + product };
                    }
                }
            }
            // The net's weights decide, as rounding can make equal weights of controls differ.
            let weight = net[0].w;
            *entry = Entry {
                surface: *index as u32,
                degree: degree.map(|degree| degree as u8),
                rational: net.iter().any(|control| control.w != weight),
                first: part.first_control + number * size,
                domain: ParamBox::new(
                    reported_ends(in_u, place_in_u, degree[0]),
                    reported_ends(in_v, place_in_v, degree[1]),
                ),
                center,
            };
            point_error.include(degree, radius, center.length());
        }
        point_error
    }
}
