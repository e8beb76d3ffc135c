//! The check of one pair.

use super::attacks;
use super::brute::{Placed, RIM_ROUNDING, Target};
use super::pairs::{Pair, pair};
use super::partners::scale_and_shift;
use super::sheet::{Sheet, sheets};
use super::surfaces::magnitude;
use super::trims::{self, Rim};
use crate::proof::{self, Motion, Side, Witness};
use crate::support::evaluator::point;
use fastrand::Rng;
use glam::{DVec2, DVec3};
use nurbs_hausdorff::engine::{
    Backend, Details, DistanceResult, Engine, Options, PreparedModel, SurfacePoint,
};
use nurbs_hausdorff::progress::NoMonitor;
use nurbs_hausdorff::{Error, Model, RigidTransform};
use std::cell::{Cell, OnceCell};
use std::f64::consts::TAU;
use std::time::{Duration, Instant};

/// The number of samples along each axis of a surface of A, one at random in each
/// cell of a grid, as the library's own samples are at dyadic fractions.
const SAMPLES: usize = 11;

/// The number of samples from which local searches for farther points start, and the
/// rounds of each.
const CLIMBS: usize = 6;
const CLIMB_ROUNDS: usize = 24;

/// Samples of method `iteration` and cells of method `hierarchy` along each direction.
const SAMPLES_OF_ITERATION: usize = 12;
const GRID_OF_HIERARCHY: usize = 16;

/// The rounding error of coordinates, the transform's included, relative to the
/// largest one: 16 units of 2^-53.
const COORDINATE_ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The distance of a witness from the point at its parameters, in units of 2^-53 of the largest
/// coordinate: knots are removed where that moves points by less (R15 of docs/method.md).
const WITNESS_ROUNDING: f64 = 512.0 * f64::EPSILON;

/// The rounding error of points relative to the models' size, as each model is
/// evaluated relative to an origin near it.
const SIZE_ROUNDING: f64 = 1e-14;

/// The exponents of 10 between which samples near loops are away from them, relative to the domain.
const NEAR_LOOPS: [f64; 2] = [-10.0, -1.0];

/// The time after which the proof that a point is farther than `upper` is given up, and the number
/// of points of a direction that are given up before the others are left out.
const PROOF_TIME: Duration = Duration::from_secs(5);
const MAX_UNDECIDED: usize = 3;

/// The refusal of a pair of which no valid model was drawn.
const NOT_DRAWN: &str = "NOT_DRAWN";

/// The outcome of the check of a pair.
#[derive(Default)]
pub(crate) struct Outcome {
    pub(crate) converged: bool,
    pub(crate) cells: usize,
    /// The seconds of the computation, without the check.
    pub(crate) seconds: f64,
    /// The code of the error by which the library refused the pair.
    pub(crate) refusal: Option<&'static str>,
    pub(crate) violations: Vec<String>,
    /// Directions with points that were neither found within `upper` nor proved farther.
    pub(crate) undecided: usize,
}

/// Checks the pair of a seed of the ordinary families.
pub(crate) fn check(seed: u64) -> Outcome {
    check_pair(seed, &pair(seed))
}

/// Checks the pair of a seed of the attack's families.
pub(crate) fn check_attack(seed: u64) -> Outcome {
    attacks::pair(seed).map_or_else(
        || Outcome { refusal: Some(NOT_DRAWN), ..Outcome::default() },
        |pair| check_pair(seed, &pair),
    )
}

/// Checks the pair of a seed of trimmed models.
pub(crate) fn check_trimmed(seed: u64) -> Outcome {
    trims::pair(seed).map_or_else(
        || Outcome { refusal: Some(NOT_DRAWN), ..Outcome::default() },
        |pair| {
            let mut outcome = check_pair(seed, &pair);
            for (name, model) in [("A", &pair.a), ("B", &pair.b)] {
                let fault = trims::fault(model).map(|fault| format!("seed {seed}: {name}: {fault}"));
                outcome.violations.extend(fault);
            }
            outcome
        },
    )
}

