//! Removal of knots across which a surface is one polynomial up to rounding, as
//! refined copies and exact refits have them.
//!
//! Lemma. Let the homogeneous curve (X, w) of every line of control points along
//! an axis, over each span, have Bézier controls that differ from those of
//! another polynomial (X', w') restricted to the span by at most `e` in space and
//! `f` in weight. Then the surface of the other polynomials is within
//! `(e + f r) / ω` of the surface at equal parameters, with r the largest distance of its
//! control points from the origin of X and ω > 0 the smallest weight.
//!
//! Proof. Along the other axis the basis functions are nonnegative with sum 1, so
//! the homogeneous surfaces differ by at most e and f. With `x' = X'/w'`,
//! `X/w - x' = (X - X' + x' (w' - w)) / w`. ∎
//!
//! So a polynomial over several spans may come from anywhere; here it
//! interpolates the spline at the extrema of a Chebyshev polynomial, and the
//! differences are measured. The removal of knots with a measured error is that
//! of L. Piegl and W. Tiller, *The NURBS Book*, section 5.4.

use crate::axis::Axis;
use crate::bezier::basis::Interpolation;
use crate::bezier::extraction::common_polynomial::{Continuation, Lines, Piece, Pieces};
use crate::bezier::extraction::extract::{Span, power_of_two_below, spans};
use crate::bvh::Aabb;
use crate::model::{Model, NurbsSurface, SurfaceArrays};
use crate::parallel::map;
use crate::rounding::{UNIT_ROUNDOFF, gamma, lower_min, upper_max};
use glam::{DVec3, DVec4, Vec4Swizzles};
use std::borrow::Cow;
use std::ops::Range;

/// The largest difference of a span's control from the common polynomial's, in
/// units of the rounding of the model's largest coordinate and weight. The solution of
/// an interpolation problem, which a refit is, carries some units.
const MAX_DIFFERENCE: f64 = 64.0;

/// A bound on the weights of a surface, of which the largest is in [1, 2).
const MAX_WEIGHT: f64 = 2.0;

/// The largest error of a surface with fewer knots, in the same units: four times the
/// error of a bicubic patch's extraction, halving and evaluation.
const MAX_ERROR: f64 = 1024.0;

/// The roundings in a difference of two controls, for each degree: six of the span's
/// own and six of the common polynomial's over the span (lemma R3 of docs/method.md).
const ROUNDINGS_PER_DEGREE: f64 = 12.0;

/// The further roundings: two products of lemma R3, forming homogeneous controls and the
/// difference, and the common polynomial's control points of the model.
const ROUNDINGS: f64 = 18.0;

/// A model with fewer knots.
pub(crate) struct Reduced {
    /// Surfaces with the parameters of the model's own.
    pub(crate) model: Model,
    /// An upper bound on the distance between points of equal parameters.
    pub(crate) error: f64,
}

/// Returns `model` without its removable knots; `None` where it has none.
/// O(control points p²) for surfaces with removable knots; for most others two
/// lines of control points are examined.
pub(crate) fn without_removable_knots(model: &Model) -> Option<Reduced> {
    let surfaces = model.surfaces();
    let reduced: Vec<Option<(NurbsSurface, f64)>> =
        map(surfaces.len(), |index| reduced_surface(index, &surfaces[index]));
    if reduced.iter().all(Option::is_none) {
        return None;
    }
    let mut largest = 0.0_f64;
    let surfaces = reduced.into_iter().zip(model.surfaces()).map(|(reduced, surface)| match reduced {
        Some((reduced, error)) => {
            largest = upper_max(largest, error);
            reduced
        }
        None => surface.clone(),
    });
    let surfaces = surfaces.collect();
    Some(Reduced { model: Model::new(model.name().map(str::to_owned), surfaces).ok()?, error: largest })
}

