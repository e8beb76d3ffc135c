//! Random pairs with a mesh or a cloud as one model or both.

use super::super::pairs::pair;
use super::super::surfaces::{direction, magnitude};
use crate::support::evaluator::point;
use fastrand::Rng;
use glam::{DQuat, DVec3};
use nurbs_hausdorff::{Facets, MeshGroup, Model, PointCloud, PreparedModel, RigidTransform, TriangleMesh};

/// A model of any kind.
pub(super) enum Drawn {
    Surfaces(Model),
    Mesh(TriangleMesh),
    Cloud(Vec<DVec3>),
}

/// Two models with the options of their computation.
pub(super) struct FacetPair {
    pub(super) models: [Drawn; 2],
    pub(super) transform: RigidTransform,
    pub(super) tolerance: f64,
    pub(super) max_cells: usize,
    pub(super) symmetric: bool,
    pub(super) limit: Option<f64>,
}

/// The budgets of cells of a direction.
const BUDGETS: [usize; 4] = [1, 500, 4000, 16_000];

impl FacetPair {
    pub(super) fn new(seed: u64) -> Self {
        let rng = &mut Rng::with_seed(seed ^ 0xFACE);
        // One base, so that models of a pair are near each other.
        let base = pair(seed).a;
        let first = drawn(rng, &base, None);
        let must_be_facets = matches!(first, Drawn::Surfaces(_));
        let second = loop {
            let other = drawn(rng, &base, Some(&first));
            if !(must_be_facets && matches!(other, Drawn::Surfaces(_))) {
                break other;
            }
        };
        let mut models = [first, second];
        if rng.bool() {
            models.reverse();
        }
        let size = base.bounding_box().diagonal();
        let transform = if rng.bool() {
            let turn = DQuat::from_axis_angle(direction(rng), 0.2 * rng.f64());
            let shift = direction(rng) * size * magnitude(rng, -6.0, 0.0);
            RigidTransform::new(turn, shift).unwrap()
        } else {
            RigidTransform::IDENTITY
        };
        Self {
            models,
            transform,
            tolerance: magnitude(rng, -6.0, -2.0),
            max_cells: BUDGETS[rng.usize(0..BUDGETS.len())],
            symmetric: rng.bool(),
            limit: (rng.u8(0..6) == 0).then(|| magnitude(rng, -4.0, 0.0)),
        }
    }
}

fn drawn(rng: &mut Rng, base: &Model, other: Option<&Drawn>) -> Drawn {
    match rng.u8(0..14) {
        0..3 => Drawn::Surfaces(base.clone()),
        3..6 => Drawn::Mesh(tessellated(rng, base)),
        6 => Drawn::Mesh(soup(rng, base)),
        7 | 8 => match other {
            Some(Drawn::Mesh(mesh)) => Drawn::Mesh(near_copy(rng, mesh)),
            Some(Drawn::Cloud(points)) => Drawn::Cloud(jittered(rng, points)),
            _ => Drawn::Mesh(tessellated(rng, base)),
        },
        9 => Drawn::Mesh(sheets(rng)),
        12 | 13 => match other {
            Some(Drawn::Mesh(mesh)) => Drawn::Mesh(other_triangles(rng, mesh)),
            _ => Drawn::Mesh(tessellated(rng, base)),
        },
        10 => {
            let points = samples(rng, base);
            Drawn::Cloud(jittered(rng, &points))
        }
        _ => {
            let mut points = samples(rng, base);
            points.truncate(rng.usize(1..4));
            Drawn::Cloud(points)
        }
    }
}

/// The grid points of every surface, of random numbers.
fn grids(rng: &mut Rng, base: &Model) -> Vec<([usize; 2], Vec<DVec3>)> {
    let grid = |surface: &nurbs_hausdorff::NurbsSurface, [m, n]: [usize; 2]| {
        let at = |index: usize, count: usize| index as f64 / (count - 1) as f64;
        let place = |k: usize| {
            let [u, v] = surface.domain().at([at(k / n, m), at(k % n, n)]);
            DVec3::from_array(point(surface, u, v))
        };
        ([m, n], (0..m * n).map(place).collect())
    };
    base.surfaces().iter().map(|surface| grid(surface, [rng.usize(2..12), rng.usize(2..12)])).collect()
}

fn samples(rng: &mut Rng, base: &Model) -> Vec<DVec3> {
    let mut points: Vec<DVec3> = grids(rng, base).into_iter().flat_map(|(_, points)| points).collect();
    rng.shuffle(&mut points);
    points
}

fn tessellated(rng: &mut Rng, base: &Model) -> TriangleMesh {
    let (mut vertices, mut triangles, mut groups) = (Vec::new(), Vec::new(), Vec::new());
    for ([m, n], points) in grids(rng, base) {
        let first = vertices.len();
        vertices.extend(points);
        let turned = rng.bool();
        for i in 0..m - 1 {
            for j in 0..n - 1 {
                let at = |i: usize, j: usize| (first + i * n + j) as u32;
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                triangles.extend(if turned { [[a, b, d], [b, c, d]] } else { [[a, b, c], [a, c, d]] });
            }
        }
        groups.push(MeshGroup { name: None, triangles: 2 * (m - 1) * (n - 1) });
    }
    TriangleMesh::new(&vertices, &triangles).unwrap().with_groups(groups).unwrap()
}

