//! Least zones, of both sides and of one: no motion of the box lays all points of a scan nearer to the model than the
//! lower bound, and the audit of the search refutes none of its own bounds.

use super::brute::{Placed, Target};
use super::check::Outcome;
use super::clearance::{Triangles, triangles_of};
use super::sheet::{Sheet, sheets};
use super::solids::Shapes;
use super::surfaces::magnitude;
use fastrand::Rng;
use glam::{DQuat, DVec3};
use nurbs_hausdorff::internals::engine::{Engine, PreparedModel};
use nurbs_hausdorff::{
    BestFitOptions, Facets, FitNorm, FitStart, PointCloud, RigidTransform, Zone, ZoneOptions,
};
use std::time::Instant;

/// The points of a scan, at least and at most.
const POINTS: [usize; 2] = [20, 120];

/// The budgets of boxes: many searches end with a wide interval.
const BUDGETS: [usize; 3] = [1, 10, 80];

/// The motions that are drawn, and the steps from the best of them.
const DRAWN: usize = 40;
const STEPS: usize = 80;

/// Rounding of distances, relative to the largest coordinate.
const ROUNDING: f64 = 1e-9;

/// The norms that are drawn: half of them of both sides.
const NORMS: [FitNorm; 4] = [FitNorm::Largest, FitNorm::Largest, FitNorm::Outside, FitNorm::Inside];

/// The distance from a sheet at which its outer side is looked up, relative to the diagonal, and the number of places.
const BESIDE: f64 = 0.05;
const PLACES: usize = 12;

/// The sine of the angle to the normal up to which a foot is one inside a sheet.
const MAX_SINE: f64 = 1e-3;

/// Checks the zone of a seed: a scan with noise and bumps on a closed shape under an affine or a projective map.
pub(crate) fn check_zone(seed: u64, shapes: &Shapes) -> Outcome {
    let rng = &mut Rng::with_seed(seed);
    let not_drawn = || Outcome { refusal: Some("NOT_DRAWN"), ..Outcome::default() };
    let Some((name, model)) = shapes.draw(rng) else { return not_drawn() };
    let origin = model.bounding_box().center();
    let size = model.bounding_box().diagonal();
    let of_model = sheets(&model, origin);
    let noise = magnitude(rng, -6.0, -1.5) * size;
    let count = rng.usize(POINTS[0]..POINTS[1]);
    let mut points: Vec<DVec3> = (0..count)
        .map(|_| {
            let sheet = &of_model[rng.usize(0..of_model.len())];
            let point = sheet.tangents(sheet.at([rng.f64(), rng.f64()])).point;
            point + noise * any(rng)
        })
        .collect();
    if rng.bool() {
        // A bump: one point far off decides.
        let bumped = rng.usize(0..count);
        points[bumped] += magnitude(rng, 0.0, 1.5) * noise * any(rng);
    }
    let moved: Vec<DVec3> = points.iter().map(|point| *point + origin).collect();
    let (Ok(b), Ok(cloud)) = (PreparedModel::new(&model), PointCloud::new(moved.clone())) else {
        return not_drawn();
    };
    let Ok(a) = PreparedModel::of_facets(&Facets::Cloud(cloud), None) else { return not_drawn() };
    let norm = NORMS[rng.usize(0..NORMS.len())];
    let options = BestFitOptions {
        start: FitStart::Given,
        norm,
        zone: ZoneOptions {
            translation: Some(magnitude(rng, -5.0, -1.5) * size),
            degrees: magnitude(rng, -3.0, 1.0),
            max_boxes: BUDGETS[rng.usize(0..BUDGETS.len())],
            ..ZoneOptions::default()
        },
        max_steps: 1 + rng.usize(0..20),
        ..BestFitOptions::default()
    };
    let started = Instant::now();
    let found = match Engine::cpu().best_fit(&a, &b, &options).wait() {
        Ok(found) => found,
        Err(error) => return Outcome { refusal: Some(error.code()), ..Outcome::default() },
    };
    let seconds = started.elapsed().as_secs_f64();
    let Some(zone) = found.zone else { return not_drawn() };
    let target = Target::new(&of_model);
    let rounding = ROUNDING * (model.bounding_box().farthest_from_origin() + size);
    let sides = match norm {
        FitNorm::Largest => None,
        _ => Some(Sides::new(triangles_of(&model), &of_model, BESIDE * size, rng)),
    };
    let is_outside = norm == FitNorm::Outside;
    let motions = Motions {
        target: &target,
        points: &moved,
        origin,
        pose: found.transform,
        zone,
        sides: sides.as_ref().map(|sides| (sides, is_outside)),
    };
    let least = motions.least(rng);
    let violated = (least < zone.lower - rounding).then(|| {
        format!("seed {seed} ({name}, {norm:?}): a motion lays all points within {least}: {zone:?}")
    });
    let refuted =
        (zone.refuted > 0).then(|| format!("seed {seed} ({name}, {norm:?}): bounds are refuted: {zone:?}"));
    let converged = found.zone_proven == Some(true);
    Outcome {
        converged,
        cells: zone.boxes,
        seconds,
        violations: violated.into_iter().chain(refuted).collect(),
        ..Outcome::default()
    }
}

