//! Forms of faces against points of their surfaces, as they are and with control points that are a little off.

use super::super::sheet::{Sheet, sheets};
use fastrand::Rng;
use glam::DVec3;
use nurbs_hausdorff::{FaceForm, Model};

/// The points along each parameter.
const GRID: usize = 24;

/// The part of the size by which control points are off: forms are stated up to a millionth.
const BENT: f64 = 3e-8;

/// Rounding of an evaluation and of a distance, relative to the size and to the largest coordinate.
const ROUNDING: f64 = 256.0 * f64::EPSILON;

/// Returns in words which forms do not hold the distances of points.
pub(super) fn violations(rng: &mut Rng, model: &Model) -> Vec<String> {
    let mut found = of_model(model);
    if let Some(bent) = bent(rng, model) {
        found.extend(of_model(&bent));
    }
    found
}

/// The model with the control points of a surface moved a little each; none where a trim refuses them.
fn bent(rng: &mut Rng, model: &Model) -> Option<Model> {
    let index = rng.usize(..model.surfaces().len());
    let step = BENT * model.bounding_box().diagonal();
    let mut points = model.surfaces()[index].control_points().to_vec();
    for coordinate in points.iter_mut().flat_map(|point| &mut point[..3]) {
        *coordinate += step * (2.0 * rng.f64() - 1.0);
    }
    model.with_control_points(index, points).ok()
}

fn of_model(model: &Model) -> Vec<String> {
    let aabb = model.bounding_box();
    let rounding = ROUNDING * (aabb.diagonal() + aabb.farthest_from_origin());
    let faces = model.surfaces().iter().map(FaceForm::of).zip(sheets(model, DVec3::ZERO));
    faces.filter_map(|(form, sheet)| form.and_then(|form| off(&form, &sheet, rounding))).collect()
}

/// A point that a form does not hold, in words.
fn off(form: &FaceForm, sheet: &Sheet, rounding: f64) -> Option<String> {
    let at = |k: usize| k as f64 / GRID as f64;
    let mut places = (0..=GRID).flat_map(|i| (0..=GRID).map(move |j| sheet.at([at(i), at(j)])));
    places.find_map(|place| {
        let (distance, lower, upper) = distance(form, sheet.point(place))?;
        let is_held = lower - rounding <= distance && distance <= upper + rounding;
        (!is_held).then(|| format!("{form:?}, a point is at {distance}"))
    })
}

/// The distance of a point from what a form is measured from, and the ends that are stated.
fn distance(form: &FaceForm, at: DVec3) -> Option<(f64, f64, f64)> {
    let from = |point: [f64; 3]| at - DVec3::from_array(point);
    let parts = |point: [f64; 3], direction: [f64; 3]| {
        let axis = DVec3::from_array(direction);
        (from(point).dot(axis), from(point).cross(axis).length())
    };
    Some(match *form {
        FaceForm::Plane { point, direction, deviation } => (parts(point, direction).0.abs(), 0.0, deviation),
        FaceForm::Sphere { point, radius } => (from(point).length(), radius.lower, radius.upper),
        FaceForm::Cylinder { point, direction, radius } => {
            (parts(point, direction).1, radius.lower, radius.upper)
        }
        FaceForm::Cone { point, direction, half_angle, deviation } => {
            let ((up, out), (sin, cos)) = (parts(point, direction), half_angle.to_radians().sin_cos());
            ((cos * out - sin * up).abs(), 0.0, deviation)
        }
        FaceForm::Torus { point, direction, major_radius, radius } => {
            let (up, out) = parts(point, direction);
            (up.hypot(out - major_radius), radius.lower, radius.upper)
        }
        _ => return None,
    })
}
