//! Meshes and clouds of points against surfaces and each other, where the distance has a formula.

use glam::{DQuat, DVec3};
use nurbs_hausdorff::shapes::{cylinder, sphere, torus};
use nurbs_hausdorff::{
    Backend, CertifiedOptions, ClosestPointOptions, DistanceOptions, DistanceResult, Engine, Facets,
    FieldOptions, Method, MethodName, Model, PointCloud, PreparedModel, RigidTransform, Side, Signs,
    TriangleMesh,
};
use std::f64::consts::PI;

fn engine() -> Engine {
    pollster::block_on(Engine::new(Backend::Cpu)).unwrap()
}

fn measure(a: &PreparedModel, b: &PreparedModel, options: &DistanceOptions) -> DistanceResult {
    pollster::block_on(engine().distance(a, b, options)).unwrap()
}

/// Checks that the interval is as narrow as requested and holds the distance.
fn contains(a: &PreparedModel, b: &PreparedModel, distance: f64) -> DistanceResult {
    let result = measure(a, b, &DistanceOptions::default());
    let [lower, upper] = [result.lower, result.upper];
    assert!(result.converged && upper - lower <= 1e-6 * result.diagonal, "[{lower}, {upper}]");
    assert!(lower <= distance && distance <= upper, "{distance} is not in [{lower}, {upper}]");
    result
}

fn surfaces(model: &Model) -> PreparedModel {
    PreparedModel::new(model).unwrap()
}

fn mesh(vertices: &[DVec3], triangles: &[[u32; 3]]) -> PreparedModel {
    PreparedModel::of_facets(&Facets::Mesh(TriangleMesh::new(vertices, triangles).unwrap()), None).unwrap()
}

fn cloud(points: &[DVec3]) -> PreparedModel {
    PreparedModel::of_facets(&Facets::Cloud(PointCloud::new(points.to_vec()).unwrap()), None).unwrap()
}

