//! The tangent plane of B at a foot, and the part of B that lies over it.

use super::piece::Piece;
use super::quadric::{Quadric, symmetric_product};
use crate::axis::Axis;
use crate::bezier::Jet;
use crate::certified::cell_context::CellContext;
use crate::certified::reparametrization::pseudo_inverse;
use crate::certified::rounding::gamma;
use crate::certified::sheets::{Chart, Reach};
use crate::rounding::{lower_min, unit, upper_max, upper_min};
use glam::{DMat3, DVec3};

/// The largest height of a first or second order by which a cell may leave B, relative to the threshold.
const MAX_SLOPE: f64 = 4.0;

/// Roundings of a product of T, P and n with a vector, relative to the sizes of its terms.
const FRAME_ROUNDINGS: f64 = 64.0;

/// The number of boxes tried; each but the first is larger by what the last one lacked.
const MAX_BOXES: usize = 3;

/// The size of a box relative to what it has to contain.
const ENLARGEMENT: f64 = 1.25;

/// The largest number of patches of B over which a cell is compared.
const MAX_PATCHES: usize = 16;

/// Roundings of a parameter of the chart for a patch's, relative to its size and that of the patch.
const PLACE_ROUNDINGS: f64 = 32.0;

/// A foot's tangents T with a map P to steps of parameters and a normal.
pub(super) struct Frame<'a> {
    pub(super) chart: Chart<'a>,
    pub(super) jet: Jet,
    pub(super) tangents: [DVec3; 2],
    /// The rows of P.
    pub(super) inverse: [DVec3; 2],
    pub(super) normal: DVec3,
    /// An upper bound on the norm of `I - T P - n nᵀ` and on `|n·T_i| / |T_i|`.
    pub(super) skew: f64,
}

/// The part of B over a box of parameters.
pub(super) struct Image {
    /// By rows.
    pub(super) parts: Vec<Part>,
    /// The parts of a row.
    pub(super) columns: usize,
    /// The ends of the box.
    pub(super) ends: [[f64; 2]; 2],
    /// How far the surface is followed.
    reach: Reach,
    /// How far points of B may jump in it.
    pub(super) gap: f64,
}

/// A piece of B with the range of its parameters, relative to the foot's, and their rounding.
pub(super) struct Part {
    pub(super) piece: Piece,
    pub(super) places: [[f64; 2]; 2],
    pub(super) errors: [f64; 2],
}

/// Where the fixed points for the points of a cell are, by functions g of space that are near B's parameters.
#[derive(Clone, Copy)]
pub(super) struct Placement {
    pub(super) functions: [Quadric; 2],
    /// How far `g(a) - g(B(y))` can be from zero along each axis where y is the fixed point.
    pub(super) overhang: [f64; 2],
    /// How far `y - β - g(B(y))` can, for all y of the box.
    pub(super) lag_of_b: [f64; 2],
    /// How far `y - β - g(a)` can.
    pub(super) lag: [f64; 2],
    /// The ranges of the fixed points' parameters.
    pub(super) feet: [[f64; 2]; 2],
    /// How far F can be beyond the start and the end of the box where y is there.
    pub(super) overhang_at_ends: [[f64; 2]; 2],
    /// For a point a that is at most `offset - g(a)` and `offset + g(a)`.
    pub(super) offsets: [[f64; 2]; 2],
    /// What jumps and rounding add to it.
    margin: [f64; 2],
}

impl Image {
    /// The largest distance of its control points from the foot.
    pub(super) fn radius(&self) -> f64 {
        self.parts.iter().fold(0.0, |radius, part| upper_max(radius, part.piece.radius))
    }

    /// Whether the surface ends where the box does.
    fn is_last(&self, axis: usize, end: usize) -> bool {
        self.ends[axis][end] == self.reach.domain[axis][end]
    }

