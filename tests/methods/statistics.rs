//! Statistics as intervals, where integrals and order statistics have formulas.

use glam::DVec3;
use nurbs_hausdorff::options::Audit;
use nurbs_hausdorff::shapes::sphere;
use nurbs_hausdorff::{
    CertifiedStatistics, Engine, Facets, Interval, Measure, Model, PointCloud, PreparedModel, RigidTransform,
    StatisticsOptions, SurfaceArrays, TriangleMesh,
};
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, FRAC_PI_4, PI, SQRT_2};

fn statistics(a: &PreparedModel, b: &PreparedModel, options: &StatisticsOptions) -> CertifiedStatistics {
    Engine::cpu().statistics(a, b, options).wait().unwrap()
}

fn with_limit(limit: f64) -> StatisticsOptions {
    StatisticsOptions {
        relative_tolerance: Some(1e-3),
        percentiles: vec![0.1, 0.5, 0.95],
        limit: Some(limit),
        ..StatisticsOptions::default()
    }
}

/// Checks that an interval holds a number and is as narrow as requested.
fn holds(of: Interval, value: f64, width: f64) {
    assert!(of.lower <= value && value <= of.upper && of.upper - of.lower <= width, "{value} {of:?}");
}

/// Checks all intervals: the mean, the root mean square, percentiles, and the part beyond the limit.
fn are(
    found: &CertifiedStatistics,
    [mean, rms, beyond]: [f64; 3],
    part_tolerance: f64,
    percentile: impl Fn(f64) -> f64,
) {
    assert!(found.converged, "{found:?}");
    holds(found.mean, mean, found.tolerance);
    holds(found.rms, rms, found.tolerance);
    for of in &found.percentiles {
        holds(of.distance, percentile(of.part), found.tolerance);
    }
    holds(found.beyond.unwrap().part, beyond, part_tolerance);
}

