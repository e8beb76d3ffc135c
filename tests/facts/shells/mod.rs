//! Bodies of several shells: those that meet, voids, and edges of more than two faces.

mod branched;
mod grids;
mod voids;

use crate::models::{Quad, faces, of, of_quads, prepared, quads_of_box};
use nurbs_hausdorff::{CheckOptions, CheckResult, DVec3, Engine, NamedModel, PreparedModel};

fn block(min: [f64; 3], max: [f64; 3]) -> Vec<Quad> {
    quads_of_box(DVec3::from_array(min), DVec3::from_array(max)).to_vec()
}

fn turned(quads: &[Quad]) -> Vec<Quad> {
    quads.iter().map(|&[a, b, c, d]| [d, c, b, a]).collect()
}

/// Builds one model of several solids from their shells. The faces carry the numbers of their solid and shell.
fn of_solids(solids: &[&[Vec<Quad>]]) -> PreparedModel {
    let faces = solids.iter().enumerate().flat_map(|(solid, shells)| {
        shells.iter().enumerate().flat_map(move |(shell, quads)| {
            faces(&of_quads(quads)).into_iter().map(move |mut face| {
                (face.solid, face.shell) = (Some(solid as u32), Some((10 * solid + shell) as u32));
                face
            })
        })
    });
    prepared(&of(faces.collect()))
}

fn check(model: &PreparedModel) -> CheckResult {
    let models = [NamedModel { name: None, model }];
    Engine::cpu().check(&models, &CheckOptions::default()).wait().unwrap()
}
