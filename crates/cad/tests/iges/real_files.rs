//! The files beside the project, when they are there.

use crate::support::root::root;
use nurbs_hausdorff::internals::engine::{DistanceOptions, Engine, PreparedModel};
use nurbs_hausdorff_cad::{from_iges, from_step};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Files, their numbers of faces, and upper bounds on their gaps in millimetres: of their
/// curves in the parameters, which are wrong by as much.
const FILES: [(&str, usize, f64); 2] = [("iges/bearing.iges", 213, 1e-5), ("iges/hammer.iges", 45, 3.0)];

/// The folder of the files, if it is there.
fn models() -> Option<PathBuf> {
    let models = root().join("../shared/models");
    if !models.exists() {
        println!("SKIPPED: ../shared/models is absent");
        return None;
    }
    Some(models)
}

fn unpacked(models: &Path, file: &str) -> Vec<u8> {
    let unpacked = Command::new("gunzip").arg("-c").arg(models.join(format!("{file}.gz"))).output().unwrap();
    assert!(unpacked.status.success(), "{file}");
    unpacked.stdout
}

/// The distances between a STEP file and an IGES file are those of `trimmed.jsonl`, which are
/// lower bounds by OpenCASCADE but for its own errors.
#[test]
fn distances_are_those_of_opencascade() {
    let Some(models) = models() else { return };
    let rods = from_step(&unpacked(&models, "step/linkrods.step")).unwrap().0;
    let bearing = from_iges(&unpacked(&models, "iges/bearing.iges")).unwrap().0;
    let [rods, bearing] = [rods, bearing].map(|model| PreparedModel::new(&model).unwrap());
    let options = DistanceOptions { relative_tolerance: Some(1e-4), ..DistanceOptions::default() };
    let distance = |a: &PreparedModel, b: &PreparedModel| {
        let engine = Engine::cpu();
        engine.distance(a, b, &options).wait().unwrap()
    };
    for (found, expected) in
        [(distance(&rods, &bearing), 8.893_692_726_09), (distance(&bearing, &rods), 4.358_231_734_33)]
    {
        // The gap is the part of the truth that the files leave open.
        let slack = found.gap;
        assert!(found.lower - slack <= expected && expected <= found.upper + slack, "{found:?}");
    }
}

#[test]
fn every_face_of_real_files_is_read() {
    let Some(models) = models() else { return };
    for (file, faces, gap) in FILES {
        let (model, report) = from_iges(&unpacked(&models, file)).unwrap();
        assert_eq!((report.skipped.len(), report.notes.len()), (0, 0), "{file}");
        assert_eq!((report.faces, model.faces().len()), (faces, faces), "{file}");
        assert!(report.gap <= gap, "{file}: {}", report.gap);
    }
}
