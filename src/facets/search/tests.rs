//! The search against analytic distances and against samples of random models.

use super::*;
use crate::bezier::{PatchSet, extract};
use crate::facets::{FacetTarget, PointCloud, TriangleMesh};
use crate::model::{Model, SurfaceArrays};
use glam::DQuat;

const TOLERANCE: f64 = 1e-6;

/// A finished search.
struct Found {
    lower: f64,
    upper: f64,
    cells: usize,
    end: End,
    witness: Witness,
}

fn measure(a: Source<'_>, b: Measured<'_>, transform: RigidTransform, tolerance: f64) -> Found {
    let mut search = FacetSearch::new(a, b, transform, tolerance, None);
    let end = loop {
        if let Some(end) = search.advance(usize::MAX) {
            break end;
        }
        assert!(search.work().cells < 3_000_000, "{:?}", search.interval());
    };
    let [lower, upper] = search.interval();
    assert!(lower <= upper && upper - lower <= tolerance, "[{lower}, {upper}] in {}", search.work().cells);
    let witness = *search.witness().unwrap();
    assert!(witness.closest.lower - 1e-9 <= lower && witness.closest.upper <= upper);
    Found { lower, upper, cells: search.work().cells, end, witness }
}

fn of_facets(facets: &FacetTarget) -> Source<'_> {
    Source::Facets { facets, error: 0.0 }
}

fn to_facets(facets: &FacetTarget) -> Measured<'_> {
    Measured::Facets { facets, error: 0.0 }
}

fn between(a: &FacetTarget, b: &FacetTarget) -> Found {
    measure(of_facets(a), to_facets(b), RigidTransform::IDENTITY, TOLERANCE)
}

