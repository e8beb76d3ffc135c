//! The difference as a spline is that of the points, and its bounds are attained.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use super::super::orientation::Orientation;
use super::BlockMap;
use super::blossom::Coefficients;
use super::coefficients::difference;
use super::knots::{Knot, KnotSequence};
use crate::axis::Axis;
use crate::certified::reparametrization::Reparametrization;
use crate::certified::rounding::UNIT_ROUNDOFF;
use crate::certified::sheets::Chart;
use crate::certified::testing::{Surfaces, clamped, closed, whole_block};
use crate::certified::{Block, Pair};
use crate::flatness::Flatness;
use crate::model::{RigidTransform, SurfaceArrays};
use glam::{DQuat, DVec2, DVec3};

fn orientation(swapped: bool, backwards: [bool; 2]) -> Orientation {
    let [s, t] = backwards.map(|backwards| if backwards { -1.0 } else { 1.0 });
    let (p, q) = if swapped { (s * DVec2::Y, t * DVec2::X) } else { (s * DVec2::X, t * DVec2::Y) };
    Orientation::new(&Reparametrization { p, q })
}

/// A surface of random control points with these inner knots, and all weights equal.
fn surface(random: &mut fastrand::Rng, degree: [usize; 2], inner: &[Vec<f64>; 2]) -> SurfaceArrays {
    let counts = [0, 1].map(|axis| degree[axis] + 1 + inner[axis].len());
    let weight = if random.bool() { 1.0 } else { 0.3 };
    let control_points =
        (0..counts[0] * counts[1]).map(|_| [random.f64(), random.f64(), random.f64(), weight]).collect();
    SurfaceArrays {
        degree,
        knots: [0, 1].map(|axis| clamped(degree[axis], &inner[axis])),
        counts,
        control_points,
    }
}

/// Inner knots at these places, of random multiplicities up to degree + 1.
fn repeated(random: &mut fastrand::Rng, degree: usize, places: &[f64]) -> Vec<f64> {
    places.iter().flat_map(|&place| std::iter::repeat_n(place, random.usize(1..=degree + 1))).collect()
}

/// Sorted random places, not close to each other.
fn places(random: &mut fastrand::Rng) -> Vec<f64> {
    let count = random.usize(0..5);
    (1..=count).map(|k| (k as f64 + 0.6 * (random.f64() - 0.5)) / (count + 1) as f64).collect()
}

/// The block of all patches but sometimes the first or the last ones.
fn part(random: &mut fastrand::Rng, a: &Surfaces) -> Block {
    let mut range = |count: usize| {
        let start = random.u32(0..count as u32);
        [start, random.u32(start + 1..=count as u32)]
    };
    let [rows, columns] = a.sheets().bezier.grids[0].counts();
    Block { surface: 0, rows: range(rows), columns: range(columns) }
}

/// The values of the basis functions by the recurrence of Cox and de Boor.
fn basis(knots: &[Knot], degree: usize, at: f64) -> Vec<f64> {
    let at_knot = |index: usize| knots[index].parameter;
    let mut values: Vec<f64> = (0..knots.len() - 1)
        .map(|index| f64::from(u8::from(at_knot(index) <= at && at < at_knot(index + 1))))
        .collect();
    for level in 1..=degree {
        for index in 0..values.len() - level {
            let share = |low: usize, high: usize, from: usize, sign: f64| {
                let width = at_knot(high) - at_knot(low);
                if width > 0.0 { sign * (at - at_knot(from)) / width } else { 0.0 }
            };
            values[index] = share(index, index + level, index, 1.0) * values[index]
                + share(index + 1, index + 1 + level, index + 1 + level, -1.0) * values[index + 1];
        }
    }
    values.truncate(knots.len() - degree - 1);
    values
}

/// The point of B at parameters of the chart by A's axes.
fn point_of_b(chart: &Chart<'_>, swapped: bool, [s, t]: [f64; 2]) -> DVec3 {
    let at = if swapped { [t, s] } else { [s, t] };
    let [(u, s), (v, t)] = Axis::BOTH.map(|axis| chart.locate(axis, at[axis.index()]));
    chart.neighbour([u, v]).point([s, t])
}