/// The square [low, high]² in triangles, at heights.
fn sheet([low, high]: [f64; 2], count: usize, height: impl Fn(f64, f64) -> f64) -> PreparedModel {
    let at = |k: usize| low + (high - low) * k as f64 / count as f64;
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for i in 0..=count {
        vertices.extend((0..=count).map(|j| DVec3::new(at(i), at(j), height(at(i), at(j)))));
    }
    for i in 0..count {
        for j in 0..count {
            let place = |i: usize, j: usize| (i * (count + 1) + j) as u32;
            let [a, b, c, d] = [place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    let mesh = TriangleMesh::new(&vertices, &triangles).unwrap();
    PreparedModel::of_facets(&Facets::Mesh(mesh), None).unwrap()
}

fn cloud(points: &[DVec3]) -> PreparedModel {
    PreparedModel::of_facets(&Facets::Cloud(PointCloud::new(points.to_vec()).unwrap()), None).unwrap()
}

fn ball(radius: f64) -> PreparedModel {
    PreparedModel::new(&sphere(DVec3::ZERO, radius).unwrap()).unwrap()
}

#[test]
fn parallel_sheets_have_one_distance() {
    let [one, other] = [sheet([0.0, 1.0], 3, |_, _| 0.0), sheet([-1.0, 2.0], 1, |_, _| 0.375)];
    let found = statistics(&one, &other, &with_limit(0.3));
    are(&found, [0.375, 0.375, 1.0], 1e-3, |_| 0.375);
    assert_eq!(found.over, Measure::Area);
    holds(found.total, 1.0, 1e-12);
    // The bounds are attained: each triangle lies above one of B, and none is halved.
    assert_eq!(found.cells, 18);
    let up = RigidTransform::translation(DVec3::new(0.0, 0.0, 0.25)).unwrap();
    let found = statistics(&one, &other, &StatisticsOptions { transform: up, ..with_limit(0.3) });
    are(&found, [0.125, 0.125, 0.0], 1e-3, |_| 0.125);
}

/// Above a plane the distance of a slope is uniform between its ends.
#[test]
fn a_slope_above_a_plane_has_a_uniform_distance() {
    let [slope, ground] = [sheet([0.0, 1.0], 4, |x, _| x), sheet([-2.0, 3.0], 3, |_, _| 0.0)];
    let found = statistics(&slope, &ground, &with_limit(0.25));
    are(&found, [0.5, (1.0 / 3.0_f64).sqrt(), 0.75], 1e-3, |part| part);
    holds(found.total, SQRT_2, 1e-12);
}

/// On a sphere the squared distance from a point is uniform, as its height is (Archimedes).
#[test]
fn a_sphere_has_the_distances_of_archimedes_from_a_point() {
    let (radius, height) = (1.0_f64, 2.5_f64);
    let point = cloud(&[DVec3::new(0.0, 0.0, height)]);
    let squared = |part: f64| (height - radius).powi(2) + 4.0 * radius * height * part;
    let limit = 2.0_f64;
    let beyond = 1.0 - (limit * limit - squared(0.0)) / (squared(1.0) - squared(0.0));
    let options = StatisticsOptions { relative_tolerance: Some(1e-2), ..with_limit(limit) };
    let options = StatisticsOptions { part_tolerance: 1e-2, ..options };
    let found = statistics(&ball(radius), &point, &options);
    assert!(found.converged, "{found:?}");
    holds(found.total, 4.0 * PI * radius * radius, 1e-3);
    holds(found.mean, height + radius * radius / (3.0 * height), found.tolerance);
    holds(found.rms, (radius * radius + height * height).sqrt(), found.tolerance);
    for of in &found.percentiles {
        holds(of.distance, squared(of.part).sqrt(), found.tolerance);
    }
    holds(found.beyond.unwrap().part, beyond, 1e-2);
}

#[test]
fn points_are_counted() {
    let distances = [0.5, 0.125, 0.75, 0.25, 1.0, 0.0];
    let points: Vec<DVec3> = distances.iter().map(|distance| DVec3::X * (1.0 + distance)).collect();
    for b in [ball(1.0), cloud(&[DVec3::X])] {
        let options = StatisticsOptions {
            percentiles: vec![0.5, 0.51, 0.99],
            limit: Some(0.6),
            ..StatisticsOptions::default()
        };
        let found = statistics(&cloud(&points), &b, &options);
        assert!(found.converged && found.over == Measure::Count, "{found:?}");
        holds(found.total, 6.0, 1e-12);
        holds(found.mean, distances.iter().sum::<f64>() / 6.0, found.tolerance);
        let squares: f64 = distances.iter().map(|distance| distance * distance).sum();
        holds(found.rms, (squares / 6.0).sqrt(), found.tolerance);
        for (of, expected) in found.percentiles.iter().zip([0.25, 0.5, 1.0]) {
            holds(of.distance, expected, found.tolerance);
        }
        holds(found.beyond.unwrap().part, 2.0 / 6.0, 1e-9);
    }
}

/// Surfaces as B are measured by a mesh that stands for them, whose error is in the intervals.
#[test]
fn a_square_in_a_sphere_has_the_distances_of_its_points() {
    let square = sheet([0.25, 0.75], 2, |_, _| 0.0);
    let options =
        StatisticsOptions { relative_tolerance: Some(5e-3), part_tolerance: 0.025, ..with_limit(1.25) };
    let found = statistics(&square, &ball(2.0), &options);
    let count = 1000;
    let at = |k: usize| 0.25 + 0.5 * (k as f64 + 0.5) / count as f64;
    let mut distances: Vec<f64> =
        (0..count * count).map(|k| 2.0 - at(k / count).hypot(at(k % count))).collect();
    distances.sort_by(f64::total_cmp);
    let mean =
        |of: &dyn Fn(f64) -> f64| distances.iter().map(|&d| of(d)).sum::<f64>() / distances.len() as f64;
    let rms = mean(&|d| d * d).sqrt();
    let beyond = mean(&|d| f64::from(u8::from(d > 1.25)));
    are(&found, [mean(&|d| d), rms, beyond], 0.025, |part| {
        distances[(part * distances.len() as f64) as usize]
    });
}

#[test]
fn a_budget_leaves_valid_intervals_and_no_area_is_an_error() {
    let [slope, ground] = [sheet([0.0, 1.0], 1, |x, _| x), sheet([-2.0, 3.0], 1, |_, _| 0.0)];
    for max_cells in [1, 10, 100] {
        let options = StatisticsOptions { max_cells, ..with_limit(0.25) };
        let found = statistics(&slope, &ground, &options);
        assert!(!found.converged && found.cells <= max_cells.max(2));
        holds(found.mean, 0.5, 1.0 + 1e-9);
        found.percentiles.iter().for_each(|of| holds(of.distance, of.part, 1.0 + 1e-9));
        holds(found.beyond.unwrap().part, 0.75, 1.0);
    }
    let line = TriangleMesh::new(&[DVec3::ZERO, DVec3::X, 2.0 * DVec3::X], &[[0, 1, 2]]).unwrap();
    let line = PreparedModel::of_facets(&Facets::Mesh(line), None).unwrap();
    let refused = Engine::cpu().statistics(&line, &ground, &StatisticsOptions::default()).wait();
    assert_eq!(refused.unwrap_err().code(), "NO_AREA");
}

/// A point in homogeneous coordinates: not multiplied by its weight.
type Control = [f64; 4];

/// A quarter of a circle about the z axis.
fn arc(radius: f64, quarter: usize, z: f64) -> [Control; 3] {
    let at = |angle: f64, radius: f64, w: f64| [radius * angle.cos(), radius * angle.sin(), z, w];
    let start = FRAC_PI_2 * quarter as f64 - FRAC_PI_4;
    [
        at(start, radius, 1.0),
        at(start + FRAC_PI_4, SQRT_2 * radius, FRAC_1_SQRT_2),
        at(start + FRAC_PI_2, radius, 1.0),
    ]
}

/// A side of the square [-half, half]² as a curve of degree 2.
fn side(half: f64, quarter: usize, z: f64) -> [Control; 3] {
    let corners = [[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]];
    let [from, to] = [corners[quarter], corners[(quarter + 1) % 4]];
    [0.0, 0.5, 1.0].map(|at: f64| {
        let [x, y] = [0, 1].map(|axis| half * (from[axis] + at * (to[axis] - from[axis])));
        [x, y, z, 1.0]
    })
}

/// The surface of the lines between two curves of degree 2.
fn ruled(one: [Control; 3], other: [Control; 3]) -> SurfaceArrays {
    SurfaceArrays {
        degree: [2, 1],
        knots: [vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
        counts: [3, 2],
        control_points: (0..3).flat_map(|k| [one[k], other[k]]).collect(),
    }
}

fn model(surfaces: Vec<SurfaceArrays>) -> PreparedModel {
    PreparedModel::new(&Model::from_arrays(None, surfaces).unwrap()).unwrap()
}

/// The plate [-4, 4]² × [0, 1] with a bore.
fn plate(radius: f64) -> PreparedModel {
    let of_quarter = |k: usize| {
        [
            ruled(arc(radius, k, 0.0), side(4.0, k, 0.0)),
            ruled(arc(radius, k, 1.0), side(4.0, k, 1.0)),
            ruled(arc(radius, k, 0.0), arc(radius, k, 1.0)),
            ruled(side(4.0, k, 0.0), side(4.0, k, 1.0)),
        ]
    };
    model((0..4).flat_map(of_quarter).collect())
}

fn of_means(relative_tolerance: f64) -> StatisticsOptions {
    StatisticsOptions {
        relative_tolerance: Some(relative_tolerance),
        percentiles: Vec::new(),
        ..StatisticsOptions::default()
    }
}

/// The wall of the bore is as far as the radii differ, the faces within the larger one as far as its
/// rim; all other points lie on both.
#[test]
fn a_plate_with_a_wider_bore_has_the_distances_of_its_rim() {
    let (small, large) = (1.0_f64, 1.05_f64);
    let found = statistics(&plate(small), &plate(large), &of_means(1e-4));
    assert!(found.converged, "{found:?}");
    let area = 2.0 * (64.0 - PI * small * small) + 32.0 + 2.0 * PI * small;
    holds(found.total, area, 1e-4);
    // ∫ (R − r)ⁿ 2πr over a ring.
    let ring = |n: i32| {
        let inner = large - small;
        2.0 * PI * (large * inner.powi(n + 1) / f64::from(n + 1) - inner.powi(n + 2) / f64::from(n + 2))
    };
    let wall = |n: i32| 2.0 * PI * small * (large - small).powi(n);
    holds(found.mean, (2.0 * ring(1) + wall(1)) / area, found.tolerance);
    holds(found.rms, ((2.0 * ring(2) + wall(2)) / area).sqrt(), found.tolerance);
    assert!(found.cells < 10_000, "{}", found.cells);
}

/// Between two cylinders about one axis the distance is the same everywhere.
#[test]
fn a_cylinder_in_another_one_takes_few_parts() {
    let cylinder = |radius: f64, [low, high]: [f64; 2]| {
        model((0..4).map(|k| ruled(arc(radius, k, low), arc(radius, k, high))).collect())
    };
    let [one, other] = [cylinder(1.0, [0.0, 1.0]), cylinder(1.25, [-1.0, 2.0])];
    let found = statistics(&one, &other, &with_limit(0.2));
    are(&found, [0.25, 0.25, 1.0], 1e-3, |_| 0.25);
    assert!(found.cells < 3000, "{}", found.cells);
}

/// The distance of a slope of triangles from a surface is uniform.
#[test]
fn a_slope_of_triangles_above_a_surface_has_a_uniform_distance() {
    let slope = sheet([0.0, 1.0], 2, |x, _| x);
    let line = |y: f64| [-2.0, 0.5, 3.0].map(|x| [x, y, 0.0, 1.0]);
    let ground = model(vec![ruled(line(-2.0), line(3.0))]);
    let found = statistics(&slope, &ground, &with_limit(0.25));
    are(&found, [0.5, (1.0 / 3.0_f64).sqrt(), 0.75], 1e-3, |part| part);
    holds(found.total, SQRT_2, 1e-12);
}

/// Where the time is over at once, nothing is measured and the intervals hold: of a cloud, of triangles and of surfaces,
/// before surfaces and before triangles.
#[test]
fn without_time_the_intervals_still_hold() {
    let (one, other) = (ball(1.0), ball(1.5));
    let mesh = sheet([0.0, 0.25], 4, |_, _| 0.5);
    let points = cloud(&[DVec3::X, DVec3::Y, DVec3::Z]);
    let options = StatisticsOptions {
        max_seconds: Some(f64::MIN_POSITIVE),
        limit: Some(0.3),
        ..StatisticsOptions::default()
    };
    for (a, b, mean) in [(&one, &other, 0.5), (&points, &other, 0.5), (&points, &mesh, f64::NAN)] {
        let found = statistics(a, b, &options);
        assert!(!found.converged, "{found:?}");
        assert!(mean.is_nan() || found.mean.lower <= mean && mean <= found.mean.upper, "{found:?}");
        assert_eq!((found.mean.lower, found.beyond.unwrap().part.upper), (0.0, 1.0));
        assert!(found.mean.upper.is_finite() && found.mean.upper >= 0.5, "{found:?}");
        assert_eq!(found.percentiles[0].distance.lower, 0.0);
    }
    for (a, b) in [(&mesh, &other), (&one, &mesh), (&mesh, &mesh)] {
        let found = statistics(a, b, &options);
        let measured = statistics(a, b, &with_limit(0.3));
        assert!(!found.converged && found.mean.upper >= measured.mean.lower, "{found:?}");
        assert!(found.cells < measured.cells || !found.converged);
    }
}

/// Parts that are asked for where their number is not what is tested.
const FEW_PARTS: usize = 20_000;

/// The parts that a result rests on are audited: a share by default, all of them on request.
#[test]
fn parts_are_audited() {
    let one = ball(1.0);
    for other in [ball(1.5), sheet([-1.0, 1.0], 3, |x, y| x * y)] {
        let options = StatisticsOptions { max_cells: FEW_PARTS, ..with_limit(0.3) };
        let share = statistics(&one, &other, &options);
        let options = StatisticsOptions { audit: Audit::All, ..options };
        let all = statistics(&one, &other, &options);
        assert!(share.audit.cells >= 8 && share.audit.cells < all.audit.cells, "{:?}", share.audit);
        assert!(all.audit.cells <= all.cells && 2 * all.audit.cells > all.cells, "{:?}", all.audit);
        assert!(share.audit.points > share.audit.cells && all.audit.points > 8 * all.audit.cells);
        assert!(
            share.notice.is_none() && all.notice.is_none() && all.audit.struck.is_empty(),
            "{:?}",
            all.notice
        );
        assert_eq!((share.mean, share.rms), (all.mean, all.rms));
    }
}
