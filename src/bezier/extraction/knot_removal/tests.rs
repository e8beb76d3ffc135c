//! Removed knots change surfaces by no more than the error that is stated.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use super::net::Net;
use super::without_removable_knots;
use crate::axis::Axis;
use crate::bezier::extract;
use crate::model::{Model, NurbsSurface};
use crate::rounding::{UNIT_ROUNDOFF, upper_max};
use crate::shapes::operations::{elevate_degree, insert_knot, refit_model};
use crate::shapes::{bicubic_patch, shape};
use glam::{DVec4, Vec4Swizzles};

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
            largest = upper_max(largest, points[0].distance(points[1]));
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
                    let knot = start + fraction * (end - start);
                    refined = insert_knot(&refined, axis, knot, times.min(surface.degree()[axis])).unwrap();
                }
                elevate_degree(&refined, Axis::V).unwrap()
            })
            .collect();
        let refined = Model::new(None, refined).unwrap();
        let reduced = without_removable_knots(&refined).unwrap();
        let least = without_removable_knots(&model).map_or(patches(&model), |least| patches(&least.model));
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
                    found[0] = upper_max(found[0], difference.xyz().length());
                    found[1] = upper_max(found[1], difference.w.abs());
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