fn mesh(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> FacetTarget {
    let vertices: Vec<DVec3> = vertices.iter().copied().map(DVec3::from_array).collect();
    FacetTarget::of_mesh(&TriangleMesh::new(&vertices, triangles).unwrap())
}

fn cloud(points: &[DVec3]) -> FacetTarget {
    FacetTarget::of_cloud(&PointCloud::new(points.to_vec()).unwrap())
}

/// A sheet over the unit square of these numbers of cells, each cut along the diagonal `turned` or not.
fn sheet(counts: [usize; 2], turned: bool, height: impl Fn(f64, f64) -> f64) -> FacetTarget {
    let [m, n] = counts;
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for i in 0..=m {
        for j in 0..=n {
            let [x, y] = [i as f64 / m as f64, j as f64 / n as f64];
            vertices.push([x, y, height(x, y)]);
        }
    }
    for i in 0..m {
        for j in 0..n {
            let at = |i: usize, j: usize| (i * (n + 1) + j) as u32;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            triangles.extend(if turned { [[a, b, d], [b, c, d]] } else { [[a, b, c], [a, c, d]] });
        }
    }
    mesh(&vertices, &triangles)
}

fn contains(found: &Found, distance: f64) {
    let Found { lower, upper, .. } = *found;
    assert!(lower <= distance && distance <= upper, "{distance} is not in [{lower}, {upper}]");
}

#[test]
fn sheets_in_other_triangles_are_at_their_distance() {
    let flat = |_: f64, _: f64| 0.0;
    let sheets = [sheet([7, 5], false, flat), sheet([3, 11], true, flat), sheet([1, 1], false, flat)];
    for a in &sheets {
        for b in &sheets {
            // The cuts follow the edges of B: without them there would be a million cells an edge.
            let found = between(a, b);
            contains(&found, 0.0);
            assert!(found.cells < 20_000, "{}", found.cells);
            assert_eq!(found.end, End::Searched);
            let up = RigidTransform::translation(DVec3::new(0.0, 0.0, 0.375)).unwrap();
            contains(&measure(of_facets(a), to_facets(b), up, TOLERANCE), 0.375);
        }
    }
}

/// Of a roof above its ground the ridge is farthest, and of the ground the foot of the ridge.
#[test]
fn a_roof_is_at_the_distances_of_its_ridge() {
    let roof = sheet([2, 1], true, |x, _| 0.5 - (x - 0.5).abs());
    let ground = sheet([3, 4], false, |_, _| 0.0);
    let found = between(&roof, &ground);
    contains(&found, 0.5);
    assert!((found.witness.point.z - 0.5).abs() < 1e-5);
    // The foot of the perpendicular on a slope of 45 degrees.
    contains(&between(&ground, &roof), 0.5 * 0.5_f64.sqrt());
}

/// The farthest point of a square from its corners is the centre.
#[test]
fn the_farthest_point_from_points_is_a_corner_of_their_cells() {
    let corners = cloud(&[DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(1.0, 1.0, 0.0)]);
    contains(&between(&sheet([1, 1], false, |_, _| 0.0), &corners), 0.5_f64.sqrt());
    contains(&between(&sheet([5, 3], true, |_, _| 0.0), &corners), 0.5_f64.sqrt());
    let far = cloud(&[DVec3::new(0.25, 0.5, -2.0), DVec3::new(3.0, 1.0, 0.0)]);
    contains(&between(&far, &sheet([5, 3], true, |_, _| 0.0)), 2.0);
    contains(&between(&far, &corners), (0.25_f64.powi(2) + 0.25 + 4.0).sqrt());
    let single = cloud(&[DVec3::new(0.0, 0.0, 1.0)]);
    contains(&between(&single, &single), 0.0);
    contains(&between(&corners, &single), 3.0_f64.sqrt());
}

fn random_point(random: &mut fastrand::Rng) -> DVec3 {
    DVec3::from_array([0; 3].map(|_| random.f64()))
}

fn random_mesh(random: &mut fastrand::Rng) -> TriangleMesh {
    let count = random.u32(3..9);
    let vertices: Vec<DVec3> = (0..count).map(|_| random_point(random)).collect();
    // Some are degenerate.
    let triangles: Vec<[u32; 3]> =
        (0..random.u32(1..12)).map(|_| [0; 3].map(|_| random.u32(0..count))).collect();
    TriangleMesh::new(&vertices, &triangles).unwrap()
}

/// Distances by an independent formula: the points of a fine grid on every triangle.
fn grid(mesh: &TriangleMesh, steps: usize) -> Vec<DVec3> {
    let mut points = Vec::new();
    for triangle in 0..mesh.triangles().len() {
        let [a, b, c] = mesh.corners(triangle);
        for i in 0..=steps {
            for j in 0..=steps - i {
                let [s, t] = [i as f64 / steps as f64, j as f64 / steps as f64];
                points.push(a * (1.0 - s - t) + b * s + c * t);
            }
        }
    }
    points
}

/// No sample of A is farther than `upper`, nor, within their spacing, all nearer than `lower`; a
/// sampled B is farther by at most its spacing.
#[test]
fn random_meshes_and_clouds_agree_with_samples() {
    let random = &mut fastrand::Rng::with_seed(31);
    let steps = 24;
    let spacing = 3.0_f64.sqrt() / steps as f64;
    for round in 0..60 {
        let meshes = [random_mesh(random), random_mesh(random)];
        let points: Vec<DVec3> = (0..random.usize(1..40)).map(|_| random_point(random)).collect();
        let grids = meshes.each_ref().map(|mesh| grid(mesh, steps));
        let targets = meshes.each_ref().map(FacetTarget::of_mesh);
        let axis = random_point(random);
        let transform =
            RigidTransform::new(DQuat::from_axis_angle(axis.normalize(), random.f64()), random_point(random))
                .unwrap();
        let farthest = |a: &[DVec3], b: &[DVec3]| {
            let nearest = |point: &DVec3| {
                let moved = transform.apply(*point);
                b.iter().map(|other| other.distance(moved)).fold(f64::INFINITY, f64::min)
            };
            a.iter().map(nearest).fold(0.0, f64::max)
        };
        let check = |a: &FacetTarget, b: &FacetTarget, sampled: f64, [of_a, of_b]: [f64; 2]| {
            let found = measure(of_facets(a), to_facets(b), transform, 1e-5);
            assert!(sampled - of_b <= found.upper && found.lower <= sampled + of_a, "round {round}");
        };
        let cloud = cloud(&points);
        check(&targets[0], &targets[1], farthest(&grids[0], &grids[1]), [spacing, spacing]);
        check(&targets[0], &cloud, farthest(&grids[0], &points), [spacing, 0.0]);
        check(&cloud, &targets[0], farthest(&points, &grids[0]), [1e-12, spacing]);
        check(&cloud, &cloud, farthest(&points, &points), [1e-12, 1e-12]);
    }
}

/// The patches of one surface of bidegree (degree, 1).
fn patches(degree: usize, controls: Vec<[f64; 4]>) -> PatchSet {
    let clamped = |degree: usize| [vec![0.0; degree + 1], vec![1.0; degree + 1]].concat();
    let surface = SurfaceArrays {
        degree: [degree, 1],
        knots: [clamped(degree), clamped(1)],
        counts: [degree + 1, 2],
        control_points: controls,
    };
    extract(&Model::from_arrays(None, vec![surface]).unwrap()).patches
}

fn of_patches(patches: &PatchSet) -> Source<'_> {
    Source::Patches { patches, error: 1e-14, control_box: patches.bounding_box() }
}