/// Returns the surface without its removable knots, and its error.
fn reduced_surface(index: usize, surface: &NurbsSurface) -> Option<(NurbsSurface, f64)> {
    let mut net = Net::new(surface);
    let is_reduced = Axis::BOTH.map(|axis| net.reduce(axis));
    if is_reduced == [false; 2] {
        return None;
    }
    let error = net.error();
    if !(net.lightest > 0.0 && error <= MAX_ERROR * UNIT_ROUNDOFF * net.largest()) {
        return None;
    }
    Some((NurbsSurface::new(index, net.into_arrays()).ok()?, error))
}

/// A surface's homogeneous control points.
struct Net {
    degree: [usize; 2],
    knots: [Vec<f64>; 2],
    counts: [usize; 2],
    /// `(w (p - center), w)`, v fastest, with the weights divided by `scale`.
    controls: Vec<DVec4>,
    center: DVec3,
    /// The largest distance of a control point from the centre.
    radius: f64,
    /// The smallest weight.
    lightest: f64,
    /// The common weight of a polynomial surface.
    weight: Option<f64>,
    /// Bounds on the differences from the given surface, in space and in weight.
    differences: [f64; 2],
}

impl Net {
    fn new(surface: &NurbsSurface) -> Self {
        let points = surface.control_points();
        let position = |&[x, y, z, _]: &[f64; 4]| DVec3::new(x, y, z);
        let center = points.iter().map(position).fold(Aabb::EMPTY, Aabb::with).center();
        let heaviest = points.iter().map(|point| point[3]).fold(0.0, upper_max);
        let scale = power_of_two_below(heaviest).recip();
        let controls: Vec<DVec4> = points
            .iter()
            .map(|point| {
                let weight = scale * point[3];
                (weight * (position(point) - center)).extend(weight)
            })
            .collect();
        let first = controls[0].w;
        let mut net = Self {
            degree: surface.degree(),
            knots: Axis::BOTH.map(|axis| surface.knots(axis).to_vec()),
            counts: surface.counts(),
            controls,
            center,
            radius: 0.0,
            lightest: f64::INFINITY,
            weight: None,
            differences: [0.0; 2],
        };
        net.weight = net.controls.iter().all(|control| control.w == first).then_some(first);
        net.measure();
        net
    }

    /// Makes the radius and the smallest weight hold for the present controls, too.
    fn measure(&mut self) {
        let length = |control: &DVec4| control.xyz().length() / control.w;
        self.radius = self.controls.iter().map(length).fold(self.radius, upper_max);
        self.lightest = self.controls.iter().map(|control| control.w).fold(self.lightest, lower_min);
    }

    /// The largest length of a coordinate vector.
    fn largest(&self) -> f64 {
        self.radius + self.center.length()
    }

    /// The error of the lemma, with that of the control points' own rounding.
    fn error(&self) -> f64 {
        let [space, weight] = self.differences;
        (space + weight * self.radius) / self.lightest * (1.0 + gamma(ROUNDINGS))
            + gamma(ROUNDINGS) * self.largest()
    }

    /// The largest difference of controls at which they count as equal.
    fn tolerance(&self) -> f64 {
        MAX_WEIGHT * MAX_DIFFERENCE * UNIT_ROUNDOFF * self.largest()
    }

    /// Replaces runs of spans along `axis` that are one polynomial by one span each;
    /// returns whether there are any.
    fn reduce(&mut self, axis: Axis) -> bool {
        let (degree, count) = (self.degree[axis], self.counts[axis]);
        let spans = spans(&self.knots[axis], degree, count);
        let rows = self.rows(axis);
        let lines = Lines { rows: &rows, count: self.counts[axis.other()] };
        // The middle one: edges are often straight where the surface is not.
        let sample = lines.line(lines.count / 2);
        let sample = Lines { rows: &sample, count: 1 };
        let runs = self.runs(axis, &spans, [sample, lines]);
        if runs.len() == spans.len() {
            return false;
        }
        let interpolation = &Interpolation::new(degree);
        let mut pieces = Pieces { degree, spans: &spans, interpolation, lines, sample, list: Vec::new() };
        let mut differences = [0.0_f64; 2];
        for run in runs {
            pieces.add(run, self.tolerance(), &mut differences);
        }
        let pieces = pieces.list;
        if pieces.len() == spans.len() {
            return false;
        }
        self.replace(axis, &spans, &pieces);
        let roundings = gamma(ROUNDINGS_PER_DEGREE * degree as f64 + ROUNDINGS);
        let heaviest = self.controls.iter().map(|control| control.w).fold(MAX_WEIGHT, upper_max);
        self.differences[0] += differences[0] + roundings * heaviest * self.radius;
        // Equal weights stay as they are.
        if self.weight.is_none() {
            self.differences[1] += differences[1] + roundings * heaviest;
        }
        true
    }

