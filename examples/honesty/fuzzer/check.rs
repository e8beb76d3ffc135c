//! The check of one pair.

use super::attacks;
use super::brute::{Placed, Target};
use super::pairs::{Pair, pair};
use super::partners::scale_and_shift;
use super::sheet::{Sheet, sheets};
use crate::proof::{self, Motion, Witness};
use crate::support::evaluator::point;
use fastrand::Rng;
use glam::{DVec2, DVec3};
use nurbs_hausdorff::engine::{
    Backend, Details, DistanceResult, Engine, Options, PreparedModel, SurfacePoint,
};
use nurbs_hausdorff::progress::NoMonitor;
use nurbs_hausdorff::{Error, Model, RigidTransform};
use std::cell::{Cell, OnceCell};
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

/// The rounding error of points relative to the models' size, as each model is
/// evaluated relative to an origin near it.
const SIZE_ROUNDING: f64 = 1e-14;

/// The time after which the proof that a point is farther than `upper` is given up, and the number
/// of points of a direction that are given up before the others are left out.
const PROOF_TIME: Duration = Duration::from_secs(5);
const MAX_UNDECIDED: usize = 3;

/// The outcome of the check of a pair.
#[derive(Default)]
pub(crate) struct Outcome {
    pub(crate) converged: bool,
    pub(crate) cells: usize,
    /// The seconds of the computation, without the check.
    pub(crate) seconds: f64,
    /// Whether the engine refused the pair with a coded error.
    pub(crate) refused: bool,
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
    attacks::pair(seed)
        .map_or_else(|| Outcome { refused: true, ..Outcome::default() }, |pair| check_pair(seed, &pair))
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
    let result = match measure(pair, &options) {
        Ok(result) => result,
        Err(error) => {
            let violations =
                if is_refusal(&error) { Vec::new() } else { vec![format!("seed {seed}: {error}")] };
            return Outcome { refused: true, violations, ..Outcome::default() };
        }
    };
    let seconds = started.elapsed().as_secs_f64();
    let directions = [(Some(&result), false), (result.reverse.as_deref(), true)];
    let mut violations = Vec::new();
    let mut undecided = 0;
    for (directed, reversed) in directions {
        let Some(directed) = directed else { continue };
        let directed = if reversed { directed } else { result.forward.as_deref().unwrap_or(directed) };
        let direction = Direction::new(pair, directed, &options, reversed);
        violations.extend(direction.violations(&mut Rng::with_seed(seed)));
        undecided += usize::from(direction.undecided.get() > 0);
    }
    Outcome {
        converged: result.converged,
        cells: result.certified().map_or(0, |details| details.cells),
        seconds,
        refused: false,
        undecided,
        violations: violations
            .into_iter()
            .map(|what| format!("seed {seed} ({}): {what}", pair.kind))
            .collect(),
    }
}

/// Measures a pair scaled by its power of two, and returns the result scaled back.
fn measure(pair: &Pair, options: &Options) -> Result<DistanceResult, Error> {
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
    let [a, b] = scaled.map(|model| PreparedModel::new(&model).unwrap());
    let engine = if pair.backend == Backend::Cpu { &CPU } else { &GPU };
    let mut result = engine.with(|engine| {
        // `Auto` would not use an adapter in software.
        options.backend = if engine.has_gpu() { Backend::Gpu } else { Backend::Cpu };
        pollster::block_on(engine.distance(&a, &b, &options, &mut NoMonitor))
    })?;
    scale_back(&mut result, scale.recip());
    Ok(result)
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
    matches!(error.code(), "PAIR_BUDGET_EXCEEDED" | "NUMBER_TOO_LARGE" | "WEIGHT_RATIO_TOO_LARGE")
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
    /// The models for proofs, once one is needed, and the points on which none succeeded.
    proof: OnceCell<proof::Pair>,
    undecided: Cell<usize>,
}

