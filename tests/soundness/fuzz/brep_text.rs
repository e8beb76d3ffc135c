//! Any text is either refused or a model whose JSON gives the same JSON again, and whose
//! report counts its faces.

use nurbs_hausdorff::Model;
use nurbs_hausdorff_cad::from_brep;

pub fn check(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    match from_brep(text) {
        Ok((model, report)) => {
            assert!(report.faces > 0 && report.exact + report.fitted == report.trims);
            assert!(report.gap.is_finite());
            let json = model.to_json().unwrap();
            assert_eq!(Model::from_json(&json).unwrap().to_json().unwrap(), json);
        }
        Err(error) => assert!(!error.to_string().is_empty() && !error.code().is_empty()),
    }
}