thread_local! {
    /// An engine on the GPU, if there is one: its set-up takes longer than a pair.
    static GPU: Engine = pollster::block_on(Engine::new(Backend::Auto)).unwrap();
    static CPU: Engine = pollster::block_on(Engine::new(Backend::Cpu)).unwrap();
}

fn check_pair(seed: u64, pair: &Pair) -> Outcome {
    let started = Instant::now();
    let diagonal = pair.a.bounding_box().diagonal().max(pair.b.bounding_box().diagonal());
    let options = Options {
        // Two points have no diagonal for a relative tolerance.
        absolute: diagonal == 0.0,
        tolerance: pair.tolerance,
        max_cells: Some(pair.max_cells),
        transform: pair.transform,
        symmetric: pair.symmetric,
        limit: pair.limit.map(|limit| limit * diagonal),
        method: pair.method,
        samples: SAMPLES_OF_ITERATION,
        grid: GRID_OF_HIERARCHY,
        backend: pair.backend,
        ..Options::default()
    };
    let (result, deviations) = match measure(pair, &options) {
        Ok(measured) => measured,
        Err(error) => {
            let violations =
                if is_refusal(&error) { Vec::new() } else { vec![format!("seed {seed}: {error}")] };
            return Outcome { refusal: Some(error.code()), violations, ..Outcome::default() };
        }
    };
    let seconds = started.elapsed().as_secs_f64();
    let directions = [(Some(&result), false), (result.reverse.as_deref(), true)];
    let mut violations = Vec::new();
    let mut undecided = 0;
    for (directed, reversed) in directions {
        let Some(directed) = directed else { continue };
        let directed = if reversed { directed } else { result.forward.as_deref().unwrap_or(directed) };
        let direction = Direction::new(pair, directed, &options, reversed, deviations);
        violations.extend(direction.violations(&mut Rng::with_seed(seed)));
        undecided += usize::from(direction.undecided.get() > 0);
    }
    Outcome {
        converged: result.converged,
        cells: result.certified().map_or(0, |details| details.cells),
        seconds,
        refusal: None,
        undecided,
        violations: violations
            .into_iter()
            .map(|what| format!("seed {seed} ({}): {what}", pair.kind))
            .collect(),
    }
}

/// Measures a pair scaled by its power of two, and returns the result scaled back, with the
/// deviations of the pieces of both models' trimmed faces.
fn measure(pair: &Pair, options: &Options) -> Result<(DistanceResult, [f64; 2]), Error> {
    let scale = 2.0_f64.powi(pair.exponent);
    let mut scaled = [pair.a.clone(), pair.b.clone()];
    let mut options = options.clone();
    if pair.exponent != 0 {
        for model in &mut scaled {
            let mut surfaces: Vec<_> =
                model.surfaces().iter().map(|surface| surface.clone().into_arrays()).collect();
            scale_and_shift(&mut surfaces, scale, [0.0; 3]);
            *model = Model::from_arrays(None, surfaces)?;
        }
        options.limit = options.limit.map(|limit| limit * scale);
        let offset = pair.transform.offset() * scale;
        options.transform = RigidTransform::new(pair.transform.rotation(), offset)?;
        if options.absolute {
            options.tolerance *= scale;
        }
    }
    let [a, b] = [PreparedModel::new(&scaled[0])?, PreparedModel::new(&scaled[1])?];
    let engine = if pair.backend == Backend::Cpu { &CPU } else { &GPU };
    let mut result = engine.with(|engine| {
        // `Auto` would not use an adapter in software.
        options.backend = if engine.has_gpu() { Backend::Gpu } else { Backend::Cpu };
        pollster::block_on(engine.distance(&a, &b, &options, &mut NoMonitor))
    })?;
    scale_back(&mut result, scale.recip());
    Ok((result, [a.deviation(), b.deviation()].map(|deviation| deviation / scale)))
}