impl<'a> Direction<'a> {
    fn new(pair: &'a Pair, result: &'a DistanceResult, options: &Options, reversed: bool) -> Self {
        let boxes = [pair.a.bounding_box(), pair.b.bounding_box()];
        let largest =
            boxes.iter().map(|aabb| aabb.min.abs().max(aabb.max.abs()).max_element()).fold(0.0, f64::max);
        let rounding = COORDINATE_ROUNDING * (largest + pair.transform.offset().length())
            + SIZE_ROUNDING * (result.diagonal + result.computed);
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
        let wide = upper - lower > details.tolerance + 200.0 * self.rounding;
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
        for ((model, pose), witness) in [self.from, self.to].into_iter().zip(&self.poses).zip(self.witness) {
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
            if error > self.rounding + parameter_error[0] + parameter_error[1] {
                violations.push(format!("a witness is {error} from the point at its parameters"));
            }
        }
        let between = start.distance(end);
        if (between - self.result.computed).abs() > self.rounding {
            violations.push(format!("the witnesses are {between} apart, computed {}", self.result.computed));
        }
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
        let witness_distance = target.least(start);
        if witness_distance < lower - self.rounding {
            violations.push(format!("lower {lower}, but B is {witness_distance} from the witness"));
        }
        let mut samples = vec![(witness.surface, DVec2::new(witness.u, witness.v), start)];
        for (index, sheet) in from_sheets.iter().enumerate() {
            for parameters in sample_parameters(sheet, rng) {
                samples.push((index, parameters, into(sheet.point(parameters))));
            }
        }
        let mut found: Vec<(usize, DVec2, Placed)> = samples
            .iter()
            .map(|&(index, parameters, point)| (index, parameters, target.near(point, None)))
            .collect();
        found[1..].sort_unstable_by(|a, b| b.2.distance.total_cmp(&a.2.distance));
        let beyond = upper + self.rounding;
        let is_beyond = |point: DVec3, at: (usize, DVec2)| {
            !target.is_within(point, beyond, at) && self.is_proved_beyond(at, beyond)
        };
        for &(index, parameters, near) in &found {
            let point = into(from_sheets[index].point(parameters));
            if near.distance > beyond && is_beyond(point, (index, parameters)) {
                violations.push(format!("upper {upper}, but a point of A is {} from B", target.least(point)));
                return;
            }
        }
        for &(index, parameters, near) in found.iter().take(CLIMBS) {
            let sheet = &from_sheets[index];
            if let Some(point) = climb((index, sheet), parameters, near, &target, &into, beyond, &is_beyond) {
                violations.push(format!("upper {upper}, but a point of A is {} from B", target.least(point)));
                return;
            }
        }
    }

    /// Whether a point of A is proved farther than `limit` from all of B, in interval arithmetic.
    fn is_proved_beyond(&self, (surface, parameters): (usize, DVec2), limit: f64) -> bool {
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
        let point = Witness { surface, u: parameters.x, v: parameters.y };
        let deadline = Instant::now() + PROOF_TIME;
        let is_farther = self.proof.get_or_init(prepare).is_farther(point, limit, deadline);
        self.undecided.set(self.undecided.get() + usize::from(is_farther.is_none()));
        is_farther == Some(true)
    }
}

/// The model as the proofs read it: by its definition, without the library.
fn definition(model: &Model) -> proof::Model {
    proof::Model::from_json(&model.to_json().unwrap()).unwrap()
}

/// Returns one random point of the domain in each cell of a grid and on each of its
/// edges, and the corners.
fn sample_parameters(sheet: &Sheet, rng: &mut Rng) -> Vec<DVec2> {
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
    samples
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
    is_beyond: &impl Fn(DVec3, (usize, DVec2)) -> bool,
) -> Option<DVec3> {
    let (mut at, mut best) = (start, foot);
    let mut step = sheet.extent() / SAMPLES as f64;
    for _ in 0..CLIMB_ROUNDS {
        let center = at;
        for i in -1..=1 {
            for j in -1..=1 {
                let parameters = sheet.clamp(center + step * DVec2::new(f64::from(i), f64::from(j)));
                let point = into(sheet.point(parameters));
                let near = target.near(point, Some(best));
                if near.distance <= best.distance {
                    continue;
                }
                if near.distance > beyond {
                    if is_beyond(point, (index, parameters)) {
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
