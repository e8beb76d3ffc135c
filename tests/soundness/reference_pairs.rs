//! The reference pairs of `../shared/models`, on both backends.

use crate::support::{gpu::engine, models::folder};
use glam::DVec3;
use nurbs_hausdorff::internals::engine::{Backend, DistanceOptions, Engine, MethodName, PreparedModel};
use nurbs_hausdorff::{Error, HierarchyOptions, Method, Model, RigidTransform};
use std::collections::HashMap;
use std::path::Path;

/// What two backends may differ by, relative to the diagonal.
const FLOAT32: f64 = 1e-5;

/// Rounding of the references, relative to the diagonal.
const ROUNDING: f64 = 1e-12;

/// Samples along each direction, half the default: the radii of the cells are
/// twice as large, and what is checked relative to them is the same.
const SAMPLES: usize = 32;

struct Reference {
    a: String,
    b: String,
    translation: DVec3,
    lower: f64,
    upper: f64,
}

fn references(folder: &Path) -> Vec<Reference> {
    let parse = |line: &str| {
        let line: serde_json::Value = serde_json::from_str(line).unwrap();
        let at = |index: usize| line["translate_a"][index].as_f64().unwrap_or(0.0);
        Reference {
            a: line["a"].as_str().unwrap().to_owned(),
            b: line["b"].as_str().unwrap().to_owned(),
            translation: DVec3::new(at(0), at(1), at(2)),
            lower: line["result"]["lower"].as_f64().unwrap(),
            upper: line["result"]["upper"].as_f64().unwrap(),
        }
    };
    std::fs::read_to_string(folder.join("reference.jsonl")).unwrap().lines().map(parse).collect()
}

/// Models read once.
struct Shelf<'a> {
    folder: &'a Path,
    prepared: HashMap<String, PreparedModel>,
}

impl Shelf<'_> {
    fn load(&mut self, name: &str) {
        let folder = self.folder;
        self.prepared.entry(name.to_owned()).or_insert_with(|| {
            let text = std::fs::read_to_string(folder.join(format!("{name}.json"))).unwrap();
            PreparedModel::new(&Model::from_json(&text).unwrap()).unwrap()
        });
    }
}

impl Reference {
    fn options(&self, method: MethodName) -> DistanceOptions {
        DistanceOptions {
            method: method.into(),
            transform: RigidTransform::translation(self.translation).unwrap(),
            ..DistanceOptions::default()
        }
    }
}

#[test]
fn samples_and_bounds_agree_with_every_reference() {
    let Some(folder) = folder("samples_and_bounds_agree_with_every_reference") else { return };
    let Some(engine) = engine("samples_and_bounds_agree_with_every_reference") else { return };
    let mut shelf = Shelf { folder: &folder, prepared: HashMap::new() };
    let references = references(&folder);
    let mut beyond_published = Vec::new();
    for reference in &references {
        shelf.load(&reference.a);
        shelf.load(&reference.b);
        let (a, b) = (&shelf.prepared[&reference.a], &shelf.prepared[&reference.b]);
        let name = format!("{} to {} {}", reference.a, reference.b, reference.translation);
        let [gpu, cpu] = [Backend::Gpu, Backend::Cpu].map(|backend| {
            let options =
                DistanceOptions { backend, samples: SAMPLES, ..reference.options(MethodName::Iteration) };
            let result = engine.distance(a, b, &options).wait().unwrap();
            let rounding = ROUNDING * result.diagonal;
            let bounds = result.iteration().unwrap().bounds;
            assert!(result.converged, "{name}");
            assert!(result.computed <= reference.upper + rounding, "{name}: {}", result.computed);
            // Samples miss the farthest point by up to the radius of a cell.
            let missed = bounds.k_a_rigorous + rounding;
            assert!(result.computed >= reference.lower - missed, "{name}: {}", result.computed);
            assert!(result.lower <= reference.upper && reference.lower <= result.upper, "{name}");
            result
        });
        assert!((gpu.computed - cpu.computed).abs() <= FLOAT32 * cpu.diagonal, "{name}");
        // The published K_B speaks of the projection alone, and of samples that include the farthest point.
        let k_b = cpu.iteration().unwrap().bounds.k_b;
        if k_b.is_none_or(|k_b| cpu.computed < reference.lower - k_b) {
            beyond_published.push(format!("{name}: {} short, K_B {k_b:?}", reference.lower - cpu.computed));
        }
    }
    println!("farther below the reference than K_B, of {} pairs: {beyond_published:#?}", references.len());
}

#[test]
fn certified_intervals_overlap_every_reference() {
    let Some(folder) = folder("certified_intervals_overlap_every_reference") else { return };
    let engine = Engine::cpu();
    let mut shelf = Shelf { folder: &folder, prepared: HashMap::new() };
    for reference in references(&folder) {
        shelf.load(&reference.a);
        shelf.load(&reference.b);
        let (a, b) = (&shelf.prepared[&reference.a], &shelf.prepared[&reference.b]);
        let name = format!("{} to {} {}", reference.a, reference.b, reference.translation);
        let options = reference.options(MethodName::Certified);
        let result = engine.distance(a, b, &options).wait().unwrap();
        let details = result.certified().unwrap();
        assert!(result.converged, "{name}: {:?}", details.stop);
        assert!(result.upper - result.lower <= details.tolerance + ROUNDING * result.diagonal, "{name}");
        let overlap = result.lower <= reference.upper && reference.lower <= result.upper;
        assert!(overlap, "{name}: [{}, {}]", result.lower, result.upper);
    }
}

#[test]
fn boxes_contain_every_reference() {
    let Some(folder) = folder("boxes_contain_every_reference") else { return };
    let Some(engine) = engine("boxes_contain_every_reference") else { return };
    let mut shelf = Shelf { folder: &folder, prepared: HashMap::new() };
    let (mut measured, mut refused) = (0, Vec::new());
    for reference in references(&folder) {
        shelf.load(&reference.a);
        shelf.load(&reference.b);
        let (a, b) = (&shelf.prepared[&reference.a], &shelf.prepared[&reference.b]);
        let name = format!("{} to {} {}", reference.a, reference.b, reference.translation);
        for backend in [Backend::Gpu, Backend::Cpu] {
            let options = DistanceOptions {
                method: Method::Hierarchy(HierarchyOptions { grid: 8, ..Default::default() }),
                backend,
                ..reference.options(MethodName::Hierarchy)
            };
            match engine.distance(a, b, &options).wait() {
                Ok(result) => {
                    measured += 1;
                    let overlap = result.lower <= reference.upper && reference.lower <= result.upper;
                    assert!(overlap, "{name}: [{}, {}]", result.lower, result.upper);
                }
                Err(Error::PairBudgetExceeded { found, .. }) => refused.push(format!("{name}: {found}")),
                Err(error) => panic!("{name}: {error}"),
            }
        }
    }
    println!("over the budget of pairs: {refused:#?}");
    assert!(measured > 4 * refused.len(), "{refused:#?}");
}