/// Multiplies all lengths of a result that are checked.
fn scale_back(result: &mut DistanceResult, scale: f64) {
    for length in [&mut result.diagonal, &mut result.computed, &mut result.lower, &mut result.upper]
        .into_iter()
        .chain(&mut result.witness.a.point)
        .chain(&mut result.witness.b.point)
    {
        *length *= scale;
    }
    if let Details::Certified(details) = &mut result.details {
        details.tolerance *= scale;
        details.min_tolerance *= scale;
    }
    for directed in [&mut result.forward, &mut result.reverse].into_iter().flatten() {
        scale_back(directed, scale);
    }
}

/// Whether an error is one by which a pair may be refused.
fn is_refusal(error: &Error) -> bool {
    matches!(
        error.code(),
        "PAIR_BUDGET_EXCEEDED" | "NUMBER_TOO_LARGE" | "WEIGHT_RATIO_TOO_LARGE" | "FACE_NOT_CUT"
    )
}

/// The check of one direction; the models have these poses.
struct Direction<'a> {
    from: &'a Model,
    to: &'a Model,
    poses: [RigidTransform; 2],
    result: &'a DistanceResult,
    witness: [&'a SurfacePoint; 2],
    truth: Option<f64>,
    limit: Option<f64>,
    rounding: f64,
    /// The deviations of the pieces of the trimmed faces of both models.
    deviations: [f64; 2],
    /// The models for proofs, once one is needed, and the points on which none succeeded.
    proof: OnceCell<proof::Pair>,
    undecided: Cell<usize>,
}

impl<'a> Direction<'a> {
    fn new(
        pair: &'a Pair,
        result: &'a DistanceResult,
        options: &Options,
        reversed: bool,
        deviations: [f64; 2],
    ) -> Self {
        let boxes = [pair.a.bounding_box(), pair.b.bounding_box()];
        let largest =
            boxes.iter().map(|aabb| aabb.min.abs().max(aabb.max.abs()).max_element()).fold(0.0, f64::max);
        let rounding = COORDINATE_ROUNDING * (largest + pair.transform.offset().length())
            + SIZE_ROUNDING * (result.diagonal + result.computed)
            // Validation moves loops next to the edge of the domain onto it, by this and no more; a
            // region moves by at most twice as much as its loops.
            + 2.0 * result.model_gap;
        let (models, poses) = ([&pair.a, &pair.b], [pair.transform, RigidTransform::IDENTITY]);
        let witness = [&result.witness.a, &result.witness.b];
        let [from, to] = if reversed { [1, 0] } else { [0, 1] };
        Self {
            from: models[from],
            to: models[to],
            poses: [poses[from], poses[to]],
            result,
            witness: [witness[from], witness[to]],
            truth: pair.truth.map(|both| both[from]).filter(|truth| !truth.is_nan()),
            limit: options.limit,
            rounding,
            deviations: [deviations[from], deviations[to]],
            proof: OnceCell::new(),
            undecided: Cell::new(0),
        }
    }

    fn violations(&self, rng: &mut Rng) -> Vec<String> {
        let DistanceResult { lower, upper, computed, .. } = self.result;
        let mut violations = Vec::new();
        if !(*lower <= *computed && *computed <= *upper && upper.is_finite()) {
            violations.push(format!("lower {lower}, computed {computed}, upper {upper}"));
        }
        if let Some(truth) = self.truth
            && !(*lower <= truth + self.rounding && truth - self.rounding <= *upper)
        {
            violations.push(format!("{truth} is not in [{lower}, {upper}]"));
        }
        self.check_witness(&mut violations);
        self.check_distances(rng, &mut violations);
        let Some(details) = self.result.certified() else { return violations };
        let deviation: f64 = self.deviations.iter().sum();
        let wide = upper - lower > details.tolerance + 200.0 * self.rounding + 4.0 * deviation;
        if self.result.converged && self.limit.is_none() && wide {
            violations.push(format!("converged, but [{lower}, {upper}] is {} wide", upper - lower));
        }
        let decided = self
            .limit
            .and_then(|limit| if *upper <= limit { Some(true) } else { (*lower > limit).then_some(false) });
        if details.within != decided {
            violations
                .push(format!("within {:?}, [{lower}, {upper}], limit {:?}", details.within, self.limit));
        }
        violations
    }

