//! Real STEP files: every face is read, within the accuracy that the file states.

use crate::support::root::root;
use nurbs_hausdorff_cad::from_step;
use std::process::Command;

/// The files with their numbers of faces by OpenCASCADE 7.9, and bounds on the gap in
/// millimetres: 10 µm is the uncertainty that most of them state.
const FILES: [(&str, usize, f64); 20] = [
    ("step/AMSurface.step", 1, 1e-8),
    ("step/NIST_MBE_PMI_1.stp", 113, 1e-2),
    ("step/NIST_MBE_PMI_11.stp", 10, 1e-8),
    ("step/NIST_MBE_PMI_2.stp", 597, 1e-2),
    ("step/NIST_MBE_PMI_5.stp", 163, 1e-2),
    ("step/axom_revolved_sphere.step", 1, 1e-8),
    ("step/axom_sliced_cylinder.step", 5, 1e-2),
    ("step/axom_tet.step", 4, 1e-8),
    ("step/base_interface_AP203.STEP", 30, 1e-8),
    ("step/featuretype.STEP", 96, 1e-6),
    ("step/linkrods.step", 37, 1e-3),
    ("step/screw.step", 10, 1e-3),
    ("so101/Base_SO101.step", 572, 1e-2),
    ("so101/Motor_holder_SO101_Base.step", 204, 1e-2),
    ("so101/Motor_holder_SO101_Wrist.step", 182, 1e-2),
    ("so101/Rotation_Pitch_SO101.step", 229, 1e-2),
    ("so101/Seeedstudio_Mounting_Plate_SO101.step", 37, 1e-8),
    ("so101/Trigger_SO101.step", 83, 1e-2),
    ("so101/Upper_arm_SO101.step", 326, 1e-2),
    ("so101/WaveShare_Mounting_Plate_SO101.step", 37, 1e-8),
];

#[test]
fn every_face_of_real_files_is_read() {
    let models = root().join("../shared/models");
    if !models.exists() {
        println!("SKIPPED: ../shared/models is absent");
        return;
    }
    for (file, faces, gap) in FILES {
        let unpacked =
            Command::new("gunzip").arg("-c").arg(models.join(format!("{file}.gz"))).output().unwrap();
        assert!(unpacked.status.success(), "{file}");
        let (model, report) = from_step(&unpacked.stdout).unwrap();
        assert_eq!(report.skipped, [], "{file}");
        assert_eq!((report.faces, model.faces().len()), (faces, faces), "{file}");
        assert!(report.gap <= gap, "{file}: {}", report.gap);
    }
}