/// Checks the difference and the bounds of a map against points of both surfaces.
fn check(random: &mut fastrand::Rng, map: &BlockMap<'_>) {
    let axes = Axis::BOTH.map(|axis| map.coefficients(axis).unwrap());
    let sequences = Axis::BOTH.map(|axis| KnotSequence::new(&map.axis(axis)).unwrap());
    let &BlockMap { pair, block, chart, orientation, images, .. } = map;
    let mut coefficients = Vec::new();
    difference(map, axes.each_ref(), |coefficient| coefficients.push(coefficient));
    let (bounds, error) = (map.upper_bounds().unwrap(), map.error(axes.each_ref()));
    let [rows, columns] = block.size().map(|count| count as usize);
    assert_eq!(bounds.len(), rows * columns);
    for (index, bound) in bounds.into_iter().enumerate() {
        let place = [index / columns, index % columns];
        let [[first, last], columns] = [0, 1].map(|axis| axes[axis].windows[place[axis]]);
        for i in first..=last {
            for j in columns[0]..=columns[1] {
                assert!(coefficients[i * axes[1].of_a.len() + j].length() + 0.999 * error <= bound);
            }
        }
        for _ in 0..12 {
            let local = [random.f64(), random.f64()];
            let ends = Axis::BOTH.map(|axis| {
                let breaks = &map.axis(axis).breaks[place[axis.index()]..];
                [breaks[0], breaks[1]]
            });
            let at = [0, 1].map(|axis| ends[axis][0] + (ends[axis][1] - ends[axis][0]) * local[axis]);
            let image = Axis::BOTH.map(|axis| {
                let (breaks, [from, to]) = (map.axis(axis).breaks, images[axis.index()]);
                from + (to - from) * (at[axis.index()] - breaks[0]) / (breaks[breaks.len() - 1] - breaks[0])
            });
            let patch = map.of_a(place);
            let exact =
                pair.transform.apply(patch.point(local)) - point_of_b(chart, orientation.swapped, image);
            let [u, v] = [0, 1].map(|axis| basis(&sequences[axis].knots, sequences[axis].degree, at[axis]));
            let mut sum = DVec3::ZERO;
            for (i, u) in u.iter().enumerate() {
                for (j, v) in v.iter().enumerate() {
                    sum += u * v * coefficients[i * axes[1].of_a.len() + j];
                    // No other coefficient counts on the patch.
                    let is_inside = [(i, 0), (j, 1)].iter().all(|&(index, axis)| {
                        let [first, last] = axes[axis].windows[place[axis]];
                        (first..=last).contains(&index)
                    });
                    assert!(is_inside || u * v <= 1e-12);
                }
            }
            assert!(sum.distance(exact) <= 1e-8, "{sum} {exact}");
            assert!(exact.length() <= bound, "{} {bound}", exact.length());
        }
    }
}

/// A chart of a surface about a random point, with the parameters at the ends of the surface.
fn random_chart<'a>(random: &mut fastrand::Rng, b: &'a Surfaces) -> (Chart<'a>, [[f64; 2]; 2]) {
    let [rows, columns] = b.sheets().bezier.grids[0].counts();
    let patch = random.usize(0..rows * columns);
    let chart = Chart::new(b.sheets(), patch as u32, [random.f64(), random.f64()]);
    let ends = [(patch / columns, rows), (patch % columns, columns)];
    let domain = Axis::BOTH.map(|axis| {
        let (index, count) = ends[axis.index()];
        [-(index as isize), (count - index) as isize].map(|line| chart.line(axis, line))
    });
    (chart, domain)
}

/// The images of the ends of a block by A's axes: the ends of parts of B's domain.
fn images(
    domain: [[f64; 2]; 2],
    swapped: bool,
    backwards: [bool; 2],
    mut part: impl FnMut() -> [f64; 2],
) -> [[f64; 2]; 2] {
    Axis::BOTH.map(|axis| {
        let [low, high] = domain[if swapped { axis.other() } else { axis }];
        let mut images = part().map(|part| (1.0 - part) * low + part * high);
        if backwards[axis.index()] {
            images.reverse();
        }
        images
    })
}