    /// Checks that the witnesses lie at their parameters, and at the computed distance.
    fn check_witness(&self, violations: &mut Vec<String>) {
        let [start, end] = self.witness.map(|witness| DVec3::from_array(witness.point));
        let models = [self.from, self.to].into_iter().zip(&self.poses).zip(self.deviations);
        for (((model, pose), deviation), witness) in models.zip(self.witness) {
            let surface = &model.surfaces()[witness.surface];
            let evaluate = |u: f64, v: f64| pose.apply(DVec3::from_array(point(surface, u, v)));
            // Rounding of the parameters moves the point.
            let [du, dv] = [witness.u, witness.v].map(|parameter| 2.0 * f64::EPSILON * parameter.abs());
            let at = evaluate(witness.u, witness.v);
            let [[u0, u1], [v0, v1]] = surface.domain().intervals();
            let parameter_error = [-1.0, 1.0].map(|sign| {
                let along_u = evaluate((witness.u + sign * du).clamp(u0, u1), witness.v).distance(at);
                along_u + evaluate(witness.u, (witness.v + sign * dv).clamp(v0, v1)).distance(at)
            });
            let error = at.distance(DVec3::from_array(witness.point));
            let witness_rounding = WITNESS_ROUNDING * at.abs().max_element();
            let allowed =
                self.rounding + witness_rounding + deviation + parameter_error[0] + parameter_error[1];
            if error > allowed {
                violations.push(format!("a witness is {error} from the point at its parameters"));
            }
            if model.is_trimmed() && self.is_off_face(model, witness, allowed) {
                violations.push(format!("a witness is not on face {}, to {allowed}", witness.surface));
            }
        }
        let between = start.distance(end);
        if (between - self.result.computed).abs() > self.rounding {
            violations.push(format!("the witnesses are {between} apart, computed {}", self.result.computed));
        }
    }

    /// Whether a witness at its parameters is proved farther than `limit` from its trimmed model.
    fn is_off_face(&self, model: &Model, witness: &SurfacePoint, limit: f64) -> bool {
        let origin = model.bounding_box().center();
        let sheets = sheets(model, origin);
        let parameters = DVec2::new(witness.u, witness.v);
        let point = sheets[witness.surface].point(parameters);
        if Target::new(&sheets).is_within(point, limit, (witness.surface, parameters)) {
            return false;
        }
        let definition = definition(model);
        let pair = proof::Pair::new(&definition, &Motion::IDENTITY, &definition);
        let side = |surface: usize, corners: [[f64; 2]; 2]| side(&sheets[surface], corners);
        let deadline = Instant::now() + PROOF_TIME;
        pair.is_farther_from_part(witness.surface, [parameters.to_array(); 2], limit, deadline, &side)
            == Some(true)
    }