/// Triangles of any shape: slivers, doubled corners, corners on a line.
fn soup(rng: &mut Rng, base: &Model) -> TriangleMesh {
    let aabb = base.bounding_box();
    let mut vertices = Vec::new();
    for _ in 0..rng.usize(1..30) {
        let any =
            |rng: &mut Rng| aabb.min + (aabb.max - aabb.min) * DVec3::new(rng.f64(), rng.f64(), rng.f64());
        let [a, b, c] = [any(rng), any(rng), any(rng)];
        let small = direction(rng) * aabb.diagonal() * magnitude(rng, -15.0, -3.0);
        vertices.extend(match rng.u8(0..5) {
            0 => [a, b, a.lerp(b, rng.f64()) + small],
            1 => [a, b, b],
            2 => [a, a + small, a + small * rng.f64()],
            _ => [a, b, c],
        });
    }
    let triangles: Vec<[u32; 3]> =
        (0..vertices.len() as u32 / 3).map(|k| [0, 1, 2].map(|c| 3 * k + c)).collect();
    TriangleMesh::new(&vertices, &triangles).unwrap()
}

/// Parallel squares in triangles of different sizes, at a height of any size.
fn sheets(rng: &mut Rng) -> TriangleMesh {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    let count = rng.usize(1..7);
    let height = magnitude(rng, -12.0, 0.0);
    for i in 0..=count {
        for j in 0..=count {
            vertices.push(DVec3::new(i as f64 / count as f64, j as f64 / count as f64, height));
        }
    }
    for i in 0..count {
        for j in 0..count {
            let at = |i: usize, j: usize| (i * (count + 1) + j) as u32;
            triangles.extend([
                [at(i, j), at(i + 1, j), at(i + 1, j + 1)],
                [at(i, j), at(i + 1, j + 1), at(i, j + 1)],
            ]);
        }
    }
    TriangleMesh::new(&vertices, &triangles).unwrap()
}

fn jittered(rng: &mut Rng, points: &[DVec3]) -> Vec<DVec3> {
    let size =
        magnitude(rng, -12.0, -1.0) * points.iter().fold(0.0_f64, |size, point| size.max(point.length()));
    points.iter().map(|&point| point + size * direction(rng)).collect()
}

fn near_copy(rng: &mut Rng, mesh: &TriangleMesh) -> TriangleMesh {
    let vertices = jittered(rng, mesh.vertices());
    let mut triangles = mesh.triangles().to_vec();
    if rng.bool() && triangles.len() > 1 {
        triangles.truncate(triangles.len() - 1);
    }
    TriangleMesh::new(&vertices, &triangles).unwrap()
}

/// About the same surface in other triangles: each in three or in four, in another order, some left out,
/// with vertices rounded to float32, scaled, or as they were.
fn other_triangles(rng: &mut Rng, mesh: &TriangleMesh) -> TriangleMesh {
    let mut vertices = mesh.vertices().to_vec();
    let mut triangles = Vec::new();
    let (is_in_four, share) = (rng.bool(), rng.f64());
    for &[a, b, c] in mesh.triangles() {
        let at = |k: u32| mesh.vertices()[k as usize];
        let mut new = |point: DVec3| {
            vertices.push(point);
            vertices.len() as u32 - 1
        };
        if rng.f64() > share {
            triangles.push([a, b, c]);
        } else if is_in_four {
            // Neighbours that are not divided have the whole edge: T-junctions.
            let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|[p, q]| new(0.5 * (at(p) + at(q))));
            triangles.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        } else {
            let inner = new(at(a).lerp(at(b), rng.f64()).lerp(at(c), rng.f64()));
            triangles.extend([[a, b, inner], [b, c, inner], [c, a, inner]]);
        }
    }
    rng.shuffle(&mut triangles);
    for corners in &mut triangles {
        corners.rotate_left(rng.usize(0..3));
        if rng.u8(0..8) == 0 {
            corners.swap(0, 1);
        }
    }
    if rng.bool() && triangles.len() > 1 {
        triangles.truncate(triangles.len() - 1);
    }
    match rng.u8(0..3) {
        0 => vertices.iter_mut().for_each(|vertex| *vertex = vertex.as_vec3().as_dvec3()),
        1 => {
            let scale = 1.0 + magnitude(rng, -9.0, -1.0);
            vertices.iter_mut().for_each(|vertex| *vertex *= scale);
        }
        _ => {}
    }
    TriangleMesh::new(&vertices, &triangles).unwrap()
}

impl Drawn {
    pub(super) fn prepared(&self) -> PreparedModel {
        match self {
            Self::Surfaces(model) => PreparedModel::new(model).unwrap(),
            Self::Mesh(mesh) => PreparedModel::of_facets(&Facets::Mesh(mesh.clone()), None).unwrap(),
            Self::Cloud(points) => {
                let cloud = PointCloud::new(points.clone()).unwrap();
                PreparedModel::of_facets(&Facets::Cloud(cloud), None).unwrap()
            }
        }
    }

    pub(super) fn kind(&self) -> &'static str {
        match self {
            Self::Surfaces(_) => "surfaces",
            Self::Mesh(_) => "mesh",
            Self::Cloud(_) => "points",
        }
    }
}