/// The difference is that of the points for all degrees, orientations, multiplicities and motions, for
/// lines of B anywhere between those of A or all but at them.
#[test]
fn the_coefficients_are_those_of_the_difference() {
    let random = &mut fastrand::Rng::with_seed(160);
    for case in 0..600 {
        let degrees = [0; 4].map(|_| random.usize(1..5));
        let [p, q, m, n] = degrees;
        let (swapped, backwards) = (random.bool(), [random.bool(), random.bool()]);
        let by_axes_of_b = |[s, t]: [Vec<f64>; 2]| if swapped { [t, s] } else { [s, t] };
        let on_a = [places(random), places(random)];
        let shared = case % 3 == 0;
        let on_b = if shared {
            // A's own lines in B's order, off by rounding or more.
            by_axes_of_b([0, 1].map(|axis| {
                let gap = [0.0, 1e-15, 1e-13, 1e-11, 1e-9, 1e-6][random.usize(0..6)];
                let mut lines: Vec<f64> = on_a[axis]
                    .iter()
                    .map(|&place| if backwards[axis] { 1.0 - place } else { place })
                    .map(|place| place + gap * (random.f64() - 0.5))
                    .collect();
                lines.sort_by(f64::total_cmp);
                lines
            }))
        } else {
            [places(random), places(random)]
        };
        let inner_a = [repeated(random, p, &on_a[0]), repeated(random, q, &on_a[1])];
        let inner_b = [repeated(random, m, &on_b[0]), repeated(random, n, &on_b[1])];
        let a = Surfaces::new(vec![surface(random, [p, q], &inner_a)], Flatness::None);
        let b = Surfaces::new(vec![surface(random, [m, n], &inner_b)], Flatness::None);
        let turn = DQuat::from_rotation_x(random.f64()) * DQuat::from_rotation_z(random.f64());
        let transform = RigidTransform::new(turn, DVec3::new(random.f64(), 0.5, -0.25)).unwrap();
        let pair = Pair { a: a.operand(), b: b.operand(), transform };
        let (chart, domain) = random_chart(random, &b);
        let block = if shared { whole_block(&a) } else { part(random, &a) };
        let images = images(domain, swapped, backwards, || {
            let [from, to] = [0.3 * random.f64(), 1.0 - 0.3 * random.f64()];
            [[0.0, 1.0], [0.0, to], [from, to]][if shared { 0 } else { random.usize(0..3) }]
        });
        let orientation = orientation(swapped, backwards);
        let map =
            BlockMap { pair: &pair, sheets: a.sheets(), block: &block, chart: &chart, orientation, images };
        check(random, &map);
    }
}

/// The same across the line where a closed surface ends.
#[test]
fn a_closed_surface_is_followed_beyond_its_end() {
    let random = &mut fastrand::Rng::with_seed(161);
    for case in 0..60 {
        let swapped = random.bool();
        let inner = [places(random), places(random)];
        let inner_a = [repeated(random, 2, &inner[0]), repeated(random, 3, &inner[1])];
        let a = Surfaces::new(vec![surface(random, [2, 3], &inner_a)], Flatness::None);
        let b = Surfaces::new(vec![closed(100 + case, false)], Flatness::None);
        let pair = Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY };
        let (chart, domain) = random_chart(random, &b);
        let backwards = [random.bool(), random.bool()];
        // Along the closed axis from anywhere by up to a whole turn.
        let mut images = images(domain, swapped, backwards, || [0.0, 1.0]);
        let turn = 3.0 * (random.f64() - 0.5);
        let around = &mut images[usize::from(swapped)];
        let length = around[1] - around[0];
        let share = 0.1 + 0.9 * random.f64();
        *around = [around[0] + turn * length, around[0] + (turn + share) * length];
        let orientation = orientation(swapped, backwards);
        let block = part(random, &a);
        let map =
            BlockMap { pair: &pair, sheets: a.sheets(), block: &block, chart: &chart, orientation, images };
        check(random, &map);
    }
}