    /// Checks by brute force that no point of A found is farther than `upper`, and no
    /// point of B found is nearer to the witness than `lower`.
    fn check_distances(&self, rng: &mut Rng, violations: &mut Vec<String>) {
        let DistanceResult { lower, upper, .. } = self.result;
        let [from_origin, to_origin] = [self.from, self.to].map(|model| model.bounding_box().center());
        let to_sheets = sheets(self.to, to_origin);
        let from_sheets = sheets(self.from, from_origin);
        let target = Target::new(&to_sheets);
        // The transform from the frame of one model's sheets into that of the other's.
        let shift = self.poses[1].apply_inverse(self.poses[0].apply(from_origin)) - to_origin;
        let turn = self.poses[1].rotation().inverse() * self.poses[0].rotation();
        let into = |point: DVec3| turn * point + shift;
        let witness = self.witness[0];
        let start = self.poses[1].apply_inverse(DVec3::from_array(witness.point)) - to_origin;
        let least = target.least(start);
        if least.distance + target.rim_error(&least) < lower - self.rounding {
            violations.push(format!("lower {lower}, but B is {} from the witness", least.distance));
        }
        let mut samples = Vec::new();
        // The witness on a trimmed face is checked to be near it, and need not be a point of it.
        if from_sheets[witness.surface].region.is_none() {
            let parameters = DVec2::new(witness.u, witness.v);
            samples.push((Sample { sheet: witness.surface, parameters, is_rim: false }, start));
        }
        for (index, sheet) in from_sheets.iter().enumerate() {
            for (parameters, is_rim) in sample_parameters(sheet, rng) {
                let point = into(sheet.point(parameters));
                samples.push((Sample { sheet: index, parameters, is_rim }, point));
            }
        }
        let mut found: Vec<(Sample, Placed)> =
            samples.iter().map(|&(sample, point)| (sample, target.near(point, None))).collect();
        let first = usize::from(from_sheets[witness.surface].region.is_none());
        found[first..].sort_unstable_by(|a, b| b.1.distance.total_cmp(&a.1.distance));
        let beyond = upper + self.rounding;
        let is_beyond = |point: DVec3, at: Sample| {
            !target.is_within(point, beyond, (at.sheet, at.parameters))
                && self.is_proved_beyond(at, beyond, &to_sheets)
        };
        for &(sample, near) in &found {
            let point = into(from_sheets[sample.sheet].point(sample.parameters));
            if near.distance > beyond && is_beyond(point, sample) {
                let distance = target.least(point).distance;
                violations.push(format!("upper {upper}, but a point of A is {distance} from B"));
                return;
            }
        }
        for &(sample, near) in found.iter().filter(|(sample, _)| !sample.is_rim).take(CLIMBS) {
            let sheet = &from_sheets[sample.sheet];
            if let Some(point) =
                climb((sample.sheet, sheet), sample.parameters, near, &target, &into, beyond, &is_beyond)
            {
                let distance = target.least(point).distance;
                violations.push(format!("upper {upper}, but a point of A is {distance} from B"));
                return;
            }
        }
    }

    /// Whether a point of A is proved farther than `limit` from all of B, in interval arithmetic.
    fn is_proved_beyond(&self, at: Sample, limit: f64, to_sheets: &[Sheet]) -> bool {
        if self.undecided.get() >= MAX_UNDECIDED {
            return false;
        }
        let prepare = || {
            let [from, to] = &self.poses;
            let motion = Motion {
                rotation: (to.rotation().inverse() * from.rotation()).to_array(),
                translation: to.apply_inverse(from.offset()).to_array(),
            };
            proof::Pair::new(&definition(self.from), &motion, &definition(self.to))
        };
        let deadline = Instant::now() + PROOF_TIME;
        let proof = self.proof.get_or_init(prepare);
        let Sample { sheet: surface, parameters, is_rim } = at;
        let is_farther = if self.from.is_trimmed() || self.to.is_trimmed() {
            // A point of a loop lies within a few roundings of its parameters.
            let error = if is_rim { RIM_ROUNDING * parameters.abs() } else { DVec2::ZERO };
            let corners = [parameters - error, parameters + error].map(|corner| corner.to_array());
            let side = |surface: usize, corners: [[f64; 2]; 2]| side(&to_sheets[surface], corners);
            proof.is_farther_from_part(surface, corners, limit, deadline, &side)
        } else {
            proof.is_farther(Witness { surface, u: parameters.x, v: parameters.y }, limit, deadline)
        };
        self.undecided.set(self.undecided.get() + usize::from(is_farther.is_none()));
        is_farther == Some(true)
    }
}

