//! The work of the search over meshes: what a change of it is judged by.
//!
//! `cargo bench --bench meshes [-- NAME …]`, with `RAYON_NUM_THREADS=1` for one thread. Prints the cells
//! and the CPU seconds of each pair whose name contains one of these words, with its interval. Pairs are
//! made by formulas, and of the STL, OBJ and STEP files of `../shared/models`.

#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

mod support;

use flate2::read::GzDecoder;
use glam::{DQuat, DVec3};
use nurbs_hausdorff::internals::engine::{DistanceOptions, Engine, PreparedModel};
use nurbs_hausdorff::{CertifiedOptions, Facets, Method, TriangleMesh};
use nurbs_hausdorff_cad::from_step;
use nurbs_hausdorff_meshes::{MeshFile, MeshFormat};
use std::io::Read;
use std::path::{Path, PathBuf};
use support::clock::Stopwatch;
use support::random::Random;
use support::shared;

/// Cells and seconds after which a search of this benchmark ends.
const MAX_CELLS: usize = 3_000_000;
const MAX_SECONDS: f64 = 30.0;

/// The parts of ../shared/models/so101 that are measured to copies of themselves.
const PARTS: [&str; 3] = ["Base_SO101", "Upper_arm_SO101", "Trigger_SO101"];

/// A mesh by its vertices and triangles.
#[derive(Clone)]
struct Mesh {
    vertices: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

/// Two models with the tolerance of their distance, relative to the diagonal if it is `None`.
struct Pair {
    name: String,
    models: [PreparedModel; 2],
    tolerance: Option<f64>,
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let is_chosen = |name: &str| words.is_empty() || words.iter().any(|word| name.contains(word.as_str()));
    println!("| pair | facets | cells | CPU s | interval | stop |");
    println!("|---|---|---|---|---|---|");
    for (name, pair) in pairs() {
        if is_chosen(&name) {
            measure(&pair(name));
        }
    }
}

fn measure(Pair { name, models: [a, b], tolerance }: &Pair) {
    let budgets = CertifiedOptions {
        max_cells: Some(MAX_CELLS),
        max_seconds: Some(MAX_SECONDS),
        ..CertifiedOptions::default()
    };
    let options = DistanceOptions {
        method: Method::Certified(budgets),
        tolerance: *tolerance,
        relative_tolerance: tolerance.is_none().then_some(1e-6),
        ..DistanceOptions::default()
    };
    let watch = Stopwatch::start(true);
    let result = Engine::cpu().distance(a, b, &options).wait().expect("a distance");
    let spent = watch.cpu_seconds();
    let details = result.certified().expect("method certified");
    println!(
        "| {name} | {} / {} | {} | {spent:.3} | {:.9e} to {:.9e} | {:?} |",
        result.patches.a, result.patches.b, details.cells, result.lower, result.upper, details.stop
    );
}

/// What makes a pair of a name.
type Made = Box<dyn Fn(String) -> Pair>;

fn pairs() -> Vec<(String, Made)> {
    let mut pairs: Vec<(String, Made)> = Vec::new();
    let mut add = |name: &str, made: Box<dyn Fn() -> [Mesh; 2]>| {
        let pair = move |name| Pair { name, models: made().map(|mesh| mesh.prepared()), tolerance: None };
        pairs.push((name.to_owned(), Box::new(pair)));
    };
    for apart in [1e-6, 1e-5, 1e-3, 1.0] {
        add(&format!("planes {apart:e} apart"), Box::new(move || [plane(2, 0.0), plane(3, apart)]));
    }
    add("icosphere to uv sphere", Box::new(|| [icosphere(5), uv_sphere(64, 128)]));
    add("icosphere to 1.01 times itself", Box::new(|| [icosphere(5), icosphere(5).mapped(|p| 1.01 * p)]));
    for [m, n] in [[5, 5], [4, 5], [5, 4]] {
        add(&format!("icosphere({m}) to ({n})"), Box::new(move || [icosphere(m), icosphere(n)]));
    }
    let wavy = |p: DVec3| p + 0.05 * (7.0 * p.x).sin() * p;
    add("icosphere to a wavy one", Box::new(move || [icosphere(5), icosphere(5).mapped(wavy)]));
    let Some(folder) = shared::folder() else {
        println!("SKIPPED files: there is no ../shared/models");
        return pairs;
    };
    for part in PARTS {
        let path = folder.join("so101").join(format!("{part}.stl.gz"));
        for (name, copy) in COPIES {
            let path = path.clone();
            let made = move || {
                let mesh = read(&path);
                let copy = copy(&mesh);
                [mesh, copy]
            };
            let from = made.clone();
            add(&format!("{part} to {name}"), Box::new(made));
            let turned = move || {
                let [mesh, copy] = from();
                [copy, mesh]
            };
            add(&format!("{part} from {name}"), Box::new(turned));
        }
    }
    of_files(&folder, &mut pairs);
    pairs
}

/// A name, and what makes the copy of a mesh.
type MeshCopy = (&'static str, fn(&Mesh) -> Mesh);

/// Copies of a mesh, with their names.
const COPIES: [MeshCopy; 8] = [
    ("itself", Mesh::clone),
    ("itself re-ordered", reordered),
    ("itself in float32, moved by 1e-4", |mesh| {
        mesh.mapped(|p| (p + DVec3::new(1e-4, 2e-4, -1e-4)).as_vec3().as_dvec3())
    }),
    ("itself moved by 0.05", |mesh| mesh.mapped(|p| p + 0.05 * DVec3::new(0.6, 0.0, 0.8))),
    ("itself turned by 1e-3", |mesh| mesh.mapped(|p| DQuat::from_rotation_z(1e-3) * p)),
    ("itself subdivided", subdivided),
    ("itself clustered", clustered),
    ("itself with noise", |mesh| {
        let random = std::cell::RefCell::new(Random(5));
        mesh.mapped(|p| p + 0.01 * random.borrow_mut().direction())
    }),
];

fn of_files(folder: &Path, pairs: &mut Vec<(String, Made)>) {
    let path = |name: &str| folder.join(name);
    let twin = ["left", "right"].map(|side| path(&format!("meshes/Generic_Twin_7081.1.t0_{side}.obj")));
    for (name, order) in [("left to right", [0, 1]), ("right to left", [1, 0])] {
        let paths = order.map(|index: usize| twin[index].clone());
        let pair = move |name| Pair {
            name,
            models: paths.each_ref().map(|path| read(path).prepared()),
            tolerance: Some(100.0),
        };
        pairs.push((format!("Generic_Twin {name}"), Box::new(pair)));
    }
    for part in PARTS {
        let [step, stl] = ["step", "stl"].map(|ending| path(&format!("so101/{part}.{ending}.gz")));
        let pair = move |name| {
            let (model, mut report) = from_step(&bytes(&step)).expect("STEP");
            let (_, model) = PreparedModel::new_skipping(model, &mut report).expect("faces");
            Pair { name, models: [model, read(&stl).prepared()], tolerance: None }
        };
        pairs.push((format!("{part}.step to its STL"), Box::new(pair)));
    }
}

fn bytes(path: &PathBuf) -> Vec<u8> {
    let found = std::fs::read(path).expect("a file");
    if path.extension().is_none_or(|extension| extension != "gz") {
        return found;
    }
    let mut bytes = Vec::new();
    GzDecoder::new(found.as_slice()).read_to_end(&mut bytes).expect("gzip");
    bytes
}

fn read(path: &PathBuf) -> Mesh {
    let name = path.to_string_lossy();
    let format = MeshFormat::of_name(name.trim_end_matches(".gz")).expect("a format");
    let Facets::Mesh(mesh) = MeshFile::read(&bytes(path), format).expect("a mesh").facets else {
        unreachable!("these files have triangles")
    };
    Mesh { vertices: mesh.vertices().to_vec(), triangles: mesh.triangles().to_vec() }
}

impl Mesh {
    fn prepared(&self) -> PreparedModel {
        let mesh = TriangleMesh::new(&self.vertices, &self.triangles).expect("a mesh");
        PreparedModel::of_facets(&Facets::Mesh(mesh), None).expect("a mesh")
    }

    fn mapped(&self, map: impl Fn(DVec3) -> DVec3) -> Self {
        Self { vertices: self.vertices.iter().map(|&p| map(p)).collect(), triangles: self.triangles.clone() }
    }
}

/// The unit square in 2 n² triangles.
fn plane(n: usize, z: f64) -> Mesh {
    let at = |k: usize| DVec3::new((k / (n + 1)) as f64 / n as f64, (k % (n + 1)) as f64 / n as f64, z);
    let mut triangles = Vec::new();
    for i in 0..n {
        for j in 0..n {
            let at = |i: usize, j: usize| (i * (n + 1) + j) as u32;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    Mesh { vertices: (0..(n + 1) * (n + 1)).map(at).collect(), triangles }
}

/// An icosahedron on the unit sphere, subdivided this often.
fn icosphere(subdivisions: usize) -> Mesh {
    let golden = 0.5 * (1.0 + 5.0_f64.sqrt());
    let mut vertices = Vec::new();
    for [x, y] in [[1.0, golden], [-1.0, golden], [1.0, -golden], [-1.0, -golden]] {
        vertices.extend([[0.0, x, y], [x, y, 0.0], [y, 0.0, x]].map(|p| DVec3::from_array(p).normalize()));
    }
    let edge = |a: u32, b: u32| vertices[a as usize].distance(vertices[b as usize]) < 1.1;
    let mut triangles = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            triangles
                .extend((b + 1..12).filter(|&c| edge(a, b) && edge(b, c) && edge(c, a)).map(|c| [a, b, c]));
        }
    }
    let mut mesh = Mesh { vertices, triangles };
    for _ in 0..subdivisions {
        mesh = subdivided(&mesh).mapped(DVec3::normalize);
    }
    mesh
}

/// The unit sphere in triangles between parallels and meridians.
fn uv_sphere(parallels: usize, meridians: usize) -> Mesh {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for i in 0..=parallels {
        for j in 0..meridians {
            let (s, c) = (std::f64::consts::PI * i as f64 / parallels as f64).sin_cos();
            let (y, x) = (std::f64::consts::TAU * j as f64 / meridians as f64).sin_cos();
            // The poles are points.
            let s = if i == 0 || i == parallels { 0.0 } else { s };
            vertices.push(DVec3::new(s * x, s * y, c));
        }
    }
    for i in 0..parallels {
        for j in 0..meridians {
            let at = |i: usize, j: usize| (i * meridians + j % meridians) as u32;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    triangles.retain(|corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|k| vertices[k as usize]);
        a != b && b != c && c != a
    });
    Mesh { vertices, triangles }
}

/// Every triangle in four, at the middles of its edges.
fn subdivided(mesh: &Mesh) -> Mesh {
    let mut vertices = mesh.vertices.clone();
    let mut middles = std::collections::HashMap::new();
    let mut middle = |a: u32, b: u32| {
        *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
            vertices.push(0.5 * (mesh.vertices[a as usize] + mesh.vertices[b as usize]));
            vertices.len() as u32 - 1
        })
    };
    let mut triangles = Vec::new();
    for &[a, b, c] in &mesh.triangles {
        let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
        triangles.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    Mesh { vertices, triangles }
}

/// The same triangles in another order, each beginning with another corner.
fn reordered(mesh: &Mesh) -> Mesh {
    let mut random = Random(3);
    let mut triangles = mesh.triangles.clone();
    for k in (1..triangles.len()).rev() {
        triangles.swap(k, (random.next() * (k + 1) as f64) as usize);
        triangles[k].rotate_left((3.0 * random.next()) as usize);
    }
    Mesh { vertices: mesh.vertices.clone(), triangles }
}

/// The vertices moved to those of a grid of a hundredth of the diagonal, without the triangles that collapse.
fn clustered(mesh: &Mesh) -> Mesh {
    let all = mesh
        .vertices
        .iter()
        .fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], &p| [low.min(p), high.max(p)]);
    let size = 0.01 * (all[1] - all[0]).length();
    let moved = mesh.mapped(|p| (p / size).round() * size);
    let mut triangles = moved.triangles;
    triangles.retain(|corners| {
        let [a, b, c] = corners.map(|k| moved.vertices[k as usize]);
        a != b && b != c && c != a
    });
    Mesh { vertices: moved.vertices, triangles }
}