    /// The controls with those of a line along `axis` apart from each other by the number of lines.
    fn rows(&self, axis: Axis) -> Cow<'_, [DVec4]> {
        match axis {
            Axis::U => Cow::Borrowed(&self.controls),
            Axis::V => Cow::Owned(transposed(&self.controls, self.counts[1])),
        }
    }

    /// The maximal runs of spans that seem to be one polynomial on every line; the first of
    /// both sets of lines is examined first.
    fn runs(&self, axis: Axis, spans: &[Span], lines: [Lines<'_>; 2]) -> Vec<Range<usize>> {
        let tolerance = self.tolerance();
        let joined: Vec<bool> = spans
            .windows(2)
            .map(|pair| {
                let continuation = Continuation::new(&pair[0], &pair[1], self.degree[axis]);
                lines.iter().all(|&lines| continuation.holds(lines, tolerance))
            })
            .collect();
        let mut runs = Vec::new();
        let mut start = 0;
        for end in 1..=spans.len() {
            if end == spans.len() || !joined[end - 1] {
                runs.push(start..end);
                start = end;
            }
        }
        runs
    }

    /// Takes the Bézier controls of pieces, all lines of each, as the net along `axis`.
    fn replace(&mut self, axis: Axis, spans: &[Span], pieces: &[Piece]) {
        let order = self.degree[axis] + 1;
        let mut knots = Vec::with_capacity((pieces.len() + 1) * order);
        for piece in pieces {
            knots.extend(std::iter::repeat_n(spans[piece.spans.start].ends[0], order));
        }
        if let Some(last) = spans.last() {
            knots.extend(std::iter::repeat_n(last.ends[1], order));
        }
        let mut rows: Vec<DVec4> = pieces.iter().flat_map(|piece| piece.controls.iter().copied()).collect();
        if let Some(weight) = self.weight {
            rows.iter_mut().for_each(|control| control.w = weight);
        }
        self.controls = if axis == Axis::U { rows } else { transposed(&rows, self.counts[0]) };
        self.knots[axis] = knots;
        self.counts[axis] = pieces.len() * order;
        self.measure();
    }

    fn into_arrays(self) -> SurfaceArrays {
        let point = |control: &DVec4| {
            let DVec3 { x, y, z } = self.center + control.xyz() / control.w;
            [x, y, z, control.w]
        };
        SurfaceArrays {
            degree: self.degree,
            control_points: self.controls.iter().map(point).collect(),
            knots: self.knots,
            counts: self.counts,
        }
    }
}