/// A point of A by its face and parameters, and whether it was taken from a loop.
#[derive(Clone, Copy)]
struct Sample {
    sheet: usize,
    parameters: DVec2,
    is_rim: bool,
}

/// Returns where a box of parameters is, compared with a face's region. A number other than 0 and
/// 1, of an overlap that validation accepts, counts as neither.
fn side(sheet: &Sheet, [low, high]: [[f64; 2]; 2]) -> Side {
    let Some(region) = &sheet.region else { return Side::Inside };
    match region.number(low.into(), high.into()) {
        Some(0) => Side::Outside,
        Some(1) => Side::Inside,
        _ => Side::Open,
    }
}

/// The model as the proofs read it: by its definition, without the library.
fn definition(model: &Model) -> proof::Model {
    proof::Model::from_json(&model.to_json().unwrap()).unwrap()
}

/// Returns random points of a face, with whether they are on a loop: one in each cell of a grid of
/// the domain and on each of its edges, and the corners, those that the face contains; and points
/// on and near its loops.
fn sample_parameters(sheet: &Sheet, rng: &mut Rng) -> Vec<(DVec2, bool)> {
    let mut samples = Vec::new();
    for index in 0..SAMPLES * SAMPLES {
        let [i, j] =
            [index / SAMPLES, index % SAMPLES].map(|cell| (cell as f64 + rng.f64()) / SAMPLES as f64);
        samples.push(sheet.at([i, j]));
    }
    for cell in 0..SAMPLES {
        let along = (cell as f64 + rng.f64()) / SAMPLES as f64;
        for end in [0.0, 1.0] {
            samples.extend([sheet.at([along, end]), sheet.at([end, along])]);
        }
    }
    for corner in [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]] {
        samples.push(sheet.at(corner));
    }
    let Some(region) = &sheet.region else {
        return samples.into_iter().map(|parameters| (parameters, false)).collect();
    };
    let mut rims = Vec::new();
    for curve in 0..region.curves() {
        for t in [0.0, rng.f64(), rng.f64(), rng.f64()] {
            let at = region.at(Rim { curve, t });
            rims.push((at, true));
            let offset = DVec2::from_angle(TAU * rng.f64()) * magnitude(rng, NEAR_LOOPS[0], NEAR_LOOPS[1]);
            samples.push(sheet.clamp(at + offset * sheet.extent()));
        }
    }
    let inside = samples.into_iter().filter(|&parameters| region.contains(parameters));
    inside.map(|parameters| (parameters, false)).chain(rims).collect()
}

/// Searches around a sample for farther points; returns one beyond the bound, if it
/// finds one.
fn climb(
    (index, sheet): (usize, &Sheet),
    start: DVec2,
    foot: Placed,
    target: &Target<'_>,
    into: &impl Fn(DVec3) -> DVec3,
    beyond: f64,
    is_beyond: &impl Fn(DVec3, Sample) -> bool,
) -> Option<DVec3> {
    let (mut at, mut best) = (start, foot);
    let mut step = sheet.extent() / SAMPLES as f64;
    for _ in 0..CLIMB_ROUNDS {
        let center = at;
        for i in -1..=1 {
            for j in -1..=1 {
                let parameters = sheet.clamp(center + step * DVec2::new(f64::from(i), f64::from(j)));
                if !sheet.contains(parameters) {
                    continue;
                }
                let point = into(sheet.point(parameters));
                let near = target.near(point, Some(best));
                if near.distance <= best.distance {
                    continue;
                }
                if near.distance > beyond {
                    if is_beyond(point, Sample { sheet: index, parameters, is_rim: false }) {
                        return Some(point);
                    }
                    continue;
                }
                (at, best) = (parameters, near);
            }
        }
        if at == center {
            step *= 0.5;
        }
    }
    None
}