/// The height of level sheets over the plane.
const HEIGHT: f64 = 0.1;

/// A sheet over the unit square of these degrees and inner knots with x = u and y = v, and these heights
/// of control points.
fn sheet(degree: [usize; 2], inner: &[Vec<f64>; 2], height: impl Fn(usize, usize) -> f64) -> SurfaceArrays {
    let knots = [0, 1].map(|axis| clamped(degree[axis], &inner[axis]));
    // The Greville abscissae.
    let places = [0, 1].map(|axis| {
        let (knots, degree) = (&knots[axis][1..knots[axis].len() - 1], degree[axis]);
        knots.windows(degree).map(|window| window.iter().sum::<f64>() / degree as f64).collect::<Vec<_>>()
    });
    let counts = [places[0].len(), places[1].len()];
    let mut control_points = Vec::new();
    for (i, &x) in places[0].iter().enumerate() {
        control_points.extend(places[1].iter().enumerate().map(|(j, &y)| [x, y, height(i, j), 1.0]));
    }
    SurfaceArrays { degree, counts, control_points, knots }
}

/// The bounds of the patches of a sheet over a plane with inner lines between and at those of the sheet, along
/// its axes or across.
fn bounds_over_plane(arrays: SurfaceArrays, swapped: bool) -> Vec<f64> {
    let inner = [vec![0.2, 0.37, 0.61], vec![0.25, 0.5, 0.9]];
    let [x, y] = inner;
    let mut plane = sheet([1, 1], &if swapped { [y, x] } else { [x, y] }, |_, _| 0.0);
    if swapped {
        plane.control_points.iter_mut().for_each(|point| point.swap(0, 1));
    }
    let a = Surfaces::new(vec![arrays], Flatness::None);
    let b = Surfaces::new(vec![plane], Flatness::None);
    let pair = Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY };
    let (chart, domain) = random_chart(&mut fastrand::Rng::with_seed(1), &b);
    let images = images(domain, swapped, [false; 2], || [0.0, 1.0]);
    let orientation = orientation(swapped, [false; 2]);
    let block = whole_block(&a);
    BlockMap { pair: &pair, sheets: a.sheets(), block: &block, chart: &chart, orientation, images }
        .upper_bounds()
        .unwrap()
}

/// A sheet at the same height everywhere is as far from the plane as its coefficients, and one control
/// point that is raised raises the bounds of the patches that it moves, up to its own height where the
/// basis function attains it.
#[test]
fn bounds_are_attained_over_a_plane() {
    for swapped in [false, true] {
        let inner = [vec![0.2, 0.4, 0.6, 0.8], vec![0.25, 0.5, 0.75]];
        for bound in bounds_over_plane(sheet([3, 2], &inner, |_, _| HEIGHT), swapped) {
            assert!((HEIGHT..HEIGHT * (1.0 + 1e-9)).contains(&bound), "{bound}");
        }
        for raised in [[0, 0], [3, 2], [4, 4], [7, 5]] {
            let height = |i: usize, j: usize| if [i, j] == raised { 2.0 * HEIGHT } else { HEIGHT };
            let bounds = bounds_over_plane(sheet([3, 2], &inner, height), swapped);
            for (index, bound) in bounds.into_iter().enumerate() {
                let place = [index / 4, index % 4];
                let is_moved = (place[0]..=place[0] + 3).contains(&raised[0])
                    && (place[1]..=place[1] + 2).contains(&raised[1]);
                assert_eq!(bound > HEIGHT * (1.0 + 1e-9), is_moved, "{raised:?} {place:?} {bound}");
                let is_corner = (raised, place) == ([0, 0], [0, 0]) || (raised, place) == ([7, 5], [4, 3]);
                assert!(!is_corner || (bound - 2.0 * HEIGHT).abs() <= 1e-9 * HEIGHT, "{bound}");
            }
        }
    }
}