/// The triangles of a grid of points that closes in its second direction.
fn strips(rings: &[Vec<DVec3>], closes: bool) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let (count, mut triangles) = (rings[0].len(), Vec::new());
    let last = if closes { rings.len() } else { rings.len() - 1 };
    for i in 0..last {
        for j in 0..count {
            let at = |i: usize, j: usize| (i % rings.len() * count + j % count) as u32;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    (rings.concat(), triangles)
}

fn ring(radius: f64, z: f64, count: usize) -> Vec<DVec3> {
    (0..count)
        .map(|k| {
            let (y, x) = (2.0 * PI * k as f64 / count as f64).sin_cos();
            DVec3::new(radius * x, radius * y, z)
        })
        .collect()
}

#[test]
fn a_cylinder_and_its_prism_are_a_sagitta_apart() {
    let exact = surfaces(&cylinder(2.0, 3.0).unwrap());
    let [low, high] = [exact.bounding_box().min.z, exact.bounding_box().max.z];
    for count in [3, 8, 40] {
        let rings =
            [ring(0.0, low, count), ring(2.0, low, count), ring(2.0, high, count), ring(0.0, high, count)];
        let (vertices, triangles) = strips(&rings, false);
        let prism = mesh(&vertices, &triangles);
        let sagitta = 2.0 * (1.0 - (PI / count as f64).cos());
        contains(&exact, &prism, sagitta);
        contains(&prism, &exact, sagitta);
    }
}

/// An octahedron whose triangles are quartered `levels` times, with its corners on a sphere.
/// A prism with caps in fans of long triangles, and a prism of other triangles: the reaches of the
/// facets of B cut its triangles into slivers.
#[test]
fn prisms_of_other_triangles_are_apart_by_the_farthest_corner() {
    let turn = 0.1;
    let prism = |count: usize, turn: f64| {
        let rings = [ring(1.0, 0.0, count), ring(1.0, 10.0, count)];
        let (mut vertices, mut triangles) = strips(&rings, false);
        for base in [0, count as u32] {
            triangles.extend((1..count as u32 - 1).map(|k| [base, base + k, base + k + 1]));
        }
        let turned = DQuat::from_rotation_z(turn);
        vertices.iter_mut().for_each(|vertex| *vertex = turned * *vertex);
        mesh(&vertices, &triangles)
    };
    let apothem = (PI / 13.0).cos();
    // A corner is as far from a side of B as its height above it, inwards or not.
    let height = |k: usize| {
        let side = 2.0 * PI / 13.0;
        let from_middle = (2.0 * PI * k as f64 / 40.0 - turn).rem_euclid(side) - 0.5 * side;
        from_middle.cos() - apothem
    };
    let expected = (0..40).map(height).fold(0.0, f64::max);
    contains(&prism(40, 0.0), &prism(13, turn), expected);
}

fn polyhedron(radius: f64, levels: u32) -> Vec<[DVec3; 3]> {
    let mut triangles: Vec<[DVec3; 3]> = Vec::new();
    for [x, y, z] in
        [1.0, -1.0].map(|x| [1.0, -1.0].map(|y| [1.0, -1.0].map(|z| [x, y, z]))).as_flattened().as_flattened()
    {
        triangles.push([DVec3::X * x, DVec3::Y * y, DVec3::Z * z]);
    }
    for _ in 0..levels {
        let quarters = |[a, b, c]: [DVec3; 3]| {
            let [d, e, f] = [a + b, b + c, c + a].map(DVec3::normalize);
            [[a, d, f], [d, b, e], [f, e, c], [d, e, f]]
        };
        triangles = triangles.into_iter().flat_map(quarters).collect();
    }
    triangles.into_iter().map(|corners| corners.map(|corner| radius * corner)).collect()
}

fn soup(triangles: &[[DVec3; 3]]) -> PreparedModel {
    let indices: Vec<[u32; 3]> = (0..triangles.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    mesh(triangles.as_flattened(), &indices)
}

/// Circumcentres of acute triangles are the points of a polyhedron farthest from its sphere.
#[test]
fn a_sphere_and_its_polyhedron_are_a_facet_formula_apart() {
    let exact = surfaces(&sphere(DVec3::ZERO, 2.0).unwrap());
    for levels in 0..4 {
        let triangles = polyhedron(2.0, levels);
        let height = |[a, b, c]: &[DVec3; 3]| (b - a).cross(c - a).normalize().dot(*a).abs();
        let distance = triangles.iter().map(|corners| 2.0 - height(corners)).fold(0.0, f64::max);
        let polyhedron = soup(&triangles);
        contains(&polyhedron, &exact, distance);
        contains(&exact, &polyhedron, distance);
    }
}

/// The points of a torus's inner circle are farthest from a mesh, and samples are never farther.
#[test]
fn a_torus_and_its_mesh_agree_with_samples() {
    let exact = surfaces(&torus(3.0, 1.0).unwrap());
    let [around, across] = [24, 12];
    let point = |i: f64, j: f64| {
        let ((sin_u, cos_u), (sin_v, cos_v)) =
            ((2.0 * PI * i / around as f64).sin_cos(), (2.0 * PI * j / across as f64).sin_cos());
        DVec3::new((3.0 + cos_v) * cos_u, (3.0 + cos_v) * sin_u, sin_v)
    };
    let rings: Vec<Vec<DVec3>> =
        (0..around).map(|i| (0..across).map(|j| point(i as f64, j as f64)).collect()).collect();
    let (vertices, triangles) = strips(&rings, true);
    let to_torus = |at: DVec3| ((at.x.hypot(at.y) - 3.0).hypot(at.z) - 1.0).abs();
    let mut sampled: f64 = 0.0;
    for corners in &triangles {
        let [a, b, c] = corners.map(|vertex| vertices[vertex as usize]);
        for i in 0..=40 {
            for j in 0..=40 - i {
                let [s, t] = [f64::from(i) / 40.0, f64::from(j) / 40.0];
                sampled = sampled.max(to_torus(a + (b - a) * s + (c - a) * t));
            }
        }
    }
    let mesh = mesh(&vertices, &triangles);
    let result = measure(&mesh, &exact, &DistanceOptions::default());
    assert!(
        result.converged && sampled <= result.upper && result.lower <= sampled * 1.002,
        "{sampled} {result:?}"
    );
    let back = measure(&exact, &mesh, &DistanceOptions { symmetric: true, ..DistanceOptions::default() });
    assert!(back.converged && back.upper >= result.lower);
    let [forward, reverse] = [back.forward.unwrap(), back.reverse.unwrap()];
    assert!((reverse.lower - result.lower).abs() < 2e-6 * result.diagonal && forward.converged);
}

#[test]
fn points_are_at_their_distances_from_a_sphere_and_back() {
    let exact = surfaces(&sphere(DVec3::ZERO, 2.0).unwrap());
    let random = &mut fastrand::Rng::with_seed(9);
    let points: Vec<DVec3> =
        (0..20_000).map(|_| DVec3::from_array([0; 3].map(|_| 5.0 * random.f64() - 2.5))).collect();
    let distance = points.iter().map(|point| (point.length() - 2.0).abs()).fold(0.0, f64::max);
    let result = contains(&cloud(&points), &exact, distance);
    // Most boxes of points are pruned without the distances of their points.
    assert!(result.certified().unwrap().cells < 2000, "{:?}", result.details);
    let index = result.witness.a.index.unwrap();
    assert_eq!(result.witness.a.point, points[index].to_array());
    assert!(((points[index].length() - 2.0).abs() - distance).abs() < 1e-5);
    let axes = cloud(&[DVec3::X, -DVec3::X, DVec3::Y, -DVec3::Y, DVec3::Z, -DVec3::Z].map(|axis| 2.0 * axis));
    contains(&exact, &axes, 2.0 * (2.0 - 2.0 / 3.0_f64.sqrt()).sqrt());
}

/// Boxes of different shapes between each other, moved, in other units, and with a limit.
#[test]
fn options_hold_for_meshes() {
    let [a, b] = [1.0, 1.5].map(|radius| polyhedron(radius, 0));
    let turn = RigidTransform::new(DQuat::from_rotation_z(PI / 2.0), DVec3::new(0.0, 0.0, 0.25)).unwrap();
    // A turn by a right angle moves an octahedron onto itself: its top is 0.25 higher.
    let options = DistanceOptions { transform: turn, symmetric: true, ..DistanceOptions::default() };
    let result = measure(&soup(&a), &soup(&b), &options);
    let reverse = result.reverse.as_deref().unwrap();
    assert!(reverse.lower <= 0.75 && 0.75 <= reverse.upper, "{reverse:?}");
    let triangle = result.witness.a.triangle.unwrap();
    let [u, v, w] = result.witness.a.barycentric.unwrap();
    let at = a[triangle][0] * u + a[triangle][1] * v + a[triangle][2] * w;
    assert!(turn.apply(at).distance(DVec3::from_array(result.witness.a.point)) < 1e-9);
    for (limit, within) in [(0.6, Some(false)), (0.8, Some(true))] {
        let options = DistanceOptions { limit: Some(limit), ..options.clone() };
        assert_eq!(measure(&soup(&a), &soup(&b), &options).certified().unwrap().within, within, "{limit}");
    }
    let facets = |triangles: &[[DVec3; 3]], unit: f64, factor: f64| {
        let indices: Vec<[u32; 3]> =
            (0..triangles.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        let vertices: Vec<DVec3> = triangles.as_flattened().iter().map(|&vertex| vertex * factor).collect();
        let mesh = TriangleMesh::new(&vertices, &indices).unwrap();
        PreparedModel::of_facets(&Facets::Mesh(mesh), Some(unit)).unwrap()
    };
    let [metres, inches] = [facets(&b, 1.0, 1.0), facets(&b, 0.0254, 1.0 / 0.0254)];
    let fails = pollster::block_on(engine().distance(&metres, &inches, &DistanceOptions::default()));
    assert_eq!(fails.unwrap_err().code(), "UNITS_DIFFER");
    let result =
        measure(&metres, &inches, &DistanceOptions { scale_units: true, ..DistanceOptions::default() });
    assert!(result.lower <= 1e-15 && result.upper <= 1e-6 * result.diagonal && result.unit == Some(1.0));
}

#[test]
fn computations_without_facets_are_refused() {
    let [octahedron, exact] = [soup(&polyhedron(1.0, 0)), surfaces(&sphere(DVec3::ZERO, 1.0).unwrap())];
    for method in [MethodName::Iteration, MethodName::Hierarchy] {
        let options = DistanceOptions { method: method.into(), ..DistanceOptions::default() };
        for (a, b) in [(&octahedron, &exact), (&exact, &octahedron)] {
            let result = pollster::block_on(engine().distance(a, b, &options));
            assert_eq!(result.unwrap_err().code(), "FACETS_UNSUPPORTED");
        }
    }
}

/// A budget of cells ends the search with a valid interval.
#[test]
fn a_budget_leaves_a_valid_interval() {
    let exact = surfaces(&sphere(DVec3::ZERO, 2.0).unwrap());
    let polyhedron = soup(&polyhedron(2.0, 1));
    let sound = measure(&exact, &polyhedron, &DistanceOptions::default());
    for max_cells in [1, 40, 400] {
        let result = measure(
            &exact,
            &polyhedron,
            &DistanceOptions {
                method: Method::Certified(CertifiedOptions {
                    max_cells: Some(max_cells),
                    ..Default::default()
                }),
                ..DistanceOptions::default()
            },
        );
        assert!(result.lower <= sound.upper && sound.lower <= result.upper);
        assert!(result.converged || result.certified().unwrap().cells >= max_cells);
    }
}

/// Against all triangles, one by one, as the formula of another algorithm gives them.
#[test]
fn closest_points_of_a_mesh_are_those_of_its_triangles() {
    let triangles = polyhedron(1.0, 2);
    let random = &mut fastrand::Rng::with_seed(3);
    let points: Vec<DVec3> =
        (0..500).map(|_| DVec3::from_array([0; 3].map(|_| 3.0 * random.f64() - 1.5))).collect();
    let coordinates: Vec<f64> = points.iter().flat_map(|point| point.to_array()).collect();
    let options = ClosestPointOptions::default();
    let found = engine().closest_points(&soup(&triangles), &coordinates, &options).wait();
    let found = found.unwrap();
    for (index, &point) in points.iter().enumerate() {
        let distance =
            triangles.iter().map(|corners| by_projection(corners, point)).fold(f64::INFINITY, f64::min);
        let (returned, bound) = (found.distances[index], found.bounds[index]);
        assert!(
            (returned - distance).abs() <= bound + 1e-12 && bound < 1e-9,
            "{returned} {distance} {bound:e}"
        );
        let foot = DVec3::from_slice(&found.feet[3 * index..]);
        assert!((foot.distance(point) - returned).abs() < 1e-12);
        // The triangles turn both ways, so that only the size of the sign is known.
        assert!((found.signed[index].abs() - returned).abs() < 1e-12);
        let [u, v] = [found.parameters[2 * index], found.parameters[2 * index + 1]];
        let [a, b, c] = triangles[found.faces[index] as usize];
        assert!((a * (1.0 - u - v) + b * u + c * v).distance(foot) < 1e-12);
    }
}

/// The distance to a triangle by repeated projection on its half-planes (Dykstra's algorithm).
fn by_projection(corners: &[DVec3; 3], point: DVec3) -> f64 {
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
    let mut at = point - normal * normal.dot(point - corners[0]);
    let mut corrections = [DVec3::ZERO; 3];
    for _ in 0..2000 {
        for side in 0..3 {
            let [from, to] = [corners[side], corners[(side + 1) % 3]];
            let inward = normal.cross(to - from).normalize();
            let moved = at + corrections[side];
            let beyond = inward.dot(moved - from).min(0.0);
            at = moved - inward * beyond;
            corrections[side] = moved - at;
        }
    }
    at.distance(point)
}

/// A closed mesh has sides whichever way its triangles turn; an open one and a cloud have none.
#[test]
fn closed_meshes_have_sides_in_every_result() {
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    // The second and the third one turn inwards.
    let triangles = [[0, 2, 1], [0, 3, 1], [1, 3, 2], [2, 0, 3]];
    let tetrahedron = mesh(&corners, &triangles);
    let (inside, outside) = ([0.1, 0.2, 0.3], [0.2, -0.3, 0.1]);
    assert!(tetrahedron.solid().closed);
    assert_eq!(tetrahedron.side(inside), Side::Inside);
    assert_eq!(tetrahedron.side(outside), Side::Outside);
    let points = [inside, outside];
    let of_points = |model: &PreparedModel, points: &[f64]| {
        pollster::block_on(engine().closest_points(model, points, &ClosestPointOptions::default())).unwrap()
    };
    let found = of_points(&tetrahedron, points.as_flattened());
    let samples = cloud(&points.map(DVec3::from_array));
    let field = pollster::block_on(engine().field(&samples, &tetrahedron, &FieldOptions::default())).unwrap();
    let of_field = &field.deviations[0];
    for (signs, signed) in [(found.signs, &found.signed), (of_field.signs, &of_field.signed)] {
        assert_eq!(signs, Signs::Solid);
        assert!((signed[0] + 0.1).abs() < 1e-12 && (signed[1] - 0.3).abs() < 1e-12, "{signed:?}");
    }
    for open in [mesh(&corners, &triangles[1..]), cloud(&corners)] {
        assert!(!open.solid().closed);
        assert_eq!(open.side(inside), Side::Undecided);
        assert_eq!(open.side(outside), Side::Undecided);
        assert_eq!(of_points(&open, &inside).signs, Signs::Faces);
    }
}

/// The corners of a tetrahedron whose middle is inside, with each triangle's own copies of them.
fn tetrahedron_soup() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let triangles = [[0, 2, 1], [0, 3, 1], [1, 3, 2], [2, 0, 3]];
    let vertices = triangles.as_flattened().iter().map(|&corner: &usize| corners[corner]).collect();
    (vertices, (0..4).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect())
}

/// Edges are joined where their ends are equal, where they are nearly so, where one lies on others,
/// and where two bodies share one; a wider crack stays open.
#[test]
fn meshes_close_where_edges_are_equal_or_near() {
    let (inside, outside) = ([0.1, 0.2, 0.3], [0.6, 0.6, 0.1]);
    let is_solid = |model: &PreparedModel| {
        assert_eq!(model.side(inside), Side::Inside);
        assert_eq!(model.side(outside), Side::Outside);
        model.solid().closed
    };
    let (vertices, triangles) = tetrahedron_soup();
    assert!(is_solid(&mesh(&vertices, &triangles)));
    for (crack, closed) in [(1e-9, true), (1e-3, false)] {
        let mut vertices = vertices.clone();
        vertices[0].z += crack;
        let model = mesh(&vertices, &triangles);
        assert_eq!(model.solid().closed, closed, "{crack}");
        assert!(!closed || is_solid(&model));
        // The corner moves off its triangle's plane: two edges have no partner on either side of the crack.
        assert_eq!(model.solid().free_edges.len(), if closed { 0 } else { 4 });
    }
    // The edge of the first triangle from 0 to 1 ends at its middle, on the second one's.
    let mut divided = vertices.clone();
    divided.push(0.5 * DVec3::X);
    let mut parts = triangles.clone();
    parts[0] = [0, 1, 12];
    parts.push([12, 1, 2]);
    assert!(is_solid(&mesh(&divided, &parts)));
    // A second body beyond the edge from 0 to 1, which then has four triangles.
    let mirrored = vertices.iter().map(|&point| DVec3::new(point.x, -point.y, -point.z));
    let both: Vec<DVec3> = vertices.iter().copied().chain(mirrored).collect();
    let of_both: Vec<[u32; 3]> = triangles.iter().flat_map(|&t| [t, t.map(|corner| corner + 12)]).collect();
    let model = mesh(&both, &of_both);
    assert!(is_solid(&model));
    assert_eq!(model.side([0.1, -0.2, -0.3]), Side::Inside);
    assert_eq!(model.side([0.1, 0.2, -0.3]), Side::Outside);
}

/// Shells are those of triangles that edges connect, whatever else lies beside them.
#[test]
fn shells_of_a_mesh_are_its_connected_parts() {
    let (vertices, triangles) = tetrahedron_soup();
    let beside: Vec<DVec3> = vertices.iter().map(|&point| point + 3.0 * DVec3::X).collect();
    let all: Vec<[u32; 3]> = triangles.iter().flat_map(|&t| [t, t.map(|corner| corner + 12)]).collect();
    let solid = mesh(&[vertices, beside].concat(), &all).solid();
    let shells: Vec<_> = solid.shells.iter().map(|shell| shell.faces.clone()).collect();
    let mut sorted: Vec<Vec<usize>> = shells
        .into_iter()
        .map(|mut faces| {
            faces.sort_unstable();
            faces
        })
        .collect();
    sorted.sort_unstable();
    assert_eq!(sorted, [[0, 2, 4, 6], [1, 3, 5, 7]]);
}