    /// The range of a function on the curves at an end of the box.
    fn range_at(&self, axis: Axis, end: usize, function: &Quadric) -> [f64; 2] {
        let ranges = self.end(axis, end).map(|curve| curve.values(function).range());
        ranges.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, largest], [low, high]| {
            [lower_min(least, low), upper_max(largest, high)]
        })
    }

    /// The curves at an end of the box, in order.
    pub(super) fn end(&self, axis: Axis, end: usize) -> impl Iterator<Item = Piece> {
        let (first, step, count) = match axis {
            Axis::U => (end * (self.parts.len() - self.columns), 1, self.columns),
            Axis::V => (end * (self.columns - 1), self.columns, usize::MAX),
        };
        let parts = self.parts.iter().skip(first).step_by(step).take(count);
        parts.map(move |part| part.piece.side(axis, end))
    }
}

impl Placement {
    /// The placement for those points of the cell for which F exceeds each end of the box by at most these limits.
    pub(super) fn limited(&self, limits: [[f64; 2]; 2]) -> Self {
        let least =
            |axis: usize| [0, 1].map(|end| upper_min(self.overhang_at_ends[axis][end], limits[axis][end]));
        let overhang_at_ends = [least(0), least(1)];
        let overhang = [0, 1].map(|axis| {
            upper_max(upper_max(overhang_at_ends[axis][0], overhang_at_ends[axis][1]), 0.0)
                + self.margin[axis]
        });
        let lag = [0, 1].map(|axis| self.lag_of_b[axis] + overhang[axis]);
        Self { overhang_at_ends, overhang, lag, ..*self }
    }
}

/// The nearest number of a range; NaN, which is in no range, stays.
fn clamped(number: f64, [start, end]: [f64; 2]) -> f64 {
    if number < start {
        start
    } else if number > end {
        end
    } else {
        number
    }
}

impl<'a> Frame<'a> {
    /// `None` where the tangents are about parallel.
    pub(super) fn new(chart: Chart<'a>) -> Option<Self> {
        let jet = chart.jet();
        let tangents = [jet.s, jet.t];
        let (inverse, normal) = (pseudo_inverse(tangents), unit(jet.s.cross(jet.t)));
        let rows = inverse.map(DVec3::length);
        let columns = tangents.map(DVec3::length);
        let mut rest = DMat3::IDENTITY - symmetric_product(normal, normal);
        for (tangent, row) in tangents.iter().zip(&inverse) {
            rest -= DMat3::from_cols(row.x * tangent, row.y * tangent, row.z * tangent);
        }
        let measured = Quadric { linear: normal, form: rest }.size();
        let sizes = 1.0 + columns[0] * rows[0] + columns[1] * rows[1];
        let along = [0, 1].map(|axis| normal.dot(tangents[axis]).abs() / columns[axis]);
        let skew = measured + along[0] + along[1] + gamma(FRAME_ROUNDINGS * sizes);
        let is_regular = skew < MAX_SKEW && inverse.iter().all(|row| *row != DVec3::ZERO);
        is_regular.then_some(Self { chart, jet, tangents, inverse, normal, skew })
    }

    /// The part of B over a box of parameters that contains the fixed points for all points of a piece
    /// of A, up to the overhang at the ends of B's surface. `None` where B turns too far or has too
    /// many patches for it.
    pub(super) fn image(&self, a: &Piece) -> Option<(Image, Placement)> {
        let functions = self.inverse.map(Quadric::of_plane);
        let ranges = functions.map(|function| a.values(&function).range());
        let mut extent = ranges.map(|[low, high]| ENLARGEMENT * upper_max(-low, high));
        for _ in 0..MAX_BOXES {
            let reach = self.chart.reach_over_creases(extent);
            let ends = [0, 1].map(|axis| {
                let (at, [low, high]) = (self.chart.parameters[axis], reach.domain[axis]);
                [(at - extent[axis]).clamp(low, high), (at + extent[axis]).clamp(low, high)]
            });
            let parts = self.parts(&reach, extent, ends)?;
            let gap = self.chart.gap(&reach, extent);
            let columns = self.chart.all_touched(extent, &reach)[1].clone().count();
            let image = Image { parts, columns, ends, reach, gap };
            let placement = self.placement(a, &image, functions);
            // Beyond an end of the surface there is nothing more.
            let lack = [0, 1].map(|axis| {
                let ends = (0..2).filter(|end| !image.is_last(axis, *end));
                ends.fold(0.0, |lack, end| upper_max(lack, placement.overhang_at_ends[axis][end]))
            });
            if lack == [0.0; 2] {
                return Some((image, placement));
            }
            extent = [0, 1].map(|axis| ENLARGEMENT * (extent[axis] + lack[axis]));
        }
        None
    }