/// Rational surfaces, images beyond the end of B and empty ones have no bound.
#[test]
fn there_is_no_bound_without_a_spline() {
    let rational = |mut arrays: SurfaceArrays| {
        let last = arrays.control_points.len() - 1;
        arrays.control_points[last][3] = 2.0;
        arrays
    };
    let inner = [vec![0.5], vec![0.5]];
    let polynomial = || sheet([2, 2], &inner, |_, _| 0.0);
    let whole_image = [[0.0, 2.0]; 2];
    let cases = [
        (polynomial(), polynomial(), whole_image, true),
        (rational(polynomial()), polynomial(), whole_image, false),
        (polynomial(), rational(polynomial()), whole_image, false),
        (polynomial(), polynomial(), [[0.0, 2.0], [0.0, 2.0 + 1e-9]], false),
        (polynomial(), polynomial(), [[-1e-9, 2.0], [0.0, 2.0]], false),
        (polynomial(), polynomial(), [[0.0, 2.0], [-1e-14, 2.0 + 1e-14]], true),
        (polynomial(), polynomial(), [[2.0 + 1e-9, 0.0], [0.0, 2.0]], false),
        (polynomial(), polynomial(), [[0.5, 0.5], [0.0, 2.0]], false),
        (polynomial(), polynomial(), [[2.25, 2.75], [0.0, 2.0]], false),
        (polynomial(), polynomial(), [[0.0, 2.0], [0.0, f64::NAN]], false),
    ];
    for (a, b, images, expected) in cases {
        let [a, b] = [a, b].map(|arrays| Surfaces::new(vec![arrays], Flatness::None));
        let pair = Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY };
        let chart = Chart::new(b.sheets(), 0, [0.5; 2]);
        let (orientation, block) = (orientation(false, [false; 2]), whole_block(&a));
        let map =
            BlockMap { pair: &pair, sheets: a.sheets(), block: &block, chart: &chart, orientation, images };
        let bounds = map.upper_bounds();
        assert_eq!(bounds.is_some(), expected, "{images:?}");
        assert!(bounds.is_none_or(|bounds| bounds.iter().all(|bound| *bound <= 1e-9)));
    }
}

/// Lemma R16: the error of a difference, from the sizes of its weights and from the errors of its knots.
#[test]
fn the_error_is_that_of_the_lemma() {
    let inner = [vec![], vec![]];
    let a = Surfaces::new(vec![sheet([3, 2], &inner, |_, _| 0.0)], Flatness::None);
    let b = Surfaces::new(vec![sheet([2, 2], &inner, |i, j| (i + j) as f64)], Flatness::None);
    let pair = Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY };
    let chart = Chart::new(b.sheets(), 0, [0.5; 2]);
    let (orientation, block) = (orientation(false, [false; 2]), whole_block(&a));
    let images = [[0.0, 1.0]; 2];
    let map = BlockMap { pair: &pair, sheets: a.sheets(), block: &block, chart: &chart, orientation, images };
    // Of a unit square, and of one that rises by 4 over it.
    let diagonals = [2.0_f64.sqrt(), 18.0_f64.sqrt()];
    let coefficients = |degree: usize, sizes: [f64; 2], change: f64, drift: f64| Coefficients {
        degree,
        of_a: Vec::new(),
        of_b: Vec::new(),
        windows: Vec::new(),
        offsets: 0..=0,
        sizes,
        change,
        drift,
    };
    for (sizes, change, drift) in [
        ([[3.0, 0.0], [5.0, 0.0]], [0.0; 2], [0.0; 2]),
        ([[0.0, 7.0], [0.0, 2.0]], [0.0; 2], [0.0; 2]),
        ([[0.0, 7.0], [0.0, 2.0]], [1e-3, 0.0], [0.0; 2]),
        ([[0.0, 7.0], [0.0, 2.0]], [0.0, 1e-3], [0.0; 2]),
        ([[0.0, 7.0], [0.0, 2.0]], [0.0; 2], [1e-3, 0.0]),
        ([[0.0, 7.0], [0.0, 2.0]], [0.0; 2], [0.0, 1e-3]),
    ] {
        let [u, v] = [0, 1].map(|axis| coefficients(3 - axis, sizes[axis], change[axis], drift[axis]));
        // Degrees 3 and 2: 24 · 5 + 16 and 8 · 5 + 24 roundings, and 66 of a rotation.
        let of_a = (200.0 + 66.0) * UNIT_ROUNDOFF * sizes[0][0] * sizes[1][0] * diagonals[0];
        let of_weights = 200.0 * UNIT_ROUNDOFF + change[0] + change[1];
        let of_knots = 2.0 * (drift[0] * sizes[1][1] + drift[1] * sizes[0][1]);
        let of_b = (of_weights * sizes[0][1] * sizes[1][1] + of_knots) * diagonals[1];
        let share = map.error([&u, &v]) / (of_a + of_b);
        assert!((1.0..=1.08).contains(&share), "{share}");
    }
}

