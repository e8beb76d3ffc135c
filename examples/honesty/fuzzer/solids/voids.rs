//! Shapes as voids of boxes with thin walls about them, whose control points may be outside of the box.

use super::super::surfaces::magnitude;
use fastrand::Rng;
use nurbs_hausdorff::internals::engine::{Engine, PreparedModel};
use nurbs_hausdorff::{CheckOptions, Model, NamedModel, PairState, SurfaceArrays};

/// The exponents of 10 of a wall's thickness, relative to the box.
const WALLS: [f64; 2] = [-4.0, -0.5];

/// Returns in words what is said wrongly of a box about a shape: the shape is a void of it, however its faces are
/// oriented, and not a body that clashes with the box.
pub(super) fn violations(rng: &mut Rng, shape: &PreparedModel, model: &Model) -> Vec<String> {
    let facts = shape.facts();
    let (Some(volume), 1) = (facts.volume, shape.bodies().len()) else { return Vec::new() };
    let [min, max] = [facts.min.map(|at| at.lower), facts.max.map(|at| at.upper)];
    let size = (0..3).map(|axis| max[axis] - min[axis]).fold(0.0, f64::max);
    let mut wall = || size * magnitude(rng, WALLS[0], WALLS[1]);
    let [min, max] = [min.map(|at| at - wall()), max.map(|at| at + wall())];
    let surfaces =
        model.surfaces().iter().map(|surface| surface.clone().into_arrays()).chain(sides(min, max));
    let built = Model::from_arrays(None, surfaces.collect());
    let Some(hollow) = built.ok().and_then(|model| PreparedModel::new(&model).ok()) else {
        return Vec::new();
    };
    let whole: f64 = (0..3).map(|axis| max[axis] - min[axis]).product();
    let mut found = Vec::new();
    if let Some(stated) = hollow.facts().volume {
        let rounding = 1e-13 * whole;
        if stated.lower - rounding > whole - volume.lower || stated.upper + rounding < whole - volume.upper {
            found.push(format!("a box of {whole} with a void of {volume:?} has {stated:?}"));
        }
    }
    let models = [NamedModel { name: None, model: &hollow }];
    let options = CheckOptions { max_cells: 1_000, ..CheckOptions::default() };
    match Engine::cpu().check(&models, &options).wait() {
        Ok(result) => {
            let clashes = result.pairs.iter().filter(|pair| pair.state == PairState::Clash);
            found.extend(clashes.map(|pair| format!("a void clashes with its body: {pair:?}")));
        }
        Err(error) => found.push(format!("check: {error}")),
    }
    found
}

/// The sides of a box.
fn sides(min: [f64; 3], max: [f64; 3]) -> impl Iterator<Item = SurfaceArrays> {
    (0..6).map(move |side| {
        let (axis, at) = (side % 3, if side < 3 { min } else { max });
        let corner = |u: usize, v: usize| {
            let mut point = at;
            for (step, is_far) in [(1, u), (2, v)] {
                let along = (axis + step) % 3;
                point[along] = if is_far == 1 { max[along] } else { min[along] };
            }
            [point[0], point[1], point[2], 1.0]
        };
        SurfaceArrays {
            degree: [1, 1],
            knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
            counts: [2, 2],
            control_points: vec![corner(0, 0), corner(0, 1), corner(1, 0), corner(1, 1)],
        }
    })
}