    /// Where the fixed points are by functions that follow B's parameters to second order.
    pub(super) fn closer_placement(&self, a: &Piece, image: &Image) -> Placement {
        self.placement(a, image, self.inverse.map(|row| self.osculating(row)))
    }

    pub(super) fn placement(&self, a: &Piece, image: &Image, functions: [Quadric; 2]) -> Placement {
        let ranges = functions.map(|function| a.values(&function).range());
        let radius = image.radius();
        let mut placement = Placement {
            functions,
            overhang: [0.0; 2],
            lag_of_b: [0.0; 2],
            lag: [0.0; 2],
            feet: [[0.0; 2]; 2],
            overhang_at_ends: [[0.0; 2]; 2],
            offsets: [[0.0; 2]; 2],
            margin: [0.0; 2],
        };
        for axis in Axis::BOTH {
            let (index, function) = (axis.index(), &functions[axis.index()]);
            let [mut least, mut largest] = [0.0_f64; 2];
            for Part { piece, places, errors } in &image.parts {
                let [low, high] = piece.values(function).lag(axis, places[index]);
                least = lower_min(least, low - errors[index]);
                largest = upper_max(largest, high + errors[index]);
            }
            let (at, [start, end]) = (self.chart.parameters[index], image.ends[index]);
            let [low, high] = ranges[index];
            let slope = function.linear.length() + 2.0 * function.size() * radius;
            let rounding = gamma(PLACE_ROUNDINGS) * (1.0 + (end - at).abs() + (at - start).abs());
            let margin = slope * image.gap + rounding;
            let [first, last] = [at + low + least - margin, at + high + largest + margin];
            placement.offsets[index] = [start - at - least, at - end + largest];
            for (end, of_a) in [-low, high].into_iter().enumerate() {
                let offset = &mut placement.offsets[index][end];
                // Where F is beyond an end, the fixed point is on it.
                if *offset + of_a > 0.0 && image.is_last(index, end) {
                    let [least, largest] = image.range_at(axis, end, function);
                    *offset = upper_min(*offset, if end == 0 { largest } else { -least });
                }
                placement.overhang_at_ends[index][end] = *offset + of_a;
            }
            placement.lag_of_b[index] = upper_max(-least, largest);
            placement.feet[index] = [first, last].map(|parameter| clamped(parameter, [start, end]));
            placement.margin[index] = margin;
        }
        placement.limited([[f64::INFINITY; 2]; 2])
    }

    /// The pieces of B over a box; `None` where they are many.
    fn parts(&self, reach: &Reach, extent: [f64; 2], ends: [[f64; 2]; 2]) -> Option<Vec<Part>> {
        let chart = &self.chart;
        let [rows, columns] = chart.all_touched(extent, reach);
        if rows.clone().count() * columns.clone().count() > MAX_PATCHES {
            return None;
        }
        let mut parts = Vec::new();
        for row in rows {
            for column in columns.clone() {
                let offsets = [row, column];
                let patch = chart.neighbour(offsets);
                let part = chart.part(offsets, ends);
                let controls = patch.restricted(part[0], part[1]);
                let shift = self.jet.point - patch.center;
                let piece = Piece::new(patch.degree, controls, shift, chart.radius(offsets));
                let places = Axis::BOTH.map(|axis| {
                    let (index, at) = (axis.index(), chart.parameters[axis.index()]);
                    part[index].map(|end| chart.parameter(axis, offsets[index], end) - at)
                });
                let errors = Axis::BOTH.map(|axis| {
                    let line = offsets[axis.index()];
                    chart.line_error(axis, line) + chart.line_error(axis, line + 1)
                });
                parts.push(Part { piece, places, errors });
            }
        }
        Some(parts)
    }