/// Lines of A and of B count as one where they are closer than 10⁻¹² of the image, with their distance in the
/// error of the knots; of lines that agree it is the rounding of B's lines and of the map.
#[test]
fn the_error_of_knots_is_that_of_the_lines() {
    for (gap, expected_gap) in [(0.0, 0.0), (4e-13, 8e-13)] {
        let [a, b] = [0.5, 0.5 + gap].map(|line| {
            Surfaces::new(vec![sheet([3, 3], &[vec![line], vec![line]], |_, _| 0.0)], Flatness::None)
        });
        let pair = Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY };
        let chart = Chart::new(b.sheets(), 0, [0.5; 2]);
        let (orientation, block) = (orientation(false, [false; 2]), whole_block(&a));
        let images = [[0.0, chart.line(Axis::U, 2)]; 2];
        let map =
            BlockMap { pair: &pair, sheets: a.sheets(), block: &block, chart: &chart, orientation, images };
        let sequence = KnotSequence::new(&map.axis(Axis::U)).unwrap();
        assert_eq!(sequence.knots.len(), 4 + 1 + 4);
        assert_eq!(sequence.knots[4], Knot { parameter: 0.5, image: 1.0 });
        let line_error = chart.line_error(Axis::U, 2);
        let expected = expected_gap + line_error + 8.0 * UNIT_ROUNDOFF * images[0][1];
        let share = sequence.error / expected;
        assert!(line_error > 0.0 && (0.99..=1.01).contains(&share), "{share}");
    }
}

/// The sizes of weights and the changes by errors of knots, by hand: cubics with one inner knot at a
/// quarter. At the knots 0, ¼, 1 the weights of the second span have the size 5/3, of the first 7.
#[test]
fn sizes_and_changes_are_those_of_the_widest_spans() {
    let inner = [vec![0.25], vec![0.25]];
    let [a, b] = [(); 2].map(|()| Surfaces::new(vec![sheet([3, 3], &inner, |_, _| 0.0)], Flatness::None));
    let pair = Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY };
    let chart = Chart::new(b.sheets(), 0, [0.5; 2]);
    let (orientation, block) = (orientation(false, [false; 2]), whole_block(&a));
    let images = [[0.0, 4.0]; 2];
    let map = BlockMap { pair: &pair, sheets: a.sheets(), block: &block, chart: &chart, orientation, images };
    let error = KnotSequence::new(&map.axis(Axis::U)).unwrap().error;
    let Coefficients { sizes, change, drift, windows, .. } = map.coefficients(Axis::U).unwrap();
    for size in sizes {
        assert!((size - 5.0 / 3.0).abs() <= 1e-14, "{size}");
    }
    assert_eq!(windows, [[0, 3], [1, 4]]);
    // At the start arguments are of the first span, of width 1, and so is the steepest derivative.
    assert!((change / (1.02 * 6.0 * 3.0 * error) - 1.0).abs() <= 1e-12);
    assert!((drift / (6.0 * 3.0 * error) - 1.0).abs() <= 1e-12);
}