/// Returns the transpose of a matrix with this many columns.
fn transposed(matrix: &[DVec4], columns: usize) -> Vec<DVec4> {
    (0..columns).flat_map(|column| matrix[column..].iter().step_by(columns).copied()).collect()
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::bezier::extract;
    use crate::shapes::operations::{elevate_degree, insert_knot, refit_model};
    use crate::shapes::{bicubic_patch, shape};

    /// The largest distance of points of equal parameters.
    fn difference(a: &Model, b: &Model) -> f64 {
        let [a, b] = [a, b].map(extract);
        let random = &mut fastrand::Rng::with_seed(5);
        let mut largest = 0.0_f64;
        for (of_a, of_b) in a.grids.iter().zip(&b.grids) {
            for _ in 0..300 {
                let fractions = [random.f64(), random.f64()];
                let points = [(&a, of_a), (&b, of_b)].map(|(bezier, grid)| {
                    let [(row, s), (column, t)] = Axis::BOTH.map(|axis| {
                        let breaks = &grid.breaks[axis];
                        let [start, end] = [breaks[0], breaks[breaks.len() - 1]];
                        grid.locate(axis, start + fractions[axis] * (end - start))
                    });
                    bezier.patches.patch(grid.first + row * grid.counts()[1] + column).point([s, t])
                });
                largest = largest.max(points[0].distance(points[1]));
            }
        }
        largest
    }

    fn patches(model: &Model) -> usize {
        extract(model).patches.len()
    }

    #[test]
    fn inserted_knots_are_removed() {
        for name in ["torus", "wavy-sheet", "naca-wing", "net-6x6"] {
            let model = shape(name).unwrap();
            let refined: Vec<_> = model
                .surfaces()
                .iter()
                .map(|surface| {
                    let mut refined = surface.clone();
                    for (axis, fraction, times) in
                        [(Axis::U, 0.31, 1), (Axis::V, 0.77, 2), (Axis::U, 0.6, 1), (Axis::U, 0.6001, 1)]
                    {
                        let [start, end] = surface.domain()[axis];
                        let times = times.min(surface.degree()[axis]);
                        let knot = start + fraction * (end - start);
                        refined = insert_knot(&refined, axis, knot, times).unwrap();
                    }
                    elevate_degree(&refined, Axis::V).unwrap()
                })
                .collect();
            let refined = Model::new(None, refined).unwrap();
            let reduced = without_removable_knots(&refined).unwrap();
            let least =
                without_removable_knots(&model).map_or(patches(&model), |least| patches(&least.model));
            assert_eq!(patches(&reduced.model), least, "{name}");
            let size = model.bounding_box().diagonal();
            assert!(reduced.error < 3e-13 * size, "{name}: {}", reduced.error);
            assert!(difference(&refined, &reduced.model) <= reduced.error, "{name}");
        }
    }

    #[test]
    fn an_exact_refit_has_the_patches_of_its_original() {
        let sheet = bicubic_patch();
        for count in [5, 12, 60] {
            let refit = refit_model(&sheet, count).unwrap();
            let reduced = without_removable_knots(&refit).unwrap();
            assert_eq!(patches(&reduced.model), 1, "{count}");
            assert!(difference(&sheet, &reduced.model) < 1e-14);
        }
    }

    /// The error covers what a removal changes: a knot at which the polynomials differ a
    /// little is removed with that difference, and one at which they differ by more stays.
    #[test]
    fn the_error_is_that_of_the_removal() {
        let model = shape("wavy-sheet").unwrap();
        let surface = &model.surfaces()[0];
        let [start, end] = surface.domain()[Axis::U];
        let refined = insert_knot(surface, Axis::U, start + 0.49 * (end - start), 1).unwrap();
        let columns = refined.counts()[1];
        let least = without_removable_knots(&model).map_or(patches(&model), |least| patches(&least.model));
        for (units, is_removed) in [(20.0, true), (1e4, false)] {
            let mut arrays = refined.clone().into_arrays();
            let row = refined.knots(Axis::U).partition_point(|&knot| knot < start + 0.49 * (end - start)) - 2;
            let size = model.bounding_box().diagonal();
            for point in &mut arrays.control_points[row * columns..][..columns] {
                point[2] += units * UNIT_ROUNDOFF * size;
            }
            let edited = Model::from_arrays(None, vec![arrays]).unwrap();
            let reduced = without_removable_knots(&edited);
            let left = reduced.as_ref().map_or(patches(&edited), |reduced| patches(&reduced.model));
            assert_eq!(left == least, is_removed, "{units}: {left}, {least}");
            if let Some(reduced) = reduced {
                let changed = difference(&edited, &reduced.model);
                assert!(changed <= reduced.error && changed > 1e-3 * reduced.error, "{changed}");
            }
        }
    }

    /// The homogeneous point of a net's surface, by de Boor's recursion over the basis functions.
    fn homogeneous(net: &Net, parameters: [f64; 2]) -> DVec4 {
        fn basis(knots: &[f64], index: usize, degree: usize, parameter: f64) -> f64 {
            let [from, to] = [knots[index], knots[index + degree + 1]];
            if degree == 0 {
                return f64::from(u8::from(from <= parameter && parameter < to));
            }
            let part = |length: f64, width: f64| if width > 0.0 { length / width } else { 0.0 };
            part(parameter - from, knots[index + degree] - from) * basis(knots, index, degree - 1, parameter)
                + part(to - parameter, to - knots[index + 1]) * basis(knots, index + 1, degree - 1, parameter)
        }
        let [of_u, of_v] = Axis::BOTH.map(|axis| {
            let basis = |index| basis(&net.knots[axis], index, net.degree[axis], parameters[axis]);
            (0..net.counts[axis]).map(basis).collect::<Vec<_>>()
        });
        let weights = of_u.iter().flat_map(|a| of_v.iter().map(move |b| a * b));
        net.controls.iter().zip(weights).map(|(&control, weight)| weight * control).sum()
    }

    /// The differences are bounds in space and in weight, on every span and every line. The
    /// surface is far from the origin, where the tolerance is many times the allowance for
    /// rounding, which would hide what was not measured.
    #[test]
    fn differences_are_bounds_on_every_span_of_every_line() {
        let torus = shape("torus").unwrap();
        let far = 200.0 * torus.bounding_box().diagonal();
        let mut surface = torus.surfaces()[0].clone();
        let first = surface.knots(Axis::U)[surface.degree()[0]];
        let last = *surface.knots(Axis::U).iter().find(|&&knot| knot > first).unwrap();
        let fractions = [0.2, 0.4, 0.6, 0.8];
        for fraction in fractions {
            surface = insert_knot(&surface, Axis::U, first + fraction * (last - first), 1).unwrap();
        }
        let mut arrays = surface.into_arrays();
        arrays.control_points.iter_mut().for_each(|point| point[0] += far);
        let columns = arrays.counts[1];
        let radius = Net::new(&NurbsSurface::new(0, arrays.clone()).unwrap()).radius;
        let change = 30.0 * UNIT_ROUNDOFF * far;
        for row in [1, 2, 4, 5] {
            for column in [0, columns / 2, columns - 1] {
                for is_weight in [false, true] {
                    let mut edited = arrays.clone();
                    let place = row * columns + column;
                    let mut net = Net::new(&NurbsSurface::new(0, edited.clone()).unwrap());
                    if is_weight {
                        net.controls[place].w += change;
                    } else {
                        edited.control_points[place][2] += change;
                        net = Net::new(&NurbsSurface::new(0, edited).unwrap());
                    }
                    let before = Net { knots: net.knots.clone(), controls: net.controls.clone(), ..net };
                    assert!(net.reduce(Axis::U), "{row} {column} {is_weight}");
                    assert!(net.counts[0] < before.counts[0] + 3);
                    let random = &mut fastrand::Rng::with_seed(7);
                    let mut found = [0.0_f64; 2];
                    for _ in 0..400 {
                        let u = first + random.f64() * (last - first);
                        let parameters = [u, random.f64()];
                        let difference = homogeneous(&net, parameters) - homogeneous(&before, parameters);
                        found[0] = found[0].max(difference.xyz().length());
                        found[1] = found[1].max(difference.w.abs());
                    }
                    for (kind, size) in [radius, 1.0].into_iter().enumerate() {
                        assert!(found[kind] <= net.differences[kind], "{row} {column} {is_weight} {kind}");
                        let allowance = 200.0 * UNIT_ROUNDOFF * size;
                        let is_measured = is_weight == (kind == 1);
                        assert!(!is_measured || found[kind] > 2.0 * allowance, "{row} {column} {found:?}");
                    }
                }
            }
        }
    }
}