    /// Whether the derivatives of A's height over B up to second order may let a bound reach the threshold.
    pub(super) fn is_left_slowly(&self, context: &CellContext<'_>, threshold: f64) -> bool {
        let (a, [h, k], normal) = (&context.jet, context.cell.half, self.normal);
        let [s, t] = [h * a.s, k * a.t];
        let paraboloid = self.osculating(normal);
        let height = |vector: DVec3| normal.dot(vector);
        let second = |own: DVec3, x: DVec3, y: DVec3| 0.5 * height(own) + x.dot(paraboloid.form * y);
        let first = height(s).abs() + height(t).abs();
        let [ss, st, tt] =
            [second(h * h * a.ss, s, s), second(h * k * a.st, s, t), second(k * k * a.tt, t, t)];
        first <= MAX_SLOPE * threshold && ss.abs() + 2.0 * st.abs() + tt.abs() <= MAX_SLOPE * threshold
    }

    /// The function with this gradient at the foot that changes on B, to second order, as along its tangent
    /// plane: of the normal, it vanishes on the paraboloid that osculates B.
    pub(super) fn osculating(&self, gradient: DVec3) -> Quadric {
        let [s, t] = self.inverse;
        let [ss, st, tt] = [self.jet.ss, self.jet.st, self.jet.tt].map(|vector| gradient.dot(vector));
        let form = symmetric_product(s, s) * ss
            + symmetric_product(s, t) * (2.0 * st)
            + symmetric_product(t, t) * tt;
        Quadric { linear: gradient, form: form * -0.5 }
    }

    /// An upper bound on the distance of two points of B that are `steps` apart along the axes of its
    /// parameters, both in a box; `None` where the surface is not followed over all of it, or over many patches.
    pub(super) fn drift(&self, image: &Image, parameters: [[f64; 2]; 2], steps: [f64; 2]) -> Option<f64> {
        let is_reached = (0..2).all(|axis| {
            let ([low, high], [first, last]) = (parameters[axis], image.reach.domain[axis]);
            let margin = DRIFT_MARGIN * (last - first);
            first - margin <= low && high <= last + margin
        });
        if is_reached && steps == [0.0; 2] {
            return Some(0.0);
        }
        let extent = [0, 1].map(|axis| {
            let ([low, high], at) = (parameters[axis], self.chart.parameters[axis]);
            upper_max(at - low, high - at)
        });
        // The rounding of the box's ends.
        let extent = extent.map(|extent| extent + gamma(PLACE_ROUNDINGS) * (1.0 + extent));
        let [rows, columns] = self.chart.all_touched(extent, &image.reach);
        let is_few = rows.count() * columns.count() <= MAX_PATCHES;
        (is_reached && is_few).then(|| {
            let along = Axis::BOTH.map(|axis| {
                let step = steps[axis.index()];
                if step > 0.0 { step * self.chart.speed(axis, &image.reach, extent) } else { 0.0 }
            });
            along[0] + along[1] + self.chart.gap(&image.reach, extent)
        })
    }
}

/// How far, relative to the surface's, a box may be beyond it by the rounding of both.
const DRIFT_MARGIN: f64 = 1e-9;

/// The largest skewness of the frame: with more, rounding or nearly parallel tangents spoil the bound.
const MAX_SKEW: f64 = 1e-6;
