//! Bodies that are embedded, as no map of a shape that is embedded makes it meet itself.

use nurbs_hausdorff::internals::engine::{Engine, PreparedModel};
use nurbs_hausdorff::{CheckOptions, NamedModel};

/// Returns in words which bodies are said to meet themselves.
pub(super) fn violations(model: &PreparedModel) -> Vec<String> {
    let options = CheckOptions { max_cells: 1, ..CheckOptions::default() };
    match Engine::cpu().check(&[NamedModel { name: None, model }], &options).wait() {
        Ok(result) => {
            let found = result.bodies.iter().filter_map(|body| body.self_overlap.as_ref());
            found.map(|found| format!("a body that is embedded meets itself: {found:?}")).collect()
        }
        Err(error) => vec![format!("check: {error}")],
    }
}
