//! Models of the papers' sizes: read from beside the project, or stand-ins.

use super::Anyhow;
use glam::{DQuat, DVec3};
use nurbs_hausdorff::shapes::operations::transformed;
use nurbs_hausdorff::shapes::{WavySheet, shape, sphere, wavy_sheet};
use nurbs_hausdorff::{Model, RigidTransform};
use std::path::{Path, PathBuf};

/// A model of `../shared/models`, or `None` if that is not there.
pub(crate) fn shared(name: &str) -> Anyhow<Option<Model>> {
    let path: PathBuf =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/models").join(format!("{name}.json"));
    if !path.is_file() {
        return Ok(None);
    }
    Ok(Some(Model::from_json(&std::fs::read_to_string(path)?)?))
}

/// A wavy sheet with `counts` control points; `variant` changes the waves, so
/// that two sheets differ.
pub(crate) fn sheet(counts: [usize; 2], variant: usize) -> Anyhow<Model> {
    // Enough control points a wave to be smooth, and few enough waves to see.
    const POINTS_A_WAVE: f64 = 5.0;
    const MOST_WAVES: f64 = 4.0;
    let stretch = 1.0 + 0.3 * variant as f64;
    let waves = counts.map(|count| (count as f64 / POINTS_A_WAVE).min(MOST_WAVES) / stretch);
    let amplitude = SHEET_SIZE / (8.0 * waves[0].max(waves[1]));
    let sheet = WavySheet { counts, size: [SHEET_SIZE; 2], amplitude, waves, phase: 0.7 * variant as f64 };
    Ok(wavy_sheet(&sheet)?)
}

/// Side of a sheet, the size of most shapes of ours.
const SHEET_SIZE: f64 = 5.0;

/// The duck's body, or a bottle of about its patches.
pub(crate) fn duck_body() -> Anyhow<Model> {
    match shared("duck")? {
        Some(duck) => Ok(Model::new(Some("duck body".to_owned()), duck.surfaces()[..1].to_vec())?),
        None => Ok(shape("bottle")?),
    }
}

/// The duck of three surfaces, or a glass and two spheres.
pub(crate) fn duck() -> Anyhow<Model> {
    if let Some(duck) = shared("duck")? {
        return Ok(duck);
    }
    let balls = [sphere(DVec3::new(0.0, 0.0, 2.0), 0.6)?, sphere(DVec3::new(0.8, 0.0, 3.0), 0.4)?];
    together("glass and two spheres", &[shape("glass")?, balls[0].clone(), balls[1].clone()])
}

/// The teapot of four surfaces, or a bottle, two tori and a sphere.
pub(crate) fn teapot() -> Anyhow<Model> {
    if let Some(teapot) = shared("utah_teapot_4nurbs")? {
        return Ok(teapot);
    }
    let upright = RigidTransform::new(DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2), DVec3::X)?;
    let handle = transformed(&shape("torus")?, &upright)?;
    let lid = sphere(DVec3::new(0.0, 0.0, 6.0), 0.5)?;
    together("bottle, two tori and a sphere", &[shape("bottle")?, handle, shape("torus-fatter")?, lid])
}

fn together(name: &str, models: &[Model]) -> Anyhow<Model> {
    let surfaces = models.iter().flat_map(Model::surfaces).cloned().collect();
    Ok(Model::new(Some(name.to_owned()), surfaces)?)
}
