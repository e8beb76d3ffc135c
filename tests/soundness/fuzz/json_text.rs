//! Any text is either refused or a model that its own text gives again.

use nurbs_hausdorff::Model;

pub fn check(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    match Model::from_json(text) {
        Ok(model) => assert_eq!(Model::from_json(&model.to_json().unwrap()), Ok(model)),
        Err(error) => assert!(!error.to_string().is_empty() && !error.code().is_empty()),
    }
}