/// A quarter of a cylinder of radius 1 is above its inscribed polyhedron by the sagitta of a chord,
/// and a flat sheet on flat triangles by nothing.
#[test]
fn a_cylinder_is_a_sagitta_above_its_chords() {
    let w = 0.5_f64.sqrt();
    let arc = [[1.0, 0.0, 1.0], [1.0, 1.0, w], [0.0, 1.0, 1.0]];
    let quarter = patches(2, arc.iter().flat_map(|&[x, y, w]| [[x, y, 0.0, w], [x, y, 1.0, w]]).collect());
    for count in [1, 2, 5, 16] {
        let mut vertices = Vec::new();
        for k in 0..=count {
            let (y, x) = (std::f64::consts::FRAC_PI_2 * k as f64 / count as f64).sin_cos();
            vertices.extend([[x, y, 0.0], [x, y, 1.0]]);
        }
        let triangles: Vec<[u32; 3]> = (0..count as u32)
            .flat_map(|k| [[2 * k, 2 * k + 1, 2 * k + 2], [2 * k + 1, 2 * k + 3, 2 * k + 2]])
            .collect();
        let found = measure(
            of_patches(&quarter),
            to_facets(&mesh(&vertices, &triangles)),
            RigidTransform::IDENTITY,
            TOLERANCE,
        );
        contains(&found, 1.0 - (std::f64::consts::FRAC_PI_4 / count as f64).cos());
    }
    let flat = patches(
        1,
        vec![[0.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0], [1.0, 1.0, 0.0, 1.0]],
    );
    let b = sheet([6, 7], true, |_, _| 0.0);
    let found = measure(of_patches(&flat), to_facets(&b), RigidTransform::IDENTITY, TOLERANCE);
    contains(&found, 0.0);
    assert!(found.cells < 1000, "{}", found.cells);
}

/// Planes in other triangles, at any height, are decided by covers: a cell a triangle and, where boxes
/// may be decided, a node. Cuts along the reach of single facets took three millions.
#[test]
fn parallel_planes_take_few_cells() {
    for apart in [1e-6, 1e-5, 1e-4, 1e-3, 0.1, 1.0] {
        for [[m, n], [k, l]] in [[[2, 2], [3, 3]], [[7, 5], [3, 11]], [[1, 1], [9, 9]]] {
            let (a, b) = (sheet([m, n], false, |_, _| 0.0), sheet([k, l], true, |_, _| apart));
            let found = between(&a, &b);
            contains(&found, apart);
            let most = 4 * m * n + 16;
            assert!(found.cells <= most, "{} of {most} cells at {apart}", found.cells);
        }
    }
}

