//! The reference pairs of `../shared/models`, on both backends.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

mod support;

use glam::DVec3;
use nurbs_hausdorff::distance::{Backend, Engine, Method, Options, PreparedModel, Silent};
use nurbs_hausdorff::{Model, RigidTransform};
use std::collections::HashMap;
use std::path::Path;
use support::{gpu::engine, models::folder};

/// What two backends may differ by, relative to the diagonal.
const FLOAT32: f64 = 1e-5;

/// Rounding of the references, relative to the diagonal.
const ROUNDING: f64 = 1e-12;

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
            PreparedModel::new(&Model::from_json(&text).unwrap())
        });
    }
}

impl Reference {
    fn options(&self, method: Method) -> Options {
        Options {
            method,
            transform: RigidTransform::translation(self.translation).unwrap(),
            ..Options::default()
        }
    }

    /// A translated copy is never farther than it was moved, as every point
    /// is that far from where it came from. One reference claims more.
    fn is_impossible(&self) -> bool {
        self.a == self.b && self.lower > self.translation.length() * (1.0 + ROUNDING)
    }
}

#[test]
fn samples_and_bounds_agree_with_every_reference() {
    let Some(folder) = folder("samples_and_bounds_agree_with_every_reference") else { return };
    let Some(engine) = engine("samples_and_bounds_agree_with_every_reference") else { return };
    let mut shelf = Shelf { folder: &folder, prepared: HashMap::new() };
    for reference in references(&folder) {
        shelf.load(&reference.a);
        shelf.load(&reference.b);
        let (a, b) = (&shelf.prepared[&reference.a], &shelf.prepared[&reference.b]);
        let name = format!("{} to {} {}", reference.a, reference.b, reference.translation);
        let [gpu, cpu] = [Backend::Gpu, Backend::Cpu].map(|backend| {
            let options = Options { backend, ..reference.options(Method::Iteration) };
            let result = pollster::block_on(engine.distance(a, b, &options, &mut Silent)).unwrap();
            let rounding = ROUNDING * result.diagonal;
            let bounds = result.iteration.unwrap().bounds;
            assert!(result.converged, "{name}");
            assert!(result.computed <= reference.upper + rounding, "{name}: {}", result.computed);
            // Samples miss the farthest point by up to K_A; what the projection can be off by is less.
            let missed = bounds.k_a_rigorous + bounds.k_b.unwrap_or(0.0);
            assert!(result.computed >= reference.lower - missed, "{name}: {}", result.computed);
            assert!(result.lower <= reference.upper && reference.lower <= result.upper, "{name}");
            result
        });
        assert!((gpu.computed - cpu.computed).abs() <= FLOAT32 * cpu.diagonal, "{name}");
    }
}

#[test]
fn certified_intervals_overlap_every_reference() {
    let Some(folder) = folder("certified_intervals_overlap_every_reference") else { return };
    let engine = pollster::block_on(Engine::new(Backend::Cpu)).unwrap();
    let mut shelf = Shelf { folder: &folder, prepared: HashMap::new() };
    let mut impossible = 0;
    for reference in references(&folder) {
        shelf.load(&reference.a);
        shelf.load(&reference.b);
        let (a, b) = (&shelf.prepared[&reference.a], &shelf.prepared[&reference.b]);
        let name = format!("{} to {} {}", reference.a, reference.b, reference.translation);
        let options = reference.options(Method::Certified);
        let result = pollster::block_on(engine.distance(a, b, &options, &mut Silent)).unwrap();
        let details = result.certified.unwrap();
        assert!(result.converged, "{name}: {:?}", details.stop);
        assert!(result.upper - result.lower <= details.tolerance + ROUNDING * result.diagonal, "{name}");
        if reference.is_impossible() {
            impossible += 1;
            assert!(result.lower <= reference.translation.length(), "{name}");
            assert!(result.upper <= reference.translation.length() + details.tolerance, "{name}");
        } else {
            let overlap = result.lower <= reference.upper && reference.lower <= result.upper;
            assert!(overlap, "{name}: [{}, {}]", result.lower, result.upper);
        }
    }
    assert_eq!(impossible, 1, "the reference of the duck moved by 0.001");
}