/// A vector with a length of at most 1.
fn any(rng: &mut Rng) -> DVec3 {
    loop {
        let drawn = DVec3::new(rng.f64(), rng.f64(), rng.f64()) * 2.0 - 1.0;
        if drawn.length() <= 1.0 {
            return drawn;
        }
    }
}

/// The motions of a box about a pose.
struct Motions<'a> {
    target: &'a Target<'a>,
    points: &'a [DVec3],
    origin: DVec3,
    pose: RigidTransform,
    zone: Zone,
    /// The sides of the model, and whether the outer one counts.
    sides: Option<(&'a Sides<'a>, bool)>,
}

/// Where a closed model is inside: by rays, and near a sheet by the side of its normal.
struct Sides<'a> {
    triangles: Triangles,
    sheets: &'a [Sheet],
    /// Whether the normal of each sheet points out; `None` where no place of it was certain.
    outwards: Vec<Option<bool>>,
}

impl<'a> Sides<'a> {
    fn new(triangles: Triangles, sheets: &'a [Sheet], beside: f64, rng: &mut Rng) -> Self {
        let mut at = |sheet: &Sheet| {
            let tangents = sheet.tangents(sheet.at([rng.f64(), rng.f64()]));
            let normal = beside * tangents.u.cross(tangents.v).normalize_or_zero();
            let is_inside = [normal, -normal].map(|off| triangles.contain(tangents.point + off));
            match is_inside {
                [Some(false), Some(true)] => Some(true),
                [Some(true), Some(false)] => Some(false),
                _ => None,
            }
        };
        let outwards = sheets.iter().map(|sheet| (0..PLACES).find_map(|_| at(sheet))).collect();
        Self { triangles, sheets, outwards }
    }

    /// Returns whether a point is inside, where that is certain.
    fn contain(&self, point: DVec3, foot: &Placed) -> Option<bool> {
        self.triangles.contain(point).or_else(|| {
            let tangents = self.sheets[foot.sheet].tangents(foot.parameters);
            let normal = tangents.u.cross(tangents.v).normalize_or_zero();
            let offset = point - tangents.point;
            let is_along = offset.cross(normal).length() <= MAX_SINE * offset.length();
            let is_out = self.outwards[foot.sheet].filter(|_| is_along)?;
            Some((offset.dot(normal) > 0.0) != is_out)
        })
    }
}

/// A motion of the box, as a part of its largest turn and shift.
type Motion = [DVec3; 2];

impl Motions<'_> {
    /// Returns the least largest distance found: of motions drawn, and of steps from the best of them.
    fn least(&self, rng: &mut Rng) -> f64 {
        let mut warm: Vec<Option<Placed>> = vec![None; self.points.len()];
        let mut best: Motion = [DVec3::ZERO; 2];
        let mut least = self.largest(best, &mut warm);
        for drawn in 0..DRAWN + STEPS {
            let scale = if drawn < DRAWN { magnitude(rng, -3.0, 0.0) } else { magnitude(rng, -4.0, -0.5) };
            let from = if drawn < DRAWN { [DVec3::ZERO; 2] } else { best };
            let motion = from.map(|part| (part + scale * any(rng)).clamp_length_max(1.0));
            let largest = self.largest(motion, &mut warm);
            if largest < least {
                (least, best) = (largest, motion);
            }
        }
        least
    }

    /// Returns an upper bound on the largest distance of the points in a motion of the box, on both sides or on one.
    fn largest(&self, [turn, shift]: Motion, warm: &mut [Option<Placed>]) -> f64 {
        let center = DVec3::from_array(self.zone.center);
        let rotation = DQuat::from_scaled_axis(self.zone.degrees.to_radians() * turn);
        let mut largest = f64::NEG_INFINITY;
        for (point, warm) in self.points.iter().zip(warm) {
            let image = self.pose.apply(*point) - center;
            let image = center + rotation * image + self.zone.translation * shift;
            let found = self.target.near(image - self.origin, *warm);
            *warm = Some(found);
            let is_on_the_other_side = self.sides.is_some_and(|(sides, is_outside)| {
                sides.contain(image - self.origin, &found) == Some(is_outside)
            });
            largest = largest.max(if is_on_the_other_side { -found.distance } else { found.distance });
        }
        largest
    }
}