/// A sphere's triangles, subdivided.
fn shell(subdivisions: usize, radius: f64) -> TriangleMesh {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X, -DVec3::Y, -DVec3::Z];
    let mut triangles: Vec<[DVec3; 3]> = Vec::new();
    for octant in 0..8 {
        let [x, y, z] = [0, 1, 2].map(|axis| axes[axis + 3 * (octant >> axis & 1)]);
        triangles.push([x, y, z]);
    }
    for _ in 0..subdivisions {
        let middle = |one: DVec3, other: DVec3| (0.5 * (one + other)).normalize();
        triangles = triangles
            .into_iter()
            .flat_map(|[a, b, c]| {
                let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    let vertices: Vec<DVec3> = triangles.iter().flatten().map(|&corner| radius * corner).collect();
    let corners: Vec<[u32; 3]> = (0..triangles.len() as u32).map(|k| [0, 1, 2].map(|c| 3 * k + c)).collect();
    TriangleMesh::new(&vertices, &corners).unwrap()
}

/// The vertices moved, the triangles in four or in another order.
fn changed(mesh: &TriangleMesh, map: impl Fn(DVec3) -> DVec3, is_divided: bool, order: usize) -> FacetTarget {
    let mut triangles: Vec<[DVec3; 3]> = (0..mesh.triangles().len()).map(|k| mesh.corners(k)).collect();
    if is_divided {
        triangles = triangles
            .into_iter()
            .flat_map(|[a, b, c]| {
                let [ab, bc, ca] = [0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)];
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    triangles
        .sort_by_key(|[a, ..]| (a.to_array().map(f64::to_bits)[order % 3]).wrapping_mul(order as u64 | 1));
    let vertices: Vec<DVec3> = triangles.iter().flatten().map(|&corner| map(corner)).collect();
    let corners: Vec<[u32; 3]> =
        (0..triangles.len() as u32).map(|k| [0, 1, 2].map(|c| 3 * k + (c + order as u32) % 3)).collect();
    FacetTarget::of_mesh(&TriangleMesh::new(&vertices, &corners).unwrap())
}

/// Identical, re-ordered, rounded, subdivided and offset copies: at most about one cell a triangle, and a
/// few for the nodes of many.
#[test]
fn copies_and_offsets_take_a_cell_a_triangle() {
    let mesh = shell(4, 1.0);
    let a = FacetTarget::of_mesh(&mesh);
    let rounded = |p: DVec3| p.as_vec3().as_dvec3();
    let copies = [
        (changed(&mesh, |p| p, false, 0), 0.0),
        (changed(&mesh, |p| p, false, 7), 0.0),
        (changed(&mesh, rounded, false, 1), 0.0),
        (changed(&mesh, |p| p, true, 5), 0.0),
        (changed(&mesh, |p| 1.01 * p, false, 2), 0.01),
        (changed(&mesh, |p| 1.5 * p, false, 0), 0.5),
    ];
    for (b, apart) in &copies {
        for [from, to] in [[&a, b], [b, &a]] {
            let found = between(from, to);
            // Facets of a sphere are nearer than its corners by their sagitta.
            assert!((found.lower - apart).abs() <= 2e-3 + 1e-2 * apart, "{} {apart}", found.lower);
            // Boxes smaller than the distance are bounded too.
            let nodes = if *apart < 0.1 { from.len() / 64 } else { from.len() };
            let most = from.len() + nodes + 16;
            assert!(found.cells <= most, "{} of {most} cells at {apart}", found.cells);
        }
    }
}

/// Every part and node that a bound drops is audited at points of it, by all facets one by one.
#[test]
fn no_point_of_what_a_search_drops_is_beyond_its_bound() {
    let random = &mut fastrand::Rng::with_seed(83);
    let mut counts = [0; 2];
    for _ in 0..300 {
        let a = FacetTarget::of_mesh(&random_mesh(random));
        let b = if random.bool() { FacetTarget::of_mesh(&random_mesh(random)) } else { a.clone() };
        let shift = 10.0_f64.powi(random.i32(-8..0)) * random_point(random);
        let transform = RigidTransform::new(DQuat::from_rotation_z(0.1 * random.f64()), shift).unwrap();
        let mut search = FacetSearch::new(of_facets(&a), to_facets(&b), transform, 1e-4, None);
        let audit = std::sync::Arc::new(Audit::default());
        search.audit = Some(std::sync::Arc::clone(&audit));
        while search.advance(usize::MAX).is_none() && search.work().cells < 20_000 {}
        assert_eq!(audit.refuted(), Vec::<String>::new());
        counts = [0, 1].map(|index| counts[index] + audit.counts()[index]);
    }
    assert!(counts[0] > 3000 && counts[1] > 30_000, "{counts:?}");
}
